// Boost.Geometry: its R-tree, rebuilt in each frame and searched once for each box.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include "play.hpp"

namespace bg = boost::geometry;

template <int D> struct Boost {
  using Point = bg::model::point<float, D, bg::cs::cartesian>;
  using Box = bg::model::box<Point>;
  using Item = std::pair<Box, uint32_t>;
  std::vector<Item> items;

  Boost(int, uint32_t count, const float*) : items(count) {}

  template <int Axis = 0> static void put(Box& box, const float* numbers) {
    if constexpr (Axis < D) {
      bg::set<bg::min_corner, Axis>(box, numbers[Axis]);
      bg::set<bg::max_corner, Axis>(box, numbers[Axis + D]);
      put<Axis + 1>(box, numbers);
    }
  }

  void update(const float* frame, Pairs& pairs) {
    for (uint32_t id = 0; id < items.size(); id++, frame += 2 * D) {
      put(items[id].first, frame);
      items[id].second = id;
    }
    const bg::index::rtree<Item, bg::index::linear<16>> tree(items);
    for (const Item& item : items) {
      tree.query(bg::index::intersects(item.first), boost::make_function_output_iterator([&](const Item& other) {
                   if (other.second > item.second) pairs.emplace_back(item.second, other.second);
                 }));
    }
  }
};

int main(int arguments, char** values) { return play<Boost<DIMENSIONS>>(arguments, values); }

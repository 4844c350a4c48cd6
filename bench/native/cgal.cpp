// CGAL: the intersections of a sequence of boxes with itself.
#include <CGAL/box_intersection_d.h>
#include "play.hpp"

template <int D> struct Cgal {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<float, D, uint32_t>;
  std::vector<Box> boxes;
  uint32_t count;

  Cgal(int, uint32_t count, const float*) : count(count) {}

  void update(const float* frame, Pairs& pairs) {
    boxes.clear();
    for (uint32_t id = 0; id < count; id++, frame += 2 * D) {
      float low[D], high[D];
      std::copy(frame, frame + D, low);
      std::copy(frame + D, frame + 2 * D, high);
      boxes.emplace_back(low, high, id);
    }
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                  [&](const Box& a, const Box& b) { pairs.emplace_back(a.info(), b.info()); });
  }
};

int main(int arguments, char** values) { return play<Cgal<DIMENSIONS>>(arguments, values); }

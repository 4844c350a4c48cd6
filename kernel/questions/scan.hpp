// The first few queries after an update, answered without an index of all boxes.
// Idea: a scan of all boxes finds those that overlap the bounds of what is asked for. They get an index of their own,
// and that is searched. The bounds of a search for the nearest boxes follow from a sample: the k-th nearest of some
// boxes is no nearer than the k-th nearest of all.
// Cost: about 2 ns per box, and 15 for each that the scan finds.
#pragma once
#include "questions/queries.hpp"

enum class Search : u32 { area, ahead, near };

template <int D> class Scan {
  Index<D> index_;  // of the boxes found
  Buffer<u32> slots_;

 public:
  /// Makes an index of those boxes of another that can be answers. Null if building the other takes less time, or if
  /// answers may be left after `most` of those in an area: they would be read in the order of the other. `boxes`: all
  /// of them, rounded to the nearest. `hits`: has begun.
  SMALL Index<D>* find(const Index<D>& all, const f32* boxes, const Question<D>& asked, Search kind, u32 most,
                       Hits& hits) {
    f64 bounds[2 * D];
    if (kind == Search::ahead) {
      asked.path(bounds);
    } else if (kind == Search::area) {
      asked.around(larger(0.0, asked.radius), bounds);
    } else {
      if (!sample(all, boxes, most)) return nullptr;
      Queries<D>(index_, asked).near(hits);
      asked.around(hits.limit, bounds);
    }
    u32 many = all.overlapping(bounds, boxes, slots_);
    if (many > all.count() / 2 || (kind == Search::area && many >= most)) return nullptr;
    index_.take(all, boxes, slots_.data(), many);
    return &index_;
  }

  SMALL void release() {
    slots_.release();
    index_.forget();
  }

 private:
  /// Makes an index of some boxes, of which `most` are probably nearer than most others; false if there are too few.
  bool sample(const Index<D>& all, const f32* boxes, u32 most) {
    const u64 n = all.count(), some = u64(__builtin_sqrt(f64(n) * most)) + 1;
    if (some > n / 16) return false;
    slots_.reserve(some);
    for (u32 k = 0; k < some; k++) slots_[k] = u32(k * n / some);
    index_.take(all, boxes, slots_.data(), u32(some));
    return index_.places() > 0;
  }
};

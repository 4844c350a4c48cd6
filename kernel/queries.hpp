// The questions: what is in a box or a circle, what does a ray or a moving box meet, what is near.
// Idea: two walks through the index. The one for areas goes through the boxes in their order, eight at a time, and
// can go on from any place, so that an answer may be read in parts. The one for rays, moving boxes and neighbours
// has a number to rank boxes by, a time or a distance; it takes what promises the least first, and keeps the best in a
// heap, whose worst is the limit for all that follows. A ray is a moving box without size.
// All is decided in double precision, by the numbers that were given; the index, in float32 rounded outward, only says
// where to look. What ranks the same is ordered by id, so that answers do not depend on the index.
#pragma once
#include "index.hpp"
#include "rounding.hpp"

SMALL_CODE  // a question takes a microsecond and there are few: bytes count for more

/// What a question is asked with.
template <int D> struct Question {
  f64 lo[D] = {}, hi[D] = {};  // the box, or twice the point
  f64 along[D] = {};           // what a moving box moves by
  f64 radius = 0;              // of a circle; negative: none
  f64 limit = 0;               // the largest rank
  f64 length = 0;              // of the way, where its share is to be ranked by distance; else 1
  u32 mask = 0;                // layers; all bits: every box, even one without a layer
  u32 ignored = 0;             // an id
};

struct Hit {
  f64 rank;  // what the moving box has moved, or distance squared
  u32 id;
  i32 side;  // of moving boxes: axis + 1 of the face that is hit, negative where its normal is; 0: none

  bool operator<(const Hit& other) const { return rank < other.rank || (rank == other.rank && id < other.id); }
};

/// The least `most` of the hits behind a given one, as a heap with the largest on top.
class Hits {
  Buffer<Hit> heap_;
  u32 count_ = 0, most_ = 0;
  bool after_ = false;
  Hit last_ = {};

  void sift(u32 at, u32 count, Hit hit) {
    for (u32 child; (child = 2 * at + 1) < count; at = child) {
      if (child + 1 < count && heap_[child] < heap_[child + 1]) child++;
      if (!(hit < heap_[child])) break;
      heap_[at] = heap_[child];
    }
    heap_[at] = hit;
  }

 public:
  f64 limit = 0;  // no hit of a larger rank is wanted

  const Hit* data() const { return heap_.data(); }

  void begin(u32 most, f64 most_rank, const Hit* after) {
    count_ = 0;
    most_ = most;
    limit = most_rank;
    after_ = after;
    if (after) last_ = *after;
  }

  void offer(Hit hit) {
    if (!(hit.rank <= limit) || (after_ && !(last_ < hit))) return;
    if (count_ < most_) {
      heap_.grow(u64(count_) + 1, count_);
      u32 at = count_++;
      for (u32 above; at > 0 && heap_[above = (at - 1) / 2] < hit; at = above) heap_[at] = heap_[above];
      heap_[at] = hit;
    } else if (hit < heap_[0]) {
      sift(0, count_, hit);
    }
    if (count_ == most_) limit = smaller(limit, heap_[0].rank);
  }

  /// Puts them in order, the least first; returns how many.
  COLD u32 finish() {
    for (u32 n = count_; n-- > 1;) {
      Hit least = heap_[n];
      heap_[n] = heap_[0];
      sift(0, n, least);
    }
    return count_;
  }

  COLD void release() { heap_.release(); }
};

template <int D> class Queries {
  using Block = typename Index<D>::Block;

  const Index<D>& index_;
  const Question<D>& asked_;
  f32x4 lo_[D], hi_[D];  // what is to be looked at, rounded outward
  f32x4 above_[D], below_[D];  // the point, rounded both ways
  f64 squared_;          // the circle's radius
  bool moving_ = false;  // rank by what the box meets, not by distance

 public:
  Queries(const Index<D>& index, const Question<D>& asked) : index_(index), asked_(asked) {
    squared_ = asked.radius * asked.radius;
  }

  /// Writes the ids of the boxes that touch the box or the circle, in the order of the index from place `from` on, at
  /// most so many. Returns how many; `from` becomes the place to go on from, or the number of boxes.
  COLD u32 area(u32& from, u32 most, Buffer<u32>& answers) {
    bool circle = asked_.radius >= 0, exact = circle || index_.rounded();
    for (int a = 0; a < D; a++) {
      f64 lo = asked_.lo[a], hi = asked_.hi[a];
      if (circle) {
        // Differences to the edge may have been rounded.
        lo -= asked_.radius + (asked_.radius + __builtin_fabs(lo)) * 1e-15;
        hi += asked_.radius + (asked_.radius + __builtin_fabs(hi)) * 1e-15;
      }
      exact |= aim(a, lo, hi, circle);
    }
    u32 found = 0, count = index_.count();
    bool all = walk(index_.top(), 0, from, [&](u32 place) {
      if (exact && !touches(place)) return true;
      if (!wanted(place)) return true;
      if (found == most) {
        from = place;
        return false;
      }
      if (found >= answers.capacity()) answers.grow(u64(found) + 1, found);
      answers[found++] = index_.id(place);
      return true;
    });
    if (all) from = count;
    return found;
  }

  /// The first boxes that the moving box meets, by how far it has moved then.
  COLD void cast(Hits& hits) {
    moving_ = true;
    for (int a = 0; a < D; a++) {
      // The way to the limit, and some more for the roundings.
      f64 reach = asked_.along[a] * (asked_.limit / asked_.length) * (1 + 1e-9);
      if (!(reach == reach)) reach = 0;  // no way at all, however long it takes
      aim(a, asked_.lo[a] + smaller(0.0, reach), asked_.hi[a] + larger(0.0, reach), true);
    }
    search(index_.top(), 0, hits);
  }

  /// The nearest boxes to the point, by distance squared.
  COLD void near(Hits& hits) {
    for (int a = 0; a < D; a++) {
      aim(a, -__builtin_inf(), __builtin_inf(), false);
      above_[a] = splat(round_up(asked_.lo[a]));
      below_[a] = splat(round_down(asked_.lo[a]));
    }
    search(index_.top(), 0, hits);
  }

 private:
  /// Sets what is to be looked at along an axis; says whether float32 cannot hold it. `slack`: a little more.
  bool aim(int axis, f64 lo, f64 hi, bool slack) {
    f32 low = round_down(lo), high = round_up(hi);
    bool exact = f64(low) == lo && f64(high) == hi;
    if (slack) {
      low = detail::is_finite(low) ? next_toward(low, false) : low;
      high = detail::is_finite(high) ? next_toward(high, true) : high;
    }
    lo_[axis] = splat(low);
    hi_[axis] = splat(high);
    return !exact;
  }

  /// One bit for each of the eight that touch what is to be looked at.
  u32 touched(const Block& block) const {
    u32 found = 0;
    for (u32 half = 0; half < 8; half += 4) {
      i32x4 all = bits<i32x4>(u32x4{} == u32x4{});
      for (int a = 0; a < D; a++) {
        all &= load<f32x4>(block.lo[a] + half) <= hi_[a];
        all &= load<f32x4>(block.hi[a] + half) >= lo_[a];
      }
      found |= bitmask(all) << half;
    }
    return found;
  }

  bool wanted(u32 place) const {
    return (asked_.mask == 0xffffffff || (index_.layer(place) & asked_.mask)) && index_.id(place) != asked_.ignored;
  }

  bool touches(u32 place) const {
    f64 box[2 * D];
    index_.box(place, box);
    if (asked_.radius >= 0) return distance(box) <= squared_;
    bool overlap = true;
    for (int a = 0; a < D; a++) overlap &= box[a] <= asked_.hi[a] && asked_.lo[a] <= box[D + a];
    return overlap;
  }

  f64 meeting(const Block& block, u32 lane) const {
    f64 box[2 * D];
    i32 side;
    for (int a = 0; a < D; a++) {
      box[a] = block.lo[a][lane];
      box[D + a] = block.hi[a][lane];
    }
    return meeting(box, side);
  }

  /// Of the point to a box, squared.
  __attribute__((noinline)) f64 distance(const f64* box) const {
    f64 sum = 0;
    for (int a = 0; a < D; a++) {
      f64 away = 0;
      if (asked_.lo[a] < box[a]) away = box[a] - asked_.lo[a];
      else if (asked_.lo[a] > box[D + a]) away = asked_.lo[a] - box[D + a];
      sum += away * away;
    }
    return sum;
  }

  /// How far the moving box moves until it meets a box, and the side it meets; NaN: never.
  __attribute__((noinline)) f64 meeting(const f64* box, i32& side) const {
    f64 enter = 0, leave = __builtin_inf();
    for (int a = 0; a < D; a++) {
      f64 along = asked_.along[a];
      f64 ahead = box[a] - asked_.hi[a], behind = box[D + a] - asked_.lo[a];  // to the first and the last touch
      bool before = asked_.hi[a] < box[a], past = asked_.lo[a] > box[D + a];
      if (before || past) {
        if (before ? !(along > 0) : !(along < 0)) return __builtin_nan("");
        f64 time = (before ? ahead : behind) / along;
        if (time > enter || side == 0) {
          enter = time;
          side = before ? -(a + 1) : a + 1;
        }
      }
      // The same infinity on both sides is never left.
      f64 way = along > 0 ? behind : ahead;
      if (along != 0 && way == way) leave = smaller(leave, way / along);
    }
    return enter <= leave && enter < __builtin_inf() ? enter * asked_.length : __builtin_nan("");
  }

  /// No more than the squared distances of the point to eight boxes: what roundings may add is taken off.
  void least_distances(const Block& block, f32 (&to)[8]) const {
    for (u32 half = 0; half < 8; half += 4) {
      f32x4 sum = {};
      for (int a = 0; a < D; a++) {
        f32x4 away = max(load<f32x4>(block.lo[a] + half) - above_[a], below_[a] - load<f32x4>(block.hi[a] + half));
        away = max(away, f32x4{});
        sum += away * away;
      }
      store(to + half, min(sum * splat(0.999999f), splat(1e38f)));
    }
  }

  f64 rank(const f64* box, i32& side) const {
    side = 0;
    return moving_ ? meeting(box, side) : distance(box);
  }

  /// Calls `take` for the places from `from` on that are touched, in their order, until it returns false.
  template <class Take> bool walk(u32 level, u32 number, u32 from, const Take& take) const {
    for (u32 left = touched(index_.block(level, number)); left; left &= left - 1) {
      u32 child = number * 8 + u32(__builtin_ctz(left));
      if ((u64(child) + 1) << (3 * level) <= from) continue;
      if (!(level == 0 ? take(child) : walk(level - 1, child, from, take))) return false;
    }
    return true;
  }

  /// Offers the boxes to `hits` by their rank, the most promising first.
  void search(u32 level, u32 number, Hits& hits) const {
    const Block& block = index_.block(level, number);
    f64 ranks[8];
    f32 distances[8];
    u32 order[8], n = 0;
    i32 side;
    if (!moving_) least_distances(block, distances);
    for (u32 left = touched(block); left; left &= left - 1) {
      u32 lane = u32(__builtin_ctz(left));
      f64 least = moving_ ? meeting(block, lane) : f64(distances[lane]);
      if (!(least <= hits.limit)) continue;
      u32 at = n++;
      for (; at > 0 && least < ranks[at - 1]; at--) {
        ranks[at] = ranks[at - 1];
        order[at] = order[at - 1];
      }
      ranks[at] = least;
      order[at] = number * 8 + lane;
    }
    for (u32 k = 0; k < n && ranks[k] <= hits.limit; k++) {
      if (level > 0) {
        search(level - 1, order[k], hits);
      } else if (wanted(order[k])) {
        f64 box[2 * D];
        index_.box(order[k], box);
        f64 exact = rank(box, side);
        hits.offer({exact, index_.id(order[k]), side});
      }
    }
  }
};

END_OF_SMALL_CODE

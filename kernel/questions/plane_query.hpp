// The query for planes: boxes that are not wholly behind any of them, such as those that a camera sees.
// Idea: a box is behind a plane if its foremost corner is, and in front of it if its hindmost corner is. The traversal
// goes down the index with the planes that still cut: a block wholly in front of a plane is not tested against it
// again, and once no plane is left, everything in the block is inside and taken without tests. Distances are summed in
// doubles, axis by axis. Each rounding is monotone, so no corner of a block is further behind than that of a box in it:
// the answers equal those of testing box by box.
// Cost, of 500,000 boxes in 3D: 0.03 ms for a view of 600 of them, 0.2 ms for 15,000, 1 ms for 66,000.
// From: N. Greene, "Detecting Intersection of a Rectangular Solid and a Convex Polyhedron", Graphics Gems IV, 1994;
// U. Assarsson and T. Möller, "Optimized View Frustum Culling Algorithms for Bounding Boxes", 2000.
#pragma once
#include "questions/queries.hpp"

template <int D> struct Planes {
  static constexpr u32 most_planes = 8;

  f64 normal[most_planes][D] = {};
  f64 offset[most_planes] = {};  // a point is in front where normal · point + offset is at least 0
  u32 count = 0;
};

template <int D> class PlaneQuery {
  using Block = typename Index<D>::Block;
  static constexpr u32 behind = 0xffffffff;  // in place of the planes that cut a box

  const Index<D>& index_;
  const Planes<D>& planes_;
  const Wanted<D> wanted_;
  const bool touching_;  // whether what only touches a plane is in front of it
  const bool takes_all_;  // what is inside, without a look at each box
  u32 from_ = 0, most_ = 0, found_ = 0, looks_ = 0;

 public:
  /// With the ids of boxes that are in front of all planes.
  static constexpr u32 inside = 0x80000000;

  PlaneQuery(const Index<D>& index, const Question<D>& asked, const Planes<D>& planes)
      : index_(index),
        planes_(planes),
        wanted_(index, asked),
        touching_(asked.touching),
        takes_all_(wanted_.all() && !index.holes()) {}

  u32 looks() const { return looks_; }

  /// Writes the ids of the boxes that are not behind a plane: as Queries::area.
  SMALL u32 search(u32& from, u32 most, Buffer<u32>& answers) {
    from_ = from;
    most_ = most;
    from = walk(index_.top(), 0, (1u << planes_.count) - 1, answers) ? index_.places() : from_;
    return found_;
  }

 private:
  /// Looks on which side of some planes, a bit each, the eight boxes of a block are. Returns a bit for each box that is
  /// behind none; `front` has, for each of the planes, a bit for each box that is in front of it.
  SHARED u32 look(const Block& block, u32 planes, u32 (&front)[Planes<D>::most_planes]) const {
    u32 left = 0;
    for (u32 half = 0; half < 8; half += 4) {
      f32x4 lo = load<f32x4>(block.lo[0] + half);
      left |= bitmask(lo == lo) << half;  // else there is no box
    }
    for (; planes && left; planes &= planes - 1) {
      u32 p = u32(__builtin_ctz(planes));
      front[p] = 0;
      ROLLED for (u32 lane = 0; lane < 8; lane += 2) {
        f64x2 foremost = {}, hindmost = {};
        for (int a = 0; a < D; a++) {
          f64 normal = planes_.normal[p][a];
          if (normal == 0) continue;  // an infinite box is no matter there
          bool up = normal > 0;
          foremost += splat(normal) * __builtin_convertvector(load<f32x2>((up ? block.hi : block.lo)[a] + lane), f64x2);
          hindmost += splat(normal) * __builtin_convertvector(load<f32x2>((up ? block.lo : block.hi)[a] + lane), f64x2);
        }
        foremost += splat(planes_.offset[p]);
        hindmost += splat(planes_.offset[p]);
        left &= ~((touching_ ? below(foremost, f64x2{}) : at_most(foremost, f64x2{})) << lane);
        front[p] |= (touching_ ? at_most(f64x2{}, hindmost) : below(f64x2{}, hindmost)) << lane;
      }
    }
    return left;
  }

  /// Which of the planes cut a box in the numbers it was given with; or `behind`.
  SMALL u32 exactly(u32 place, u32 planes) const {
    f64 box[2 * D];
    index_.box(place, box);
    u32 cut = 0;
    for (; planes; planes &= planes - 1) {
      u32 p = u32(__builtin_ctz(planes));
      f64 foremost = 0, hindmost = 0;
      for (int a = 0; a < D; a++) {
        f64 normal = planes_.normal[p][a];
        if (normal == 0) continue;
        foremost += normal * box[normal > 0 ? D + a : a];
        hindmost += normal * box[normal > 0 ? a : D + a];
      }
      foremost += planes_.offset[p];
      hindmost += planes_.offset[p];
      if (touching_ ? foremost < 0 : foremost <= 0) return behind;
      if (!(touching_ ? hindmost >= 0 : hindmost > 0)) cut |= 1u << p;
    }
    return cut;
  }

  /// Adds the answers from place `from_` on; false where there are more than are wanted: `from_` is then the next.
  bool walk(u32 level, u32 number, u32 planes, Buffer<u32>& answers) {
    u32 front[Planes<D>::most_planes];
    looks_++;
    u32 left = look(index_.block(level, number), planes, front);
    if (level == 0) {
      if (from_ > number * 8) left &= 0xff << (from_ - number * 8);
      answers.grow(u64(found_) + 8, found_);
    }
    for (; left; left &= left - 1) {
      u32 lane = u32(__builtin_ctz(left)), child = number * 8 + lane, cut = 0;
      for (u32 rest = planes; rest; rest &= rest - 1) {
        u32 p = u32(__builtin_ctz(rest));
        cut |= (~front[p] >> lane & 1) << p;
      }
      if (!(level == 0 ? offer(child, cut, answers) : descend(level, child, cut, answers))) return false;
    }
    return true;
  }

  bool offer(u32 place, u32 cut, Buffer<u32>& answers) {
    if (cut && index_.rounded()) cut = exactly(place, cut);
    if (cut == behind || !wanted_(place)) return true;
    if (found_ == most_) {
      from_ = place;
      return false;
    }
    answers[found_++] = index_.id(place) | (cut ? 0 : inside);
    return true;
  }

  bool descend(u32 level, u32 child, u32 cut, Buffer<u32>& answers) {
    u32 first = child << (3 * level), end = smaller((child + 1) << (3 * level), index_.places());
    if (end <= from_) return true;
    if (cut || !takes_all_) return walk(level - 1, child, cut, answers);
    first = larger(first, from_);
    u32 taken = smaller(end - first, most_ - found_);
    answers.grow(u64(found_) + taken, found_);
    for (u32 k = 0; k < taken; k++) answers[found_++] = index_.id(first + k) | inside;
    if (taken == end - first) return true;
    from_ = first + taken;
    return false;
  }
};

// The query for planes: boxes that are not wholly behind any of them, such as those that a camera sees.
// Idea: a box is behind a plane if its foremost corner is, and in front of it if its hindmost corner is. The traversal
// goes down the index with the planes that still cut: a block wholly in front of a plane is not tested against it
// again, and once no plane is left, everything in the block is inside and taken without tests. Distances are summed in
// doubles, axis by axis. Each rounding is monotone, so no corner of a block is further behind than that of a box in it:
// the answers equal those of testing box by box.
// In a world that wraps around, the planes are shifted by whole worlds and the search is repeated, one turn per shift:
// a box is tested at its place in the world and one world further along each axis, and taken in the first turn in which
// it is behind no plane. Turns in which the planes are beside all boxes are left out, and what is inside in the first of
// the others needs no further test.
// Cost, of 500,000 boxes in 3D: 0.03 ms for a view of 600 of them, 0.2 ms for 15,000, 1 ms for 66,000.
// From: N. Greene, "Detecting Intersection of a Rectangular Solid and a Convex Polyhedron", Graphics Gems IV, 1994;
// U. Assarsson and T. Möller, "Optimized View Frustum Culling Algorithms for Bounding Boxes", 2000.
#pragma once
#include "questions/question.hpp"

template <int D> struct Planes {
  static constexpr u32 most_planes = 8;

  f64 normal[most_planes][D] = {};
  f64 offset[most_planes] = {};  // a point is in front where normal · point + offset is at least 0
  u32 count = 0;
};

template <int D> class PlaneQuery {
  using Block = typename Index<D>::Block;
  static constexpr u32 behind = 0xffffffff;  // instead of a set of planes

  const Index<D>& index_;
  const Planes<D>& planes_;
  f64 offset_[Planes<D>::most_planes];  // of the planes, shifted for the present turn
  f64 doubt_[Planes<D>::most_planes] = {};  // a box further in front than that is so in spite of rounding errors
  const f64* const world_;  // its size if it wraps around, else null
  const f64 origin_[D] = {};
  Copies copies_;  // used only then: copies of the origin
  u32 turn_ = 0, turns_seen_ = 1;  // turns in which some boxes may be in front, a bit each
  const Wanted<D> wanted_;
  const bool touching_;  // whether a box that only touches a plane from behind is in front of it
  const bool takes_all_;  // whether all boxes of a block that is inside are taken without tests
  u32 from_ = 0, most_ = 0, found_ = 0, looks_ = 0;

 public:
  /// A flag on the ids of boxes that are in front of all planes.
  static constexpr u32 inside = 0x80000000;

  SMALL PlaneQuery(const Index<D>& index, const Question<D>& asked, const Planes<D>& planes)
      : index_(index),
        planes_(planes),
        world_(index.world()),
        wanted_(index, asked),
        touching_(asked.touching),
        takes_all_(wanted_.all() && !index.holes()) {
    __builtin_memcpy(offset_, planes.offset, sizeof(offset_));
    if (world_) copies_.begin(world_, D, origin_, origin_);
  }

  u32 looks() const { return looks_; }

  /// Writes the ids of the boxes that are not behind a plane: as Queries::area.
  SMALL u32 search(u32& from, u32 most, Buffer<u32>& answers) {
    most_ = most;
    u32 places = index_.places(), turns = world_ ? Copies::turns(D) : 1;
    if (world_) look_around();
    turn_ = world_ ? from / places : 0;
    for (from_ = from - turn_ * places; turn_ < turns; turn_++, from_ = 0) {
      if (!(turns_seen_ >> turn_ & 1)) continue;
      if (world_) aim();
      if (walk(index_.top(), 0, (1u << planes_.count) - 1, answers)) continue;
      from = turn_ * places + from_;
      return found_;
    }
    from = turn_ * places;
    return found_;
  }

 private:
  /// Leaves out turns in which all boxes are behind a plane.
  SMALL void look_around() {
    turns_seen_ = 0;
    for (turn_ = 0; turn_ < Copies::turns(D); turn_++) {
      u32 front[Planes<D>::most_planes];
      aim();
      bool some = look(index_.block(index_.top(), 0), (1u << planes_.count) - 1, front);
      turns_seen_ |= u32(some) << turn_;
    }
  }

  /// Whether an earlier turn may have found the same boxes.
  bool may_be_found() const { return turns_seen_ & ((1u << turn_) - 1); }

  /// Shifts the planes for a turn, and moves them back a little, by a bound for the rounding errors.
  SMALL void aim() {
    copies_.take(turn_);
    for (u32 p = 0; p < planes_.count; p++) {
      f64 moved = planes_.offset[p], size = __builtin_fabs(moved);
      for (int a = 0; a < D; a++) {
        moved -= planes_.normal[p][a] * (copies_.turn(a) * world_[a]);
        size += __builtin_fabs(planes_.normal[p][a]) * 4 * world_[a];
      }
      doubt_[p] = size * 0x1p-47;
      offset_[p] = moved + size * 0x1p-48;
    }
  }

  /// Tests the eight boxes of a block against a set of planes, one bit each. Returns a bit for each box that is behind
  /// none; `front` gets, for each plane, a bit for each box in front of it.
  NOINLINE u32 look(const Block& block, u32 planes, u32 (&front)[Planes<D>::most_planes]) const {
    u32 left = 0;
    for (u32 half = 0; half < 8; half += 4) {
      f32x4 lo = load<f32x4>(block.lo[0] + half);
      left |= bitmask(lo == lo) << half;  // NaN: no box
    }
    for (; planes && left; planes &= planes - 1) {
      u32 p = u32(__builtin_ctz(planes));
      front[p] = 0;
      ROLLED for (u32 lane = 0; lane < 8; lane += 2) {
        f64x2 foremost = {}, hindmost = {};
        for (int a = 0; a < D; a++) {
          f64 normal = planes_.normal[p][a];
          if (normal == 0) continue;  // 0 times an infinite bound would be NaN
          bool up = normal > 0;
          foremost += splat(normal) * __builtin_convertvector(load<f32x2>((up ? block.hi : block.lo)[a] + lane), f64x2);
          hindmost += splat(normal) * __builtin_convertvector(load<f32x2>((up ? block.lo : block.hi)[a] + lane), f64x2);
        }
        foremost += splat(offset_[p]);
        hindmost += splat(offset_[p] - doubt_[p]);
        left &= ~((touching_ ? below(foremost, f64x2{}) : at_most(foremost, f64x2{})) << lane);
        front[p] |= (touching_ ? at_most(f64x2{}, hindmost) : below(f64x2{}, hindmost)) << lane;
      }
    }
    return left;
  }

  /// The set of planes that cut a box, by the numbers it was given with; or `behind`.
  SMALL u32 exactly(const f64* box, u32 planes) const {
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

  /// The same in a world that wraps around: 0 if any of its copies is inside; `behind` also if an earlier turn has
  /// found the box.
  SMALL u32 exactly_around(const f64* box) const {
    Copies at = copies_;
    Copies::Home home = at.home_of(box);
    u32 least = behind;
    for (u32 left = turns_seen_; left; left &= left - 1) {
      u32 turn = u32(__builtin_ctz(left));
      f64 copy[2 * D];
      at.take(turn);
      at.copy(home, box, copy);
      u32 cut = exactly(copy, (1u << planes_.count) - 1);
      if (turn < turn_ && cut != behind) return behind;
      if (turn == turn_ && cut == behind) return behind;
      if (least != 0 && cut != behind) least = cut;
      if (least == 0 && turn >= turn_) return 0;  // the other turns change nothing
    }
    return least;
  }

  /// Adds the answers from place `from_` on; false if there are more than `most_`: `from_` is then where to resume.
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
    if (may_be_found() || (cut && index_.rounded())) {
      f64 box[2 * D];
      index_.box(place, box);
      cut = world_ ? exactly_around(box) : exactly(box, cut);
    }
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
    if (cut || may_be_found() || !takes_all_) return walk(level - 1, child, cut, answers);
    first = larger(first, from_);
    u32 taken = smaller(end - first, most_ - found_);
    answers.grow(u64(found_) + taken, found_);
    for (u32 k = 0; k < taken; k++) answers[found_++] = index_.id(first + k) | inside;
    if (taken == end - first) return true;
    from_ = first + taken;
    return false;
  }
};

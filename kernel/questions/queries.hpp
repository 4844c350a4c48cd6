// The queries: what is in a box or a circle, what a ray or a moving box hits, what is near.
// Idea: two traversals of the index. The one for areas visits the boxes in their order, eight at a time, takes blocks
// wholly within the area without further tests, and can resume anywhere, so that an answer may be read in parts. The
// one for rays, moving boxes and neighbours ranks boxes by a time or a distance: it computes a lower bound for eight at
// once, in float32, visits the smallest first, and keeps the best found, the worst of which limits the rest of the
// search. A ray is a moving box of zero size. Everything is decided in double precision, by the numbers given; the
// index, in float32 rounded outward, only prunes. Ties are ordered by id, so that answers do not depend on the index.
// Cost, among 10,000 boxes: 0.4 us for a box with 20 in it, 0.5 us for a ray that goes far, 1.4 us for the 10 nearest.
#pragma once
#include "questions/area_aim.hpp"
#include "questions/cast_aim.hpp"
#include "questions/question.hpp"

template <int D> class Queries {
  using Block = typename Index<D>::Block;

  const Index<D>& index_;
  const Question<D>& asked_;
  const f64* const world_;  // its size if it wraps around, else null
  Copies copies_;  // used only then
  f64 reach_[D];  // how far the moving box may get
  Hits* hits_ = nullptr;  // for moving boxes
  AreaAim<D> area_;  // what is searched; of a moving box, all that it may get to
  f32x4 above_[D], below_[D];  // the point, rounded outward
  CastAim<D> aim_;  // the moving box
  f64 unit_ = 1;  // of a circle: what distances are multiplied by, so that their squares fit
  f64 squared_ = 0;  // its radius in that unit, squared
  f64 scale_ = 1;  // from ranks to estimated times
  bool is_tame_ = true;  // whether times may be estimated
  const u32* const names_;  // what answers consist of: ids, or slots if another space asks
  const Wanted<D> wanted_;
  const bool all_wanted_;
  // The bits of a float without its sign, shifted by this, are those of one below 2^-126, in the same order.
  static constexpr u32 around_shift = 9;
  f32 most_rank_ = 0;  // the limit, in the unit of the lower bounds
  u32 from_ = 0, most_ = 0, found_ = 0, looks_ = 0;

 public:
  SMALL Queries(const Index<D>& index, const Question<D>& asked)
      : index_(index),
        asked_(asked),
        world_(index.world()),
        names_(asked.layer ? index.slots() : index.ids()),
        wanted_(index, asked),
        all_wanted_(wanted_.all()) {
    if (world_) begin_around();
  }

  /// The number of blocks visited.
  u32 looks() const { return looks_; }

  /// Writes the ids of the boxes that touch the box or the circle, in the order of the index from place `from` on, at
  /// most `most`, after those already found. Returns how many; sets `from` to where to resume, or to the number of
  /// boxes.
  SMALL u32 area(u32& from, u32 most, Buffer<u32>& answers, u32 found = 0) {
    most_ = most;
    found_ = found;
    if (is_circle()) {
      unit_ = unit_of(asked_.radius * asked_.radius);
      squared_ = asked_.radius * unit_ * (asked_.radius * unit_);
    }
    // In a world that wraps around, each turn counts its places on from those of the turn before.
    u32 places = index_.places(), turn = world_ ? from / places : 0;
    for (from_ = from - turn * places; turn < turns(); turn++, from_ = 0) {
      if (world_ && !(copies_.take(turn) && copies_.may_meet())) continue;
      aim_area();
      if (walk(index_.top(), 0, answers)) continue;
      from = turn * places + from_;
      return found_;
    }
    from = turn * places;
    return found_;
  }

  /// The first boxes that the moving box meets, ranked by how far it has moved by then.
  SMALL void cast(Hits& hits) {
    scale_ = asked_.scale();
    for (int a = 0; a < D; a++) reach_[a] = asked_.reach(a);
    hits_ = &hits;
    auto one = [](void* self) { static_cast<Queries*>(self)->cast_once(); };
    if (world_) copies_.pass(reach_, one, this);
    else cast_once();
  }

  /// The boxes nearest to a box, which usually is a point.
  SMALL void near(Hits& hits) {
    for (u32 turn = 0; turn < turns(); turn++) {
      if (world_ && !copies_.take(turn)) continue;
      for (int a = 0; a < D; a++) {
        above_[a] = splat(round_up(high(a)));
        below_[a] = splat(round_down(low(a)));
      }
      set_most<false>(hits.limit);
      search<false>(index_.top(), 0, hits);
    }
  }

 private:
  /// In a world that wraps around: leaves out turns that find nothing.
  SMALL void begin_around() {
    copies_.begin(world_, D, asked_.lo, asked_.hi);
    copies_.limit(reinterpret_cast<const f32*>(&index_.block(index_.top(), 0)), larger(0.0, asked_.radius));
  }

  /// The bounds of the query, as searched in this turn.
  f64 low(int a) const { return world_ ? copies_.end(a, false) : asked_.lo[a]; }
  f64 high(int a) const { return world_ ? copies_.end(a, true) : asked_.hi[a]; }

  u32 turns() const { return world_ ? Copies::turns(D) : 1; }

  SMALL void cast_once() {
    aim_ahead();
    set_most<true>(hits_->limit);
    search<true>(index_.top(), 0, *hits_);
  }

  SMALL void aim_area() {
    for (int a = 0; a < D; a++) {
      f64 lo = low(a), hi = high(a);
      if (is_circle()) {
        lo = asked_.widened(lo, -asked_.radius);
        hi = asked_.widened(hi, asked_.radius);
      }
      area_.set(a, lo, hi, asked_.touching || is_circle());
    }
  }

  SMALL void aim_ahead() {
    f64 lo[D], hi[D];
    for (int a = 0; a < D; a++) {
      lo[a] = low(a);
      hi[a] = high(a);
      f32 least = round_down(lo[a] + smaller(0.0, reach_[a])), most = round_up(hi[a] + larger(0.0, reach_[a]));
      area_.lo[a] = splat(is_finite(least) ? next_toward(least, false) : least);
      area_.hi[a] = splat(is_finite(most) ? next_toward(most, true) : most);
    }
    is_tame_ = aim_.take(lo, hi, asked_.along) && asked_.length > 0;
  }

  /// Whether a box at this distance, squared, is in the circle.
  bool is_in(f64 squared) const { return asked_.touching ? squared <= squared_ : squared < squared_; }

  /// Whether a square is neither so large nor so small that digits are lost: from 2^-930 to 2^996, by its exponent.
  static bool is_plain(f64 squared) { return (bits<u64>(squared) >> 52) - (1023 - 930) < 930 + 996; }

  /// A power of two: if distances are multiplied by it, their squares have all digits.
  static f64 unit_of(f64 squared) { return is_plain(squared) ? 1 : squared < 1 ? 0x1p600 : 0x1p-600; }

  SMALL static f64 squared(const f64 (&away)[D], f64 unit) {
    f64 sum = 0;
    for (int a = 0; a < D; a++) sum += away[a] * unit * (away[a] * unit);
    return sum;
  }

  SMALL static f64 length_of(const f64 (&away)[D]) {
    f64 unit = unit_of(squared(away, 1));
    return __builtin_sqrt(squared(away, unit)) / unit;
  }

  /// A circle of radius 0 at the side of a box touches it. If touching does not count, it is treated as a point.
  bool is_circle() const { return asked_.radius > 0 || (asked_.radius == 0 && asked_.touching); }

  bool wanted(u32 place) const { return all_wanted_ || wanted_(place); }

  /// Of eight boxes that touch in float32, those that touch in the numbers given; in a world that wraps around, in this
  /// turn and in no earlier one.
  SMALL u32 touching(u32 number, u32 left) const {
    f64 ranks[8];
    const bool circle = is_circle(), whole = asked_.radius == Question<D>::within, plain = unit_ == 1 && !world_;
    if (circle && !world_) left &= distances(number, plain ? squared_ : squared_limit(asked_.radius), ranks);
    if (!index_.rounded() && whole) return left & area_.within(index_.block(0, number));
    if (!index_.rounded() && (!circle || (plain && asked_.touching))) return left;
    for (u32 all = left; all; all &= all - 1) {
      u32 lane = u32(__builtin_ctz(all));
      if (!(circle && plain ? is_in(ranks[lane]) : touches(number * 8 + lane, circle, whole))) left &= ~(1u << lane);
    }
    return left;
  }

  bool touches(u32 place, bool circle, bool whole) const {
    f64 box[2 * D], to[D];
    if (circle) return away(place, to) && is_in(squared(to, unit_));
    index_.box(place, box);
    return world_ ? copies_.touches(box, whole, asked_.touching) : asked_.touches(box, whole);
  }

  /// Adds the answers from place `from_` on; false if there are more than `most_`: `from_` is then where to resume.
  bool walk(u32 level, u32 number, Buffer<u32>& answers) {
    const Block& block = index_.block(level, number);
    looks_++;
    u32 left = area_.touched(block);
    if (level == 0) {
      if (from_ > number * 8) left &= 0xff << (from_ - number * 8);
      answers.grow(u64(found_) + 8, found_);
      left = touching(number, left);
      if (all_wanted_ && most_ - found_ >= 8) {
        // No branch for each box: which of them touch is unpredictable.
        for (u32 half = 0; half < 8; half += 4, left >>= 4) {
          store(answers.data() + found_, packed(load<u32x4>(names_ + number * 8 + half), left & 15));
          found_ += bits_set[left & 15];
        }
        return true;
      }
      for (; left; left &= left - 1) {
        u32 place = number * 8 + u32(__builtin_ctz(left));
        if (!wanted(place)) continue;
        if (found_ == most_) {
          from_ = place;
          return false;
        }
        answers[found_++] = names_[place];
      }
      return true;
    }
    u32 inside = all_wanted_ && !world_ && !is_circle() && !index_.holes() ? area_.within(block) : 0;
    for (; left; left &= left - 1) {
      u32 lane = u32(__builtin_ctz(left)), child = number * 8 + lane;
      u32 first = child << (3 * level), end = smaller((child + 1) << (3 * level), index_.places());
      if (end <= from_) continue;
      if (!(inside >> lane & 1)) {
        if (!walk(level - 1, child, answers)) return false;
        continue;
      }
      first = larger(first, from_);
      u32 taken = smaller(end - first, most_ - found_);
      answers.grow(u64(found_) + taken, found_);
      __builtin_memcpy(answers.data() + found_, names_ + first, taken * sizeof(u32));
      found_ += taken;
      if (taken < end - first) {
        from_ = first + taken;
        return false;
      }
    }
    return true;
  }

  /// Ranks eight boxes by lower bounds for their squared distances from the point, reduced by the possible rounding
  /// error. Of those around it, the smallest come first, since what is near is probably there: their ranks follow from
  /// their sizes, and are so small that no limit leaves them out.
  NOINLINE void rank_by_distance(const Block& block, Ranks& to) const {
    f32x4 most = splat(most_rank_);
    ROLLED for (u32 half = 0; half < 8; half += 4) {
      f32x4 sum = {}, size = {};
      for (int a = 0; a < D; a++) {
        f32x4 lo = load<f32x4>(block.lo[a] + half), hi = load<f32x4>(block.hi[a] + half);
        f32x4 away = max(max(lo - above_[a], below_[a] - hi), f32x4{});
        sum += away * away;
        size += hi - lo;
      }
      f32x4 least = min(sum * splat(0.999999f), splat(1e38f));
      i32x4 is_box = load<f32x4>(block.lo[0] + half) == load<f32x4>(block.lo[0] + half);
      // Infinity less infinity is NaN, of either sign: its sign is cut off first.
      u32x4 around = (bits<u32x4>(size) << 1 >> around_shift) & bits<u32x4>(sum == f32x4{});
      to.set(half, bits<f32x4>(bits<u32x4>(least) | around), is_box & (least <= most));
    }
  }

  /// Ranks eight boxes by the times at which the moving box may meet them, as shares of its path.
  void rank_by_time(const Block& block, Ranks& to) const {
    if (is_tame_) return aim_.rank(block, to);
    u32 close = area_.touched(block);
    for (u32 lane = 0; lane < 8; lane++) to.of[lane] = close >> lane & 1 ? lane : Ranks::none;
  }

  /// Offers the boxes of a block to `hits`, in ascending order of their lower bounds.
  template <bool moving> void search(u32 level, u32 number, Hits& hits) {
    const Block& block = index_.block(level, number);
    looks_++;
    if (!moving && level == 0) {
      offer_near(number, hits);
      return set_most<moving>(hits.limit);
    }
    Ranks ranks;
    if (moving) rank_by_time(block, ranks);
    else rank_by_distance(block, ranks);
    for (u32 lane; (lane = ranks.take(most_rank_)) < 8;) {
      if (moving && level == 0) offer_ahead(number * 8 + lane, hits);
      else search<moving>(level - 1, number * 8 + lane, hits);
    }
  }

  /// Sets the limit, in the unit of the lower bounds, a time or a squared distance; never rounded below it.
  template <bool moving> void set_most(f64 limit) {
    if (!moving) most_rank_ = round_up(squared_limit(limit));
    else aim_.most = most_rank_ = is_tame_ ? round_up(limit * scale_) : __builtin_inff();
  }
  /// An upper bound for the square of every distance within the limit, in float32 too, where the smallest squares are
  /// rounded to multiples of 2^-149, and above all ranks of boxes around the point.
  static f64 squared_limit(f64 limit) { return limit * limit * (1 + 0x1p-49) + 0x1p-126; }

  /// The distance to a box, given its square, which may have lost digits.
  f64 distance(u32 place, f64 squared) const {
    return is_plain(squared) ? __builtin_sqrt(squared) : far_distance(place);
  }
  SMALL f64 far_distance(u32 place) const {
    f64 to[D];
    away(place, to);
    return length_of(to);
  }

  /// The distance to a box along each axis; false if it is nearer in another turn.
  SMALL bool away(u32 place, f64 (&to)[D]) const {
    f64 box[2 * D];
    index_.box(place, box);
    if (world_) return copies_.away(box, to);
    for (int a = 0; a < D; a++) to[a] = larger(0.0, larger(box[a] - asked_.hi[a], asked_.lo[a] - box[D + a]));
    return true;
  }

  /// Writes the squared distances to eight boxes. Returns one bit for each within the limit, and perhaps more.
  NOINLINE u32 distances(u32 number, f64 limit, f64 (&to)[8]) const {
    const Block& block = index_.block(0, number);
    u32 close = 0, is_box = 0;
    ROLLED for (u32 lane = 0; lane < 8; lane += 2) {
      f64x2 sum = {};
      for (int a = 0; a < D; a++) {
        f64x2 lo = __builtin_convertvector(load<f32x2>(block.lo[a] + lane), f64x2);
        f64x2 hi = __builtin_convertvector(load<f32x2>(block.hi[a] + lane), f64x2);
        // Equal infinite sides have distance 0, not NaN; unused lanes, which are NaN, are not in `is_box`.
        f64x2 away = max(max(lo - splat(asked_.hi[a]), splat(asked_.lo[a]) - hi), f64x2{});
        sum += away * away;
        if (a == 0) is_box |= at_most(lo, hi) << lane;
      }
      store(to + lane, sum);
      close |= at_most(sum, splat(limit)) << lane;
    }
    close &= is_box;
    for (u32 left = index_.rounded() ? close : 0; left; left &= left - 1) {
      u32 lane = u32(__builtin_ctz(left));
      f64 box[2 * D];
      index_.box(number * 8 + lane, box);
      to[lane] = 0;
      for (int a = 0; a < D; a++) {
        f64 away = larger(0.0, larger(box[a] - asked_.hi[a], asked_.lo[a] - box[D + a]));
        to[lane] += away * away;
      }
    }
    return close;
  }

  /// Offers boxes by their distance to the point.
  NOINLINE void offer_near(u32 number, Hits& hits) const {
    if (world_) return offer_near_around(number, hits);
    f64 ranks[8];
    for (u32 left = distances(number, squared_limit(hits.limit), ranks); left; left &= left - 1) {
      u32 lane = u32(__builtin_ctz(left)), place = number * 8 + lane;
      if (wanted(place)) hits.offer({distance(place, ranks[lane]), index_.id(place), 0});
    }
  }

  SMALL void offer_near_around(u32 number, Hits& hits) const {
    Ranks ranks;
    rank_by_distance(index_.block(0, number), ranks);
    for (u32 lane; (lane = ranks.take(most_rank_)) < 8;) {
      u32 place = number * 8 + lane;
      f64 to[D];
      if (wanted(place) && away(place, to)) hits.offer({length_of(to), index_.id(place), 0});
    }
  }

  /// How the moving box meets a box in a world that wraps around; false where it does not, or earlier in another turn.
  SMALL bool meets_around(const f64* box, u32 id, Hit& hit, f64 limit) const {
    f64 copy[2 * D];
    Copies::Home home = copies_.home_of(box);
    copies_.copy(home, box, copy);
    if (!asked_.hits(copy, id, hit) || hit.rank > limit) return false;
    struct Others {
      const Queries& asks;
      const Copies::Home& home;
      const f64* box;
      const Hit& hit;
      Copies at;
      bool first, before;
    } others{*this, home, box, hit, copies_, true, true};
    // Only what it meets by then can come first.
    f64 until = hit.rank < asked_.limit ? hit.rank / asked_.limit + 1e-9 : 1;
    others.at.pass(
        reach_,
        [](void* given) {
          auto& [asks, home, box, hit, at, first, before] = *static_cast<Others*>(given);
          if (at.same_turn(asks.copies_)) {
            before = false;
            return;
          }
          f64 copy[2 * D];
          Hit other;
          at.copy(home, box, copy);
          if (first && asks.asked_.hits(copy, hit.id & ~Hit::corner, other))
            first = !(other < hit) && (!before || hit < other);
        },
        &others, 0, 0, until);
    return others.first;
  }

  /// Offers a box by how far the moving box moves until it meets it.
  SMALL void offer_ahead(u32 place, Hits& hits) {
    if (!wanted(place)) return;
    f64 box[2 * D];
    index_.box(place, box);
    Hit hit;
    if (world_ ? !meets_around(box, index_.id(place), hit, hits.limit) : !asked_.hits(box, index_.id(place), hit))
      return;
    hits.offer(hit);
    set_most<true>(hits.limit);
  }
};

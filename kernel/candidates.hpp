// The pairs that an update has to test: of boxes that move, and of those with boxes at rest.
// Idea: two that move are a pair of slots. A box at rest is where it was when it was found, so it is copied, next to the
// others that the same mover may meet: four at a time are tested against one, and nobody has to fetch them from where they
// stand, each in another line of the cache.
// Cost: 3 to 5 ns for two that move, about as much for one that moves and four at rest, 10 where the caches are cold, and
// 17, its cell included, where each cell has but two or three of these; to find them again 1 ns for each box at rest;
// 8 bytes a pair that moves, 24 (2D) or 32 (3D) for a box at rest where a mover meets four.
#pragma once
#include "arena.hpp"
#include "fat_boxes.hpp"

template <int D> class Candidates {
  static constexpr u32 width = 2 * D;
  static constexpr f32 nan = __builtin_nanf("");

  /// A mover, and up to four boxes at rest that it may meet; one that is none of these is NaN.
  struct Meeting {
    f32 bounds[width][4];
    u32 slots[4];
    u32 mover[4];  // one would do, but for where the next one begins
  };

  Arena::Place pairs_, meetings_;
  u32 pair_count_, meeting_count_;

  u64* pairs() const { return reinterpret_cast<u64*>(pairs_.at); }  // as they are reported
  Meeting* meetings() const { return reinterpret_cast<Meeting*>(meetings_.at); }

 public:
  /// Where those of all cells stand. Each is to be read from front to back, so they stand apart.
  struct Room {
    Arena pairs, meetings;
  };

  /// How many times something is tested.
  u32 count() const { return pair_count_ + meeting_count_; }
  u32 tests() const { return pair_count_ + 4 * meeting_count_; }

  /// Reads the boxes that `report` is going to read: see read_lines.
  void fetch_boxes(const f32* boxes) const {
    constexpr u32 bytes = width * sizeof(f32);
    read_rows(boxes, bytes, reinterpret_cast<const u32*>(pairs()), 2 * pair_count_, 1);
    read_rows(boxes, bytes, meetings()->mover, meeting_count_, sizeof(Meeting) / sizeof(u32));
  }

  COLD void clear(Room& room) {
    room.pairs.release(pairs_);
    room.meetings.release(meetings_);
    pair_count_ = meeting_count_ = 0;
  }

  /// One that moves and one that has come to rest: with the last others that this mover may meet, or apart.
  COLD void add_still(Room& room, u32 mover, u32 still, const f32* box) {
    u32 at = meeting_count_;
    while (at > 0 && meetings()[at - 1].mover[0] != mover) at--;
    Meeting* to = at > 0 ? &meetings()[at - 1] : nullptr;
    u32 free = to ? bitmask(load<f32x4>(to->bounds[0]) != load<f32x4>(to->bounds[0])) : 0;
    if (free == 0) {
      to = &open(room, splat(mover));
      store(to->bounds[0], splat(nan));
      free = 15;
    }
    u32 lane = u32(__builtin_ctz(free));
    for (u32 k = 0; k < width; k++) to->bounds[k][lane] = box[k];
    to->slots[lane] = still;
  }

  /// The mover at a place, with those that move, from `from` on, and those at rest.
  template <class Movers, class Stills> NOINLINE void meet(Room& room, const Movers& movers, u32 at, u32 from, const Stills& stills) {
    u64 most = u64(pair_count_) + movers.count + Pairs::slack;
    room.pairs.grow(pairs_, most * sizeof(u64), pair_count_ * sizeof(u64));
    u64* out = pairs() + pair_count_;
    Probe<D> mover = movers.probe(at);
    for (u32 j = from; j < movers.count; j = (j | 3) + 1) {
      const f32* block = movers.block_of(j);
      u32x4 slots = load<u32x4>(block + 4 * width) & splat(slot_mask);
      out = append(out, mover.slot, slots, bitmask(hits(mover, block) & (slots != mover.slot)) & 15u << j % 4);
    }
    pair_count_ = u32(Pairs::between(pairs(), out));
    u32 near[8], many = 0;
    const f32* block = stills.block_of(0);
    for (u32 j = 0; j < stills.count; j += 64) {
      u64 found = 0;  // a bit for each: in which four there are some nobody could guess
      for (u32 k = 0; k < smaller(stills.count - j, 64u); k += 4, block += Stills::block) {
        found |= u64(bitmask(hits(mover, block))) << k;
      }
      for (; found; found &= found - 1) {
        near[many++] = j + u32(__builtin_ctzll(found));
        if (many < 4) continue;
        copy(room, mover.slot, stills, near);
        many = 0;
      }
    }
    if (many == 0) return;
    store(near + many, splat(stills.count));  // behind the last all is NaN
    copy(room, mover.slot, stills, near);
  }

  /// Takes all of a box away.
  COLD void purge(u32 slot) {
    u32 left = 0;
    for (u32 k = 0; k < pair_count_; k++) {
      u64 pair = pairs()[k];
      pairs()[left] = pair;
      left += u32(pair) != slot && u32(pair >> 32) != slot;
    }
    pair_count_ = left;
    left = 0;
    for (u32 k = 0; k < meeting_count_; k++) {
      Meeting& meeting = meetings()[left] = meetings()[k];
      for (u32 lane = 0; lane < 4; lane++) {
        if (meeting.slots[lane] == slot) meeting.bounds[0][lane] = nan;
      }
      left += meeting.mover[0] != slot;
    }
    meeting_count_ = left;
  }

  /// Appends those that overlap and whose corner, the larger of their two lower ones, is at or above `least`, and not at
  /// or above `most`.
  /// Behind `out` there is room for all; gives where it ends.
  NOINLINE u64* report(const f32* boxes, const f32* least, const f32* most, u64* out) const {
    f32x4 low = load<f32x4>(least), high = load<f32x4>(most);
    const u64* list = pairs();
    for (u32 k = 0; k < pair_count_; k++) {
      u64 pair = list[k];
      const f32* one = boxes + u64(u32(pair)) * width;
      const f32* other = boxes + (pair >> 32) * width;
      f32x4 first = load<f32x4>(one), second = load<f32x4>(other), corner = max(first, second);
      i32x4 hit = (first <= load<f32x4>(other + D)) & (second <= load<f32x4>(one + D)) & (corner >= low) & ~(corner >= high);
      *out = pair;
      out += !(~bitmask(hit) & ((1 << D) - 1));
    }
    f32x4 lows[D], highs[D];  // made in the loop they would go through memory each time
    for (int a = 0; a < D; a++) {
      lows[a] = splat(least[a]);
      highs[a] = splat(most[a]);
    }
    const Meeting* meeting = meetings();
    for (const Meeting* end = meeting + meeting_count_; meeting < end; meeting++) {
      const f32* box = boxes + u64(meeting->mover[0]) * width;
      i32x4 hits[D];
      for (int a = 0; a < D; a++) {
        f32x4 first = splat(box[a]), second = load<f32x4>(meeting->bounds[a]), corner = max(first, second);
        hits[a] = (second <= splat(box[D + a])) & (first <= load<f32x4>(meeting->bounds[D + a]));
        hits[a] &= (corner >= lows[a]) & ~(corner >= highs[a]);
      }
      i32x4 all = hits[0] & hits[1];
      if constexpr (D == 3) all &= hits[2];
      out = append(out, load<u32x4>(meeting->mover), load<u32x4>(meeting->slots), bitmask(all));
    }
    return out;
  }

 private:
  Meeting& open(Room& room, u32x4 mover) {
    u64 used = meeting_count_ * sizeof(Meeting);
    room.meetings.grow(meetings_, used + sizeof(Meeting), used);
    Meeting& meeting = meetings()[meeting_count_++];
    store(meeting.mover, mover);
    return meeting;
  }

  /// Copies four boxes at rest.
  template <class Stills> COLD void copy(Room& room, u32x4 mover, const Stills& stills, const u32* from) {
    Meeting& to = open(room, mover);
    const f32 *a = stills.numbers(from[0]), *b = stills.numbers(from[1]), *c = stills.numbers(from[2]), *d = stills.numbers(from[3]);
    ROLLED
    for (u32 k = 0; k < 4 * width; k += 4) store(to.bounds[k / 4], f32x4{a[k], b[k], c[k], d[k]});
    u32 tags = 4 * width;
    store(to.slots, bits<u32x4>(f32x4{a[tags], b[tags], c[tags], d[tags]}) & splat(slot_mask));
  }
};

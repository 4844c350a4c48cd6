// Fat boxes in blocks, for techniques that keep a few of them together, which come and go.
// Idea: four boxes to a block, a row for each coordinate, so that they are tested at a time; what is tested one after the
// other stands one after the other, and memory is read in one stream. The last one takes the place of one that goes.
// Cost: a quarter of a nanosecond a box to test; finding one by its slot looks at all.
#pragma once
#include "sweep.hpp"

/// Which of the four boxes of a block overlap one and share no exclusion bit with it.
template <int D> i32x4 hits(const Probe<D>& one, const f32* block) {
  i32x4 all = bits<i32x4>((load<u32x4>(block + 8 * D) & one.excluded) == u32x4{});
  for (int a = 0; a < D; a++) {
    all &= load<f32x4>(block + 4 * a) <= one.hi[a];
    all &= load<f32x4>(block + 4 * (D + a)) >= one.lo[a];
  }
  return all;
}

/// Calls `what` with the place of each of the boxes in blocks of so many numbers that overlaps this one and may meet its tag.
/// Hits are few: so this exists once, whatever is done with them.
template <int D>
NOINLINE void each_overlapping(
    const f32* blocks, u32 block, u32 count, const f32* fat, u32 tag, void (*what)(void*, u32), void* to) {
  Probe<D> one(fat, 1, tag);
  for (u32 j = 0; j < count; j += 4, blocks += block) {
    for (u32 found = bitmask(hits(one, blocks)); found; found &= found - 1) what(to, j + u32(__builtin_ctz(found)));
  }
}

/// Blocks of four boxes, in `height` rows, of which number `tags` is that of the tags. One copy of this code serves all.
struct BoxBlocks {
  static constexpr u32 nowhere = 0xffffffff;
  Buffer<f32> values;
  u32 room = 0, count = 0;

  COLD void release() {
    values.release();
    room = count = 0;
  }

 protected:
  /// The first number of a box.
  f32* first(u32 at, u32 height) const { return values.data() + at / 4 * 4 * height + at % 4; }

  /// Room for more. Behind the last box the first row is NaN, which overlaps nothing, and no tag names a slot.
  COLD void grow(u32 height, u32 tags) {
    u32 more_room = (count + count / 2 + 12) & ~3u;
    values.grow(u64(more_room) * height, u64(room) * height);
    for (; room < more_room; room += 4) {
      f32* block = first(room, height);
      store(block, splat(__builtin_nanf("")));
      store(block + 4 * tags, splat(slot_mask));  // no box has this slot
    }
  }

  /// Takes the box at a place away; the last one comes there.
  COLD void take(u32 at, u32 height, u32 tags) {
    f32 *from = first(--count, height), *to = first(at, height);
    for (u32 k = 0; k < 4 * height; k += 4) to[k] = from[k];
    from[0] = __builtin_nanf("");
    from[4 * tags] = bits<f32>(slot_mask);
  }

  /// The place of a slot, or `nowhere`.
  NOINLINE u32 find(u32 slot, u32 height, u32 tags) const {
    for (u32 k = 0; k < count; k += 4) {
      u32x4 four = load<u32x4>(first(k, height) + 4 * tags);
      u32 same = bitmask(bits<i32x4>((four & splat(slot_mask)) == splat(slot)));
      if (same) return k + u32(__builtin_ctz(same));
    }
    return nowhere;
  }
};

/// Fat boxes in blocks of four: minima, maxima, tags, then `more` rows of the owner's.
template <int D, u32 more> struct FatBoxes : BoxBlocks {
  static constexpr u32 width = 2 * D, height = width + 1 + more, block = 4 * height;

  /// The numbers of a box, four apart; those of the first of its block.
  f32* numbers(u32 at) const { return first(at, height); }
  const f32* block_of(u32 at) const { return numbers(at & ~3u); }
  u32 tag(u32 at) const { return bits<u32>(numbers(at)[4 * width]); }
  NOINLINE u32 slot(u32 at) const { return tag(at) & slot_mask; }

  Probe<D> probe(u32 at) const { return Probe<D>(numbers(at), 4, tag(at)); }

  NOINLINE void write(u32 at, const f32* box) const {
    f32* to = numbers(at);
    for (u32 k = 0; k < width; k++) to[4 * k] = box[k];
  }

  /// Reads all boxes: see read_lines.
  void fetch() const { read_lines(values.data(), (count + 3) / 4 * block * sizeof(f32)); }

  /// Adds a box; gives its place.
  u32 put(const f32* box, u32 tag) {
    if (count + 1 >= room) grow(height, width);
    write(count, box);
    numbers(count)[4 * width] = bits<f32>(tag);
    return count++;
  }

  void take(u32 at) { BoxBlocks::take(at, height, width); }
  u32 find(u32 slot) const { return BoxBlocks::find(slot, height, width); }

  /// Calls `what` with the place of each whose fat box overlaps this one and may meet this tag.
  template <class What> void each_hit(const f32* fat, u32 tag, What what) const {
    each_overlapping<D>(
        values.data(), block, count, fat, tag, [](void* to, u32 at) { (*static_cast<What*>(to))(at); }, &what);
  }
};

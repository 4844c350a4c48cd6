// Many box queries at once: for each, the places of the boxes that it touches in float32.
// Idea: a batch of queries goes down the index together, level by level. A list has an entry for each block that a
// query visits. Each entry is tested against the eight children of its block, and those it touches are appended to the
// list of the level below. Appending takes no branch; a single query has an unpredictable branch per child. Lists are
// processed in parts, which bounds their size, and in order, so each query finds the same boxes in the same order as
// alone.
// Cost: about half of that of single queries; 19 KB for the lists.
#pragma once
#include "pairs/pairs.hpp"
#include "questions/question.hpp"

template <int D> class Together {
  using Block = typename Index<D>::Block;
  static constexpr u32 number_bits = 26;  // of a block's number; above them is that of the query
  static constexpr u32 part = 64;  // entries that are expanded at once
  static constexpr u32 list_room = 8 * part + 4;
  struct Aim {
    f32 lo[D], hi[D];
  };

  const Index<D>* index_ = nullptr;
  Buffer<Aim> aims_;
  Buffer<u32> lists_;  // one per level
  u32 found_ = 0;

 public:
  static constexpr u32 most = 64;  // queries
  u32 ends[most] = {};  // per query, where the places it touches end; 0 if it touches none

  /// Begins a batch of the `left` queries that remain; returns its size.
  u32 begin(const Index<D>& index, u32 left) {
    index_ = &index;
    aims_.reserve(most);
    lists_.reserve((index.top() + 1) * list_room);
    __builtin_memset(ends, 0, sizeof(ends));
    return smaller(left, most);
  }

  void aim(u32 question, const Question<D>& asked) {
    Aim& aim = aims_[question];
    ROLLED for (int a = 0; a < D; a++) round_inward(asked.lo[a], asked.hi[a], asked.touching, aim.lo[a], aim.hi[a]);
  }

  /// Appends the places that `count` queries touch, after the first `found`. Returns the number of blocks visited.
  SMALL u32 search(u32 count, Buffer<u32>& places, u32 found) {
    u32* list = lists_.data() + index_->top() * list_room;
    for (u32 k = 0; k < count; k++) list[k] = k << number_bits;
    found_ = found;
    return descend(index_->top(), count, places);
  }

  SMALL void release() {
    aims_.release();
    lists_.release();
  }

 private:
  u32 descend(u32 level, u32 count, Buffer<u32>& places) {
    u32* list = lists_.data() + level * list_room;
    u32 looks = count;
    for (u32 k = 0; k < count; k += part) {
      u32 some = smaller(count - k, part);
      if (level > 0) {
        looks += descend(level - 1, expand(level, list + k, some, list - list_room), places);
      } else {
        places.grow(u64(found_) + list_room, found_);
        found_ += expand(0, list + k, some, places.data() + found_);
      }
    }
    return looks;
  }

  /// Writes what each entry touches: entries of the level below, or on the lowest level boxes. Returns how many.
  NOINLINE u32 expand(u32 level, const u32* entries, u32 count, u32* to) {
    const Block* blocks = &index_->block(level, 0);
    const u32 kept = level > 0 ? ~0u << number_bits : 0;
    u32 n = 0;
    for (u32 k = 0; k < count; k++) {
      u32 asks = entries[k] >> number_bits, number = entries[k] & ~(~0u << number_bits);
      const Block& block = blocks[number];
      const Aim& aim = aims_[asks];
      u32x4 children = splat((entries[k] & kept) + number * 8) + u32x4{0, 1, 2, 3};
      ROLLED for (u32 half = 0; half < 8; half += 4) {
        i32x4 all = bits<i32x4>(u32x4{} == u32x4{});
        for (int a = 0; a < D; a++) {
          all &= load<f32x4>(block.lo[a] + half) <= splat(aim.hi[a]);
          all &= load<f32x4>(block.hi[a] + half) >= splat(aim.lo[a]);
        }
        u32 mask = bitmask(all);
        store(to + n, swizzle(bits<u8x16>(children), load<u8x16>(detail::swizzles.of[mask])));
        n += detail::bits_set[mask];
        children += splat(4u);
      }
      if (level == 0) ends[asks] = found_ + n;
    }
    return n;
  }
};

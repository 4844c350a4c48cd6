// What was written since the last update: the slots that changed, and the memory that boxes() handed out. That memory
// is written without a call, so it is compared before boxes are read, and in each update. If the boxes outgrow it, they
// move elsewhere, and it stays: values written there are copied in, and other changes are copied out.
#pragma once
#include "boxes/changes.hpp"

template <int D> class Written {
  static constexpr u32 width = 2 * D;

  bool in_place_ = false;  // `boxes()` has handed out the memory: each update checks what was written
  Buffer<f32> shown_;  // that memory, once the boxes had to move elsewhere
  u32 shown_count_ = 0;  // boxes in it; 0: it is not in use

 public:
  Changes changes;  // since the last update
  bool renamed = false;  // since the last update, boxes have come, gone or got other ids

  bool in_place() const { return in_place_; }
  u32 shown() const { return shown_count_; }

  /// Hands out the memory of the boxes.
  void begin() {
    in_place_ = true;
    shown_count_ = 0;
  }
  /// Ends writing in place.
  void end() {
    in_place_ = false;
    shown_count_ = 0;
  }

  /// Moves the first `count` boxes, whose memory was handed out, to where there is room for `numbers` numbers.
  SMALL void move(Buffer<f32>& boxes, u64 numbers, u32 count) {
    f32* moved = shown_.reserve(numbers);
    if (count) __builtin_memcpy(moved, boxes.data(), u64(count) * width * sizeof(f32));
    boxes.swap(shown_);
    shown_count_ = count;
  }

  /// Copies what was written in place to where the boxes are.
  void see(f32* boxes, u32 count) const {
    u32 many = smaller(shown_count_, count);
    if (many) __builtin_memcpy(boxes, shown_.data(), u64(many) * width * sizeof(f32));
  }

  /// Copies a box that changed in another way to the memory handed out.
  SMALL void show(const f32* boxes, u32 slot) {
    if (slot < shown_count_)
      __builtin_memcpy(shown_.data() + u64(slot) * width, boxes + u64(slot) * width, width * sizeof(f32));
  }
};

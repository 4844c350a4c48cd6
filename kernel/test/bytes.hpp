// A source of decisions: bytes that are read as numbers, boxes and settings of boxes.
#pragma once
#include "model.hpp"

/// The bytes; zeros once they are used up.
class Bytes {
  const u8* at_;
  const u8* end_;

 public:
  Bytes(const u8* data, size_t size) : at_(data), end_(data + size) {}
  bool empty() const { return at_ == end_; }
  u8 next() { return empty() ? u8(0) : *at_++; }
  u32 below(u32 end) { return next() % end; }
  u16 next16() {
    u16 low = next();
    return u16(low | next() << 8);
  }
  u64 next64() {
    u64 value = 0;
    for (int k = 0; k < 8; k++) value |= u64(next()) << (8 * k);
    return value;
  }
};

/// The first byte of a sequence: how many dimensions, and the technique to begin with.
struct Beginning {
  int dimensions;
  Technique technique;

  explicit Beginning(u8 byte) : dimensions(2 + byte % 2), technique(Technique(byte / 2 % technique_count)) {}
};

/// Any number; special ones are frequent.
inline f64 any_number(Bytes& bytes) {
  static const f64 special[] = {std::numeric_limits<f64>::infinity(),
                                -std::numeric_limits<f64>::infinity(),
                                std::numeric_limits<f64>::max(),
                                -std::numeric_limits<f64>::max(),
                                std::numeric_limits<f32>::max(),
                                -std::numeric_limits<f32>::max(),
                                1e39,
                                -1e39,
                                1e9,
                                -1e9,
                                1e-45,
                                -1e-45,
                                1e-320,
                                -1e-320,
                                -0.0,
                                0.1};
  u8 kind = bytes.next();
  if (kind < 128) return kind % 32;
  if (kind < 180) return (kind - 128) * 0.1;
  if (kind < 220) return f64(bytes.next16()) * 0x1p-6;
  if (kind < 250) return special[kind % std::size(special)];
  f64 any = bits<f64>(bytes.next64());
  return any == any ? any : 0;
}

/// A box; small ones are frequent.
template <int D> Box<D> any_box(Bytes& bytes) {
  Box<D> box;
  for (u32 a = 0; a < D; a++) {
    f64 one = any_number(bytes), other = bytes.below(4) ? one + bytes.below(8) : any_number(bytes);
    box[a] = smaller(one, other);
    box[D + a] = larger(one, other);
  }
  return box;
}

/// A box with a NaN or with a minimum above its maximum.
template <int D> Box<D> bad_box(Bytes& bytes) {
  Box<D> bad = any_box<D>(bytes);
  u32 k = bytes.below(2 * 2 * D);
  if (k < 2 * D) {
    bad[k] = std::nan("");
  } else {
    bad[k % D] = 1;
    bad[D + k % D] = 0;
  }
  return bad;
}

/// Settings of boxes: few different ones, so that boxes share them.
struct Given {
  u32 group;
  f64 reach;

  static Given from(Bytes& bytes) {
    static const u32 groups[] = {0, 1, 1, 2, 3, ~0u};
    static const f64 reaches[] = {0, 0, 1, 0.5, 0.1, 1e-12, 1e300};
    u32 group = groups[bytes.below(u32(std::size(groups)))];
    return {group, bytes.below(3) ? 0 : reaches[bytes.below(u32(std::size(reaches)))]};
  }

  template <int D> void give(Space<D>& space, u32 slot) const { space.store.put_in_group(slot, group); }
  template <int D> void give_reach(Space<D>& space, u32 slot) const { space.store.set_reach(slot, reach); }
};

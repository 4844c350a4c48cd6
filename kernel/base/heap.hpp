// Memory: growable arrays over one heap that never asks twice for the same bytes.
// Idea: sizes are rounded up to quarter octaves (waste at most 25 %); a block given back waits in the list of its size
// class; the last block grows in place, so the pair list, the one array of unpredictable size, costs no copy. Natively
// the same arrays use malloc, where AddressSanitizer sees them. Running out of memory: nothing has been changed yet
// when `fail` is called; it does not return (wasm: a trap that the JavaScript side turns into an error; natively: an
// exception).
#pragma once
#include "base/simd.hpp"

// Code that runs once in a while: small rather than fast, and out of the way of the code that runs often.
#if defined(__clang__)
#define SMALL __attribute__((noinline, minsize))
// Before a loop of known length that is long enough without being unrolled.
#define ROLLED _Pragma("clang loop unroll(disable)")
#else
#define SMALL __attribute__((noinline, cold))
#define ROLLED  // g++ builds the tests only, and warns where its own pragma comes to nothing
#endif
// One copy for all callers: code that runs long each time it is called.
#define SHARED __attribute__((noinline))

// One copy of what several callers share.
#define NOINLINE __attribute__((noinline))

enum class Fault : u32 { none = 0, out_of_memory = 1 };

#if defined(__wasm__)
inline Fault fault = Fault::none;
inline f64 fault_bytes = 0;
[[noreturn]] inline void fail(Fault what, f64 bytes) {
  fault = what;
  fault_bytes = bytes;
  __builtin_trap();
}
#else
#include <cstdlib>
struct Failure {
  Fault what;
  f64 bytes;
};
[[noreturn]] inline void fail(Fault what, f64 bytes) { throw Failure{what, bytes}; }
#endif

/// Where what is only read goes, to have it near: nobody needs it, but no compiler knows that.
inline volatile u32 unneeded;

/// Reads from each line of the cache, of 64 bytes, that so many bytes stand in, so that they are on their way all at once.
NOINLINE inline void read_lines(const void* from, u32 bytes) {
  const u8* at = static_cast<const u8*>(from);
  u32 read = 0;
  for (u32 k = 0; k < bytes; k += 64) read ^= at[k];
  unneeded = read;
}

/// Likewise from each of these rows of so many bytes, whose numbers stand `step` apart.
NOINLINE inline void read_rows(const void* rows, u32 bytes, const u32* numbers, u32 count, u32 step) {
  const u8* from = static_cast<const u8*>(rows);
  u32 read = 0;
  for (u32 k = 0; k < count; k++, numbers += step) read ^= from[u64(*numbers) * bytes];
  unneeded = read;
}

namespace heap {

inline constexpr u32 least = 64;  // bytes of the smallest block; all are aligned to 16
inline size_t used = 0;  // bytes in blocks that are handed out

/// The size class of a request: class c holds blocks of (4 + c % 4) << (c / 4) times `least` / 4 bytes.
inline u32 size_class(size_t bytes) {
  size_t quarters = (bytes + least / 4 - 1) / (least / 4);
  if (quarters <= 4) return 0;
  u32 octave = 61 - u32(__builtin_clzll(u64(quarters - 1)));
  u32 step = u32((quarters - 1) >> octave) + 1;  // 5 … 8
  return octave * 4 + step - 4;
}
inline u64 class_bytes(u32 c) { return u64(4 + c % 4) * (least / 4) << (c / 4); }

/// The size class of a request that may be too large for any memory.
inline u32 checked_class(u64 bytes) {
  if (bytes >= u64(1) << 32) fail(Fault::out_of_memory, f64(bytes));
  return size_class(size_t(bytes));
}

#if defined(__wasm__)
extern "C" u8 __heap_base;
inline u8* top = nullptr;  // first byte never handed out
inline u8* highest = nullptr;  // where `top` stood before it last went down, at most
inline u8* waiting[112] = {};  // per size class, the given-back blocks, each holding the address of the next

/// Makes the memory reach to `bytes` behind `top`; false where it cannot. Growing cuts off every view that
/// JavaScript holds, so it takes a quarter more than it needs, and 1 MiB: pages not touched cost nothing.
inline bool reach(u64 bytes) {
  if (!top) top = reinterpret_cast<u8*>((reinterpret_cast<size_t>(&__heap_base) + least - 1) / least * least);
  u64 end = u64(reinterpret_cast<size_t>(top)) + bytes;
  u64 have = u64(__builtin_wasm_memory_size(0)) << 16;
  if (end <= have) return true;
  if (end >= (u64(1) << 32)) return false;
  u64 pages = (end - have + 0xffff) >> 16;
  return __builtin_wasm_memory_grow(0, size_t(pages + (have >> 18) + 16)) != size_t(-1) ||
         __builtin_wasm_memory_grow(0, size_t(pages)) != size_t(-1);
}

/// Nothing is handed out any more, as in a new memory. Returns how many bytes have been in use at most.
inline size_t forget_all() {
  size_t most = size_t(larger(highest, top) - &__heap_base);
  top = highest = nullptr;
  used = 0;
  for (u8*& block : waiting) block = nullptr;
  return most;
}

SMALL inline void* take(u32 c) {
  u8* block = waiting[c];
  if (block) {
    waiting[c] = load<u8*>(block);
  } else {
    if (!reach(class_bytes(c))) fail(Fault::out_of_memory, f64(class_bytes(c)));
    block = top;
    top += class_bytes(c);
  }
  used += class_bytes(c);
  return block;
}

SMALL inline void give(void* block, u32 c) {
  used -= class_bytes(c);
  if (static_cast<u8*>(block) + class_bytes(c) == top) {
    highest = larger(highest, top);
    top = static_cast<u8*>(block);
    return;
  }
  store(block, waiting[c]);
  waiting[c] = static_cast<u8*>(block);
}

/// The last block can become larger where it stands.
inline bool extend(void* block, u32 from, u32 to) {
  if (static_cast<u8*>(block) + class_bytes(from) != top) return false;
  u64 more = class_bytes(to) - class_bytes(from);
  if (!reach(more)) fail(Fault::out_of_memory, f64(class_bytes(to)));
  top += more;
  used += more;
  return true;
}
#else
inline u64 limit = u64(1) << 32;  // tests lower it to see what happens when memory ends
inline void* take(u32 c) {
  if (used + class_bytes(c) > limit) fail(Fault::out_of_memory, f64(class_bytes(c)));
  used += class_bytes(c);
  return std::malloc(class_bytes(c));
}
inline void give(void* block, u32 c) {
  used -= class_bytes(c);
  std::free(block);
}
inline bool extend(void*, u32, u32) { return false; }
inline bool reach(u64 bytes) { return used + bytes <= limit; }
inline u64 copied = 0;  // bytes of arrays that outgrew their blocks: tests see what an update paid for that
#endif

}  // namespace heap

/// A block of the heap that can become larger. One copy of this code serves the arrays of every type.
class Block {
 protected:
  void* at_ = nullptr;
  u32 class_ = 0;

  u64 bytes() const { return at_ ? heap::class_bytes(class_) : 0; }

  /// At least that many bytes; what was inside is lost when it has to grow.
  NOINLINE void* reserve_bytes(u64 wanted) {
    if (wanted <= bytes() && at_) return at_;
    u32 to = heap::checked_class(wanted);
    release();
    class_ = to;
    return at_ = heap::take(to);
  }

  /// At least that many bytes, and half as many again as before; the first `keep` stay what they are.
  NOINLINE void* grow_bytes(u64 wanted, u64 keep) {
    if (wanted <= bytes() && at_) return at_;
    u32 to = heap::checked_class(larger(wanted, bytes() + bytes() / 2));
    if (at_ && heap::extend(at_, class_, to)) {
      class_ = to;
      return at_;
    }
    void* moved = heap::take(to);
    if (keep) __builtin_memcpy(moved, at_, keep);
#if !defined(__wasm__)
    heap::copied += keep;
#endif
    release();
    class_ = to;
    return at_ = moved;
  }

 public:
  constexpr Block() = default;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
#if !defined(__wasm__)
  ~Block() { release(); }  // the wasm's arrays are all global: they go with its memory
#endif

  SMALL void release() {
    if (at_) heap::give(at_, class_);
    at_ = nullptr;
  }

  void swap(Block& other) {
    void* at = at_;
    u32 c = class_;
    at_ = other.at_;
    class_ = other.class_;
    other.at_ = at;
    other.class_ = c;
  }
};

/// An array of plain values that grows. Not copied.
template <class T> class Buffer : public Block {
 public:
  T* data() const { return static_cast<T*>(at_); }
  T& operator[](size_t i) const { return data()[i]; }
  u64 capacity() const { return bytes() / sizeof(T); }

  /// Room for n values; what was inside is lost when it has to grow.
  T* reserve(u64 n) { return static_cast<T*>(reserve_bytes(n * sizeof(T))); }

  /// Room for n values, of which the first `keep` stay what they are.
  T* grow(u64 n, u64 keep) { return static_cast<T*>(grow_bytes(n * sizeof(T), keep * sizeof(T))); }
};

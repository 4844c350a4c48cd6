// Memory: growable arrays on one heap, which reuses freed blocks.
// Idea: sizes are rounded up to quarter octaves (waste at most 25 %). A freed block goes to the free list of its size
// class. The last block grows in place, so that the pair list, the one array of unpredictable size, is not copied.
// Natively the same arrays use malloc, so that AddressSanitizer sees them. When memory runs out, `fail` is called
// before anything has changed. It does not return: in wasm it traps, which the JavaScript side turns into an error;
// natively it throws.
#pragma once
#include "base/simd.hpp"

// Optimized for size and never inlined: code that runs rarely, or spends its time in faster functions that it calls.
#if defined(__clang__)
#define SMALL __attribute__((noinline, minsize))
// Before a loop that is not worth unrolling.
#define ROLLED _Pragma("clang loop unroll(disable)")
#else
#define SMALL __attribute__((noinline, cold))
#define ROLLED  // g++ builds only the tests, and warns if its own pragma has no effect
#endif
// Never inlined, but optimized for speed: one copy for several callers, which keeps the module small, or a hot loop that
// is better compiled apart from its caller.
#define NOINLINE __attribute__((noinline))
// Always inlined: for hot loops in which the compiler decides otherwise.
#define INLINE __attribute__((always_inline)) inline

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

/// A sink for values that are read only to prefetch them: it keeps the compiler from removing the reads.
inline volatile u32 unneeded;

/// Prefetches the rows of these numbers, of `bytes` bytes each.
NOINLINE inline void read_rows(const void* rows, u32 bytes, const u32* numbers, u32 count) {
  const u8* from = static_cast<const u8*>(rows);
  u32 read = 0;
  for (u32 k = 0; k < count; k++) read ^= from[u64(numbers[k]) * bytes];
  unneeded = read;
}

namespace heap {

inline constexpr u32 least = 64;  // bytes of the smallest block; all are aligned to 16
inline size_t used = 0;  // bytes in blocks that are in use
inline u64 kept = 0;  // bytes that only their owner may take, who sets this to 0 first

inline bool reach(u64 bytes);
/// Whether there is memory for `bytes` bytes besides what is kept.
inline bool can_spare(u64 bytes) { return reach(bytes + kept); }

/// The size class of a request: class c holds blocks of (4 + c % 4) << (c / 4) times `least` / 4 bytes.
SMALL inline u32 size_class(size_t bytes) {
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
inline u8* top = nullptr;  // first byte after all blocks
inline u8* highest = nullptr;  // the largest `top` before it was lowered
inline u8* waiting[112] = {};  // per size class, the free list: each block begins with the address of the next

/// Makes the memory extend `bytes` beyond `top`; false if it cannot. Growing detaches every view that JavaScript holds,
/// so it takes a quarter more than needed, and 1 MiB: untouched pages cost nothing.
SMALL inline bool reach(u64 bytes) {
  if (!top) top = reinterpret_cast<u8*>((reinterpret_cast<size_t>(&__heap_base) + least - 1) / least * least);
  u64 end = u64(reinterpret_cast<size_t>(top)) + bytes;
  u64 have = u64(__builtin_wasm_memory_size(0)) << 16;
  if (end <= have) return true;
  if (end >= (u64(1) << 32)) return false;
  u64 pages = (end - have + 0xffff) >> 16;
  return __builtin_wasm_memory_grow(0, size_t(pages + (have >> 18) + 16)) != size_t(-1) ||
         __builtin_wasm_memory_grow(0, size_t(pages)) != size_t(-1);
}

/// Frees everything at once, as in a new memory. Returns the largest number of bytes that were ever in use.
inline size_t forget_all() {
  size_t most = size_t(larger(highest, top) - &__heap_base);
  top = highest = nullptr;
  used = 0;
  kept = 0;
  for (u8*& block : waiting) block = nullptr;
  return most;
}

SMALL inline void* take(u32 c) {
  u8* block = waiting[c];
  if (block) {
    waiting[c] = load<u8*>(block);
  } else {
    if (!can_spare(class_bytes(c))) fail(Fault::out_of_memory, f64(class_bytes(c)));
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

/// Grows a block in place, which works only for the last one.
inline bool extend(void* block, u32 from, u32 to) {
  if (static_cast<u8*>(block) + class_bytes(from) != top) return false;
  u64 more = class_bytes(to) - class_bytes(from);
  if (!can_spare(more)) fail(Fault::out_of_memory, f64(class_bytes(to)));
  top += more;
  used += more;
  return true;
}
#else
inline u64 limit = u64(1) << 32;  // tests lower it to see what happens when memory ends
inline void* take(u32 c) {
  if (!can_spare(class_bytes(c))) fail(Fault::out_of_memory, f64(class_bytes(c)));
  used += class_bytes(c);
  return std::malloc(class_bytes(c));
}
inline void give(void* block, u32 c) {
  used -= class_bytes(c);
  std::free(block);
}
inline bool extend(void*, u32, u32) { return false; }
inline bool reach(u64 bytes) { return used + bytes <= limit; }
inline u64 copied = 0;  // bytes copied because arrays outgrew their blocks: tests read it
#endif

}  // namespace heap

/// A block of the heap that can become larger. One copy of this code serves the arrays of every type.
class Block {
 protected:
  void* at_ = nullptr;
  u32 quarters_ = 0;  // its size, in quarters of the smallest block

  u64 bytes() const { return u64(quarters_) * (heap::least / 4); }
  u32 size_class() const { return heap::size_class(size_t(bytes())); }
  void* hold(void* block, u32 c) {
    quarters_ = u32(heap::class_bytes(c) / (heap::least / 4));
    return at_ = block;
  }

  /// Makes room for `wanted` bytes; the contents are lost if the block has to grow.
  NOINLINE void* reserve_bytes(u64 wanted) {
    if (wanted <= bytes() && at_) return at_;
    u32 to = heap::checked_class(wanted);
    release();
    return hold(heap::take(to), to);
  }

  SMALL u64 missing_bytes(u64 wanted) const {
    return wanted <= bytes() ? 0 : heap::class_bytes(heap::size_class(size_t(wanted)));
  }

  /// Makes room for `wanted` bytes and preserves the first `keep`. A block that has to grow does so by at least half.
  NOINLINE void* grow_bytes(u64 wanted, u64 keep) {
    if (wanted <= bytes() && at_) return at_;
    u32 to = heap::checked_class(larger(wanted, bytes() + bytes() / 2));
    if (at_ && heap::extend(at_, size_class(), to)) return hold(at_, to);
    void* moved = heap::take(to);
    if (keep) __builtin_memcpy(moved, at_, keep);
#if !defined(__wasm__)
    heap::copied += keep;
#endif
    release();
    return hold(moved, to);
  }

 public:
  constexpr Block() = default;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
#if !defined(__wasm__)
  ~Block() { release(); }  // in wasm all arrays are global and live as long as the memory
#endif

  SMALL void release() {
    if (at_) heap::give(at_, size_class());
    at_ = nullptr;
    quarters_ = 0;
  }

  void swap(Block& other) {
    void* at = at_;
    u32 quarters = quarters_;
    at_ = other.at_;
    quarters_ = other.quarters_;
    other.at_ = at;
    other.quarters_ = quarters;
  }
};

/// An array of plain values that grows. Not copied.
template <class T> class Buffer : public Block {
 public:
  T* data() const { return static_cast<T*>(at_); }
  T& operator[](size_t i) const { return data()[i]; }
  u64 capacity() const { return bytes() / sizeof(T); }
  /// Bytes that `reserve` takes from the heap for n values.
  u64 missing(u64 n) const { return missing_bytes(n * sizeof(T)); }

  /// Makes room for n values; the contents are lost if the array has to grow.
  T* reserve(u64 n) { return static_cast<T*>(reserve_bytes(n * sizeof(T))); }

  /// Makes room for n values and preserves the first `keep`.
  T* grow(u64 n, u64 keep) { return static_cast<T*>(grow_bytes(n * sizeof(T), keep * sizeof(T))); }
};

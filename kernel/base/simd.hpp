// Four lanes at a time: the few vector operations the kernel needs, the same for WebAssembly simd128 and
// native SSE4.1, so that sanitizers and fuzzers test the code that ships.
#pragma once
#include <stddef.h>
#include <stdint.h>

#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#else
#include <smmintrin.h>
#endif

using f32 = float;
using f64 = double;
using u8 = uint8_t;
using u16 = uint16_t;
using u32 = uint32_t;
using i32 = int32_t;
using u64 = uint64_t;

typedef f32 f32x4 __attribute__((vector_size(16)));
typedef i32 i32x4 __attribute__((vector_size(16)));
typedef u32 u32x4 __attribute__((vector_size(16)));
typedef f64 f64x2 __attribute__((vector_size(16)));
typedef u64 u64x2 __attribute__((vector_size(16)));
typedef f32 f32x2 __attribute__((vector_size(8)));
typedef u8 u8x16 __attribute__((vector_size(16)));

/// Reads any plain value from unaligned memory.
template <class T> inline T load(const void* at) {
  T value;
  __builtin_memcpy(&value, at, sizeof(T));
  return value;
}

template <class T> inline void store(void* at, T value) { __builtin_memcpy(at, &value, sizeof(T)); }

inline f32x4 splat(f32 x) { return f32x4{x, x, x, x}; }
inline f64x2 splat(f64 x) { return f64x2{x, x}; }
inline u32x4 splat(u32 x) { return u32x4{x, x, x, x}; }
inline u8x16 splat(u8 x) { return u8x16{x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x}; }

template <class To, class From> inline To bits(From value) {
  static_assert(sizeof(To) == sizeof(From));
  To result;
  __builtin_memcpy(&result, &value, sizeof(To));
  return result;
}

#if defined(__wasm_simd128__)
/// One bit a lane: its sign.
inline u32 bitmask(i32x4 v) { return wasm_i32x4_bitmask(bits<v128_t>(v)); }
/// One bit a lane: whether it is 0.
inline u32 zeros(u8x16 v) { return wasm_i8x16_bitmask(wasm_i8x16_eq(bits<v128_t>(v), v128_t{})); }
/// By how much a is above b, and 0 where it is not.
inline u8x16 excess(u8x16 a, u8x16 b) { return bits<u8x16>(wasm_u8x16_sub_sat(bits<v128_t>(a), bits<v128_t>(b))); }
/// Sixteen numbers below 256 as bytes.
inline u8x16 bytes(u32x4 a, u32x4 b, u32x4 c, u32x4 d) {
  v128_t first = wasm_i16x8_narrow_i32x4(bits<v128_t>(a), bits<v128_t>(b));
  return bits<u8x16>(wasm_u8x16_narrow_i16x8(first, wasm_i16x8_narrow_i32x4(bits<v128_t>(c), bits<v128_t>(d))));
}
/// Lane k says whether the condition holds in all lanes of the k-th vector.
inline i32x4 all_lanes(i32x4 a, i32x4 b, i32x4 c, i32x4 d) {
  v128_t first = wasm_i16x8_narrow_i32x4(bits<v128_t>(a), bits<v128_t>(b));
  return bits<i32x4>(wasm_i8x16_narrow_i16x8(first, wasm_i16x8_narrow_i32x4(bits<v128_t>(c), bits<v128_t>(d)))) == -1;
}
/// One bit a lane: whether a is at most b.
inline u32 at_most(f64x2 a, f64x2 b) { return wasm_i64x2_bitmask(bits<v128_t>(a <= b)); }
/// One bit a lane: whether a is below b.
inline u32 below(f64x2 a, f64x2 b) { return wasm_i64x2_bitmask(bits<v128_t>(a < b)); }
inline bool any(i32x4 v) { return wasm_v128_any_true(bits<v128_t>(v)); }
/// Two doubles as float32 in the lower lanes, and back.
inline f32x4 narrow(f64x2 v) {
  v128_t low = wasm_f32x4_demote_f64x2_zero(bits<v128_t>(v));
  __asm__("" : "+r"(low));  // otherwise the compiler converts the numbers one by one if a shuffle follows
  return bits<f32x4>(low);
}
inline f64x2 widen(f32x4 v) { return bits<f64x2>(wasm_f64x2_promote_low_f32x4(bits<v128_t>(v))); }
inline u32x4 min(u32x4 a, u32x4 b) { return bits<u32x4>(wasm_u32x4_min(bits<v128_t>(a), bits<v128_t>(b))); }
inline u32x4 max(u32x4 a, u32x4 b) { return bits<u32x4>(wasm_u32x4_max(bits<v128_t>(a), bits<v128_t>(b))); }
/// min and max of floats; where one is NaN the result is the second.
inline f32x4 min(f32x4 a, f32x4 b) { return bits<f32x4>(wasm_f32x4_pmin(bits<v128_t>(b), bits<v128_t>(a))); }
inline f32x4 max(f32x4 a, f32x4 b) { return bits<f32x4>(wasm_f32x4_pmax(bits<v128_t>(b), bits<v128_t>(a))); }
inline f64x2 min(f64x2 a, f64x2 b) { return bits<f64x2>(wasm_f64x2_pmin(bits<v128_t>(b), bits<v128_t>(a))); }
inline f64x2 max(f64x2 a, f64x2 b) { return bits<f64x2>(wasm_f64x2_pmax(bits<v128_t>(b), bits<v128_t>(a))); }
inline u8x16 swizzle(u8x16 v, u8x16 index) {
  return bits<u8x16>(wasm_i8x16_swizzle(bits<v128_t>(v), bits<v128_t>(index)));
}
#else
inline u32 bitmask(i32x4 v) { return u32(_mm_movemask_ps(bits<__m128>(v))); }
inline u32 zeros(u8x16 v) { return u32(_mm_movemask_epi8(_mm_cmpeq_epi8(bits<__m128i>(v), __m128i{}))); }
inline u8x16 excess(u8x16 a, u8x16 b) { return bits<u8x16>(_mm_subs_epu8(bits<__m128i>(a), bits<__m128i>(b))); }
inline u8x16 bytes(u32x4 a, u32x4 b, u32x4 c, u32x4 d) {
  __m128i first = _mm_packs_epi32(bits<__m128i>(a), bits<__m128i>(b));
  return bits<u8x16>(_mm_packus_epi16(first, _mm_packs_epi32(bits<__m128i>(c), bits<__m128i>(d))));
}
inline i32x4 all_lanes(i32x4 a, i32x4 b, i32x4 c, i32x4 d) {
  __m128i first = _mm_packs_epi32(bits<__m128i>(a), bits<__m128i>(b));
  return bits<i32x4>(_mm_packs_epi16(first, _mm_packs_epi32(bits<__m128i>(c), bits<__m128i>(d)))) == -1;
}
inline u32 at_most(f64x2 a, f64x2 b) { return u32(_mm_movemask_pd(bits<__m128d>(a <= b))); }
inline u32 below(f64x2 a, f64x2 b) { return u32(_mm_movemask_pd(bits<__m128d>(a < b))); }
inline bool any(i32x4 v) { return !_mm_testz_si128(bits<__m128i>(v), bits<__m128i>(v)); }
inline f32x4 narrow(f64x2 v) { return bits<f32x4>(_mm_cvtpd_ps(bits<__m128d>(v))); }
inline f64x2 widen(f32x4 v) { return bits<f64x2>(_mm_cvtps_pd(bits<__m128>(v))); }
inline u32x4 min(u32x4 a, u32x4 b) { return bits<u32x4>(_mm_min_epu32(bits<__m128i>(a), bits<__m128i>(b))); }
inline u32x4 max(u32x4 a, u32x4 b) { return bits<u32x4>(_mm_max_epu32(bits<__m128i>(a), bits<__m128i>(b))); }
inline f32x4 min(f32x4 a, f32x4 b) { return bits<f32x4>(_mm_min_ps(bits<__m128>(a), bits<__m128>(b))); }
inline f32x4 max(f32x4 a, f32x4 b) { return bits<f32x4>(_mm_max_ps(bits<__m128>(a), bits<__m128>(b))); }
inline f64x2 min(f64x2 a, f64x2 b) { return bits<f64x2>(_mm_min_pd(bits<__m128d>(a), bits<__m128d>(b))); }
inline f64x2 max(f64x2 a, f64x2 b) { return bits<f64x2>(_mm_max_pd(bits<__m128d>(a), bits<__m128d>(b))); }
inline u8x16 swizzle(u8x16 v, u8x16 index) {
  return bits<u8x16>(_mm_shuffle_epi8(bits<__m128i>(v), bits<__m128i>(index)));
}
#endif

/// Whether a number is neither infinite nor NaN.
template <class T> inline bool is_finite(T x) { return x - x == 0; }

template <class T> inline T smaller(T a, T b) { return b < a ? b : a; }
template <class T> inline T larger(T a, T b) { return a < b ? b : a; }
// Floats as vectors: engines compile a choice between two scalars to a branch, which would be unpredictable.
inline f32 smaller(f32 a, f32 b) { return min(splat(b), splat(a))[0]; }
inline f32 larger(f32 a, f32 b) { return max(splat(b), splat(a))[0]; }
inline f64 smaller(f64 a, f64 b) { return min(splat(b), splat(a))[0]; }
inline f64 larger(f64 a, f64 b) { return max(splat(b), splat(a))[0]; }

/// The largest of four numbers, and the smallest.
inline f32 largest(f32x4 of) {
  of = max(of, __builtin_shufflevector(of, of, 2, 3, 0, 1));
  return max(of, __builtin_shufflevector(of, of, 1, 0, 3, 2))[0];
}
inline u32 smallest(u32x4 of) {
  of = min(of, __builtin_shufflevector(of, of, 2, 3, 0, 1));
  return min(of, __builtin_shufflevector(of, of, 1, 0, 3, 2))[0];
}

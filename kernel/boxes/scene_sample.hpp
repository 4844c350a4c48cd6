// What a frame looks like, from a sample of it: extents, sizes and crowding.
// Idea: a few hundred boxes at jittered strides (fixed strides alias with structured input). If the extents have a
// heavy tail (one box at 1e9 must not stretch the grid), the 2nd and 98th percentiles take their place. Crowding is
// measured by a coarse histogram: the ratio of a box's neighbours to those it would have if all were spread evenly. It
// depends on the boxes alone, never on earlier frames, so that a restored space behaves the same.
// Cost: about 10 ns for each of at most 1,024 sampled boxes.
#pragma once
#include "boxes/box.hpp"

inline f64 cube_root(f64 x) {
  f64 root = bits<f64>(bits<u64>(x) / 3 + 0x2a9f7893782da1ce);  // within 5 %: the exponent divided by three
  for (int k = 0; k < 3; k++) root = (2 * root + x / (root * root)) / 3;
  return root;
}

template <int D> struct SceneSample {
  f64 low[D], high[D];  // extents of the boxes' lower corners, without outliers
  f64 size[D];          // mean sizes, each clipped to the extent
  f64 crowding;         // 1: spread evenly

  /// The axis along which the world is longest, measured in boxes.
  SMALL int longest() const {
    int best = 0;
    f64 most = -1;
    for (int a = 0; a < D; a++) {
      f64 extent = high[a] - low[a];
      f64 length = extent > 0 ? extent / larger(size[a], extent * 1e-7) : 0;
      if (length > most) {
        most = length;
        best = a;
      }
    }
    return best;
  }

  /// The same sample with the axes in another order.
  SceneSample in(const AxisOrder<D>& order) const {
    SceneSample turned = *this;
    for (int a = 0; a < D; a++) {
      turned.low[a] = low[order.axis[a]];
      turned.high[a] = high[order.axis[a]];
      turned.size[a] = size[order.axis[a]];
    }
    return turned;
  }
};

namespace detail {

inline constexpr u32 most_samples = 1024;
// Standard deviations: for even or bell-shaped spreads of that many boxes the range is smaller.
inline constexpr f32 tail = 8;
inline f32 sample[6][most_samples];  // per axis the minima, then per axis the maxima
inline f32 sorted[most_samples];

/// The k-th smallest of n values, which are reordered (quickselect with the median of three). With a `width` above 1,
/// they are points of that many coordinates, compared along one axis.
template <int width = 1> SMALL f32 select(f32* points, i32 n, i32 k, int axis = 0) {
  f32* v = points + axis;
  i32 from = 0, to = n - 1;
  while (from < to) {
    f32 a = v[from * width], b = v[(from + to) / 2 * width], c = v[to * width];
    f32 pivot = larger(smaller(a, b), smaller(larger(a, b), c));
    i32 i = from, j = to;
    while (i <= j) {
      while (v[i * width] < pivot) i++;
      while (pivot < v[j * width]) j--;
      if (i <= j) {
        for (int a = 0; a < width; a++) {
          f32 t = points[i * width + a];
          points[i * width + a] = points[j * width + a];
          points[j * width + a] = t;
        }
        i++;
        j--;
      }
    }
    if (k <= j) to = j;
    else if (k >= i) from = i;
    else break;
  }
  return v[k * width];
}

/// Stratified sampling: picks n of `count`, one at a pseudorandom place in each of n ranges of equal size, or one larger.
class Sampling {
  u32 size_, larger_, at_ = 0, jitter_ = 0x9e3779b9;

 public:
  Sampling(u32 count, u32 n) : size_(count / n), larger_(count % n) {}
  u32 next() {
    jitter_ = jitter_ * 1664525 + 1013904223;
    u32 from = at_, size = size_ + (larger_ > 0);
    larger_ -= larger_ > 0;
    at_ += size;
    return from + u32((u64(jitter_) * size) >> 32);
  }
};

/// How many of `count` boxes are sampled.
inline u32 samples_of(u32 count) { return smaller(count, smaller(larger(count / 64, 256u), most_samples)); }

inline bool is_finite(f32 x) { return x - x == 0; }

/// The extent of the finite values among n, without outliers.
SMALL inline void extents(const f32* v, u32 n, f64& low, f64& high) {
  // In float32, values near the largest float would overflow; in double none do.
  f64 least = __builtin_inf(), most = -__builtin_inf(), sum = 0, squares = 0;
  for (u32 k = 0; k < n; k++) {
    f64 x = v[k];
    least = smaller(x, least);
    most = larger(x, most);
    sum += x;
    squares += x * x;
  }
  f64 mean = sum / n;
  f64 variance = squares / n - mean * mean;
  low = least;
  high = most;
  // The second test catches cancellation: then the deviation is unreliable.
  f64 range = most - least;
  bool tame = range * range <= tail * tail * variance && variance > 1e-9 * mean * mean;
  if (tame) return;
  i32 kept = 0;
  for (u32 k = 0; k < n; k++) {
    if (is_finite(v[k])) sorted[kept++] = v[k];
  }
  if (kept == 0) {
    low = high = 0;
    return;
  }
  // Cuts off 2 % on each side, or 12 % if that leaves less than a sixteenth. Values outside go to the border
  // cells.
  for (i32 share = 50; share > 0; share = share == 50 ? 8 : 0) {
    i32 tail = kept / share;
    f64 from = select(sorted, kept, tail), to = select(sorted, kept, kept - 1 - tail);
    if (share == 50 || (to - from) * 16 < high - low) {
      low = from;
      high = to;
    }
  }
}

/// After `measure` of `count` items: the size along an axis that this share of the sample does not exceed (a quantile).
SMALL inline f64 common_size(int axis, int dimensions, u32 count, f64 share) {
  i32 n = i32(samples_of(count)), kept = 0;
  for (i32 k = 0; k < n; k++) {
    f32 size = sample[dimensions + axis][k] - sample[axis][k];
    if (is_finite(size)) sorted[kept++] = size;
  }
  return kept ? select(sorted, kept, i32((kept - 1) * share)) : 0;
}

/// Evaluates the n items in `sample`.
template <int D> NOINLINE SceneSample<D> judge(u32 n) {
  SceneSample<D> found;
  constexpr u32 side = D == 2 ? 64 : 16;
  static u16 cell[most_samples];
  for (int a = 0; a < D; a++) {
    extents(sample[a], n, found.low[a], found.high[a]);
    f64 extent = found.high[a] - found.low[a];
    f64 sum = 0;
    for (u32 k = 0; k < n; k++) {
      f64 size = f64(sample[D + a][k]) - f64(sample[a][k]);
      if (size > 0) sum += smaller(size, extent);  // false for NaN, when both bounds are the same infinity
    }
    found.size[a] = sum / n;
    f64 scale = extent > 0 ? side / extent : 0;
    for (u32 k = 0; k < n; k++) {
      f64 at = (f64(sample[a][k]) - found.low[a]) * scale;
      u32 index = at > 0 ? u32(smaller(at, f64(side - 1))) : 0;
      cell[k] = a == 0 ? u16(index) : u16(cell[k] * side + index);
    }
  }

  constexpr u32 cells = D == 2 ? side * side : side * side * side;
  static u16 histogram[cells];
  for (u32 c = 0; c < cells; c++) histogram[c] = 0;
  f64 meetings = 0;
  for (u32 k = 0; k < n; k++) meetings += 2 * histogram[cell[k]]++;
  found.crowding = n < 64 ? 1 : larger(1.0, meetings * cells / (f64(n) * (n - 1)));
  return found;
}

}  // namespace detail

/// A sample of `count` items (Source: SceneItems or ItemsAt), along the axes as the source gives them.
template <int D, class Source> NOINLINE SceneSample<D> measure(const Source& items, u32 count) {
  using detail::sample;
  u32 n = detail::samples_of(count);
  detail::Sampling sampling(count, n);
  for (u32 k = 0; k < n; k++) {
    Item<D> item = items[sampling.next()];
    for (int a = 0; a < D; a++) {
      sample[a][k] = item.lo(a);
      sample[D + a][k] = item.hi(a);
    }
  }
  return detail::judge<D>(n);
}

/// The same for a few items, from all of them, without crowding. False if some are infinite, or far from all others:
/// then they must be measured.
template <int D, class Source> bool glance(const Source& items, u32 count, SceneSample<D>& found) {
  f32x4 origin = items[0].first(), least = origin, most = origin, sizes = {}, sum = {}, squares = {};
  for (u32 k = 0; k < count; k++) {
    Item<D> item = items[k];
    least = min(least, item.first());
    most = max(most, item.first());
    sizes += item.size();
  }
  u32 seen = 0;
  ROLLED for (u32 k = 0; k < count; k += count / 64 + 1, seen++) {
    f32x4 far = items[k].first() - origin;
    sum += far;
    squares += far * far;
  }
  f32x4 n = splat(f32(seen)), range = most - least, mean = sum / n, variance = squares / n - mean * mean;
  i32x4 tame = range * range <= splat(detail::tail * detail::tail) * variance;
  found.crowding = 1;
  bool all = true;
  for (int a = 0; a < D; a++) {
    found.low[a] = least[a];
    found.high[a] = most[a];
    found.size[a] = sizes[a] / f32(count);
    all &= tame[a] || range[a] == 0;
  }
  return all;
}

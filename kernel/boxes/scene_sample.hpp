// What a frame looks like, from a sample of it: extents, sizes and crowding.
// Idea: a few hundred boxes at jittered strides (fixed strides alias with structured input). If some boxes are far
// from most others (one at 1e9 must not stretch the grid, nor a tenth of them in another room), the extents are those of
// most boxes, and all others go to the border cells. Crowding is measured by a coarse histogram: the ratio of a box's
// neighbours to those it would have if all were spread evenly. It depends on the boxes alone, never on earlier frames, so
// that a restored space behaves the same.
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
  f64 size[D];  // mean sizes, each clipped to the extent
  f64 crowding;  // 1: spread evenly

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
    SceneSample sample = *this;
    for (int a = 0; a < D; a++) {
      sample.low[a] = low[order.axis[a]];
      sample.high[a] = high[order.axis[a]];
      sample.size[a] = size[order.axis[a]];
    }
    return sample;
  }
};

/// The k-th smallest of n values, which are reordered (quickselect with the median of three). With a `width` above 1,
/// they are points of that many coordinates, compared along one axis.
template <int width = 1> SMALL f32 kth_smallest(f32* points, i32 n, i32 k, int axis = 0) {
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

namespace detail {

inline constexpr u32 most_samples = 1024;
inline f32 sample[6][most_samples];  // per axis the minima, then per axis the maxima
inline f32 sorted[most_samples];

/// How many of `count` boxes are sampled.
inline u32 samples_of(u32 count) { return smaller(count, smaller(larger(count / 64, 256u), most_samples)); }

/// Narrows a range to that of most of n values, `finite` of which count: to one without gaps that has 98 % of them in half
/// of the range, or five in six in a sixteenth of it. It does so again and again, since one value far off hides another.
NOINLINE inline void narrow_to_most(const f32* v, u32 n, u32 finite, f64& low, f64& high) {
  constexpr u32 bins = 64;
  while (high > low) {
    u32 counts[bins + 1] = {};
    f64 scale = bins / (high - low);
    auto bin_of = [&](u32 k) {
      f64 at = (v[k] - low) * scale;
      return at >= 0 && at <= bins ? smaller(u32(at), bins - 1) : bins;
    };
    for (u32 k = 0; k < n; k++) counts[bin_of(k)]++;
    counts[bins] = 0;
    u32 from = 0, to = 0, most = 0, begin = 0, here = 0;
    for (u32 b = 0; b <= bins; b++) {
      here += counts[b];
      if (counts[b] > 0) continue;
      if (here > most) {
        most = here;
        from = begin;
        to = b;
      }
      here = 0;
      begin = b + 1;
    }
    u32 length = to - from;
    if (most * 50 >= finite * 49 ? length > bins / 2 : most * 6 < finite * 5 || length > bins / 16) return;
    f64 least = high, last = low;
    for (u32 k = 0; k < n; k++) {
      u32 bin = bin_of(k);
      if (bin < from || bin >= to) continue;
      least = smaller(f64(v[k]), least);
      last = larger(f64(v[k]), last);
    }
    low = least;
    high = last;
  }
}

/// The extent of the finite values among n, without outliers.
SMALL inline void extents(const f32* v, u32 n, f64& low, f64& high) {
  u32 finite = 0;
  low = __builtin_inf();
  high = -low;
  for (u32 k = 0; k < n; k++) {
    if (!is_finite(v[k])) continue;
    finite++;
    low = smaller(f64(v[k]), low);
    high = larger(f64(v[k]), high);
  }
  if (finite == 0) low = high = 0;
  narrow_to_most(v, n, finite, low, high);
}

/// The mean of n sizes, each clipped to the extent of the world.
SMALL inline f64 mean_size(const f32* lo, const f32* hi, u32 n, f64 extent) {
  f64 sum = 0;
  for (u32 k = 0; k < n; k++) {
    f64 size = f64(hi[k]) - f64(lo[k]);
    if (size > 0) sum += smaller(size, extent);  // false for NaN, when both bounds are the same infinity
  }
  return sum / n;
}

/// Evaluates the n items in `sample`.
template <int D> NOINLINE SceneSample<D> judge(u32 n) {
  SceneSample<D> found;
  constexpr u32 side = D == 2 ? 64 : 16, cells = D == 2 ? side * side : side * side * side;
  static u16 cell[most_samples];
  for (int a = 0; a < D; a++) {
    extents(sample[a], n, found.low[a], found.high[a]);
    f64 extent = found.high[a] - found.low[a];
    found.size[a] = mean_size(sample[a], sample[D + a], n, extent);
    f64 scale = extent > 0 ? side / extent : 0;
    for (u32 k = 0; k < n; k++) {
      f64 at = (f64(sample[a][k]) - found.low[a]) * scale;
      bool inside = at >= 0 && at <= side && (a == 0 || cell[k] < cells);
      u32 index = inside ? u32(smaller(at, f64(side - 1))) : 0;
      cell[k] = u16(!inside ? cells : a == 0 ? index : cell[k] * side + index);
    }
  }

  static u16 histogram[cells];
  __builtin_memset(histogram, 0, sizeof(histogram));
  f64 meetings = 0, inside = 0;
  for (u32 k = 0; k < n; k++) {
    if (cell[k] == cells) continue;
    meetings += 2 * histogram[cell[k]]++;
    inside++;
  }
  found.crowding = inside < 64 ? 1 : larger(1.0, meetings * cells / (inside * (inside - 1)));
  return found;
}

}  // namespace detail

/// A sample of `count` items (Source: SceneItems or ItemsAt), along the axes as the source gives them.
template <int D, class Source> NOINLINE SceneSample<D> measure(const Source& items, u32 count) {
  using detail::sample;
  u32 n = detail::samples_of(count);
  Sampling sampling(count, n);
  for (u32 k = 0; k < n; k++) {
    Item<D> item = items[sampling.next()];
    for (int a = 0; a < D; a++) {
      sample[a][k] = item.lo(a);
      sample[D + a][k] = item.hi(a);
    }
  }
  return detail::judge<D>(n);
}

namespace detail {

/// Extent and size along an axis from every `step`-th item, `seen` of them, without outliers.
template <int D, class Source>
SMALL void look_closer(const Source& items, u32 step, u32 seen, int axis, SceneSample<D>& found) {
  for (u32 k = 0; k < seen; k++) {
    sample[0][k] = items[k * step].lo(axis);
    sample[1][k] = items[k * step].hi(axis);
  }
  extents(sample[0], seen, found.low[axis], found.high[axis]);
  found.size[axis] = mean_size(sample[0], sample[1], seen, found.high[axis] - found.low[axis]);
}

}  // namespace detail

/// The same for a few items, without crowding: extents and sizes of all of them, or of a sample of 64 where some are far
/// from most others, or infinite.
template <int D, class Source> SceneSample<D> glance(const Source& items, u32 count) {
  // Boxes spread evenly, or in a bell, have a range of fewer than 8 standard deviations, and a mean deviation of at least
  // 2.25 variances by the range; it would be 2 if all were at the two ends of the range.
  const f32x4 tail = splat(8.0f), apart = splat(2.25f);
  f32x4 origin = items[0].first(), least = origin, most = origin, sizes = {}, sum = {}, squares = {}, deviation = {};
  f32x4 largest = {};
  for (u32 k = 0; k < count; k++) {
    Item<D> item = items[k];
    least = min(least, item.first());
    most = max(most, item.first());
    sizes += item.size();
    largest = max(largest, item.size());
  }
  u32 step = count / 64 + 1, seen = 0;
  ROLLED for (u32 k = 0; k < count; k += step, seen++) {
    f32x4 far = items[k].first() - origin;
    sum += far;
    squares += far * far;
  }
  f32x4 n = splat(f32(seen)), range = most - least, mean = sum / n, variance = squares / n - mean * mean;
  ROLLED for (u32 k = 0; k < count; k += step) {
    f32x4 away = items[k].first() - origin - mean;
    deviation += max(away, -away);
  }
  i32x4 tame = (range * range <= tail * tail * variance) & (deviation / n * range >= apart * variance);
  SceneSample<D> found;
  found.crowding = 1;
  for (int a = 0; a < D; a++) {
    found.low[a] = least[a];
    found.high[a] = most[a];
    found.size[a] = sizes[a] / f32(count);
    // A box as long as the world, such as its floor, hardly changes the mean size.
    if (tame[a] && is_finite(range[a]) && largest[a] <= 4 * range[a]) continue;
    detail::look_closer<D>(items, step, seen, a, found);
  }
  return found;
}

/// After `measure` of `count` items: the size along an axis that this share of the sample does not exceed (a quantile).
SMALL inline f64 common_size(int axis, int dimensions, u32 count, f64 share) {
  using namespace detail;
  i32 n = i32(samples_of(count)), kept = 0;
  for (i32 k = 0; k < n; k++) {
    f32 size = sample[dimensions + axis][k] - sample[axis][k];
    if (is_finite(size)) sorted[kept++] = size;
  }
  return kept ? kth_smallest(sorted, kept, i32((kept - 1) * share)) : 0;
}

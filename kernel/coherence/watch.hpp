// How far boxes get from where they were, by a sample of them, and which margin is worth it.
// Idea: for each box of the sample, the largest displacement after 1, 2, 4 … 64 updates is measured. Nothing is
// extrapolated. A list with a margin m that lives for so many updates then costs: its candidates, the share of its
// making, and whatever it takes to serve the boxes that were further away than m. The cheapest is chosen.
// Motion that most boxes have in common (a world that scrolls) is taken out first.
#pragma once
#include "../box_tests.hpp"
#include "../statistics.hpp"
#include "tuning.hpp"

/// What is known of the lists to come, for each box, in tests of strip sweep.
template <int D> struct Prospect {
  f64 sizes[D] = {};       // of boxes: the median
  f64 boxes = 0, looked = 0;  // all, and those that an update looks at
  f64 pairs = 0;           // candidates of a list without a margin
  f64 fresh = 0;           // a rebuild
  f64 rest = 0;            // the share of boxes that will be known to rest

  f64 growth(f64 margin) const {
    f64 growth = 1;
    for (f64 size : sizes) growth *= size > 0 ? 1 + 2 * margin / size : 1;
    return growth;
  }
  /// The smallest of the sizes that are above 0.
  f64 smallest() const {
    f64 least = 0;
    for (f64 size : sizes) least = size > 0 && (least == 0 || size < least) ? size : least;
    return least;
  }
  /// What is tested in an update: not the pairs of two that rest, which do not grow.
  f64 candidates(f64 growth) const { return pairs * growth * (1 - rest * rest); }
  /// How many times as much strip sweep does for a list as for a rebuild.
  f64 widening(f64 growth, const Tuning<D>& tuning) const { return 1 + tuning.widen * (growth - 1) * (1 - rest * rest); }
  /// What it takes to make a list.
  f64 build(f64 growth, const Tuning<D>& tuning) const { return fresh * (tuning.build - 1 + widening(growth, tuning)); }
  /// How many times as long it takes as in the near caches to get at what stands anywhere.
  f64 farness(const Tuning<D>& tuning) const { return 1 + boxes / tuning.far; }
};

struct Plan {
  f32 margin = 0;
  f64 work = __builtin_inf();  // for each box and update
};

template <int D> class Watch {
  static constexpr u32 width = 2 * D, most = 256, horizons = 7, buckets = 24, voters = 31;

  struct Sample {
    f32x4 at[2], last[2], far;  // the first and the last four numbers of the box
    u32 slot, jumps;
  };
  /// How far the samples got in so many updates, and how often they jumped.
  struct Horizon {
    f32 reach[most];
    u32 jumps[most];
  };

  Buffer<Sample> samples_;
  Buffer<Horizon> horizons_;
  u32 many_ = 0, age_ = 0, known_ = 0;
  bool common_ = false;
  f32x4 total_ = {}, begun_ = {};  // common motion, since ever and until these samples were taken

 public:
  static constexpr u32 longest = 1u << (horizons - 1);  // updates over which displacements are measured

  /// Common motion since ever, per axis.
  f32x4 common() const { return total_; }
  /// Of how many updates it is known how far boxes get.
  u32 known() const { return known_ ? 1u << (known_ - 1) : 0; }
  COLD void release() {
    many_ = known_ = 0;
    samples_.release();
    horizons_.release();
  }

  /// The share of boxes that have not moved for as long as is known.
  f64 resting() const {
    u32 count = 0;
    for (u32 k = 0; known_ > 0 && k < many_; k++) count += horizons_[known_ - 1].reach[k] == 0 && horizons_[known_ - 1].jumps[k] == 0;
    return count ? f64(count) / many_ : 0;
  }

  /// Whether all rest, or more than a share by twice what a sample varies.
  bool more_rest(f64 share) const {
    f64 more = resting() - share;
    return more > 0 && (share + more == 1 || more * more * many_ > 4 * share * (1 - share));
  }

  /// The size along an axis that half of the boxes do not exceed, or an eighth of what they are apart.
  COLD f64 size(int a, u32 boxes) const {
    f32 sizes[most];
    f32 least = __builtin_inff(), most_of_all = -least;
    u32 count = 0;
    for (u32 k = 0; k < many_; k++) {
      f32 low = samples_[k].last[0][a], size = samples_[k].last[1][4 - D + a] - low;
      if (!detail::is_finite(size)) continue;
      sizes[count++] = size;
      least = smaller(least, low);
      most_of_all = larger(most_of_all, low);
    }
    if (count == 0) return 0;
    f64 apart = (f64(most_of_all) - least) / (D == 2 ? __builtin_sqrt(f64(boxes)) : cube_root(boxes));
    return larger(f64(detail::select(sizes, i32(count), i32(count / 2))), apart / 8);
  }

  /// Whether a sample was taken in the last update.
  bool is_new() const { return many_ > 0 && age_ == 0; }

  COLD void begin_if_new(const Scene<D>& scene) {
    if (many_ == 0) begin(scene);
  }

  /// Sees where the boxes are in this update. `size`: of a box; what moves by more at once jumps.
  COLD void look(const Scene<D>& scene, f32 size) {
    bool fits = many_ > 0 && scene.count >= smallest_;
    if (!fits) return begin(scene);
    age_++;
    f32x4 shift = f32x4{};
    bool judged = (age_ & (age_ - 1)) == 0;
    if (common_ || judged) shift = vote(scene);
    if (judged && judge(scene, shift, size)) return begin(scene);
    if (!common_) shift = f32x4{};
    f32x4 now = begun_ + shift, step = now - total_;
    total_ = now;
    for (u32 k = 0; k < many_; k++) follow(samples_[k], scene.box(samples_[k].slot), shift, step, size);
    for (u32 h = 0; h < horizons; h++) {
      if (age_ != 1u << h) continue;
      for (u32 k = 0; k < many_; k++) {
        f32x4 far = samples_[k].far;
        horizons_[h].reach[k] = larger(larger(far[0], far[1]), larger(far[2], far[3]));
        horizons_[h].jumps[k] = samples_[k].jumps;
      }
      known_ = larger(known_, h + 1);
    }
    if (age_ == 1u << (horizons - 1)) begin(scene);
  }

  /// The margin of least work.
  COLD Plan plan(const Prospect<D>& prospect, const Tuning<D>& tuning) const {
    Plan best;
    f64 scale = larger(prospect.smallest(), 1e-30);
    for (u32 h = 0; h < known_; h++) weigh(h, scale, prospect, tuning, best);
    return best;
  }

 private:
  u32 smallest_ = 0;  // boxes without which the sample is none

  static f32x4 first(const f32* box) { return load<f32x4>(box); }
  static f32x4 last(const f32* box) { return load<f32x4>(box + width - 4); }
  static f32x4 magnitude(f32x4 v) { return bits<f32x4>(bits<u32x4>(v) & splat(0x7fffffffu)); }
  /// A motion along the axes, for the first and for the last four numbers of a box.
  static f32x4 for_first(f32x4 v) { return D == 2 ? __builtin_shufflevector(v, v, 0, 1, 0, 1) : __builtin_shufflevector(v, v, 0, 1, 2, 0); }
  static f32x4 for_last(f32x4 v) { return D == 2 ? for_first(v) : __builtin_shufflevector(v, v, 2, 0, 1, 2); }

  COLD void begin(const Scene<D>& scene) {
    samples_.reserve(most);
    horizons_.reserve(horizons);
    many_ = smaller(most, larger(scene.count / 16, 32u));
    smallest_ = 0;
    detail::Sampling sampling(scene.count, many_);
    for (u32 k = 0; k < many_; k++) {
      Sample& sample = samples_[k];
      sample.slot = sampling.next();
      smallest_ = larger(smallest_, sample.slot + 1);
      const f32* box = scene.box(sample.slot);
      sample.at[0] = sample.last[0] = first(box);
      sample.at[1] = sample.last[1] = last(box);
      sample.far = f32x4{};
      sample.jumps = 0;
    }
    age_ = 0;
    begun_ = total_;
  }

  static void follow(Sample& sample, const f32* box, f32x4 shift, f32x4 step, f32 size) {
    f32x4 one = first(box), two = last(box);
    f32x4 move = one - sample.last[0] - for_first(step);
    if ((bitmask(magnitude(move) > splat(size)) & (D == 2 ? 3 : 7)) != 0) {  // the sample goes on from where it jumped to
      sample.at[0] += one - sample.last[0] - for_first(step);
      sample.at[1] += two - sample.last[1] - for_last(step);
      sample.jumps++;
    }
    sample.last[0] = one;
    sample.last[1] = two;
    f32x4 far = max(magnitude(one - sample.at[0] - for_first(shift)), magnitude(two - sample.at[1] - for_last(shift)));
    sample.far = max(far, sample.far);
  }

  /// The median displacement of some of the sample, per axis.
  COLD f32x4 vote(const Scene<D>& scene) const {
    f32 moves[D][voters];
    u32 step = larger(1u, many_ / voters), votes = 0;
    for (u32 k = 0; k < many_ && votes < voters; k += step, votes++) {
      const f32* box = scene.box(samples_[k].slot);
      for (int a = 0; a < D; a++) moves[a][votes] = box[a] - samples_[k].at[0][a];
    }
    f32x4 median = {};
    for (int a = 0; a < D; a++) {
      f32 m = detail::select(moves[a], i32(votes), i32(votes / 2));
      median[a] = m - m == 0 ? m : 0;
    }
    return median;
  }

  /// Whether it changes that common motion is taken out.
  COLD bool judge(const Scene<D>& scene, f32x4 shift, f32 size) {
    f64 with = 0, without = 0;
    for (u32 k = 0; k < many_; k++) {
      f32x4 move = first(scene.box(samples_[k].slot)) - samples_[k].at[0], most = splat(4 * size);
      f32x4 all = min(magnitude(move), most), own = min(magnitude(move - shift), most);
      for (int a = 0; a < D; a++) {
        without += all[a];
        with += own[a];
      }
    }
    bool wish = with < (common_ ? 0.9 : 0.6) * without;
    if (wish == common_) return false;
    common_ = wish;
    known_ = 0;
    return true;
  }

  /// The upper end of a bucket of reaches, in mean sizes: half octaves.
  static f64 edge(u32 bucket) {
    f64 octave = bits<f64>(u64(1023 + bucket / 2 - 10) << 52);
    return bucket & 1 ? octave * 1.5 : octave;
  }

  COLD void weigh(u32 h, f64 scale, const Prospect<D>& prospect, const Tuning<D>& tuning, Plan& best) const {
    u32 tail[buckets + 1] = {};  // how many reach into a bucket
    f64 jumps = 0, steady = 0, updates = 1u << h;
    f32 unit = f32(1 / scale);
    u32 lowest = bits<u32>(f32(edge(0))) >> 22;
    for (u32 k = 0; k < many_; k++) {
      i32 bucket = i32((bits<u32>(horizons_[h].reach[k] * unit) + (1u << 22) - 1) >> 22) - i32(lowest);
      tail[larger(0, smaller(bucket, i32(buckets)))]++;
      u32 its = horizons_[h].jumps[k];
      if (2 * its >= updates) steady++;
      else jumps += its;
    }
    // A box is late once, and once more for each two buckets that it is further away: its margin doubles.
    f64 events[buckets + 3] = {}, beyond = 0;
    for (u32 m = buckets + 1; m-- > 0;) {
      events[m] = beyond + events[m + 2];
      beyond += tail[m];
    }
    f64 far = prospect.farness(tuning), late = tuning.late * far / many_;
    for (u32 m = 0; m < buckets - 2; m++) {
      f64 margin = scale * edge(m), growth = prospect.growth(margin);
      f64 work = tuning.look * prospect.looked + tuning.candidate * far * prospect.candidates(growth);
      work += (prospect.build(growth, tuning) + (jumps + events[m]) * late) / updates + steady * late;
      if (work < best.work) best = {f32(margin), work};
    }
  }
};

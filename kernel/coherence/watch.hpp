// How far boxes move, measured on a sample, and the margin that costs least.
// Idea: for each box of the sample, the largest displacement within 1, 2, 4 … 64 updates is measured. Nothing is
// extrapolated. Regions may also reach ahead by as far as a box moved in the same number of updates before. How far
// boxes then were from that path is measured too. Of all displacements only a histogram is retained. For a list with
// margin m that lives for that many updates, the cost per update is: testing its candidates, its share of choosing the
// margin and of making the list, and serving the boxes that moved further than m, or that were at rest and begin to
// move. The cheapest plan is chosen. Motion common to most boxes (a world that scrolls or zooms) is subtracted first.
// Cost: about 10 ns per sampled box in an update; 2 to 6 µs to choose a margin; up to 8,000 distances between sampled
// boxes when samples are taken.
#pragma once
#include "base/box_tests.hpp"
#include "boxes/scene_sample.hpp"
#include "coherence/tuning.hpp"

/// A motion that boxes have in common: along each axis, they are scaled and moved. The lanes are those of the first
/// four numbers of a box. Rounding is monotone, so boxes that overlap still do so after it.
struct Shift {
  f32x4 scale = {1, 1, 1, 1}, offset = {};

  f32x4 operator()(f32x4 x) const { return x * scale + offset; }
  Shift after(const Shift& first) const { return {scale * first.scale, (*this)(first.offset)}; }
  Shift back() const { return {splat(1.0f) / scale, f32x4{} - offset / scale}; }
  bool differs(const Shift& other) const {
    return any((bits<i32x4>(scale) ^ bits<i32x4>(other.scale)) | (bits<i32x4>(offset) ^ bits<i32x4>(other.offset)));
  }
  /// Whether it makes no number NaN.
  bool is_sound() const {
    return bitmask((scale > splat(0.25f)) & (scale < splat(4.0f)) & (offset - offset == f32x4{})) == 15;
  }
};

/// What is known about the next list, per box; work in tests of strip sweep.
template <int D> struct Prospect {
  f64 size = 0;  // mean size of boxes along the axis where it is smallest, at least `least`
  f64 least = 0;  // the spacing of boxes, divided by Tuning::apart
  f64 looked = 0;  // the share of boxes that an update checks
  f64 pairs = 0;  // that the sweep of a list without a margin finds
  f64 fresh = 0;  // work of a rebuild
  f64 tests = 0;  // the tests in that
  f64 rest = 0;  // the share of boxes that will be known to rest
  f64 settled = 0;  // the share of pairs in which both will
  f64 listed = 1;  // the share of pairs that it will test: neither these, nor forbidden ones as far as is known
  f64 planning = 0;  // work of choosing the margin
  f64 late = 0;  // work for a late box

  /// Candidates that an update tests.
  f64 candidates(f64 growth) const { return pairs * growth * listed; }
  /// How many times as many pairs the sweep finds as without a margin. Boxes at rest have none.
  f64 widening(f64 growth) const { return 1 + (growth - 1) * (1 - settled); }
  /// How many times as many tests its sweep takes as a rebuild: the growth along all axes but one.
  f64 more_tests(f64 growth) const {
    f64 root = D == 2 ? __builtin_sqrt(widening(growth)) : cube_root(widening(growth));
    return D == 2 ? root : root * root;
  }
  /// The work of making a list: a rebuild with larger boxes, which finds more, and twice the check of all boxes.
  f64 build(f64 growth) const { return fresh + tests * (more_tests(growth) - 1) + pairs * (widening(growth) - 1) + 2; }
};

struct Plan {
  f32 margin = 0;
  f64 growth = 1;  // how many times as many candidates as without a margin
  u32 lead = 0;  // updates that regions reach ahead
  f64 work = __builtin_inf();  // per box and update
  bool settles = true;  // boxes at rest have no margin
};

/// How far regions reach ahead: not at all if `lead` is longer than `most`, which is unlikely to come true.
inline f32x4 bounded(f32x4 lead, f32 most) {
  i32x4 near = (lead <= splat(most)) & (lead >= splat(-most));
  return bitmask(near) == 15 ? lead : f32x4{};
}

/// The volume of the relative positions in which two regions touch, as a polynomial in four times their margin. Summed
/// over several pairs.
template <int D> struct Growth {
  f64 of[D + 1] = {};
  f64 operator()(f64 margin) const {
    f64 sum = 0;
    for (int k = D; k >= 0; k--) sum = sum * 4 * margin + of[k];
    return sum;
  }
};

template <int D> class Watch {
  // One box in `watched_share` is watched, within these limits.
  static constexpr u32 watched_share = 16, most_watched = 256;
  static constexpr Tuning<D> tuning = {};
  static constexpr f64 common_share = 0.75;  // common motion is subtracted if it leaves less than this share
  static constexpr u32 width = 2 * D, most_turns = 3, horizons = 7, voters = 31;
  static constexpr u32 buckets = 30, margins = 22;  // of distances; those whose upper end may be a margin

  struct Sample {
    // The minima and the maxima of the box: where it began, and in the last update. Spare lanes have what follows them.
    f32x4 at[2], last[2];
    f32x4 move;  // in the last update; 0 if it jumped
    f32x4 far;  // the furthest it got from where it began
    f32x4 lead;  // its displacement at the last horizon
    f32x4 led;  // the furthest it has been since then from the path that goes on like that
    u32 slot, jumps;

    bool rests() const { return jumps == 0 && largest(far) == 0; }
  };
  /// How far the samples got within 1, 2, 4 … updates.
  struct Horizon {
    // How many got how far: from where they began; and in as many further updates, from regions that reach ahead.
    u32 far[2][buckets + 1];
    f32 size;  // the unit of the buckets
    u32 many, still, jumps;  // samples; those that did not move; jumps of all
    f32x4 lead[2 * voters];
  };

  Buffer<Sample> samples_;
  Buffer<Horizon> horizons_;
  u32 many_ = 0, age_ = 0, known_ = 0;
  u32 turns_ = 0;  // how many times it has changed whether common motion is subtracted
  bool common_ = false;
  bool quiet_ = false;  // no sample has moved in these updates, at least eight
  Shift total_, begun_;  // common motion so far, and until these samples were taken

 public:
  // Of a box's size: regions that would reach further ahead do not at all; and longer motion counts as this where it is
  // decided whether motion is common, so that one jump does not decide.
  static constexpr f32 farthest = 4;
  static constexpr u32 least_watched = 16;  // boxes: fewer are not watched
  static constexpr u32 longest = 1u << (horizons - 1);  // updates

  /// The spacing of this many boxes where there are boxes: they may be in clusters far from one another. In a crowd of
  /// density d, half of all boxes have another within 0.42 / sqrt(d) along both axes, or 0.44 / cbrt(d) along all three.
  f64 spacing(u32 boxes) const {
    f64 share = f64(many_) / boxes;
    return apart_ * (D == 2 ? __builtin_sqrt(share) / 0.416 : cube_root(share) / 0.442);
  }

  /// The common motion so far.
  const Shift& common() const { return total_; }
  /// The largest number of updates for which it is known how far boxes get.
  u32 known() const { return known_ ? 1u << (known_ - 1) : 0; }
  /// Whether new samples were taken in this update.
  bool is_new() const { return many_ > 0 && age_ == 0; }
  /// Whether it was measured in this update how far boxes got.
  bool is_judged() const { return (age_ & (age_ - 1)) == 0; }
  /// Whether it was found in this update that no box moves any more.
  bool is_quiet() const { return quiet_ && is_judged(); }
  /// Whether measurements were begun again several times, since it changed whether common motion is subtracted.
  bool wavers() const { return turns_ > most_turns; }
  /// Forgets all measurements; the next `look` takes new samples.
  void forget() { many_ = known_ = turns_ = 0; }
  SMALL void release() {
    forget();
    samples_.release();
    horizons_.release();
  }

  /// The share of boxes that have not moved within `known` updates.
  f64 resting() const {
    if (known_ == 0 || common_) return 0;
    const Horizon& last = horizons_[known_ - 1];
    return f64(last.still) / last.many;
  }

  /// The share of boxes that will not stay where they are if they move on as in the last update. `stays`: whether the
  /// box of a slot does if it moves by so much.
  template <class Stays> SMALL f64 leaving(Stays stays) const {
    u32 found = 0;
    for (u32 k = 0; k < many_; k++) found += !stays(samples_[k].slot, samples_[k].move);
    return f64(found) / many_;
  }

  /// Follows the samples in this update. `size`: of a box; one that moves further than this in one update has jumped.
  SMALL void look(const Scene<D>& scene, f32 size) {
    bool fits = many_ > 0 && scene.count >= smallest_;
    if (!fits) return begin(scene);
    age_++;
    Shift since;
    bool judged = is_judged();
    if (common_ || judged) since = vote(scene);
    if (judged && judge(scene, since, size)) return begin(scene);
    if (!common_) since = {};
    Shift now = since.after(begun_), step = now.after(total_.back());
    total_ = now;
    for (u32 k = 0; k < many_; k++) follow(samples_[k], scene.box(samples_[k].slot), since, step, size);
    if (judged) record(scene, u32(__builtin_ctz(age_)), since, size);
    if (age_ == longest) begin(scene);
  }

  /// The plan with the least work, if that is less than `most`. Boxes at rest get a margin like all others if so many of
  /// them begin to move that this is clearly less work.
  SMALL Plan plan(Prospect<D> prospect, f64 most) const {
    Plan best = cheapest(prospect, most);
    if (prospect.rest == 0) return best;
    prospect.listed += prospect.settled;
    prospect.rest = prospect.settled = 0;
    Plan restless = cheapest(prospect, smaller(most, best.work * tuning.ahead));
    if (restless.work == __builtin_inf()) return best;
    restless.settles = false;
    return restless;
  }

  /// How many times as many candidates a margin makes, for boxes at random places: estimated from pairs of samples.
  /// Mean sizes would mislead: boxes that are long along different axes are thick on average.
  SMALL f64 growth(f64 margin, const Prospect<D>& prospect) const {
    Growth<D> plain = space(prospect, nullptr);
    return plain(margin) / plain(0);
  }

 private:
  u32 smallest_ = 0;  // with fewer boxes, some samples are gone
  f64 apart_ = 0;  // the median distance from a sample to the nearest other one, along the axis where it is largest

  /// The plan with the least work for this share of boxes at rest.
  SMALL Plan cheapest(const Prospect<D>& prospect, f64 most) const {
    Plan best;
    Growth<D> plain = space(prospect, nullptr);
    for (u32 led = 0; led < 2; led++) {
      f64 late[margins] = {}, bursts[margins] = {};
      for (u32 h = 0; h + led < known_; h++) weigh(h, led, plain, late, bursts, prospect, most, best);
    }
    return best;
  }

  /// The growth of some pairs of samples, with regions that reach ahead by `lead` unless that is null.
  SMALL Growth<D> space(const Prospect<D>& prospect, const f32x4* lead) const {
    Growth<D> all;
    for (u32 k = 0; k + 1 < many_ && k < 2 * voters; k += 2) {
      const Sample &one = samples_[k], &other = samples_[k + 1];
      f64 of[D + 1] = {1};
      for (int a = 0; a < D; a++) {
        f64 size = f64(one.at[1][a]) - one.at[0][a] + other.at[1][a] - other.at[0][a];
        size = smaller(larger(size, 2 * prospect.least), 1e30);
        if (lead) size += magnitude(lead[k])[a] + magnitude(lead[k + 1])[a];
        for (int j = D; j > 0; j--) of[j] = of[j] * size + of[j - 1];
        of[0] *= size;
      }
      for (int j = 0; j <= D; j++) all.of[j] += of[j];
    }
    if (all.of[0] == 0) all.of[0] = 1;
    return all;
  }

  /// Records how far the samples have got within 2^h updates.
  SMALL void record(const Scene<D>& scene, u32 h, const Shift& since, f32 size) {
    Horizon &now = horizons_[h], *before = h > 0 ? &now - 1 : nullptr;
    now.size = larger(size, 1e-30f);
    now.many = many_;
    now.still = now.jumps = 0;
    __builtin_memset(now.far[0], 0, sizeof(now.far[0]));
    __builtin_memset(now.lead, 0, sizeof(now.lead));
    if (before) __builtin_memset(before->far[1], 0, sizeof(before->far[1]));
    for (u32 k = 0; k < many_; k++) {
      Sample& sample = samples_[k];
      now.far[0][bucket_of(largest(sample.far), now.size)]++;
      now.still += sample.rests();
      now.jumps += sample.jumps;
      if (before) before->far[1][bucket_of(largest(sample.led), before->size)]++;
      const f32* box = scene.box(sample.slot);
      sample.lead = bounded(on_axes(load<f32x4>(box) - since(sample.at[0])), farthest * size);
      sample.led = f32x4{};
      if (k < 2 * voters) now.lead[k] = sample.lead;
    }
    quiet_ = now.still == many_ && age_ >= 8 && !common_;
    known_ = quiet_ ? h + 1 : larger(known_, h + 1);  // what was measured before all came to rest is out of date
  }

  /// Sets the lanes that are not an axis to 0.
  static f32x4 on_axes(f32x4 v) { return bits<f32x4>(bits<u32x4>(v) & u32x4{~0u, ~0u, D == 2 ? 0 : ~0u, 0}); }

  /// The magnitudes of numbers along the axes, and 0 in the other lanes.
  static f32x4 magnitude(f32x4 v) {
    constexpr u32 most = 0x7fffffff;
    return bits<f32x4>(bits<u32x4>(v) & u32x4{most, most, D == 2 ? 0 : most, 0});
  }

  SMALL void begin(const Scene<D>& scene) {
    samples_.reserve(most_watched);
    horizons_.reserve(horizons);
    many_ = smaller(most_watched, larger(scene.count / watched_share, least_watched));
    smallest_ = 0;
    Sampling sampling(scene.count, many_);
    for (u32 k = 0; k < many_; k++) {
      Sample& sample = samples_[k];
      sample.slot = sampling.next();
      smallest_ = larger(smallest_, sample.slot + 1);
      const f32* box = scene.box(sample.slot);
      sample.at[0] = sample.last[0] = load<f32x4>(box);
      sample.at[1] = sample.last[1] = load<f32x4>(box + D);
      sample.move = sample.far = sample.lead = sample.led = f32x4{};
      sample.jumps = 0;
    }
    age_ = 0;
    begun_ = total_;
    apart_ = median_distance();
  }

  NOINLINE f64 median_distance() const {
    f32 all[voters + 1];
    u32 step = larger(1u, many_ / voters), count = 0;
    for (u32 k = 0; k < many_ && count < voters; k += step) {
      f32 nearest = __builtin_inff();
      for (u32 j = 0; j < many_; j++) {
        f32 far = largest(magnitude(samples_[j].at[0] - samples_[k].at[0]));
        if (j != k && far < nearest) nearest = far;  // not if it is NaN
      }
      all[count++] = nearest;
    }
    return smaller(kth_smallest(all, i32(count), i32(count / 2)), 1e30f);
  }

  static void follow(Sample& sample, const f32* box, const Shift& shift, const Shift& step, f32 size) {
    f32x4 low = load<f32x4>(box), high = load<f32x4>(box + D), move = low - step(sample.last[0]);
    if (bitmask(magnitude(move) > splat(size))) {  // the sample goes on from where it jumped to
      sample.at[0] += move;
      sample.at[1] += high - step(sample.last[1]);
      sample.jumps++;
      move = f32x4{};
    }
    sample.move = move;
    sample.last[0] = low;
    sample.last[1] = high;
    f32x4 by_low = on_axes(low - shift(sample.at[0])), by_high = on_axes(high - shift(sample.at[1]));
    sample.far = max(max(magnitude(by_low), magnitude(by_high)), sample.far);
    f32x4 from = min(sample.lead, sample.lead + sample.lead), until = max(sample.lead, sample.lead + sample.lead);
    sample.led = max(max(from - min(by_low, by_high), max(by_low, by_high) - until), sample.led);
  }

  /// The motion that some of the samples have in common. Along each axis, it is the line through two medians: of the
  /// samples in the lower half, and of those in the upper half.
  SMALL Shift vote(const Scene<D>& scene) const {
    Shift found;
    u32 step = larger(1u, many_ / voters);
    for (int a = 0; a < D; a++) {
      f32 all[voters + 1], places[2][voters + 1], moves[2][voters + 1];
      i32 count = 0, votes[2] = {};
      for (u32 k = 0; k < many_ && count < i32(voters); k += step) all[count++] = samples_[k].at[0][a];
      f32 middle = kth_smallest(all, count, count / 2);
      for (i32 k = 0; k < count; k++) {
        const Sample& sample = samples_[u32(k) * step];
        f32 place = sample.at[0][a], move = scene.box(sample.slot)[a] - place;
        if (!is_finite(move)) continue;
        bool upper = place > middle;
        places[upper][votes[upper]] = place;
        moves[upper][votes[upper]++] = move;
      }
      f64 place[2], move[2];
      for (int k = 0; k < 2; k++) {
        i32 odd = (votes[k] - 1) | 1;  // so that both medians are of one box if all move alike
        place[k] = votes[k] ? kth_smallest(places[k], odd, odd / 2) : 0;
        move[k] = votes[k] ? kth_smallest(moves[k], odd, odd / 2) : 0;
      }
      f64 slope = votes[1] && place[1] > place[0] ? (move[1] - move[0]) / (place[1] - place[0]) : 0;
      for (int k = a; k < 4; k += D) {
        found.scale[k] = f32(1 + slope);
        found.offset[k] = f32(move[0] - slope * place[0]);
      }
    }
    return found;
  }

  /// Decides whether common motion is subtracted; returns whether that has changed.
  SMALL bool judge(const Scene<D>& scene, const Shift& shift, f32 size) {
    f64 with = 0, without = 0;
    for (u32 k = 0; k < many_; k++) {
      f32x4 at = samples_[k].at[0], now = load<f32x4>(scene.box(samples_[k].slot)), most = splat(farthest * size);
      f32x4 all = min(magnitude(now - at), most), own = min(magnitude(now - shift(at)), most);
      for (int a = 0; a < D; a++) {
        without += all[a];
        with += own[a];
      }
    }
    bool wish = with < common_share * without;
    if (wish == common_) return false;
    common_ = wish;
    known_ = 0;
    turns_++;
    return true;
  }

  /// The upper end of a bucket of distances, in sizes. Buckets are half octaves.
  static f64 edge(u32 bucket) {
    f64 octave = bits<f64>(u64(1023 + bucket / 2 - 10) << 52);
    return bucket & 1 ? octave * 1.5 : octave;
  }
  static u32 bucket_of(f32 far, f32 size) {
    i32 bucket = i32((bits<u32>(far / size) + (1u << 22) - 1) >> 22) - i32(bits<u32>(f32(edge(0))) >> 22);
    return u32(larger(0, smaller(bucket, i32(buckets))));
  }

  /// Weighs all margins for one horizon, and replaces `best` if one takes less work, and less than `most`. `plain`: the
  /// growth of regions that do not reach ahead; `led`: these do. Per margin, `lates`: the share of samples that were late
  /// in half as many updates; `bursts`: the most per update so far.
  NOINLINE void weigh(u32 h, u32 led, const Growth<D>& plain, f64* lates, f64* bursts, const Prospect<D>& prospect,
                      f64 most, Plan& best) const {
    const Horizon& horizon = horizons_[h];
    f64 updates = 1u << h, share = 1.0 / horizon.many;
    // A box is late once, and once more for each `late_margin` that it moves further.
    f64 events[buckets + 1] = {}, beyond = 0, sum = 0;
    for (u32 m = buckets + 1; m-- > 0;) {
      if (m < margins) {
        bursts[m] = larger(bursts[m], (beyond - lates[m]) * (h ? 2 / updates : 1));
        lates[m] = beyond;
      }
      events[m] = beyond + (sum - beyond * edge(m)) / tuning.late_margin;
      f64 here = horizon.far[led][m] * share;
      beyond += here;
      sum += here * edge(m);
    }
    f64 jumps = horizon.jumps * share;
    f64 looked = prospect.looked;
    if (h > 0 && prospect.rest > 0 && horizon.still < horizons_[h - 1].still) {
      // As many boxes at rest begin to move as in the second half of these updates, and all settled pairs are gone through.
      jumps += 2 * share * (horizons_[h - 1].still - horizon.still);
      looked += tuning.candidate * prospect.pairs * prospect.settled;
    }
    f64 least = looked + tuning.candidate * prospect.candidates(1) + (prospect.planning + prospect.build(1)) / updates;
    Growth<D> all = led ? Growth<D>{} : plain;
    for (u32 m = 0; m < margins; m++) {
      f64 limit = smaller(most, best.work * (led && !best.lead ? tuning.ahead : 1));
      f64 lateness = (jumps + events[m]) * prospect.late / updates;
      if (bursts[m] * prospect.late > tuning.burst * prospect.fresh || least + lateness >= limit) continue;
      if (all.of[0] == 0) all = space(prospect, horizon.lead);
      f64 margin = horizon.size * edge(m), growth = all(margin) / plain(0), build = prospect.build(growth);
      if (build > tuning.build * prospect.fresh) return;  // as for all larger ones
      f64 work = looked + tuning.candidate * prospect.candidates(growth) + lateness;
      work += (prospect.planning + build) / updates;
      if (work < limit) best = {f32(margin), growth, led << h, work};
      if (events[m] == 0) return;  // larger ones only cost more
    }
  }
};

// The simplest model of a space: a map from id to box in double precision, and all pairs by testing every pair of boxes.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "space/space.hpp"

template <int D> using Box = std::array<f64, 2 * D>;  // D minima, then D maxima
template <int D> using Boxes = std::vector<Box<D>>;
using PairList = std::vector<u64>;  // sorted; the smaller id in the low half

// Testing all pairs takes most of the time, and sanitizing the model finds nothing in the kernel.
#if defined(__clang__)
#define UNWATCHED __attribute__((no_sanitize("address", "undefined", "coverage")))
#else
#define UNWATCHED __attribute__((no_sanitize("address", "undefined")))
#endif

/// The number of techniques, `automatic` included.
inline constexpr u32 technique_count = u32(Technique::automatic) + 1;

/// `touching`: whether touching is enough.
inline bool overlap(const f64* a, const f64* b, int dimensions, bool touching = true) {
  for (int k = 0; k < dimensions; k++) {
    if (a[k] > b[dimensions + k] || b[k] > a[dimensions + k]) return false;
    if (!touching && (a[k] == b[dimensions + k] || b[k] == a[dimensions + k])) return false;
  }
  return true;
}

/// The nearest float32 at or below (above) x.
inline f32 outward(f64 x, bool up) {
  const f32 infinity = std::numeric_limits<f32>::infinity(), most = std::numeric_limits<f32>::max();
  if (x > most) return up || x == infinity ? infinity : most;
  if (x < -most) return up && x != -infinity ? -most : -infinity;
  f32 near = f32(x);
  if (up && near < x) return std::nextafter(near, infinity);
  if (!up && near > x) return std::nextafter(near, -infinity);
  return near;
}

template <int D> class Model {
  struct Entry {
    Box<D> box = {};
    Rule rule{~0u, ~0u, 0};
    u32 group = 0;
    f64 reach = 0;
  };
  std::map<u32, Entry> entries_;
  std::set<u32> gone_;  // deleted since the last update

  /// The ids become 0 … count - 1; boxes that were there keep their rules.
  void renumber(u32 count) {
    for (auto entry = entries_.lower_bound(count); entry != entries_.end(); ++entry) gone_.insert(entry->first);
    entries_.erase(entries_.lower_bound(count), entries_.end());
    for (u32 id = 0; id < count; id++) entries_[id];
  }

 public:
  bool touching = true;  // whether boxes that only touch are pairs

  u32 count() const { return u32(entries_.size()); }
  bool has(u32 id) const { return entries_.count(id) > 0; }
  const Box<D>& at(u32 id) const { return entries_.at(id).box; }
  std::vector<u32> ids() const {
    std::vector<u32> all;
    for (const auto& [id, entry] : entries_) all.push_back(id);
    return all;
  }

  void set(u32 id, const Box<D>& box) { entries_[id].box = box; }
  bool remove(u32 id) {
    if (entries_.erase(id) == 0) return false;
    gone_.insert(id);
    return true;
  }
  void clear() { renumber(0); }
  const Rule& rule(u32 id) const { return entries_.at(id).rule; }
  u32 group(u32 id) const { return entries_.at(id).group; }
  f64 reach(u32 id) const { return entries_.at(id).reach; }
  void set_reach(u32 id, f64 distance) { entries_.at(id).reach = distance; }
  /// A box enlarged by its reach.
  Box<D> grown(u32 id) const {
    Box<D> box = at(id);
    for (u32 a = 0; a < D; a++) {
      box[a] -= reach(id);
      box[D + a] += reach(id);
    }
    return box;
  }
  void put_in_group(u32 id, u32 group) { entries_.at(id).group = group; }
  bool is_gone(u64 pair) const { return !gone_.empty() && (gone_.count(u32(pair)) || gone_.count(u32(pair >> 32))); }
  void updated() { gone_.clear(); }
  void replace(const Boxes<D>& boxes) {
    renumber(u32(boxes.size()));
    for (u32 id = 0; id < boxes.size(); id++) entries_[id].box = boxes[id];
  }
  void expose(u32 count) {
    renumber(count);
    for (auto& [id, entry] : entries_) {
      for (int k = 0; k < 2 * D; k++) entry.box[size_t(k)] = f32(entry.box[size_t(k)]);
    }
  }
  void exclude(u32 id, u32 bit, bool on) {
    u32& bits = entries_.at(id).rule.excluded;
    bits = on ? bits | bit : bits & ~bit;
  }
  void filter(u32 id, u32 layer, u32 mask) {
    entries_.at(id).rule.layer = layer;
    entries_.at(id).rule.mask = mask;
  }

  /// Sorted by the larger id first.
  PairList pairs() const {
    std::vector<u32> ids;
    std::vector<f64> boxes;
    std::vector<Rule> rules;
    for (const auto& [id, entry] : entries_) {
      ids.push_back(id);
      Box<D> box = grown(id);
      boxes.insert(boxes.end(), box.begin(), box.end());
      rules.push_back(entry.rule);
    }
    PairList found;
    std::vector<u32> partners(ids.size());
    for (u32 k = 0; k < ids.size(); k++) {
      u32 count = meet_before(k, boxes.data(), rules.data(), partners.data());
      for (u32 n = 0; n < count; n++) {
        u32 other = ids[partners[n]], its = group(other);
        if (!touching && !overlap(grown(other).data(), grown(ids[k]).data(), D, false)) continue;
        if (its == 0 || its != group(ids[k])) found.push_back(other | u64(ids[k]) << 32);
      }
    }
    return found;
  }

 private:
  /// The boxes before the k-th one that meet it.
  UNWATCHED static u32 meet_before(u32 k, const f64* boxes, const Rule* rules, u32* found) {
    const f64* box = boxes + size_t(k) * 2 * D;
    Rule rule = rules[k];
    u32 count = 0;
    for (u32 other = 0; other < k; other++, boxes += 2 * D) {
      const Rule& its = rules[other];
      bool both = !(rule.is_off() || its.is_off());
      both &= (rule.layer & its.mask) && (its.layer & rule.mask) && !(rule.excluded & its.excluded);
      for (u32 a = 0; a < D; a++) both &= (box[a] <= boxes[D + a]) & (boxes[a] <= box[D + a]);
      found[count] = other;
      count += both;
    }
    return count;
  }
};

/// A space with the ids and options that it refers to.
template <int D> struct Instance {
  Ids ids;
  Options options;
  Space<D> space{ids, options};
};

/// The same on the heap: ids alone are too large for some stacks.
template <int D> std::unique_ptr<Instance<D>> open(Technique technique) {
  auto instance = std::make_unique<Instance<D>>();
  instance->space.technique = technique;
  return instance;
}

template <int D> PairList sorted_pairs(const Space<D>& space) {
  const u64* list = space.pairs.list.data();
  PairList found(list, list + space.pairs.count);
  std::sort(found.begin(), found.end());
  return found;
}

/// Adds or moves a box, as JavaScript does if a box may not wait.
template <int D> void set(Space<D>& space, u32 id, const f64* box) {
  Ring<D> ring;
  ring.place(nullptr);
  ring.first()[0] = id;
  __builtin_memcpy(ring.first() + 1, box, 2 * D * sizeof(f64));
  space.store.take(ring, 1);
}

/// Stages boxes and replaces all by them; as float32 if `doubles` is false. Returns the first bad one.
template <int D> i32 replace(Space<D>& space, const Boxes<D>& boxes, bool doubles) {
  u32 count = u32(boxes.size());
  if (doubles) {
    f64* to = space.store.numbers.stage_exact(count);
    for (u32 k = 0; k < count; k++) std::copy(boxes[k].begin(), boxes[k].end(), to + size_t(k) * 2 * D);
  } else {
    f32* to = space.store.numbers.stage(count);
    for (u32 k = 0; k < count; k++) {
      for (u32 n = 0; n < 2 * D; n++) to[size_t(k) * 2 * D + n] = f32(boxes[k][n]);
    }
  }
  return space.store.replace(count, doubles);
}

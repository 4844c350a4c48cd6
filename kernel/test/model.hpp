// What a space must be, said as plainly as possible: a map from id to box in double precision, and all pairs by
// testing each box against each.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "space.hpp"

template <int D> using Box = std::array<f64, 2 * D>;  // D minima, then D maxima
template <int D> using Boxes = std::vector<Box<D>>;
using PairList = std::vector<u64>;  // sorted; the smaller id in the low half

/// The number of techniques, `automatic` included.
inline constexpr u32 technique_count = u32(Technique::automatic) + 1;

inline bool overlap(const f64* a, const f64* b, int dimensions) {
  for (int k = 0; k < dimensions; k++) {
    if (a[k] > b[dimensions + k] || b[k] > a[dimensions + k]) return false;
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
  };
  std::map<u32, Entry> entries_;
  std::set<u32> gone_;  // deleted since the last update

  /// Ids are 0 … count - 1 from now on; those that were there keep their rules.
  void renumber(u32 count) {
    for (auto entry = entries_.lower_bound(count); entry != entries_.end(); ++entry) gone_.insert(entry->first);
    entries_.erase(entries_.lower_bound(count), entries_.end());
    for (u32 id = 0; id < count; id++) entries_[id];
  }

 public:
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
  bool is_gone(u64 pair) const { return gone_.count(u32(pair)) || gone_.count(u32(pair >> 32)); }
  void updated() { gone_.clear(); }
  void replace(const Boxes<D>& boxes) {
    renumber(u32(boxes.size()));
    for (u32 id = 0; id < boxes.size(); id++) entries_[id].box = boxes[id];
  }
  void expose(u32 count) {
    renumber(count);
    for (auto& [id, entry] : entries_) {
      for (int k = 0; k < 2 * D; k++) entry.box[size_t(k)] = outward(entry.box[size_t(k)], k >= D);
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

  PairList pairs() const {
    struct Known {
      u32 id;
      const Entry* entry;
    };
    std::vector<Known> known;
    for (const auto& [id, entry] : entries_) known.push_back({id, &entry});
    PairList found;
    for (size_t i = 0; i < known.size(); i++) {
      for (size_t j = i + 1; j < known.size(); j++) {
        const Entry &a = *known[i].entry, &b = *known[j].entry;
        if (!meet(a.rule, b.rule)) continue;
        if (overlap(a.box.data(), b.box.data(), D)) found.push_back(known[i].id | u64(known[j].id) << 32);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }
};

/// A space with the ids and settings that it stands on.
template <int D> struct Instance {
  Ids ids;
  Settings settings;
  Space<D> space{ids, settings};
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

/// Stages boxes and puts them in place of all; as float32 where `doubles` is false. Returns the first bad one.
template <int D> i32 replace(Space<D>& space, const Boxes<D>& boxes, bool doubles) {
  u32 count = u32(boxes.size());
  if (doubles) {
    f64* to = space.stage_exact(count);
    for (u32 k = 0; k < count; k++) std::copy(boxes[k].begin(), boxes[k].end(), to + size_t(k) * 2 * D);
  } else {
    f32* to = space.stage(count);
    for (u32 k = 0; k < count; k++) {
      for (u32 n = 0; n < 2 * D; n++) to[size_t(k) * 2 * D + n] = f32(boxes[k][n]);
    }
  }
  return space.replace(count, doubles);
}

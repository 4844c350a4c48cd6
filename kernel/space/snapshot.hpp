// A space as bytes, to go back to or to save: their format, and their validation. A header, then the contents of the
// space, in the order of the slots: the pairs of the last update, if events are on; the boxes, as float32 if that
// represents all of them; ids, the order of addition, layers, masks, groups, reaches and exclusion bits, each only if
// it differs from the default. What techniques retain is not included: it is rebuilt, and the pairs and their order do
// not depend on it. The checksum maps 8 bytes at a time by a bijection, so that every change within 8 bytes is
// detected, and others are missed once in 2^64.
// From: the mixing of a multiplication and a shift is that of many fast hashes, such as MurmurHash (A. Appleby).
#pragma once
#include "boxes/per_box.hpp"
#include "pairs/events.hpp"
#include "rules/filters.hpp"

enum SnapshotPart : u8 {
  has_ids = 1,
  has_doubles = 2,
  has_layers = 4,
  has_masks = 8,
  has_bits = 16,
  has_pairs = 32,
  has_order = 64,
  has_groups = 128
};

/// Little endian, as WebAssembly is.
struct SnapshotHeader {
  u32 magic;
  u8 version;  // 2 if `is_new`
  u8 dimensions : 4;
  u8 reaches : 1;  // reaches are included
  u8 in_place : 1;  // boxes may be written in place, which decides how doubles are rounded
  u8 spare : 2;
  u8 parts;  // SnapshotPart
  u8 technique;  // its number, or `automatic`
  u64 checksum;  // of all bytes, with this field 0
  u32 count;  // boxes
  u32 pairs;

  /// Whether there is something that version 1 does not have.
  bool is_new() const { return parts >= has_groups || reaches || in_place; }

  static constexpr u32 right_magic = 0x53504270;  // "pBPS"
  static constexpr u8 newest = 2, automatic = 255;
};

/// Why bytes are refused: src/snapshot.ts has a message for each of these names.
enum class SnapshotFault : u32 { none, foreign, newer, length, damaged, dimensions, technique, content };

class Snapshot {
  Buffer<u64> words_;
  SnapshotHeader head_ = {};
  // Where each part begins, in bytes.
  u32 pairs_ = 0, boxes_ = 0, ids_ = 0, order_ = 0, layers_ = 0, masks_ = 0, groups_ = 0, reaches_ = 0, bits_ = 0,
      end_ = 0;

  u8* at(u64 byte) const { return reinterpret_cast<u8*>(words_.data()) + byte; }
  bool has(u8 parts) const { return head_.parts & parts; }

  /// Computes the offsets of all parts; false if the end is beyond what can be addressed.
  SMALL bool lay_out() {
    u64 count = head_.count, place = sizeof(SnapshotHeader);
    auto take = [&](bool is_there, u64 bytes) {
      u32 from = u32(place);
      if (is_there) place += bytes;
      return from;
    };
    pairs_ = take(has(has_pairs), head_.pairs * u64(sizeof(u64)));
    boxes_ = take(true, count * 2 * head_.dimensions * (has(has_doubles) ? sizeof(f64) : sizeof(f32)));
    ids_ = take(has(has_ids), count * sizeof(u32));
    order_ = take(has(has_order), (count + 1) * sizeof(u32));
    layers_ = take(has(has_layers), count * sizeof(u32));
    masks_ = take(has(has_masks), count * sizeof(u32));
    groups_ = take(has(has_groups), count * sizeof(u32));
    reaches_ = take(head_.reaches, count * sizeof(f64));
    bits_ = take(has(has_bits), count);
    place = (place + 7) & ~u64(7);
    end_ = u32(place);
    return place < u64(1) << 32;
  }

  SMALL u64 checksum() const {
    u64 sum = end_;
    for (u32 place = 0; place < end_; place += sizeof(u64)) {
      u64 word = place == __builtin_offsetof(SnapshotHeader, checksum) ? 0 : load<u64>(at(place));
      sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
      sum ^= sum >> 29;
    }
    return sum;
  }

 public:
  const u64* words() const { return words_.data(); }
  u32 bytes() const { return end_; }
  const SnapshotHeader& head() const { return head_; }
  bool doubles() const { return has(has_doubles); }
  u8* boxes() const { return at(boxes_); }
  u32 box_bytes() const { return ids_ - boxes_; }

  /// Writes everything except the boxes, and makes room for them. `events`: null if they are off.
  SMALL void write(u32 dimensions, u8 technique, bool doubles, bool in_place, const Ids& ids, const Filters& filters,
                   const u32* groups, const f64* reaches, const Events* events) {
    u32 n = ids.count();
    const Rule* rules = filters.active() ? filters.rules() : nullptr;
    u32 parts = (ids.same() ? 0 : has_ids) | (ids.since() ? has_order : 0) | (doubles ? has_doubles : 0) |
                (events ? has_pairs : 0);
    for (u32 s = 0; rules && s < n; s++) {
      if (~rules[s].layer) parts |= has_layers;
      if (~rules[s].mask) parts |= has_masks;
      if (rules[s].excluded) parts |= has_bits;
    }
    for (u32 s = 0; groups && s < n; s++) {
      if (groups[s]) parts |= has_groups;
    }
    u8 reach = 0;
    for (u32 s = 0; reaches && s < n; s++) reach |= reaches[s] > 0;
    head_ = {
        SnapshotHeader::right_magic, 1, u8(dimensions & 15), u8(reach & 1), in_place, 0, u8(parts), technique, 0, n, 0};
    if (head_.is_new()) head_.version = 2;
    if (events) head_.pairs = u32(events->count());
    if (!lay_out()) fail(Fault::out_of_memory, f64(u64(1) << 32));
    words_.reserve(end_ / sizeof(u64));
    words_[end_ / sizeof(u64) - 1] = 0;  // the padding
    if (events) events->save(reinterpret_cast<u64*>(at(pairs_)));
    if (has(has_order)) store(at(order_), ids.clock());
    for (u32 s = 0; s < n; s++) {
      if (has(has_order)) store(at(order_ + (s + 1) * sizeof(u32)), ids.since()[s]);
      if (has(has_ids)) store(at(ids_ + s * sizeof(u32)), ids.id(s));
      if (has(has_layers)) store(at(layers_ + s * sizeof(u32)), rules[s].layer);
      if (has(has_masks)) store(at(masks_ + s * sizeof(u32)), rules[s].mask);
      if (has(has_groups)) store(at(groups_ + s * sizeof(u32)), groups[s]);
      if (reach) store(at(reaches_ + s * sizeof(f64)), reaches[s]);
      if (has(has_bits)) *at(bits_ + s) = u8(rules[s].excluded >> 24 | rules[s].excluded);
    }
  }

  /// Writes the checksum, once the boxes are there.
  SMALL void seal() {
    store(at(0), head_);
    head_.checksum = checksum();
    store(at(0), head_);
  }

  /// Makes room for the bytes of a snapshot with this header, if the header is good. `built`: the techniques of this
  /// build.
  SMALL SnapshotFault stage(const SnapshotHeader& head, u32 size, u32 dimensions, u32 built) {
    if (size < sizeof(SnapshotHeader) || head.magic != SnapshotHeader::right_magic) return SnapshotFault::foreign;
    if (head.version > SnapshotHeader::newest) return SnapshotFault::newer;
    bool good = head.version > 0 && head.count <= max_slots && !head.spare && (head.version > 1 || !head.is_new());
    if (!good || (head.dimensions != 2 && head.dimensions != 3)) return SnapshotFault::damaged;
    head_ = head;
    if (!lay_out() || end_ != size) return SnapshotFault::length;
    if (head.dimensions != dimensions) return SnapshotFault::dimensions;
    if (head.technique != SnapshotHeader::automatic && (head.technique > 31 || !(built >> head.technique & 1))) {
      return SnapshotFault::technique;
    }
    words_.reserve(end_ / sizeof(u64));
    return SnapshotFault::none;
  }

  /// Whether the bytes after the header are what was once written, by the checksum.
  SMALL bool is_whole() const {
    store(at(0), head_);
    return checksum() == head_.checksum;
  }

  /// Validates everything except the boxes, and makes room for it; nothing changes. False if it cannot have been
  /// written by `write`.
  SMALL bool check(Filters& filters, PerBox<u32>& groups, PerBox<f64>& reaches, Events* events) const {
    Rule* rules = has(has_layers | has_masks | has_bits) ? filters.stage(head_.count) : nullptr;
    for (u32 s = 0; rules && s < head_.count; s++) {
      rules[s].layer = has(has_layers) ? load<u32>(at(layers_ + s * sizeof(u32))) : ~0u;
      rules[s].mask = has(has_masks) ? load<u32>(at(masks_ + s * sizeof(u32))) : ~0u;
      u32 bits = has(has_bits) ? *at(bits_ + s) : 0;
      rules[s].excluded = (bits & ~Rule::off) << 24 | (bits & Rule::off);
      if (rules[s].excluded & ~(is_static | is_red | is_blue | Rule::off)) return false;
    }
    if (has(has_groups)) __builtin_memcpy(groups.stage(head_.count), at(groups_), head_.count * sizeof(u32));
    f64* reach = head_.reaches ? reaches.stage(head_.count) : nullptr;
    for (u32 s = 0; reach && s < head_.count; s++) {
      reach[s] = load<f64>(at(reaches_ + s * sizeof(f64)));
      if (!(reach[s] >= 0 && reach[s] < __builtin_inf())) return false;
    }
    if (has(has_order) && !has(has_ids)) return false;
    for (u32 s = 0; has(has_order) && s < head_.count; s++) {
      if (load<u32>(at(order_ + (s + 1) * sizeof(u32))) >= load<u32>(at(order_))) return false;
    }
    u32 last = 0;
    for (u32 place = pairs_; place < boxes_; place += sizeof(u64)) {
      u64 pair = load<u64>(at(place)) & ~pair_marks;
      if (u32(pair) >= pair >> 32 || pair >> 32 >= max_slots) return false;
      last = larger(last, u32(pair >> 32));
    }
    if (events) events->stage((boxes_ - pairs_) / sizeof(u64), last);
    return true;
  }

  /// Restores everything except the boxes, after `check`; false, and nothing has changed, if the ids are bad.
  SMALL bool take(Ids& ids, Filters& filters, PerBox<u32>& groups, PerBox<f64>& reaches, Events* events) const {
    const u32* order = has(has_order) ? reinterpret_cast<const u32*>(at(order_)) : nullptr;
    if (!has(has_ids)) ids.reset(head_.count);
    else if (!ids.replace(reinterpret_cast<const u32*>(at(ids_)), head_.count, order ? order + 1 : nullptr,
                          order ? *order : 0))
      return false;
    filters.clear();
    if (has(has_layers | has_masks | has_bits)) filters.replace();
    groups.clear();
    if (has(has_groups)) groups.replace();
    reaches.clear();
    if (head_.reaches) reaches.replace();
    if (events) events->restore(reinterpret_cast<const u64*>(at(pairs_)), (boxes_ - pairs_) / sizeof(u64));
    return true;
  }
};

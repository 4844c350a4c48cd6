// Settings of boxes besides their numbers, by slot: rules, groups and reaches. Most spaces use none, and then nothing
// is stored.
#pragma once
#include "boxes/per_box.hpp"
#include "rules/filters.hpp"

/// What `Own::write` tells of a box.
enum RulePlace : u32 { layer_at, mask_at, static_at, enabled_at, group_at, reach_at };

struct Own {
  Filters filters;
  PerBox<u32> groups;
  PerBox<f64> reaches;

  /// Null if no box has a rule.
  const Rule* rules() const { return filters.active() ? filters.rules() : nullptr; }
  Rule rule(u32 slot) const { return filters.active() ? filters.rules()[slot] : everybody; }
  /// Writes the settings of a box, in the order of RulePlace.
  SMALL void write(u32 slot, f64* to) const {
    Rule its = rule(slot);
    to[layer_at] = its.layer;
    to[mask_at] = its.mask;
    to[static_at] = (its.excluded & is_static) != 0;
    to[enabled_at] = !its.is_off();
    to[group_at] = groups.of(slot);
    to[reach_at] = reaches.of(slot);
  }

  void make_room(u64 count, u32 keep) {
    if (filters.active()) filters.make_room(count, keep);
    groups.make_room(count, keep);
    reaches.make_room(count, keep);
  }
  /// The number of boxes there is room for, at most `all`.
  u64 room(u64 all) const {
    if (filters.active()) all = smaller(all, filters.room());
    if (groups.some()) all = smaller(all, groups.room());
    if (reaches.some()) all = smaller(all, reaches.room());
    return all;
  }

  /// A new box has the default settings.
  void insert(u32 slot) {
    if (filters.active()) filters.insert(slot);
    groups.insert(slot);
    reaches.insert(slot);
  }
  void move(u32 last, u32 slot) {
    if (filters.active()) filters.move(last, slot);
    groups.move(last, slot);
    reaches.move(last, slot);
  }
  void clear() {
    filters.clear();
    groups.clear();
    reaches.clear();
  }
  /// Memory for `renumber`.
  void stage(u32 count) {
    if (groups.some()) groups.stage(count);
    if (reaches.some()) reaches.stage(count);
    if (filters.active()) filters.stage(count);
  }
  /// The ids become 0 … count - 1; boxes that were there keep their settings. After `stage(count)`.
  void renumber(const Ids& ids, u32 count) {
    if (filters.active()) filters.renumber(ids, count);
    groups.renumber(ids, count);
    reaches.renumber(ids, count);
  }
};

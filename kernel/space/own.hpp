// Settings of boxes besides their numbers, by slot: rules, groups and reaches. Most spaces use none, and then nothing
// is stored.
#pragma once
#include "boxes/per_box.hpp"
#include "rules/filters.hpp"

struct Own {
  Filters filters;
  PerBox<u32> groups;
  PerBox<f64> reaches;

  /// Null if no box has a rule.
  const Rule* rules() const { return filters.active() ? filters.rules() : nullptr; }
  Rule rule(u32 slot) const { return filters.active() ? filters.rules()[slot] : Rule{0xffffffff, 0xffffffff, 0}; }

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

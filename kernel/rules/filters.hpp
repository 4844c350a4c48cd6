// Which boxes may meet: layers, masks and exclusion bits, turned into as little search as possible.
// Idea: boxes with the same layer, mask and bits are one class, and games have a handful of classes. Which classes
// ignore each other is computed once after a change, and saves search in three ways. Boxes that can meet nobody are not
// searched at all; boxes that are off are one such class. A set of classes that ignore themselves and each other shares
// an exclusion bit, which every technique tests along with the boxes. Other forbidden pairs, say of two classes that
// meet themselves but not each other, are removed from the pairs found.
// Cost: nothing while no box has a filter; O(boxes + classes squared) in the update after a change; a copy of the
// boxes that are searched where some are not.
#pragma once
#include "boxes/ids.hpp"
#include "pairs/pairs.hpp"

/// The rule of a box: which other boxes it meets. Two boxes meet where each one's layer is in the other's mask and they
/// share no exclusion bit.
struct Rule {
  u32 layer, mask, excluded;

  /// A mark beside the exclusion bits: the box is off, and in no pair and no answer.
  static constexpr u32 off = 2;
  bool is_off() const { return excluded & off; }
  /// Whether it may meet boxes of another space.
  bool meets_some() const { return !is_off() && layer != 0 && mask != 0; }
};

inline bool meet(const Rule& a, const Rule& b) {
  return (a.layer & b.mask) && (b.layer & a.mask) && !(a.excluded & b.excluded);
}

class Filters {
  static constexpr Rule everybody{0xffffffff, 0xffffffff, 0}, nobody{0, 0, 0};
  static constexpr u32 most_classes = 64, table_size = 4 * most_classes;
  static constexpr u32 rest = most_classes;  // stands for all classes beyond that number: they may meet any box
  static constexpr u32 spare_bits = 0x0f000000;  // bits of the tag: those that no box has set are used for classes

  struct Class {
    Rule rule;
    u64 meets;  // bit d: it meets class d
    u32 count;  // its boxes
    u32 bits;  // its exclusion bits in the search
    bool lonely;
  };

  bool active_ = false;  // some box has a rule of its own
  bool changed_ = false;  // since the classes were computed
  bool check_ = false;  // the search may find forbidden pairs
  bool some_ = false;  // not all boxes are searched
  u32 searched_ = 0;  // how many are, while `some_`
  Buffer<Rule> rules_;  // per slot
  Buffer<Rule> staged_;  // what `replace` puts in place of them
  Buffer<u32> excluded_;  // per slot, or per searched box: the exclusion bits for the search
  Buffer<u32> slots_;  // per searched box
  Buffer<f32> boxes_;  // per searched box
  Buffer<u8> class_of_;  // per slot

  // Used only while classes are computed, so all spaces share it.
  inline static Class classes_[most_classes + 1];
  inline static u8 table_[table_size];  // by hash: number of the class + 1
  inline static u32 class_count_;

 public:
  bool active() const { return active_; }
  bool changed() const { return active_ && changed_; }
  /// Whether all boxes are searched, as in the last update.
  bool search_all() const { return !active_ || !(changed_ || some_); }
  /// Per slot, while active.
  const Rule* rules() const { return rules_.data(); }

  SMALL void clear() { active_ = false; }

  /// Gives each box a rule of its own, with room for `capacity` of them.
  SMALL void start(u32 count, u64 capacity) {
    rules_.reserve(capacity);
    for (u32 s = 0; s < count; s++) rules_[s] = everybody;
    active_ = changed_ = true;
  }

  /// Room for the rules that `replace` will put in place of all.
  SMALL Rule* stage(u32 count) { return staged_.reserve(larger(count, 1u)); }
  SMALL void replace() {
    rules_.swap(staged_);
    active_ = changed_ = true;
  }

  /// The rule of a slot, for changing it.
  SMALL Rule& change(u32 slot) {
    changed_ = true;
    return rules_[slot];
  }

  // What happens to slots, as in Store; only while active.
  SMALL void make_room(u64 count, u32 keep) { rules_.grow(count, keep); }
  u64 room() const { return rules_.capacity(); }
  SMALL void insert(u32 slot) { change(slot) = everybody; }
  SMALL void move(u32 from, u32 to) { change(to) = rules_[from]; }
  /// After `stage(count)`.
  SMALL void renumber(const Ids& ids, u32 count) {
    for (u32 id = 0; id < count; id++) {
      u32 slot = ids.slot(id);
      staged_[id] = slot == Ids::none ? everybody : rules_[slot];
    }
    rules_.swap(staged_);
    staged_.release();
    changed_ = true;
  }

  /// The exclusion bits of the boxes that select() leaves.
  const u32* excluded() const { return excluded_.data(); }

  /// The boxes that have to be searched, of `count` boxes of `width` numbers each.
  SMALL const f32* select(const f32* boxes, u32& count, u32 width) {
    if (changed_) classify(count);
    changed_ = false;
    if (!some_) return boxes;
    count = searched_;
    f32* to = boxes_.reserve(u64(searched_) * width + 4);
    for (u32 k = 0; k < searched_; k++) {
      for (u32 n = 0; n < width; n++) to[u64(k) * width + n] = boxes[u64(slots_[k]) * width + n];
    }
    return to;
  }

  /// Picks, from an array with an entry per slot, those of the boxes that are searched.
  SMALL const u32* select(const u32* of_slots, u32 count, Buffer<u32>& to) const {
    if (!active_ || !some_) return of_slots;
    to.reserve(larger(count, 1u));
    for (u32 k = 0; k < count; k++) to[k] = of_slots[slots_[k]];
    return to.data();
  }

  /// The slot of the k-th box that is searched.
  u32 slot(u32 k) const { return active_ && some_ ? slots_[k] : k; }

  /// After the search: turns places in the scene back into slots, and removes forbidden pairs.
  SMALL void finish(Pairs& pairs) const {
    if (!some_ && !check_) return;
    u64* list = pairs.list.data();
    u64 kept = 0;
    for (u64 p = 0; p < pairs.count; p++) {
      u32 a = u32(list[p]), b = u32(list[p] >> 32);
      if (some_) {
        a = slots_[a];
        b = slots_[b];
      }
      list[kept] = u64(a) | u64(b) << 32;
      kept += !check_ || meet(rules_[a], rules_[b]);
    }
    pairs.count = kept;
  }

 private:
  SMALL void classify(u32 count) {
    find_classes(count);
    share_bits();
    searched_ = 0;
    for (u32 c = 0; c <= rest; c++) {
      if (classes_[c].count && !classes_[c].lonely) searched_ += classes_[c].count;
    }
    some_ = searched_ < count;
    excluded_.reserve(count);
    if (some_) slots_.reserve(count);
    u32 k = 0;
    for (u32 s = 0; s < count; s++) {
      const Class& its = classes_[class_of_[s]];
      if (its.lonely) continue;
      // Boxes beyond the counted classes each use their own bits.
      excluded_[k] = class_of_[s] == rest ? rules_[s].excluded : its.bits;
      if (some_) slots_[k] = s;
      k++;
    }
  }

  static u32 home(const Rule& rule) {
    return (rule.layer * 0x9e3779b1u ^ rule.mask * 0x85ebca6bu ^ rule.excluded) >> 24;
  }

  SMALL void find_classes(u32 count) {
    class_of_.reserve(count);
    __builtin_memset(table_, 0, sizeof(table_));
    // The first class is that of boxes that are off, so that there is always room for it.
    classes_[0] = {nobody, 0, 0, 0, false};
    class_count_ = table_[home(nobody)] = 1;
    classes_[rest] = {everybody, 0, 0, 0, false};
    for (u32 s = 0; s < count; s++) {
      const Rule& rule = rules_[s].is_off() ? nobody : rules_[s];
      u32 at = home(rule);
      for (;; at = (at + 1) % table_size) {
        u32 found = table_[at];
        if (found == 0) {
          if (class_count_ == most_classes) {
            class_of_[s] = u8(rest);
            break;
          }
          classes_[class_count_] = {rule, 0, 0, rule.excluded, false};
          table_[at] = u8(++class_count_);
          found = class_count_;
        }
        const Rule& known = classes_[found - 1].rule;
        if (known.layer == rule.layer && known.mask == rule.mask && known.excluded == rule.excluded) {
          class_of_[s] = u8(found - 1);
          break;
        }
      }
      classes_[class_of_[s]].count++;
    }
    for (u32 c = class_count_; c < rest; c++) classes_[c].count = 0;
  }

  /// Finds the classes that meet nobody, and gives exclusion bits to sets of classes that all ignore one another,
  /// themselves included, beginning with the largest.
  SMALL void share_bits() {
    bool beyond = classes_[rest].count > 0;
    u32 free = beyond ? 0 : spare_bits;  // which bits the boxes beyond have set is not known
    check_ = beyond;
    u64 lonely = 0, wanting = 0;  // sets of classes: bit c stands for class c
    for (u32 c = 0; c < class_count_; c++) {
      Class& mine = classes_[c];
      mine.meets = 0;
      for (u32 d = 0; d < class_count_; d++) mine.meets |= u64(meet(mine.rule, classes_[d].rule)) << d;
      mine.lonely = !mine.meets && !(beyond && mine.rule.layer && mine.rule.mask);
      lonely |= u64(mine.lonely) << c;
      free &= ~mine.bits;
    }
    for (u32 c = 0; c < class_count_; c++) {
      const Class& mine = classes_[c];
      wanting |= u64(!mine.lonely && !mine.bits && !(mine.meets >> c & 1)) << c;
    }
    for (; free && wanting; free &= free - 1) {
      u32 largest = rest;
      for (u32 c = 0; c < class_count_; c++) {
        if (wanting >> c & 1 && (largest == rest || classes_[c].count > classes_[largest].count)) largest = c;
      }
      u64 members = u64(1) << largest;
      for (u32 c = 0; c < class_count_; c++) {
        u64 with_me = members | u64(1) << c;
        if (!(lonely >> c & 1) && !(classes_[c].meets & with_me)) members = with_me;
      }
      for (u32 c = 0; c < class_count_; c++) {
        if (members >> c & 1) classes_[c].bits |= free & -free;
      }
      wanting &= ~members;
    }
    for (u32 c = 0; c < class_count_; c++) {
      for (u32 d = 0; d <= c; d++) {
        bool searched = !((lonely >> c | lonely >> d) & 1) && !(classes_[c].bits & classes_[d].bits);
        check_ |= searched && !(classes_[c].meets >> d & 1);
      }
    }
  }
};

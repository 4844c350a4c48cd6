// Classes of boxes with the same rule, and which of them may meet.
// Idea: few rules are in use, so it is computed per class which classes ignore each other. A class that meets nobody is
// lonely: its boxes need not be searched. A set of classes that ignore themselves and each other shares an exclusion
// bit, which every technique tests along with the boxes. Other forbidden pairs, say of two classes that meet themselves
// but not each other, have to be removed from the pairs found.
// Cost: O(boxes + classes squared) to build; a few ns to find the class of a rule.
#pragma once
#include "boxes/box.hpp"

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

class Classes {
  static constexpr Rule everybody{0xffffffff, 0xffffffff, 0}, nobody{0, 0, 0};
  static constexpr u32 most = 64, table_size = 4 * most;
  static constexpr u32 spare_bits = 0x0f000000;  // bits of the tag: those that no box has set are used for classes

 public:
  struct Class {
    Rule rule;
    u32 count;  // its boxes when the classes were built
    u32 bits;  // its exclusion bits in the search
    bool lonely;
  };
  static constexpr u32 rest = most;  // stands for all classes beyond that number: they may meet any box

 private:
  Buffer<Class> classes_;  // in a buffer, as are the others, so that the wasm does not contain zeros for them
  Buffer<u64> meets_;  // per class; bit d: it meets class d
  Buffer<u8> table_;  // by hash: number of the class + 1
  u32 count_ = 0;
  bool check_ = false;

 public:
  const Class& operator[](u32 number) const { return classes_[number]; }

  /// Whether the search may find forbidden pairs.
  bool check() const { return check_; }
  /// Per class, a bit for each that it meets; null if the search finds no forbidden pairs, or not all classes are known.
  const u64* meets() const { return check_ && !classes_[rest].count ? meets_.data() : nullptr; }

  /// Builds the classes of these boxes. Writes which class each is in.
  SMALL void build(const Rule* rules, u32 count, u8* class_of) {
    classes_.reserve(most + 1);
    meets_.reserve(most);
    __builtin_memset(table_.reserve(table_size), 0, table_size);
    // The first class is that of boxes that are off, so that there is always room for it.
    classes_[0] = {nobody, 0, 0, false};
    count_ = table_[home(nobody)] = 1;
    classes_[rest] = {everybody, 0, 0, false};
    for (u32 s = 0; s < count; s++) {
      u32 its = find(rules[s], true);
      class_of[s] = u8(its);
      classes_[its].count++;
    }
    share_bits();
  }

  /// The class of a rule. One that is not known is `rest`, unless it is to be added and there is room.
  SMALL u32 find(const Rule& given, bool add) {
    Rule rule = given.is_off() ? nobody : given;
    for (u32 at = home(rule);; at = (at + 1) % table_size) {
      u32 found = table_[at];
      if (found == 0) {
        if (!add || count_ == most) return rest;
        classes_[count_] = {rule, 0, rule.excluded, false};
        table_[at] = u8(count_ + 1);
        return count_++;
      }
      const Rule& known = classes_[found - 1].rule;
      if (known.layer == rule.layer && known.mask == rule.mask && known.excluded == rule.excluded) return found - 1;
    }
  }

 private:
  static u32 home(const Rule& rule) {
    return (rule.layer * 0x9e3779b1u ^ rule.mask * 0x85ebca6bu ^ rule.excluded) >> 24;
  }

  /// Finds the classes that meet nobody, and gives exclusion bits to sets of classes that all ignore one another,
  /// themselves included, beginning with the largest.
  SMALL void share_bits() {
    bool beyond = classes_[rest].count > 0;
    u32 free = beyond ? 0 : spare_bits;  // which bits the boxes beyond have set is not known
    check_ = beyond;
    u64 lonely = 0, wanting = 0;  // sets of classes: bit c stands for class c
    for (u32 c = 0; c < count_; c++) {
      Class& mine = classes_[c];
      meets_[c] = 0;
      for (u32 d = 0; d < count_; d++) meets_[c] |= u64(meet(mine.rule, classes_[d].rule)) << d;
      mine.lonely = !meets_[c] && !(beyond && mine.rule.layer && mine.rule.mask);
      lonely |= u64(mine.lonely) << c;
      free &= ~mine.bits;
    }
    for (u32 c = 0; c < count_; c++) {
      const Class& mine = classes_[c];
      wanting |= u64(!mine.lonely && !mine.bits && !(meets_[c] >> c & 1)) << c;
    }
    for (; free && wanting; free &= free - 1) {
      u32 largest = rest;
      for (u32 c = 0; c < count_; c++) {
        if (wanting >> c & 1 && (largest == rest || classes_[c].count > classes_[largest].count)) largest = c;
      }
      u64 members = u64(1) << largest;
      for (u32 c = 0; c < count_; c++) {
        u64 with_me = members | u64(1) << c;
        if (!(lonely >> c & 1) && !(meets_[c] & with_me)) members = with_me;
      }
      for (u32 c = 0; c < count_; c++) {
        if (members >> c & 1) classes_[c].bits |= free & -free;
      }
      wanting &= ~members;
    }
    for (u32 c = 0; c < count_; c++) {
      for (u32 d = 0; d <= c; d++) {
        bool searched = !((lonely >> c | lonely >> d) & 1) && !(classes_[c].bits & classes_[d].bits);
        check_ |= searched && !(meets_[c] >> d & 1);
      }
    }
  }
};

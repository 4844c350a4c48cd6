// Classes of boxes with the same rule, and which of them may meet.
// Idea: few rules are in use, so it is computed per class which classes ignore each other. A class that meets nobody is
// lonely: its boxes need not be searched. A set of classes that ignore themselves and each other shares an exclusion
// bit, which every technique tests along with the boxes. Other forbidden pairs, say of two classes that meet themselves
// but not each other, have to be removed from the pairs found, or from candidates that are retained.
// Cost: O(boxes + 64 squared) to build; a few ns to find the class of a rule; 32 kB.
#pragma once
#include "boxes/box.hpp"

class Classes {
  static constexpr Rule nobody{0, 0, 0};
  static constexpr u32 most = 64;  // that share exclusion bits; further ones each use their own
  static constexpr u32 most_known = 1024, table_size = 4 * most_known;
  static constexpr u32 spare_bits = 0x0f000000;  // bits of the tag: those that no box has set are used for classes

 public:
  struct Class {
    u32 count;  // its boxes when the classes were built
    u32 bits;  // its exclusion bits in the search
    bool lonely;
  };
  static constexpr u32 rest = most_known;  // stands for all classes beyond that number: they may meet any box

 private:
  Buffer<Class> classes_;  // in a buffer, as are the others, so that the wasm does not contain zeros for them
  Buffer<Rule> rules_;  // per class
  Buffer<u64> meets_;  // per class that may share bits; bit d: it meets class d
  Buffer<u16> table_;  // by hash: number of the class + 1
  u32 count_ = 0;
  bool check_ = false;

 public:
  const Class& operator[](u32 number) const { return classes_[number]; }

  /// Whether the search may find forbidden pairs.
  bool check() const { return check_; }
  /// Per class; null if the search finds no forbidden pairs, or if not all classes are known.
  const Rule* rules() const { return check_ && !classes_[rest].count ? rules_.data() : nullptr; }
  /// Whether there are more classes than may share exclusion bits.
  bool some_further() const { return count_ > most; }

  /// Builds the classes of these boxes. Writes which class each is in.
  SMALL void build(const Rule* rules, u32 count, u16* class_of) {
    classes_.reserve(most_known + 1);
    rules_.reserve(most_known);
    meets_.reserve(most);
    __builtin_memset(table_.reserve(table_size), 0, table_size * sizeof(u16));
    // The first class is that of boxes that are off, so that there is always room for it.
    count_ = 0;
    find(nobody, true);
    classes_[rest] = {0, 0, false};
    for (u32 s = 0; s < count; s++) {
      u32 its = find(rules[s], true);
      class_of[s] = u16(its);
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
        if (!add || count_ == most_known) return rest;
        rules_[count_] = rule;
        classes_[count_] = {0, rule.excluded, false};
        table_[at] = u16(count_ + 1);
        return count_++;
      }
      const Rule& known = rules_[found - 1];
      if (known.layer == rule.layer && known.mask == rule.mask && known.excluded == rule.excluded) return found - 1;
    }
  }

 private:
  static u32 home(const Rule& rule) {
    return (rule.layer * 0x9e3779b1u ^ rule.mask * 0x85ebca6bu ^ rule.excluded) >> 20;
  }

  /// Finds the classes that meet nobody, and gives exclusion bits to sets of classes that all ignore one another,
  /// themselves included, beginning with the largest.
  SMALL void share_bits() {
    bool beyond = some_further();
    u32 free = beyond ? 0 : spare_bits;  // which bits further boxes have set is not looked up
    u32 many = smaller(count_, most);
    check_ = beyond;
    u64 lonely = 0, wanting = 0;  // sets of classes: bit c stands for class c
    for (u32 c = 0; c < many; c++) {
      Class& mine = classes_[c];
      meets_[c] = 0;
      for (u32 d = 0; d < many; d++) meets_[c] |= u64(meet(rules_[c], rules_[d])) << d;
      mine.lonely = !meets_[c] && !(beyond && rules_[c].layer && rules_[c].mask);
      lonely |= u64(mine.lonely) << c;
      free &= ~mine.bits;
    }
    for (u32 c = 0; c < many; c++) {
      const Class& mine = classes_[c];
      wanting |= u64(!mine.lonely && !mine.bits && !(meets_[c] >> c & 1)) << c;
    }
    for (; free && wanting; free &= free - 1) {
      u32 largest = rest;
      for (u32 c = 0; c < many; c++) {
        if (wanting >> c & 1 && (largest == rest || classes_[c].count > classes_[largest].count)) largest = c;
      }
      u64 members = u64(1) << largest;
      for (u32 c = 0; c < many; c++) {
        u64 with_me = members | u64(1) << c;
        if (!(lonely >> c & 1) && !(meets_[c] & with_me)) members = with_me;
      }
      for (u32 c = 0; c < many; c++) {
        if (members >> c & 1) classes_[c].bits |= free & -free;
      }
      wanting &= ~members;
    }
    for (u32 c = 0; c < many; c++) {
      for (u32 d = 0; d <= c; d++) {
        bool searched = !((lonely >> c | lonely >> d) & 1) && !(classes_[c].bits & classes_[d].bits);
        check_ |= searched && !(meets_[c] >> d & 1);
      }
    }
  }
};

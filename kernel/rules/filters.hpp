// Which boxes may meet: each has a layer and a mask.
// Idea: boxes that can meet nobody are not searched at all; boxes that are off are among them. What else the rules
// forbid is left to exclusion bits in the search, or removed from the pairs found: see classes.hpp. A searched box has a
// place in the scene. While a technique keeps something between updates, a box whose rule changes keeps its place, one
// that is no longer searched gives it to the last one, and one that is searched again comes last. So a change costs
// that technique no more than a box that is added or removed.
// Cost: nothing while no box has a filter; a few ns per box whose rule has changed; O(boxes + classes squared) if it is of
// a new class, or if many have changed.
#pragma once
#include "boxes/changes.hpp"
#include "boxes/ids.hpp"
#include "pairs/pairs.hpp"
#include "rules/classes.hpp"

class Filters {
  static constexpr u32 followed = 8;  // if more than one box in this many has changed, all are classified again

  bool active_ = false;  // some box has a rule of its own
  bool some_ = false;  // some boxes are not searched, or were not
  bool mixed_ = false;  // places are not in the order of slots
  u32 count_ = 0, searched_ = 0;  // boxes in the last update; those that are searched
  Buffer<Rule> rules_;  // per slot
  Buffer<Rule> staged_;  // what `replace` puts in place of them
  Changes changed_;  // slots whose rules changed since the last update
  Classes classes_;
  Buffer<u16> class_of_;  // per slot, while classes are built
  Buffer<u32> places_;  // per slot, while `some_`
  Buffer<u32> slots_;  // per place, while `some_`
  Buffer<u32> tags_;  // per place: the exclusion bits for the search, and the class
  Changes moved_;  // places that got another box or another rule in the last update

 public:
  static constexpr u32 nowhere = 0xffffffff;  // the place of a slot that is not searched

  bool active() const { return active_; }
  bool changed() const { return active_ && !changed_.none(); }
  /// Per slot, while active.
  const Rule* rules() const { return rules_.data(); }

  SMALL void clear() { active_ = false; }

  /// Gives each box a rule of its own, with room for `capacity` of them.
  SMALL void start(u32 count, u64 capacity) {
    rules_.reserve(capacity);
    changed_.make_room(capacity);
    for (u32 s = 0; s < count; s++) rules_[s] = everybody;
    forget();
    active_ = true;
  }

  /// Everything may have changed.
  SMALL void forget() { changed_.note_all(); }

  /// Room for the rules that `replace` will put in place of all.
  SMALL Rule* stage(u32 count) { return staged_.reserve(larger(count, 1u)); }
  SMALL void replace() {
    rules_.swap(staged_);
    forget();
    active_ = true;
  }

  /// The rule of a slot, for changing it.
  SMALL Rule& change(u32 slot) {
    changed_.note(slot);
    return rules_[slot];
  }

  // What happens to slots, as in Store; only while active.
  SMALL void make_room(u64 count, u32 keep) {
    rules_.grow(count, keep);
    changed_.make_room(count);
  }
  u64 room() const { return smaller(rules_.capacity(), u64(changed_.room())); }
  SMALL void insert(u32 slot) { change(slot) = everybody; }
  SMALL void move(u32 from, u32 to) { change(to) = rules_[from]; }
  /// After `stage(count)`.
  SMALL void renumber(const Ids& ids, u32 count) {
    for (u32 id = 0; id < count; id++) {
      u32 slot = ids.slot(id);
      staged_[id] = slot == Ids::none ? everybody : rules_[slot];
    }
    replace();
    staged_.release();
  }

  /// Follows the changes of rules. `in_order`: places have to be in the order of slots.
  SMALL void update(u32 count, bool in_order) {
    bool none = changed_.none(), many = changed_.count() > count / followed;
    bool untidy = mixed_ && (in_order || (none && searched_ == count));
    moved_.clear(larger(count, count_));
    if (changed_.all() || many || untidy || (!none && (in_order || !follow(count)))) classify(count);
    changed_.clear(count);
    count_ = count;
  }

  /// Whether only some boxes are searched, or all in another order than that of their slots.
  bool some() const { return active_ && some_; }
  /// The number of boxes that are searched.
  u32 searched() const { return searched_; }
  /// Places that got another box or another rule in the last update.
  const Changes& moved() const { return moved_; }
  /// The exclusion bits and the class, per place.
  const u32* tags() const { return tags_.data(); }
  /// The rule of each class; null if it is not needed, or not all are known.
  const Rule* classes() const { return classes_.rules(); }
  /// The slots of all places while `some`, and the slot of a place.
  const u32* slots() const { return slots_.data(); }
  u32 slot(u32 place) const { return some() ? slots_[place] : place; }
  /// The place of a slot while `some`; `nowhere` if it is not searched.
  u32 place(u32 slot) const { return places_[slot]; }

  /// Picks, from an array with an entry per slot, those of the boxes that are searched.
  SMALL const u32* pick(const u32* of_slots, Buffer<u32>& to) const {
    if (!some()) return of_slots;
    to.reserve(larger(searched_, 1u));
    for (u32 place = 0; place < searched_; place++) to[place] = of_slots[slots_[place]];
    return to.data();
  }

  /// Whether forbidden pairs are removed after every search.
  bool removes() const { return active_ && classes_.check() && !classes(); }

  /// After the search: turns places back into slots, and removes forbidden pairs, unless the technique has.
  NOINLINE void finish(Pairs& pairs) const {
    const bool check = classes_.check() && !(classes() && pairs.checked), some = some_;
    if (!some && !check) return;
    const Rule* rules = rules_.data();
    const u32* slots = slots_.data();
    u64* list = pairs.list.data();
    u64 kept = pairs.kept;
    for (u64 p = kept; p < pairs.count; p++) {
      u32 a = u32(list[p]), b = u32(list[p] >> 32);
      if (some) {
        a = slots[a];
        b = slots[b];
      }
      list[kept] = pair_of(a, b);
      kept += !check || meet(rules[a], rules[b]);
    }
    pairs.count = kept;
  }

 private:
  SMALL void classify(u32 count) {
    u16* class_of = class_of_.reserve(larger(count, 1u));
    classes_.build(rules_.data(), count, class_of);
    searched_ = 0;
    for (u32 s = 0; s < count; s++) searched_ += !classes_[class_of[s]].lonely;
    some_ = searched_ < count;
    mixed_ = false;
    tags_.reserve(larger(count, 1u));
    if (some_) number_all(count);
    for (u32 s = 0, place = 0; s < count; s++) {
      if (classes_[class_of[s]].lonely) {
        places_[s] = nowhere;
        continue;
      }
      tags_[place] = tag(s, class_of[s]);
      if (some_) {
        slots_[place] = s;
        places_[s] = place;
      }
      place++;
    }
    moved_.note_all();
  }

  /// Follows each change. Returns false if one needs another class, and all boxes are in classes.
  SMALL bool follow(u32 count) {
    tags_.grow(count, smaller(searched_, count));
    if (!some_) searched_ = count;
    else {
      for (u32 s = count; s < count_; s++) drop(s);
      slots_.grow(count, searched_);
      places_.grow(count, smaller(count, count_));
      for (u32 s = count_; s < count; s++) places_[s] = nowhere;
    }
    for (u32 k = 0; k < changed_.count(); k++) {
      u32 s = changed_.list()[k];
      if (s >= count) continue;
      u32 its = classes_.find(rules_[s], classes_.some_further());
      if (its == Classes::rest && classes_[its].count == 0) return false;
      if (!classes_[its].lonely) {
        put(s, tag(s, its));
        continue;
      }
      if (!some_) {
        some_ = true;
        number_all(count);
      }
      drop(s);
    }
    return true;
  }

  /// What is stored of the rule of a slot in this class. Boxes beyond the classes each use their own bits.
  u32 tag(u32 slot, u32 its) const {
    return (its == Classes::rest ? rules_[slot].excluded : classes_[its].bits) | its * class_bit;
  }

  /// Gives each slot its own number as its place.
  SMALL void number_all(u32 count) {
    places_.reserve(count);
    slots_.reserve(count);
    for (u32 s = 0; s < count; s++) places_[s] = slots_[s] = s;
  }

  /// Gives a slot that is searched this tag, and, if it has none, the last place.
  void put(u32 slot, u32 tag) {
    u32 place = slot;
    if (some_) {
      place = places_[slot];
      if (place == nowhere) {
        place = searched_++;
        mixed_ |= place > 0 && slots_[place - 1] > slot;
        slots_[place] = slot;
        places_[slot] = place;
      }
    }
    tags_[place] = tag;
    moved_.note(place);
  }

  /// Gives the place of a slot that is no longer searched to the last one.
  void drop(u32 slot) {
    u32 place = places_[slot];
    if (place == nowhere) return;
    places_[slot] = nowhere;
    u32 last = --searched_;
    if (place == last) return;
    slots_[place] = slots_[last];
    places_[slots_[place]] = place;
    tags_[place] = tags_[last];
    mixed_ = true;
    moved_.note(place);
  }
};

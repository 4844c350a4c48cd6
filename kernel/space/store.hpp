// The contents of a space: boxes by id, and their settings. Two parts are notified before a change: what queries see,
// which is then copied, and the events, which record deleted boxes. Every change allocates before it writes: if memory
// runs out, the store is as it was.
#pragma once
#include "boxes/changed_ids.hpp"
#include "boxes/ring.hpp"
#include "pairs/events.hpp"
#include "search/options.hpp"
#include "space/numbers.hpp"
#include "space/own.hpp"
#include "space/room_ahead.hpp"
#include "space/seen.hpp"

/// The contents of a space, for a recorder. 0 for ids that are the slots, and for what no box has.
enum ContentsPlace : u32 { ids_at, boxes_at, doubles_at, rules_at, groups_at, reaches_at };

template <int D> class Store {
  static constexpr u32 width = 2 * D;
  // With more boxes than this, slots no longer fit the cache, and a batch is prefetched: see Ring.
  static constexpr u32 near_boxes = 20000;

  const Options& options_;
  bool tight_ = false;  // there may be no memory to start storing doubles
  bool full_ = false;  // the ring has been full since the last update
  Buffer<f64> waiting_;  // a larger ring

 public:
  Ids& ids;
  Numbers<D> numbers;
  Own own;
  Seen<D> seen;
  Events events;  // while `keeps_events`
  bool keeps_events = false;
  ChangedIds changed;  // for spaces that keep pairs with this one

  SMALL constexpr Store(Ids& all, const Options& options) : options_(options), ids(all) {}

  Changes& changes() { return numbers.written.changes; }
  /// The size of the world if it wraps around; else null.
  const f64* world() const { return options_.wrap[0] > 0 ? options_.wrap : nullptr; }
  /// For the index.
  PresentBoxes present() {
    see_written();
    return {numbers.boxes(), numbers.exact(),           ids, own.rules(), own.reaches.data(),
            world(),         numbers.written.in_place()};
  }
  /// Copies what was written in place to where the boxes are.
  SMALL void see_written() { numbers.written.see(numbers.boxes(), ids.count()); }

  /// Memory for that many boxes, so that it need not grow while they are added.
  SMALL void reserve(u32 count) {
    if (count > ids.count()) make_room(count, ids.count());
  }

  /// Adds or moves the first `count` boxes of the ring, in order, and updates what may wait in it. All ids are in the
  /// space, or there is room for them; only a box that comes alone may need more.
  NOINLINE void take(Ring<D>& ring, u32 count) {
    full_ |= count >= Ring<D>::usual_entries;
    put(ring.first(), count);
    tell(ring);
  }

  /// The same, right before an update. If the ring was full before, it is enlarged: when all boxes of a frame wait until
  /// its update, what the last update saw need not be copied (see Seen::pass).
  SMALL void take_for_update(Ring<D>& ring, u32 count) {
    seen.pass();
    put(ring.first(), count);
    if (full_ && ids.count() >= Ring<D>::usual_entries && ids.count() <= Seen<D>::spared) enlarge(ring);
    full_ = false;
    tell(ring);
  }

  /// Tells JavaScript which boxes may wait in the ring.
  NOINLINE void tell(Ring<D>& ring) {
    const u32 n = ids.count(), usual = Ring<D>::usual_entries;
    const u32 usable = n > Seen<D>::spared ? usual : larger(usual + 1, u32(waiting_.capacity()) / Ring<D>::step) - 1;
    ring.usable = usable;
    ring.place(waiting_.data());
    ring.dense = ring.room = ring.pages = 0;
    heap::kept = 0;
    if (numbers.written.in_place()) return;
    if (!ids.same() && room() < n + usable) {
      u64 more = u64(n) + usable;
      tight_ = !heap::reach(more * RoomAhead<D>::most);
      if (!tight_ && more <= max_slots) make_room(more, n);
    }
    if (tight_) return;
    heap::kept = numbers.bytes_to_round();  // any of them may be the first double
    if (ids.same()) {
      ring.dense = n;
      ring.room = room() - n;
    } else if (room() >= n + usable) {
      ring.pages = f64(reinterpret_cast<size_t>(ids.pages()));
    }
  }

  /// Removes a box; false if there is none.
  SMALL bool remove(u32 id) {
    see_written();
    u32 slot = ids.slot(id);
    if (slot == Ids::none) return false;
    before_change();
    if (keeps_events) events.make_room(id);
    changed.remove(id);
    ids.erase(id);
    numbers.written.renamed = true;
    if (keeps_events) events.forget(id);
    u32 last = ids.count();
    own.move(last, slot);
    if (slot != last) numbers.move(last, slot);
    return true;
  }

  /// The numbers a box was given with; false if there is none.
  SMALL bool get(u32 id, f64* box) {
    see_written();
    u32 slot = ids.slot(id);
    if (slot == Ids::none) return false;
    for (u32 k = 0; k < width; k++) box[k] = numbers.number(slot, k);
    return true;
  }

  SMALL void clear() {
    before_change();
    room_to_forget();
    forget_from(0);
    ids.reset(0);
    own.clear();
    changes().note_all();
    numbers.written.end();
    numbers.hold_floats();
    numbers.written.renamed = true;
  }

  /// Writes the addresses of all contents, in the order of ContentsPlace.
  SMALL void contents(f64* out) const {
    out[ids_at] = f64(u64(ids.names()));
    out[boxes_at] = f64(u64(numbers.boxes()));
    out[doubles_at] = f64(u64(numbers.exact()));
    out[rules_at] = f64(u64(own.rules()));
    out[groups_at] = f64(u64(own.groups.data()));
    out[reaches_at] = f64(u64(own.reaches.data()));
  }

  /// Replaces all boxes by the staged ones, as ids 0 … count - 1. Returns the first bad id, or -1; if there is one,
  /// nothing changes.
  SMALL i32 replace(u32 count, bool doubles) {
    bool rounded;
    i32 bad = numbers.check_staged(count, doubles, rounded);
    if (bad >= 0) return bad;
    bool keeps_ids = ids.same() && ids.count() == count;
    if (!keeps_ids) prepare_ids(count);  // may fail, so before the numbers are given away
    // The numbers that are replaced need not be copied, unless JavaScript may still write to where they are.
    if (seen.is_open()) hold(Seen<D>::spared, !world() && !numbers.written.in_place());
    if (keeps_ids) changes().note_all();
    else renumber(count);
    numbers.take_staged(rounded);
    return -1;
  }

  /// The boxes of ids 0 … count - 1, to be written in place. Ids from count on are removed, new ones are points
  /// at the origin.
  SMALL f32* expose(u32 count) {
    numbers.take_written(ids.count());
    before_change(Seen<D>::spared_in_place);
    u32 had = ids.count();
    bool ids_were_same = ids.same();
    if (!ids_were_same) {
      stage_by_id(count);
      prepare_ids(count);
      renumber(count);
      numbers.swap_staged();
    } else if (count != had || !numbers.boxes()) {
      prepare_ids(count);
      numbers.resize(count, had);
      renumber(count);
    }
    if (numbers.exact()) {
      if (ids_were_same) numbers.write_floats(smaller(count, had), numbers.boxes());
      changes().note_all();  // boxes that touch only when rounded are pairs from now on
      numbers.hold_floats();
    }
    numbers.written.begin();
    // Growing memory later would detach the caller's view.
    RoomAhead<D>::take(count, RoomAhead<D>::in_place, keeps_events);
    return numbers.boxes();
  }

  /// Sets the layer and the mask of a box.
  SMALL void filter(u32 slot, u32 layer, u32 mask) {
    Rule now = own.rule(slot);
    if (now.layer == layer && now.mask == mask) return;
    before_change();
    Rule& rule = rule_of(slot);
    rule.layer = layer;
    rule.mask = mask;
  }

  /// Sets or clears an exclusion bit of a box, or the mark that it is off.
  SMALL void exclude(u32 slot, u32 bit, bool on) {
    u32 was = own.rule(slot).excluded, is = on ? was | bit : was & ~bit;
    if (is != was) rule_of(slot).excluded = is;
  }

  /// Excludes a box from pairs and queries, or includes it again.
  SMALL void enable(u32 slot, bool on) {
    if (on != own.rule(slot).is_off()) return;
    before_change();
    exclude(slot, Rule::off, !on);
  }

  /// Puts a box into a group, or, with 0, into none.
  SMALL void put_in_group(u32 slot, u32 group) {
    if (group == own.groups.of(slot)) return;
    own.groups.set(slot, group, numbers.capacity());
    changes().note(slot);
  }

  /// Sets how far a box reaches.
  SMALL void set_reach(u32 slot, f64 distance) {
    if (distance == own.reaches.of(slot)) return;
    before_change();
    own.reaches.set(slot, distance, numbers.capacity());
    changes().note(slot);
  }

  /// The id of the first bad box among those written in place, or -1.
  SMALL i32 bad_in_place() const {
    i32 bad = numbers.written.in_place() ? numbers.first_bad(ids.count()) : -1;
    return bad < 0 ? -1 : i32(ids.id(u32(bad)));  // a removal may have moved it after it was written
  }

 private:
  SMALL void before_change(u32 most = Seen<D>::spared) {
    if (seen.is_open()) hold(most);
  }

  /// Keeps what the last update saw. `gives`: the memory of its numbers, which will be written to no more.
  SMALL void hold(u32 most, bool gives = false) {
    PresentBoxes last = present();
    if (gives) last.boxes = nullptr;
    seen.hold(last, most);
    if (gives && !seen.lost()) seen.index.take(numbers);
  }

  /// Makes room for all boxes in the ring, and one more: it is flushed when the last entry is written. Its entries stay,
  /// since JavaScript still counts on them: the stack may end before the update does.
  SMALL void enlarge(Ring<D>& ring) {
    u64 had = waiting_.capacity(), numbers = (u64(ids.count()) + 2) * Ring<D>::step;
    if (!heap::can_spare(2 * waiting_.missing(numbers))) return;
    waiting_.grow(numbers, had);
    if (had == 0) __builtin_memcpy(waiting_.data(), ring.few, sizeof(ring.few));
    ring.place(waiting_.data());
  }

  /// Adds or moves boxes.
  NOINLINE void put(const f64* entries, u32 count) {
    if (count) before_change();
    u32 slots[Ring<D>::batch];
    for (; count > 0; entries += Ring<D>::batch * Ring<D>::step) {
      u32 many = smaller(count, Ring<D>::batch);
      count -= many;
      // Whatever can fail comes first.
      if (!numbers.exact() && !numbers.are_floats(entries + 1, many, Ring<D>::step)) numbers.keep_doubles(ids.count());
      find_slots(entries, many, slots);
      if (ids.count() > near_boxes) numbers.read_ahead(slots, many);
      if (changes().most(ids.count())) changes().note_all();  // a list of most boxes is not used
      numbers.template put<Ring<D>::step>(entries + 1, slots, many);
    }
  }

  /// Room for `count` boxes in every array with one entry per box.
  SMALL void make_room(u64 count, u32 keep) {
    if (count > max_slots) fail(Fault::out_of_memory, f64(count) * width * sizeof(f32));
    ids.make_room(count);
    numbers.make_room(count, keep);
    changes().make_room(numbers.capacity());
    own.make_room(numbers.capacity(), keep);
    tight_ = !heap::reach(numbers.bytes_to_round());
  }

  /// The number of boxes there is room for in all of these arrays.
  SMALL u32 room() const {
    u64 all = smaller(smaller(u64(max_slots), numbers.room()), u64(numbers.written.changes.room()));
    return u32(larger(own.room(smaller(all, ids.room())), u64(ids.count())));
  }

  /// Finds the slots of these boxes of the ring; new ids get one.
  void find_slots(const f64* entry, u32 count, u32* slots) {
    u32 known = ids.same() ? ids.count() : 0;
    for (u32 k = 0; k < count; k++, entry += Ring<D>::step) {
      u32 id = Ring<D>::id(entry), slot = id;
      if (id >= known) slot = ids.same() ? Ids::none : ids.on_page(id);
      if (slot == Ids::none) {
        slot = add(id);
        known = ids.same() ? ids.count() : 0;
      }
      slots[k] = slot;
    }
  }

  /// Gives a new id a slot.
  NOINLINE u32 add(u32 id) {
    if (ids.count() >= room()) make_room(u64(ids.count()) + 1, ids.count());
    u32 slot = ids.insert(id);
    numbers.written.renamed = true;
    own.insert(slot);
    changes().note(slot);
    return slot;
  }

  /// Stages the boxes of ids 0 … count - 1 as float32; missing ones are points at the origin.
  SMALL void stage_by_id(u32 count) {
    f32* to = numbers.stage(count);
    for (u32 id = 0; id < count; id++) {
      u32 slot = ids.slot(id);
      for (u32 k = 0; k < width; k++) {
        to[u64(id) * width + k] = slot == Ids::none ? 0 : f32(numbers.number(slot, k));
      }
    }
  }

  /// The rule of a box, for changing it.
  SMALL Rule& rule_of(u32 slot) {
    if (!own.filters.active()) own.filters.start(ids.count(), numbers.capacity());
    changes().note(slot);  // also for the index
    return own.filters.change(slot);
  }

  /// Room to record the deletion of any id, if events are on.
  SMALL void room_to_forget() {
    u32 last = 0;
    for (u32 s = 0; s < ids.count(); s++) last = larger(last, ids.id(s));
    if (keeps_events) events.make_room(last);
  }

  /// Records that the boxes of ids from this one on are about to be removed; there is room.
  SMALL void forget_from(u32 first) {
    for (u32 s = 0; keeps_events && s < ids.count(); s++) {
      if (ids.id(s) >= first) events.forget(ids.id(s));
    }
  }

  /// Memory for `renumber`.
  SMALL void prepare_ids(u32 count) {
    room_to_forget();
    own.stage(count);
  }

  /// The ids become 0 … count - 1, once they are prepared; boxes that were there keep their rules.
  SMALL void renumber(u32 count) {
    changes().note_all();
    numbers.written.renamed = true;
    own.renumber(ids, count);
    forget_from(count);
    ids.reset(count);
  }
};

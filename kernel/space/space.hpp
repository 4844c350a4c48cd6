// A space: its contents, the technique that finds the pairs, and the exactness of the answer. An update is a sequence
// of steps: changes are recorded, the scene is built, a technique searches it, pairs in doubt are decided with the
// numbers given, and the pairs are published. Boxes that were set wait in the ring (ring.hpp) until JavaScript flushes
// it, at the latest before an update.
#pragma once
#include "pairs/lookups.hpp"
#include "pairs/pair_order.hpp"
#include "space/auto.hpp"
#include "space/finder.hpp"
#include "space/questions.hpp"
#include "space/report.hpp"

/// What `validate` finds. The comments are what it says: scripts/abi.mjs takes them from here.
enum class Broken : u32 {
  nothing,  // nothing
  ids,  // ids and slots do not name each other, at id
  box,  // a box has a NaN or a minimum above its maximum, id
  rounded,  // a box is not what its numbers are rounded to, id
  pair,  // a pair is not in order, number
};

template <int D> class Space {
  const Options& options_;
  SceneBuilder<D> builder_;
  Lookups lookups_;
  PairOrder order_;
  u32 seen_ = 0;  // boxes in the last update
  bool mapped_ = false;  // the pairs are not in the slots that the technique saw
  bool searching_ = false;  // in the middle of an update: there are no pairs until it ends
  bool ordered_ = false;  // after the first snapshot, earlier updates must not affect the order of pairs

 public:
  Store<D> store;
  Finder<D> finder;
  Pairs pairs;
  Questions<D> questions;
  Snapshot snapshot;
  Stats stats;
  Technique technique = by_default;
  u32 updates = 0;

  SMALL constexpr Space(Ids& ids, const Options& options)
      : options_(options), store(ids, options), questions(store, options) {}

  /// Brings the pairs up to date. Returns the first bad id among boxes written in place, or -1.
  SMALL i32 update() {
    if (searching_) recover();  // the stack ended in the middle of the last one
    store.see_written();
    i32 bad = store.bad_in_place();
    if (bad >= 0) return bad;
    Technique chosen = choose();
    note_written();
    if (is_at_rest(chosen) || !find(chosen)) return rest();
    if (store.keeps_events) store.events.follow(pairs, lookups_.table);
    publish();
    return -1;
  }

  /// Writes the contents of the space to `snapshot`. Returns the first bad id among boxes written in place, or -1.
  SMALL i32 save() {
    store.see_written();
    i32 bad = store.bad_in_place();
    if (bad >= 0) return bad;
    Numbers<D>& numbers = store.numbers;
    u32 n = store.ids.count();
    numbers.take_written(n);
    if (!ordered_) store.changes().note_all();  // the retained pairs are in another order
    ordered_ = true;
    const f64* exact = numbers.exact();
    bool doubles = exact && !numbers.are_floats(exact, n, 2 * D);
    snapshot.write(D, saved_number(technique), doubles, numbers.written.in_place(), store.ids, store.own.filters,
                   store.own.groups.data(), store.own.reaches.data(), kept_events());
    if (doubles) __builtin_memcpy(snapshot.boxes(), exact, snapshot.box_bytes());
    else numbers.write_floats(n, reinterpret_cast<f32*>(snapshot.boxes()));
    snapshot.seal();
    return -1;
  }

  /// Replaces the contents by those staged in `snapshot`, and finds the pairs, as after an update. If the bytes are
  /// bad, or memory runs out before everything is replaced, nothing changes; if it runs out later, there are no pairs.
  SMALL SnapshotFault restore() {
    if (!snapshot.is_whole()) return SnapshotFault::damaged;
    const SnapshotHeader& head = snapshot.head();
    Numbers<D>& numbers = store.numbers;
    Own& own = store.own;
    bool doubles = snapshot.doubles(), rounded;
    void* staged = doubles ? static_cast<void*>(numbers.stage_exact(head.count)) : numbers.stage(head.count);
    if (head.count) __builtin_memcpy(staged, snapshot.boxes(), snapshot.box_bytes());
    if (numbers.check_staged(head.count, doubles, rounded) >= 0 ||
        !snapshot.check(own.filters, own.groups, own.reaches, kept_events()) ||
        !snapshot.take(store.ids, own.filters, own.groups, own.reaches, kept_events()))
      return SnapshotFault::content;
    store.changes().note_all();
    numbers.take_staged(rounded);
    if (head.in_place) numbers.write_in_place(head.count);
    technique = saved_technique(head.technique);
    ordered_ = numbers.written.renamed = true;
    store.seen.restart();
    look_for_map();
    find(choose());
    publish();
    store.changes().note_all();  // the next update determines which pairs begin and end
    return SnapshotFault::none;
  }

  /// Whether two ids are a pair of the last update.
  SMALL bool is_pair(u32 a, u32 b) { return lookups_.is_pair(pairs, a, b); }

  /// Writes the partners of an id in the last update to the answers; returns how many.
  SMALL u32 partners(u32 id) { return lookups_.partners(pairs, id, questions.answers); }

  /// Writes the boxes of the cells of the last update to the finder's `cells`.
  SMALL void structure() {
    store.see_written();
    finder.structure(store, stats);
  }

  /// After memory has run out: drops everything retained, so that the next update rebuilds it. If it ran out during an
  /// update, there are no pairs.
  SMALL void recover() {
    finder.release();
    store.changes().note_all();
    store.changed.note_all();
    store.own.filters.forget();
    pairs.stable = 0;
    if (searching_) {
      pairs.list.release();
      pairs.count = store.events.began.count = store.events.ended.count = 0;
      stats = Stats{};
    }
    searching_ = false;
    stats.cells = stats.entries = 0;  // there are none to draw any more
    lookups_.forget();
    pairs.doubts.release();
    order_.release();
    builder_.release();
    store.seen.index.forget();
    questions.release();
    stats.bytes = f64(heap::used);
  }

  /// The first invariant that does not hold; `detail`: where.
  SMALL Broken validate(u32& detail) {
    store.see_written();
    detail = 0;
    const Ids& ids = store.ids;
    if (!ids.valid()) return Broken::ids;
    i32 bad = store.numbers.written.in_place() ? -1 : store.numbers.first_bad(ids.count());
    Broken broken = Broken::box;
    if (bad < 0) {
      bad = store.numbers.first_unrounded(ids.count());
      broken = Broken::rounded;
    }
    if (bad >= 0) {
      detail = ids.id(u32(bad));
      return broken;
    }
    for (u64 p = 0; p < pairs.count; p++) {
      u32 a = u32(pairs.list[p]), b = u32(pairs.list[p] >> 32);
      detail = u32(p);
      if (a >= b) return Broken::pair;
    }
    return Broken::nothing;
  }

 private:
  Technique choose() const { return auto_choice(technique, store.ids.count()); }
  Events* kept_events() { return store.keeps_events ? &store.events : nullptr; }

  /// Records what was written in place, and tries a better map.
  void note_written() {
    store.numbers.take_written(store.ids.count());
    look_for_map();
    if (store.numbers.written.in_place()) store.changes().note_all();
  }

  void look_for_map() {
    if (!store.world()) store.numbers.look_for_map(store.ids.count(), ordered_);
  }

  /// Whether nothing has changed since the technique found the pairs.
  bool is_at_rest(Technique chosen) {
    const Own& own = store.own;
    return finder.traits(chosen).follows_changes && chosen == finder.ran() && store.changes().none() &&
           store.ids.count() == seen_ && !own.filters.changed() && !own.groups.changed();
  }

  /// Lets a technique find the pairs, and turns them into the ones to report; false if they are the same as before.
  SMALL bool find(Technique chosen) {
    searching_ = true;
    Traits its = finder.traits(chosen);
    Scene<D> scene = builder_.build(store, its.follows_changes, !its.varies_order);
    if (!keeps_head(scene)) pairs.stable = 0;
    search(scene, chosen);
    // With doubles, bounds may have changed by less than float32 shows.
    bool same = pairs.same && !store.numbers.written.renamed && !builder_.doubles;
    note_seen(its.follows_changes);
    if (stats.candidates == 0) stats.candidates = f64(pairs.count);
    stats.pairs = f64(pairs.count);
    if (same) searching_ = false;
    else report(its, scene.groups);
    return !same;
  }

  /// Whether pairs that stay at the head of the list are as they are to be reported.
  SMALL bool keeps_head(const Scene<D>& scene) {
    const Own& own = store.own;
    bool were_mapped = mapped_;
    mapped_ = own.filters.some() || !store.ids.same();
    if (ordered_ || own.filters.removes() || (own.groups.some() && !scene.groups)) return false;
    if (own.filters.active() && !own.filters.moved().none()) return false;
    return !store.numbers.written.renamed || !(mapped_ || were_mapped);
  }

  void search(const Scene<D>& scene, Technique chosen) {
    pairs.count = pairs.doubt_count = 0;
    pairs.watch = builder_.doubles || !options_.touching;
    stats = Stats{};
    bool is_bounded = options_.bounds[0] < options_.bounds[D];
    if (is_bounded) finder.run(chosen, scene, mapped_options(), pairs, stats);
    else finder.run(chosen, scene, options_, pairs, stats);
  }

  SMALL Options mapped_options() const {
    Options mapped = options_;
    for (u32 n = 0; n < 2 * D; n++) mapped.bounds[n] = store.numbers.map().map(options_.bounds[n], n % D);
    return mapped;
  }

  /// Passes the changes on to those who follow them, and empties the list. `followed`: the technique does.
  SMALL void note_seen(bool followed) {
    Changes& changes = store.changes();
    u32 n = store.ids.count();
    store.changed.note(changes.all(), changes.list(), changes.count(), n, [&](u32 slot) { return store.ids.id(slot); });
    store.seen.end();
    if (store.seen.can_follow(changes, n)) store.seen.follow(store.present(), changes);
    if (store.numbers.written.in_place()) store.seen.see_in_place(store.present());
    if (followed) changes.clear(n);
    else changes.note_all();
    seen_ = n;
    store.numbers.written.renamed = false;
  }

  /// Turns pairs of slots found in float32 into the pairs to report. `its`: of the technique; `grouped`: it knew of
  /// groups.
  SMALL void report(const Traits& its, bool grouped) {
    const Own& own = store.own;
    if (store.world()) builder_.wrap.fold(pairs, options_.touching, its.notes_doubts);
    else if (pairs.watch) decide_doubts(pairs, store, builder_.doubles, its.notes_doubts, options_.touching);
    if (own.filters.active()) own.filters.finish(pairs);
    if (own.groups.some() && !(grouped && pairs.checked)) part_groups(pairs, own.groups.data());
    bool sorts = ordered_ || (store.keeps_events && !pairs.checked && store.events.scattered);
    if (sorts && its.varies_order) order_.sort(pairs.list.data(), pairs.count, store.ids.count());
    if (!store.ids.same()) name_pairs(pairs, store.ids);
  }

  SMALL void publish() {
    searching_ = false;
    lookups_.forget();
    stats.pairs = f64(pairs.count);
    // Growing memory later would detach the views of the pairs in the middle of a loop over them.
    u64 more = pairs.count * RoomAhead<D>::lookup + RoomAhead<D>::spare;
    RoomAhead<D>::take(store.ids.count(), more, store.keeps_events);
    end();
  }

  /// An update in which nothing has changed.
  i32 rest() {
    store.seen.end();
    store.events.began.count = store.events.ended.count = 0;
    stats.tests = 0;
    stats.reason = f64(u32(Reason::kept));
    end();
    return -1;
  }

  SMALL void end() {
    updates++;
    stats.address = f64(reinterpret_cast<size_t>(pairs.list.data()));
    stats.bytes = f64(heap::used);
    say_choice(technique, finder.ran(), stats);
  }
};

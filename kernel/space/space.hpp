// A space: boxes by id, the technique that finds their pairs, and the exactness of the answer.
//
// Boxes live twice over where they must: as float32, which every technique searches, and, from the first box on that
// float32 cannot hold, as the doubles that were given. They are rounded so that the order of numbers is kept (see
// gap_map.hpp), and so only pairs of which two bounds are equal in float32 are in doubt: these are tested again in
// double. Boxes that float32 holds pay nothing.
// Every change allocates before it writes: when memory ends, the space is as it was.
#pragma once
#include "boxes/changed_ids.hpp"
#include "boxes/gap_map.hpp"
#include "boxes/per_box.hpp"
#include "boxes/ring.hpp"
#include "pairs/events.hpp"
#include "pairs/partners.hpp"
#include "questions/bulk.hpp"
#include "questions/plane_query.hpp"
#include "rules/filters.hpp"
#include "rules/wrap.hpp"
#include "space/auto.hpp"
#include "space/snapshot.hpp"
#include "space/techniques.hpp"

template <int D> class Space {
  static constexpr u32 width = 2 * D;  // numbers in a box
  static constexpr u64 padding = 4;    // vector loads may read this many floats past the last box
  // More than so many are read beforehand, all that are taken together, when they are set: see Ring.
  static constexpr u32 near_boxes = 20000;

  // So many points, all at one place, are few candidates for an update.
  static constexpr u32 usual_collapsed = 256;
  // Updates between two looks for a better map, and boxes from which on it is worth one.
  static constexpr u32 look_every = 16, worth_a_look = 64;

  // Bytes a box, pairs included, that an update takes in ordinary scenes; and that stand once all is kept.
  static constexpr u32 usual_bytes = D == 2 ? 448 : 640, kept_bytes = D == 2 ? 352 : 640;

  // Bytes a box that all arrays of boxes may take as they grow.
  static constexpr u32 most_bytes = 2 * (width * (sizeof(f32) + sizeof(f64)) + 24);

  // Bytes a pair that the tables take in which pairs are looked up.
  static constexpr u32 bytes_to_look_up = 24;

  Ids& ids_;
  const Settings& options_;
  Buffer<f32> boxes_, staged_;
  Buffer<f64> exact_, staged_exact_;  // the doubles given, while `rounding_`
  bool rounding_ = false;
  GapMap<D>
      map_;  // from doubles to float32, while `rounding_`; plain while boxes are exposed or the world wraps around
  u32 collapsed_ = 0;  // how many boxes given since the last update are points in float32, on some axis, but are none
  u32 bearable_ = usual_collapsed;  // with more of them another map is looked for at once
  u32 look_in_ = 0;  // updates until it is looked for anyhow
  bool exposed_ = false;  // `boxes()` has handed out the memory: look at each update for what was written
  Buffer<f32> shown_;  // where that memory is, once the boxes had to move elsewhere
  u32 shown_count_ = 0;  // boxes in it; 0: it is not in use
  bool renamed_ = false;  // since the last update, boxes have come, gone or got other ids
  bool tight_ = false;  // memory may not be had for the first double
  Filters filters_;
  PerBox<u32> groups_;
  Buffer<u32> searched_groups_;  // where not all boxes are searched
  PerBox<f64> reaches_;
  Buffer<f32> grown_;  // by their reaches: the boxes that are searched, where some box has one
  Buffer<f64> grown_exact_;  // the same as doubles, of which they are made
  Changes changes_;  // since the last update, for the technique that asks
  Wrap wrap_;
  Techniques<D> techniques_;
  Technique ran_ = Technique::brute_force;
  u32 seen_ = 0;  // boxes in the last update
  // Made of the pairs at the first question after an update.
  PairTable table_;
  Partners partners_;
  bool partners_made_ = false;
  Index<D> index_;
  // What questions see is what the last update saw. While nothing has changed since, the boxes themselves are that; the
  // index takes a copy before the first change. Large spaces that nobody has asked are spared it, and then cannot say.
  bool asked_ = false;  // ever
  bool holds_ = true;  // the index has what the last update saw: at first, nothing
  bool lost_ = false;  // nobody has
  static constexpr u32 spared = 16384, spared_in_place = 4096;
  bool searching_ = false;  // in an update: until its end there are no pairs
  bool restored_ = false;  // since the last update: the pairs before are not those of which `table_` may be made
  bool ordered_ =
      false;  // a snapshot was taken or restored: from then on no update before may show in the order of pairs

 public:
  Pairs pairs;
  Events events;  // while `keeps_events`
  bool keeps_events = false;
  u32 updates = 0;
  Question<D> question;
  Planes<D> planes;  // of a question about planes
  Buffer<u32> answers;  // ids, of the last question
  Hits hits;  // where the question asks for an order
  Bulk<D> bulk;  // many questions, and their answers
  ChangedIds changed;  // for who keeps pairs with another space
  Stats stats;
  Buffer<f32> cells;  // what structure() has written
  u32 cell_count = 0;
  Technique technique = Technique::automatic;
  Snapshot snapshot;

  static constexpr u32 unknown = 0xffffffff;  // an answer: nobody has kept what the last update saw

  constexpr Space(Ids& ids, const Settings& options) : ids_(ids), options_(options) {}

  /// Memory for that many boxes, so that it need not grow while they are added.
  SMALL void reserve(u32 count) {
    if (count > ids_.count()) make_room(count, ids_.count());
  }

  /// Adds or moves the first `count` boxes of the ring, in their order, and says what may wait in it from now on. All
  /// ids but one that comes alone are in the space, or there is room for them.
  NOINLINE void take(Ring<D>& ring, u32 count) {
    if (count && !holds_) hold();
    u32 slots[Ring<D>::batch];
    for (u32 from = 0; from < count; from += Ring<D>::batch) {
      const f64* entries = ring.entries + from * Ring<D>::step;
      u32 many = smaller(count - from, Ring<D>::batch);
      // What can fail comes first.
      if (!rounding_ && !are_floats(entries + 1, many, Ring<D>::step)) start_rounding();
      find_slots(entries, many, slots);
      if (ids_.count() > near_boxes) {
        read_rows(boxes_.data(), width * sizeof(f32), slots, many, 1);
        if (rounding_) read_rows(exact_.data(), width * sizeof(f64), slots, many, 1);
      }
      if (rounding_) put<true>(entries, slots, many);
      else put<false>(entries, slots, many);
    }
    tell(ring);
  }

  /// Says what may wait in the ring.
  NOINLINE void tell(Ring<D>& ring) {
    ring.dense = ring.room = ring.pages = 0;
    if (exposed_) return;
    if (!ids_.same() && room() < ids_.count() + Ring<D>::most) {
      u64 more = u64(ids_.count()) + Ring<D>::most;
      tight_ = !heap::reach(more * most_bytes);
      if (!tight_ && more <= max_slots) make_room(more, ids_.count());
    }
    if (tight_) return;
    if (ids_.same()) {
      ring.dense = ids_.count();
      ring.room = room() - ids_.count();
    } else if (room() >= ids_.count() + Ring<D>::most) {
      ring.pages = f64(reinterpret_cast<size_t>(ids_.pages()));
    }
  }

  /// Takes a box away; false where there is none.
  SMALL bool remove(u32 id) {
    see_shown();
    if (!holds_) hold();
    u32 slot = ids_.slot(id);
    if (slot == Ids::none) return false;
    if (keeps_events) events.make_room(id);
    changed.remove(id);
    ids_.erase(id);
    renamed_ = true;
    if (keeps_events) events.forget(id);
    u32 last = ids_.count();
    if (filters_.active()) filters_.move(last, slot);
    groups_.move(last, slot);
    reaches_.move(last, slot);
    if (slot == last) return true;
    changes_.note(slot);
    __builtin_memcpy(boxes_.data() + u64(slot) * width, boxes_.data() + u64(last) * width, width * sizeof(f32));
    if (rounding_) {
      __builtin_memcpy(exact_.data() + u64(slot) * width, exact_.data() + u64(last) * width, width * sizeof(f64));
    }
    show(slot);
    return true;
  }

  /// The numbers a box was given with; false where there is none.
  SMALL bool get(u32 id, f64* box) {
    see_shown();
    u32 slot = ids_.slot(id);
    if (slot == Ids::none) return false;
    for (u32 k = 0; k < width; k++) box[k] = number(slot, k);
    return true;
  }

  SMALL void clear() {
    if (!holds_) hold();
    room_to_forget();
    forget_from(0);
    ids_.reset(0);
    filters_.clear();
    groups_.clear();
    reaches_.clear();
    changes_.note_all();
    exposed_ = false;
    shown_count_ = 0;
    hold_floats();
    renamed_ = true;
  }

  /// Where everything stands, for a recorder and right after an update: the ids (0: slots), the boxes, the doubles they
  /// were given as (0: none), the rules (0: none), the groups and the reaches (0: none).
  SMALL void contents(f64* out) const {
    out[0] = f64(u64(ids_.names()));
    out[1] = f64(u64(boxes_.data()));
    out[2] = rounding_ ? f64(u64(exact_.data())) : 0;
    out[3] = filters_.active() ? f64(u64(filters_.rules())) : 0;
    out[4] = f64(u64(groups_.data()));
    out[5] = f64(u64(reaches_.data()));
  }

  /// Memory into which the next `replace` expects its boxes, as float32 or as doubles.
  SMALL f32* stage(u32 count) { return staged_.reserve(u64(count) * width + padding); }
  SMALL f64* stage_exact(u32 count) {
    stage(count);
    return staged_exact_.reserve(u64(count) * width);
  }

  f64 staged_number(u32 index, bool doubles) const { return doubles ? staged_exact_[index] : f64(staged_[index]); }

  /// Takes what was staged in place of all boxes, as ids 0 … count - 1. Returns the first bad id, or -1;
  /// where there is one, nothing changes.
  i32 replace(u32 count, bool doubles) {
    bool rounded = false;
    i32 bad = doubles ? round_staged(count, rounded) : first_bad(staged_.data(), count);
    if (bad >= 0) return bad;
    if (!holds_) hold();
    if (ids_.same() && ids_.count() == count) changes_.note_all();
    else renumber(count);
    take_staged(rounded);
    return -1;
  }

  /// The boxes of ids 0 … count - 1, to be written in place. Ids from count on are removed, new ones are points
  /// at the origin.
  SMALL f32* expose(u32 count) {
    take_written();
    if (!holds_) hold(spared_in_place);
    u32 had = ids_.count();
    bool ids_were_same = ids_.same();
    if (!ids_were_same) {
      f32* to = stage(count);
      for (u32 id = 0; id < count; id++) {
        u32 slot = ids_.slot(id);
        for (u32 k = 0; k < width; k++) to[u64(id) * width + k] = slot == Ids::none ? 0 : f32(number(slot, k));
      }
      renumber(count);
      boxes_.swap(staged_);
    } else if (count != had || !boxes_.data()) {
      boxes_.grow(u64(count) * width + padding, u64(had) * width);
      if (count > had) {
        __builtin_memset(boxes_.data() + u64(had) * width, 0, u64(count - had) * width * sizeof(f32));
      }
      renumber(count);
    }
    if (rounding_) {
      for (u32 k = 0; ids_were_same && k < smaller(count, had) * width; k++) boxes_[k] = f32(exact_[k]);
      changes_.note_all();  // boxes that touch only as they are rounded are pairs from now on
      hold_floats();
    }
    exposed_ = true;
    shown_count_ = 0;
    // Growing later would cut the caller's view off, so take now what an update usually needs. Memory that is
    // not touched costs nothing.
    reach(count, 1 << 18);
    return boxes_.data();
  }

  SMALL Rule rule(u32 slot) const {
    return filters_.active() ? filters_.rules()[slot] : Rule{0xffffffff, 0xffffffff, 0};
  }

  /// Sets the layer and the mask of a box.
  SMALL void filter(u32 slot, u32 layer, u32 mask) {
    if (!holds_) hold();
    changes_.note(slot);  // for the index
    Rule& rule = rule_of(slot);
    rule.layer = layer;
    rule.mask = mask;
  }

  /// Sets or clears an exclusion bit of a box, or the mark that it is off.
  SMALL void exclude(u32 slot, u32 bit, bool on) {
    if (!on && !filters_.active()) return;
    Rule& rule = rule_of(slot);
    rule.excluded = on ? rule.excluded | bit : rule.excluded & ~bit;
  }

  /// Takes a box out of pairs and questions, or back in.
  SMALL void enable(u32 slot, bool on) {
    if (on != rule(slot).is_off()) return;
    if (!holds_) hold();
    changes_.note(slot);  // for the index
    exclude(slot, Rule::off, !on);
  }

  u32 group(u32 slot) const { return groups_.of(slot); }

  /// Puts a box into a group, or, with 0, into none.
  SMALL void put_in_group(u32 slot, u32 group) {
    if (group != groups_.of(slot)) groups_.set(slot, group, boxes_.capacity() / width);
  }

  f64 reach_of(u32 slot) const { return reaches_.of(slot); }

  /// Says how far a box reaches.
  SMALL void set_reach(u32 slot, f64 distance) {
    if (distance == reaches_.of(slot)) return;
    if (!holds_) hold();
    reaches_.set(slot, distance, boxes_.capacity() / width);
    changes_.note(slot);
  }

  /// Writes what stands in the space to `snapshot`. Returns the first bad id among boxes written in place, or -1.
  SMALL i32 save() {
    see_shown();
    i32 bad = bad_in_place();
    if (bad >= 0) return bad;
    take_written();
    if (!ordered_) changes_.note_all();  // those pairs are in another order
    ordered_ = true;
    bool doubles = rounding_ && !are_floats(exact_.data(), ids_.count(), width);
    u8 used = technique == Technique::automatic ? SnapshotHeader::automatic : u8(technique);
    snapshot.write(D, used, doubles, ids_, filters_, groups_.data(), reaches_.data(), keeps_events ? &events : nullptr);
    const void* boxes = doubles ? static_cast<const void*>(exact_.data()) : boxes_.data();
    if (ids_.count()) __builtin_memcpy(snapshot.boxes(), boxes, snapshot.box_bytes());
    snapshot.seal();
    return -1;
  }

  /// Takes what was staged in `snapshot` in place of all there is, and finds the pairs, as after an update. Where the
  /// bytes are bad, or memory ends before all is taken, nothing changes; where it ends later there are no pairs.
  SMALL SnapshotFault restore() {
    if (!snapshot.is_whole()) return SnapshotFault::damaged;
    const SnapshotHeader& head = snapshot.head();
    bool doubles = snapshot.doubles(), rounded = false;
    void* staged = doubles ? static_cast<void*>(stage_exact(head.count)) : stage(head.count);
    if (head.count) __builtin_memcpy(staged, snapshot.boxes(), snapshot.box_bytes());
    i32 bad = doubles ? round_staged(head.count, rounded) : first_bad(staged_.data(), head.count);
    Events* kept = keeps_events ? &events : nullptr;
    if (bad >= 0 || !snapshot.check(filters_, groups_, reaches_, kept) ||
        !snapshot.take(ids_, filters_, groups_, reaches_, kept))
      return SnapshotFault::content;
    changes_.note_all();
    take_staged(rounded);
    technique = head.technique == SnapshotHeader::automatic ? Technique::automatic : Technique(head.technique);
    restored_ = ordered_ = renamed_ = true;
    holds_ = lost_ = false;
    index_.forget();  // of the order of boxes before nothing is to be seen
    find();
    changes_.note_all();  // the next update finds out what begins and ends
    return SnapshotFault::none;
  }

  /// Brings the pairs up to date. Returns the first bad id among boxes written in place, or -1.
  SMALL i32 update() {
    see_shown();
    Technique chosen = auto_choice(technique, ids_.count(), ordered_);
    bool follows = chosen == Technique::incremental;
    i32 bad = bad_in_place();
    if (bad >= 0) return bad;
    take_written();
    look_for_map();
    if (exposed_) changes_.note_all();
    if (lost_) holds_ = lost_ = false;
    bool regrouped = filters_.changed() || groups_.changed();
    if (follows && chosen == ran_ && changes_.none() && ids_.count() == seen_ && !regrouped) return rest();
    if (!search(chosen)) return rest();
    if (restored_) table_.made = false;
    restored_ = false;
    if (keeps_events) events.follow(pairs, table_);
    finish();
    return -1;
  }

 private:
  /// Finds the pairs of what has been restored, which has been looked at.
  SMALL void find() {
    Technique chosen = auto_choice(technique, ids_.count(), ordered_);
    look_for_map();
    search(chosen);
    finish();
  }

  /// Has a technique find the pairs, and makes of them what is reported; false where they are those of before.
  bool search(Technique chosen) {
    searching_ = true;
    bool follows = chosen == Technique::incremental;
    bool wraps = options_.wrap[0] > 0;
    bool reaches = reaches_.some();
    if (reaches) grow();
    const f32* boxes = reaches ? grown_.data() : boxes_.data();
    const f64* doubles = reaches ? grown_exact_.data() : rounding_ ? exact_.data() : nullptr;
    Scene<D> scene{boxes, ids_.count(), nullptr, follows ? &changes_ : nullptr, ordered_};
    if (filters_.active()) {
      scene.filtered = filters_.changed();
      scene.boxes = filters_.select(scene.boxes, scene.count, width);
      scene.excluded = filters_.excluded();
      if (scene.filtered || scene.boxes != boxes) scene.changes = nullptr;
    }
    if (groups_.some() && !wraps) {  // ghosts have none: `part` sees to them
      scene.groups = filters_.select(groups_.data(), scene.count, searched_groups_);
      scene.filtered |= groups_.changed();
    }
    groups_.updated();
    if (wraps) {
      scene.changes = nullptr;
      scene.filtered |= scene.excluded != nullptr;  // of the ghosts, too
      scene.boxes = wrap_.unfold(scene.count, scene.excluded, filters_, boxes, doubles, options_.wrap, D);
    }
    pairs.count = pairs.doubt_count = 0;
    pairs.watch = (doubles || !options_.touching) && !wraps;
    stats = Stats{};
    if (chosen != ran_) {
      release_techniques();
      pairs.stable = 0;
    }
    ran_ = chosen;
    pairs.same = false;
    Settings mapped = options_;
    for (u32 n = 0; options_.bounds[0] < options_.bounds[D] && n < width; n++)
      mapped.bounds[n] = map_.map(options_.bounds[n], n % D);
    techniques_.with(ran_, [&](auto& chosen) { chosen.update(scene, mapped, pairs, stats); });
    bool same = pairs.same && !renamed_ && !doubles;  // doubles may have changed below float32
    if (filters_.active() || wraps || !ids_.same()) pairs.stable = 0;
    follow_with_index();
    if (follows) changes_.clear(ids_.count());
    else changes_.note_all();
    seen_ = ids_.count();
    renamed_ = false;
    if (stats.candidates == 0) stats.candidates = f64(pairs.count);
    stats.pairs = f64(pairs.count);
    if (same) {
      searching_ = false;
      return false;
    }
    if (wraps) wrap_.fold(pairs, options_.touching);
    else if (pairs.watch) retest(doubles);
    if (filters_.active()) filters_.finish(pairs);
    if (groups_.some()) part();
    if (!ids_.same()) name_pairs();
    return true;
  }

  void finish() {
    searching_ = false;
    table_.made = partners_made_ = false;
    updates++;
    stats.pairs = f64(pairs.count);
    // Growing later would cut the views of the pairs off, in the midst of a loop over them: what a few more boxes, the
    // first filter, double or gap, and the first question take is taken now.
    reach(ids_.count(), pairs.count * bytes_to_look_up + (1 << 17));
    stats.bytes = f64(heap::used);
    explain();
  }

 public:
  /// Whether two ids are a pair of the last update.
  SMALL bool is_pair(u32 a, u32 b) {
    if (pairs.count == 0) return false;
    if (!table_.made) table_.make(pairs);
    return table_.find(pairs, pair_of(a, b)) != PairTable::none;
  }

  /// Writes the ids that were in a pair with this one in the last update to `answers`; returns how many.
  SMALL u32 partners(u32 id) {
    if (!partners_made_) partners_.build(pairs);
    partners_made_ = true;
    return partners_.of(id, answers);
  }

  /// Answers the question with the boxes that touch its box or circle: see Queries::area.
  SMALL u32 ask_area(u32& from, u32 most) {
    if (lost_) return unknown;
    if (!can_answer()) return 0;
    if (index_.world()) question.wrap(index_.world());
    Queries<D> queries(index_, question);
    u32 found = queries.area(from, most, answers);
    index_.looked_at(queries.looks());
    return found;
  }

  /// Answers it with the boxes that are not behind one of the planes: see PlaneQuery::search.
  SMALL u32 ask_planes(u32& from, u32 most) {
    if (lost_) return unknown;
    if (!can_answer()) return 0;
    PlaneQuery<D> query(index_, question, planes);
    u32 found = query.search(from, most, answers);
    index_.looked_at(query.looks());
    return found;
  }

  /// Answers it with what the moving box meets first, or with what is nearest, at most so many and behind `after`:
  /// the answers are in `hits`, in order. Returns how many.
  SMALL u32 ask_order(bool moving, u32 most, const Hit* after) {
    if (lost_) return unknown;
    if (!can_answer()) return 0;
    if (index_.world()) question.wrap(index_.world());
    hits.begin(most, question.limit, after);
    Queries<D> queries(index_, question);
    if (moving) queries.cast(hits);
    else queries.near(hits);
    index_.looked_at(queries.looks());
    return hits.finish();
  }

  /// Answers many questions, those that are staged or those of all boxes, into `bulk`; `question` says what they have in
  /// common. Returns how many there are, or `unknown`.
  SMALL u32 ask_many(Asks kind, u32 count, u32 most) {
    if (lost_) return unknown;
    bool can = can_answer();
    if (kind == Asks::others) count = index_.count();
    if (can) bulk.answer(index_, question, kind, count, most, hits);
    else bulk.answer_nothing(count);
    if (can) index_.looked_at(bulk.looks);
    if (kind == Asks::others) {
      answers.reserve(count);
      for (u32 s = 0; s < count; s++) answers[s] = index_.id_of_slot(s);
    }
    return count;
  }

  /// From now on the ids are kept that have changed, and what the last update saw. Returns their epoch, or `unknown`.
  SMALL u32 keep_changes() {
    if (lost_) return unknown;
    asked_ = true;
    if (!holds_) see();
    return changed.keep();
  }
  /// What the last update saw.
  const Index<D>& seen() const { return index_; }
  /// Whether two boxes overlap, one behind the other, where the world wraps around.
  SMALL bool meet_around(const f64* boxes) const {
    Copies copies;
    copies.begin(options_.wrap, D, boxes, boxes + D);
    return copies.meets(boxes + width, options_.touching);
  }

  /// Writes the boxes of the cells of the last update to `cells`. Sides without a border become the border of
  /// all finite boxes.
  SMALL void structure() {
    see_shown();
    techniques_.with(ran_, [&](auto& used) { used.structure(cells, cell_count, stats); });
    f32 least[D], most[D];
    for (int a = 0; a < D; a++) {
      least[a] = __builtin_inff();
      most[a] = -__builtin_inff();
      for (u32 s = 0; s < ids_.count(); s++) {
        f32 lo = boxes_[u64(s) * width + a], hi = boxes_[u64(s) * width + D + a];
        if (detail::is_finite(lo)) least[a] = smaller(least[a], lo);
        if (detail::is_finite(hi)) most[a] = larger(most[a], hi);
      }
    }
    for (u64 c = 0; c < cell_count; c++) {
      for (int a = 0; a < D; a++) {
        f32& lo = cells[c * width + a];
        f32& hi = cells[c * width + D + a];
        if (!detail::is_finite(lo)) lo = smaller(least[a], hi);
        if (!detail::is_finite(hi)) hi = larger(most[a], lo);
        lo = f32(map_.unmap(lo, u32(a)));
        hi = f32(map_.unmap(hi, u32(a)));
      }
    }
  }

  /// After memory has run out: all that an update needs is built anew. In the middle of one: and there are no pairs.
  SMALL void recover() {
    release_techniques();
    changes_.note_all();
    changed.note_all();
    pairs.stable = 0;
    if (searching_) {
      pairs.list.release();
      pairs.count = events.began.count = events.ended.count = 0;
      stats = Stats{};
    }
    searching_ = false;
    table_.made = partners_made_ = false;
    pairs.doubts.release();
    wrap_.release();
    index_.forget();
    answers.release();
    hits.release();
    bulk.release();
    stats.bytes = f64(heap::used);
  }

  /// Gives the techniques' memory back: on a switch, and after memory has run out in the middle of one.
  SMALL void release_techniques() {
    techniques_.with(ran_, [](auto& used) { used.release(); });
    cells.release();
    cell_count = 0;
    stats.cells = stats.entries = 0;  // there are none to draw
  }

  /// The number of the first invariant that does not hold (see src/broad-phase.ts), or 0; `detail`: where.
  SMALL u32 validate(u32& detail) {
    see_shown();
    detail = 0;
    if (!ids_.valid()) return 1;
    if (!exposed_) {
      i32 bad = first_bad(boxes_.data(), ids_.count());
      if (bad >= 0) {
        detail = ids_.id(u32(bad));
        return 2;
      }
    }
    for (u32 s = 0; rounding_ && !exposed_ && s < ids_.count(); s++) {
      detail = ids_.id(s);
      f32 image[width];
      round(exact_.data() + u64(s) * width, image);
      if (differ<width * sizeof(f32)>(image, boxes_.data() + u64(s) * width)) return 3;
    }
    for (u64 p = 0; p < pairs.count; p++) {
      u32 a = u32(pairs.list[p]), b = u32(pairs.list[p] >> 32);
      detail = u32(p);
      if (a >= b) return 5;
    }
    return 0;
  }

 private:
  /// Takes memory for the updates to come of so many boxes, and so many bytes.
  SMALL static void reach(u64 count, u64 more) {
    u64 usual = count * usual_bytes, all = usual + count * kept_bytes;
    heap::reach(larger(usual, all - smaller(all, u64(heap::used))) + more);
  }

  /// Says what ran, and where the choice was ours why.
  void explain() { say_choice(technique, ran_, stats); }

  /// An update in which nothing has changed.
  i32 rest() {
    events.began.count = events.ended.count = 0;
    updates++;
    stats.tests = 0;
    stats.bytes = f64(heap::used);
    if (ran_ == Technique::incremental) stats.reason = f64(u32(Reason::kept));
    explain();
    return -1;
  }

  /// The id of the first bad box among those written in place, or -1.
  i32 bad_in_place() const {
    i32 bad = exposed_ ? first_bad(boxes_.data(), ids_.count()) : -1;
    return bad < 0 ? -1 : i32(ids_.id(u32(bad)));  // since it was written, a removal may have moved it
  }

  /// What was staged is now what stands in the space; `rounded`: with doubles that float32 cannot hold.
  void take_staged(bool rounded) {
    boxes_.swap(staged_);
    if (rounded) exact_.swap(staged_exact_);
    else hold_floats();
    rounding_ = rounded;
    exposed_ = false;
    shown_count_ = 0;
  }

  f64 number(u32 slot, u32 k) const {
    u64 at = u64(slot) * width + k;
    if (!rounding_) return boxes_[at];
    if (!exposed_) return exact_[at];
    f64 box[width];
    as_written(slot, box);
    return box[k];
  }

  /// A box of which some numbers may have been written in place since it was given: those that are not what was shown.
  SMALL void as_written(u32 slot, f64* to) const {
    const f64* given = exact_.data() + u64(slot) * width;
    const f32* now = boxes_.data() + u64(slot) * width;
    f32 shown[width];
    round(given, shown);
    for (u32 k = 0; k < width; k++) to[k] = shown[k] == now[k] ? given[k] : f64(now[k]);
    for (u32 a = 0; a < D; a++) {
      // One side as it was given, the other as it was written: rounding may have put them in this order.
      if (to[a] <= to[D + a]) continue;
      to[a] = now[a];
      to[D + a] = now[D + a];
    }
  }

  /// Takes over what was written in place, none of it bad, over boxes that were given as doubles.
  SMALL void take_written() {
    see_shown();
    for (u32 s = 0; exposed_ && rounding_ && s < ids_.count(); s++) {
      f64 box[width];
      as_written(s, box);
      __builtin_memcpy(exact_.data() + u64(s) * width, box, sizeof(box));
      round(box, boxes_.data() + u64(s) * width);
      show(s);
    }
  }

  /// Before a change: what the last update saw is kept, once.
  SMALL void hold(u32 most = spared) {
    if (asked_ || ids_.count() <= most) see();
    else lost_ = holds_ = true;  // holds_: so that it is not asked for again
  }

  /// After an update, while its changes are known.
  SMALL void follow_with_index() {
    changed.note(changes_.all(), changes_.list(), changes_.count(), ids_.count(),
                 [&](u32 slot) { return ids_.id(slot); });
    const f64* exact = rounding_ ? exact_.data() : nullptr;
    const Rule* rules = filters_.active() ? filters_.rules() : nullptr;
    u32 few = larger(ids_.count() / 32, 8u);  // more are dearer to follow than the index is to make
    holds_ = holds_ && !changes_.all() && changes_.count() <= few &&
             index_.follow(boxes_.data(), exact, ids_, rules, reaches_.data(), changes_.list(), changes_.count(),
                           world());
    // Who writes in place does not say when.
    if (exposed_ && !holds_ && (asked_ || ids_.count() <= spared_in_place)) see();
  }

  /// The size of the world, where it wraps around.
  const f64* world() const { return options_.wrap[0] > 0 ? options_.wrap : nullptr; }

  /// The index takes over what stands in the space.
  SMALL void see() {
    see_shown();
    const Rule* rules = filters_.active() ? filters_.rules() : nullptr;
    index_.see(boxes_.data(), rounding_ ? exact_.data() : nullptr, ids_, rules, reaches_.data(), world());
    holds_ = true;
  }

  /// Whether there is anything to ask about; if so, the index is made.
  SMALL bool can_answer() {
    asked_ = true;
    if (!holds_) see();
    if (index_.count() == 0) return false;
    index_.build();
    return true;
  }

  /// Room for `count` boxes in every array that has one entry a box.
  SMALL void make_room(u64 count, u32 keep) {
    if (count > max_slots) fail(Fault::out_of_memory, f64(count) * width * sizeof(f32));
    if (exposed_ && shown_count_ == 0 && count * width + padding > boxes_.capacity()) {
      f32* moved = shown_.reserve(larger(count * width + padding, boxes_.capacity() + boxes_.capacity() / 2));
      if (keep) __builtin_memcpy(moved, boxes_.data(), u64(keep) * width * sizeof(f32));
      boxes_.swap(shown_);
      shown_count_ = keep;
    }
    boxes_.grow(count * width + padding, u64(keep) * width);
    u64 all = boxes_.capacity() / width;
    changes_.make_room(all);
    if (filters_.active()) filters_.make_room(all, keep);
    groups_.make_room(all, keep);
    reaches_.make_room(all, keep);
    if (rounding_) {
      exact_.grow(all * width, u64(keep) * width);
    }
    tight_ = !rounding_ && !heap::reach(2 * all * width * sizeof(f64));  // for the first double
  }

  /// How many boxes there is room for in all of these arrays.
  u32 room() const {
    u64 all = smaller(u64(max_slots), (boxes_.capacity() - padding) / width);
    all = smaller(all, u64(changes_.room()));
    if (filters_.active()) all = smaller(all, filters_.room());
    if (groups_.some()) all = smaller(all, groups_.room());
    if (reaches_.some()) all = smaller(all, reaches_.room());
    if (rounding_) all = smaller(all, exact_.capacity() / width);
    return u32(larger(all, u64(ids_.count())));
  }

  /// Whether float32 holds all numbers of these boxes, so many numbers apart.
  NOINLINE static bool are_floats(const f64* box, u32 count, u32 step) {
    i32x4 rounded = {};
    for (; count > 0; count--, box += step) {
      for (u32 a = 0; a < D; a++) {
        f64x2 numbers = load<f64x2>(box + 2 * a);
        rounded |= bits<i32x4>(widen(narrow(numbers)) != numbers);
      }
    }
    return !any(rounded);
  }

  /// The slots of these boxes of the ring; those that have none get one.
  void find_slots(const f64* entry, u32 count, u32* slots) {
    u32 known = ids_.same() ? ids_.count() : 0;
    for (u32 k = 0; k < count; k++, entry += Ring<D>::step) {
      u32 slot = Ring<D>::id(entry);
      if (slot >= known) {
        slot = add(slot);
        known = ids_.same() ? ids_.count() : 0;
      }
      slots[k] = slot;
    }
  }

  /// The slot of an id, which gets one if it has none.
  NOINLINE u32 add(u32 id) {
    u32 slot = ids_.slot(id);
    if (slot != Ids::none) return slot;
    if (ids_.count() >= room()) make_room(u64(ids_.count()) + 1, ids_.count());
    slot = ids_.insert(id);
    renamed_ = true;
    if (filters_.active()) filters_.insert(slot);
    groups_.insert(slot);
    reaches_.insert(slot);
    changes_.note(slot);
    return slot;
  }

  /// Puts boxes of the ring in their slots, and notes which are not what stood there.
  template <bool rounding> NOINLINE void put(const f64* entry, const u32* slots, u32 count) {
    f32* boxes = boxes_.data();
    f64* exact = exact_.data();
    const bool notes = !changes_.all(), plain = map_.plain();
    u32 shown = shown_count_, collapsed = 0;
    Changes::Notes changed = changes_.begin();
    for (u32 k = 0; k < count; k++, entry += Ring<D>::step) {
      const f64* box = entry + 1;
      u32 slot = slots[k];
      f32* to = boxes + u64(slot) * width;
      if constexpr (rounding) {
        collapsed += map_.round(plain, box, to);
        f64* its = exact + u64(slot) * width;
        if (notes && differ<width * sizeof(f64)>(its, box)) changed.note(slot);
        __builtin_memcpy(its, box, width * sizeof(f64));
      } else {
        f32x4 first, last;
        GapMap<D>::narrowed(box, first, last);
        i32x4 other = bits<i32x4>(first) ^ load<i32x4>(to);
        if constexpr (D == 3) other |= bits<i32x4>(last) ^ load<i32x4>(to + width - 4);
        if (notes && any(other)) changed.note(slot);
        store(to, first);
        if constexpr (D == 3) store(to + width - 4, last);
      }
      if (slot < shown) show(slot);
    }
    collapsed_ += collapsed;
    if (notes) changes_.end(changed);
  }

  /// What was written in place is where the boxes are.
  void see_shown() {
    u32 many = smaller(shown_count_, ids_.count());
    if (many) __builtin_memcpy(boxes_.data(), shown_.data(), u64(many) * width * sizeof(f32));
  }
  /// What changed in another way is seen by who writes in place.
  SMALL void show(u32 slot) {
    if (slot < shown_count_)
      __builtin_memcpy(shown_.data() + u64(slot) * width, boxes_.data() + u64(slot) * width, width * sizeof(f32));
  }

  /// From now on the doubles are kept too.
  SMALL void start_rounding() {
    see_shown();
    u32 n = ids_.count();
    exact_.reserve(larger(boxes_.capacity(), u64(width)));
    for (u64 k = 0; k < u64(n) * width; k++) exact_[k] = boxes_[k];
    rounding_ = true;
    round_all();
  }

  /// From now on the boxes are float32.
  SMALL void hold_floats() {
    rounding_ = false;
    map_.reset();
    collapsed_ = look_in_ = 0;
    bearable_ = usual_collapsed;
  }

  SMALL void round_all() {
    for (u32 s = 0; s < ids_.count(); s++) {
      round(exact_.data() + u64(s) * width, boxes_.data() + u64(s) * width);
      show(s);
    }
    changes_.note_all();
  }

  NOINLINE void round(const f64* box, f32* to) const {
    f32x4 first, last;
    map_.round(box, first, last);
    store(to, first);
    if constexpr (D == 3) store(to + width - 4, last);
  }

  /// Looks whether another map serves better, now and then, and at once where many boxes have become points.
  SMALL void look_for_map() {
    if (!rounding_ || exposed_ || options_.wrap[0] > 0) return;
    u32 n = ids_.count(), collapsed = collapsed_;
    collapsed_ = 0;
    if (ordered_) {  // by what stands in the space alone
      GapMap<D> other;
      if (n >= worth_a_look) other.choose(exact_.data(), n, nullptr, 0);
      if (other == map_) return;
      map_ = other;
      return round_all();
    }
    if (n < worth_a_look || (collapsed <= bearable_ && look_in_-- > 0)) return;
    look_in_ = look_every;
    u32 some[usual_collapsed], many = 0;
    if (collapsed > bearable_) {
      u32 step = collapsed / usual_collapsed + 1, seen = 0;
      for (u32 s = 0; s < n && many < usual_collapsed; s++) {
        const f32* box = boxes_.data() + u64(s) * width;
        if (!map_.collapses(exact_.data() + u64(s) * width, load<f32x4>(box), load<f32x4>(box + width - 4))) continue;
        if (seen++ % step == 0) some[many++] = s;
      }
    }
    bool better = map_.choose(exact_.data(), n, some, many);
    if (better) round_all();
    if (better) bearable_ = usual_collapsed;
    else if (collapsed > bearable_) bearable_ = 2 * collapsed;
  }

  /// The rule of a box, to be changed.
  SMALL Rule& rule_of(u32 slot) {
    if (!filters_.active()) filters_.start(ids_.count(), boxes_.capacity() / width);
    return filters_.change(slot);
  }

  /// Room for all ids to be deleted, where events have to know of it.
  SMALL void room_to_forget() {
    u32 last = 0;
    for (u32 s = 0; s < ids_.count(); s++) last = larger(last, ids_.id(s));
    if (keeps_events) events.make_room(last);
  }

  /// The boxes of ids from this one on are about to go; there is room.
  SMALL void forget_from(u32 first) {
    for (u32 s = 0; keeps_events && s < ids_.count(); s++) {
      if (ids_.id(s) >= first) events.forget(ids_.id(s));
    }
  }

  /// The ids become 0 … count - 1; those that were there keep their filters.
  SMALL void renumber(u32 count) {
    changes_.note_all();
    renamed_ = true;
    room_to_forget();
    if (groups_.some()) groups_.stage(count);
    if (reaches_.some()) reaches_.stage(count);
    if (filters_.active()) filters_.renumber(ids_, count);
    groups_.renumber(ids_, count);
    reaches_.renumber(ids_, count);
    forget_from(count);
    ids_.reset(count);
  }

  /// The first of `count` boxes with a NaN or with a minimum above its maximum, or -1.
  NOINLINE static i32 first_bad(const f32* boxes, u32 count) {
    constexpr u32 all = D == 2 ? 3 : 7;
    for (u32 s = 0; s < count; s++) {
      f32x4 low = load<f32x4>(boxes + u64(s) * width);
      f32x4 high;
      if constexpr (D == 2) {
        high = __builtin_shufflevector(low, low, 2, 3, 2, 3);
      } else {
        f32x4 tail = load<f32x4>(boxes + u64(s) * width + 2);
        high = __builtin_shufflevector(tail, tail, 1, 2, 3, 3);
      }
      if ((bitmask(low <= high) & all) != all) return i32(s);
    }
    return -1;
  }

  /// Rounds the staged doubles into the staged float32; says whether float32 cannot hold all of them. Returns the first
  /// bad box, or -1.
  i32 round_staged(u32 count, bool& rounded) {
    auto all = map_.round_all(staged_exact_.data(), count, staged_.data());
    if (all.bad >= 0) return all.bad;
    rounded = all.inexact;
    collapsed_ = all.collapsed;
    return -1;
  }

  /// Whether some box is nowhere along an axis: the difference of its bounds is no number, or, where they were rounded,
  /// infinite, so that doubts go unnoticed.
  template <class T> SMALL bool some_nowhere(const T* boxes) const {
    bool some = false;
    for (u64 k = 0; k < u64(ids_.count()) * width; k += width) {
      for (u32 a = 0; a < D; a++) some |= boxes[k + a] == __builtin_inff() || boxes[k + D + a] == -__builtin_inff();
    }
    return some;
  }

  /// Makes the boxes that are searched where some reach beyond themselves.
  SMALL void grow() {
    u32 n = ids_.count();
    f32* to = grown_.reserve(u64(n) * width + padding);
    f64* exact = grown_exact_.reserve(larger(u64(n) * width, u64(1)));
    for (u32 s = 0; s < n; s++) {
      f64* box = exact + u64(s) * width;
      for (u32 k = 0; k < width; k++) {
        f64 given = rounding_ ? exact_[u64(s) * width + k] : f64(boxes_[u64(s) * width + k]), reach = reaches_.of(s);
        box[k] = k < D ? given - reach : given + reach;
      }
      round(box, to + u64(s) * width);
    }
  }

  /// Keeps, of the pairs in doubt, those that overlap in the numbers given, or grown from these.
  SMALL void retest(const f64* doubles) {
    u64* list = pairs.list.data();
    u64 at = 0, kept = 0;
    auto keep = [&](u64 until) {
      if (kept != at && until > at) __builtin_memmove(list + kept, list + at, (until - at) * sizeof(u64));
      kept += until - at;
      at = until;
    };
    bool all = !(watching >> u32(ran_) & 1);
    if (!options_.touching) all |= doubles ? some_nowhere(doubles) : some_nowhere(boxes_.data());
    for (u32 k = 0; k < (all ? 1 : pairs.doubt_count); k++) {
      if (!all) keep(pairs.doubts[2 * k]);
      u64 until = all ? pairs.count : pairs.doubts[2 * k + 1];
      const u64 *from = list + at, *end = list + until;
      u64* to = list + kept;
      if (!doubles) to = retest<false>(boxes_.data(), from, end, to);
      else to = options_.touching ? retest<true>(doubles, from, end, to) : retest<false>(doubles, from, end, to);
      kept = Pairs::between(list, to);
      at = until;
    }
    keep(pairs.count);
    pairs.count = kept;
  }
  template <bool touching, class T>
  NOINLINE u64* retest(const T* boxes, const u64* from, const u64* until, u64* to) const {
    for (; from < until; from++) {
      u64 pair = *from;
      const T* first = boxes + u64(filters_.slot(u32(pair))) * width;
      const T* second = boxes + u64(filters_.slot(u32(pair >> 32))) * width;
      bool overlap = true;
      for (int k = 0; k < D; k++) {
        overlap &= touching ? first[k] <= second[D + k] && second[k] <= first[D + k]
                            : first[k] < second[D + k] && second[k] < first[D + k];
      }
      *to = pair;
      to += overlap;
    }
    return to;
  }

  /// Takes pairs within a group out.
  SMALL void part() {
    u64* list = pairs.list.data();
    const u32* groups = groups_.data();
    u64 kept = 0;
    for (u64 p = 0; p < pairs.count; p++) {
      u64 pair = list[p];
      list[kept] = pair;
      kept += !one_group(groups[u32(pair)], groups[pair >> 32]);
    }
    if (kept < pairs.count) pairs.stable = 0;
    pairs.count = kept;
  }

  /// Slots to ids, the smaller first.
  void name_pairs() {
    u64* list = pairs.list.data();
    for (u64 p = 0; p < pairs.count; p++) {
      u32 a = ids_.id(u32(list[p])), b = ids_.id(u32(list[p] >> 32));
      list[p] = pair_of(a, b);
    }
  }
};

// The queries of a space: their arguments, the code that answers them, and the place of the answers. Queries see the
// boxes of the last update: see seen.hpp.
#pragma once
#include "questions/neighbours.hpp"
#include "questions/plane_query.hpp"
#include "questions/scan.hpp"
#include "space/store.hpp"

/// With how many other spaces a space can have pairs without starting over.
inline constexpr u32 most_neighbours = 16;

template <int D> class Questions {
  const Options& options_;
  Store<D>& store_;
  Scan<D> scan_;

 public:
  Question<D> asked;
  Planes<D> planes;  // of a query with planes
  Buffer<u32> answers;  // ids, of the last query
  Hits hits;  // of queries whose answers are in order
  Bulk<D> bulk;  // many queries in one call, and their answers
  Neighbours<D> neighbours[most_neighbours];  // for the pairs with other spaces

  static constexpr u32 unknown = 0xffffffff;  // an answer: no copy was kept of what the last update saw

  SMALL constexpr Questions(Store<D>& store, const Options& options) : options_(options), store_(store) {}

  /// The boxes of the last update.
  Index<D>& index() { return store_.seen.index; }

  /// Finds the boxes that touch the box or circle of the query: see Queries::area.
  SMALL u32 ask_area(u32& from, u32 most) {
    if (store_.seen.lost()) return unknown;
    Index<D>* searched = index_for(Search::area, most, from == 0);
    if (!searched) return 0;
    wrap();
    Queries<D> queries(*searched, asked);
    u32 found = queries.area(from, most, answers);
    searched->looked_at(queries.looks());
    return found;
  }

  /// Finds the boxes that are not behind one of the planes: see PlaneQuery::search.
  SMALL u32 ask_planes(u32& from, u32 most) {
    if (store_.seen.lost()) return unknown;
    if (!can_answer()) return 0;
    PlaneQuery<D> query(index(), asked, planes);
    u32 found = query.search(from, most, answers);
    index().looked_at(query.looks());
    return found;
  }

  /// Finds the first boxes that the moving box meets, or the nearest ones: at most `most`, after the hit `after`. They
  /// are in `hits`, in order. Returns how many.
  SMALL u32 ask_order(bool moving, u32 most, const Hit* after) {
    if (store_.seen.lost()) return unknown;
    hits.begin(most, asked.limit, after);
    Index<D>* searched = index_for(moving ? Search::ahead : Search::near, most);
    if (!searched) return 0;
    wrap();
    hits.begin(most, asked.limit, after);
    Queries<D> queries(*searched, asked);
    if (moving) queries.cast(hits);
    else queries.near(hits);
    searched->looked_at(queries.looks());
    return hits.finish();
  }

  /// Answers many queries into `bulk`: those that are staged, or one for each box. `asked` has what they have in
  /// common. Returns the number of queries, or `unknown`.
  SMALL u32 ask_many(Asks kind, u32 count, u32 most) {
    if (store_.seen.lost()) return unknown;
    bool can = can_answer();
    if (kind == Asks::others) count = index().count();
    if (can) bulk.answer(index(), asked, kind, count, most, hits);
    else bulk.answer_nothing(count);
    if (can) index().looked_at(bulk.looks, count);
    if (kind == Asks::others) {
      answers.reserve(count);
      for (u32 s = 0; s < count; s++) answers[s] = index().id_of_slot(s);
    }
    return count;
  }

  /// Starts to keep a list of changed ids, and what the last update saw. Returns the epoch of the list, or `unknown`.
  SMALL u32 keep_changes() {
    if (store_.seen.lost()) return unknown;
    look();
    return store_.changed.keep();
  }

  /// Brings the pairs of a set up to date as far as its lists tell: see Neighbours::begin. The changes are staged as
  /// queries are; then queries of the other space are, which reaches as far as `reach`.
  SMALL u32 begin_pairs(u32 set, u32 changes, bool same, bool first, f64 reach) {
    u32 epoch = keep_changes();
    if (epoch == unknown) return unknown;
    Neighbours<D>& near = neighbours[set];
    u32 asked = near.begin(index(), store_.changed, epoch, bulk.given.data(), changes, same, first);
    if (asked != near.still && asked > 0) near.write_questions(index(), bulk.stage(asked * (Index<D>::row - 1)), reach);
    return asked;
  }

  /// Takes the staged answers of the other space: see Neighbours::take_answers.
  SMALL u32 take_answers(u32 set, u32 total, bool exact) {
    neighbours[set].take_answers(index(), bulk.given.data(), total, exact, options_.touching);
    return total;
  }

  /// Stages rows that begin with the slots of the loose boxes.
  SMALL void stage_loose(u32 set) { neighbours[set].write_loose(bulk.stage(neighbours[set].loose() * Index<D>::row)); }

  /// Finds the pairs of the loose boxes, whose rows are staged.
  SMALL u32 meet_loose(u32 set) {
    Neighbours<D>& near = neighbours[set];
    f64 reach = index().most_reach();
    u32 count = near.take_loose(bulk.given, reach);
    asked = {};
    asked.touching = options_.touching;
    ask_many(Asks::meeting, count, 1);
    near.meet_loose(index(), bulk.offsets(), bulk.ids.data(), reach == 0, options_.touching);
    return count;
  }

  SMALL void release() {
    answers.release();
    hits.release();
    scan_.release();
    bulk.release();
    for (Neighbours<D>& near : neighbours) near.release();
  }

 private:
  /// Sees the boxes of the last update. Returns these if they are still in the space, rounded to the nearest; else null.
  SMALL const f32* look() {
    Seen<D>& seen = store_.seen;
    seen.ask();
    if (seen.is_open()) seen.see(store_.present());
    return index().lent() ? store_.numbers.nearest() : nullptr;
  }

  /// The index to search for one query; null if it cannot have answers. `begins`: no part of them has been read before.
  SMALL Index<D>* index_for(Search kind, u32 most, bool begins = true) {
    const f32* nearest = look();
    if (index().count() == 0) return nullptr;
    const f32* boxes = index().to_scan(nearest, kind == Search::near ? 2 : 1);
    Index<D>* searched = boxes && begins ? scan_.find(index(), boxes, asked, kind, most, hits) : nullptr;
    if (!searched) {
      index().build(nearest);
      searched = &index();
    }
    return searched->places() > 0 ? searched : nullptr;
  }

  /// Whether there are any boxes that are not off; builds the index.
  SMALL bool can_answer() {
    const f32* nearest = look();
    if (index().count() == 0) return false;
    index().note_search();
    index().build(nearest);
    return index().places() > 0;
  }

  void wrap() {
    if (index().world()) asked.wrap(index().world());
  }
};

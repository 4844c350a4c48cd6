// The queries of a space: their arguments, the code that answers them, and the place of the answers. Queries see the
// boxes of the last update: see seen.hpp.
#pragma once
#include "questions/bulk.hpp"
#include "questions/plane_query.hpp"
#include "space/store.hpp"

template <int D> class Questions {
  const Settings& options_;
  Store<D>& store_;

 public:
  Question<D> asked;
  Planes<D> planes;  // of a query with planes
  Buffer<u32> answers;  // ids, of the last query
  Hits hits;  // of queries whose answers are in order
  Bulk<D> bulk;  // many queries in one call, and their answers

  static constexpr u32 unknown = 0xffffffff;  // an answer: no copy was kept of what the last update saw

  SMALL constexpr Questions(Store<D>& store, const Settings& options) : options_(options), store_(store) {}

  /// The boxes of the last update.
  Index<D>& index() { return store_.seen.index; }

  /// Finds the boxes that touch the box or circle of the query: see Queries::area.
  SMALL u32 ask_area(u32& from, u32 most) {
    if (store_.seen.lost()) return unknown;
    if (!can_answer()) return 0;
    wrap();
    Queries<D> queries(index(), asked);
    u32 found = queries.area(from, most, answers);
    index().looked_at(queries.looks());
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
    if (!can_answer()) return 0;
    wrap();
    hits.begin(most, asked.limit, after);
    Queries<D> queries(index(), asked);
    if (moving) queries.cast(hits);
    else queries.near(hits);
    index().looked_at(queries.looks());
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
    if (can) index().looked_at(bulk.looks);
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

  /// Whether two boxes, stored one after the other, overlap in a world that wraps around.
  SMALL bool meet_around(const f64* boxes) const {
    Copies copies;
    copies.begin(options_.wrap, D, boxes, boxes + D);
    return copies.meets(boxes + 2 * D, options_.touching);
  }

  SMALL void release() {
    answers.release();
    hits.release();
    bulk.release();
  }

 private:
  SMALL void look() {
    if (!store_.seen.ask()) store_.seen.see(store_.standing());
  }

  /// Whether there are any boxes; if so, builds the index.
  SMALL bool can_answer() {
    look();
    if (index().count() == 0) return false;
    index().build();
    return true;
  }

  void wrap() {
    if (index().world()) asked.wrap(index().world());
  }
};

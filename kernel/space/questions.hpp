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
  Planes<D> planes;  // of a question about planes
  Buffer<u32> answers;  // ids, of the last question
  Hits hits;  // where the question asks for an order
  Bulk<D> bulk;  // many questions, and their answers

  static constexpr u32 unknown = 0xffffffff;  // an answer: nobody has kept what the last update saw

  SMALL constexpr Questions(Store<D>& store, const Settings& options) : options_(options), store_(store) {}

  /// What the last update saw.
  Index<D>& index() { return store_.seen.index; }

  /// Answers the question with the boxes that touch its box or circle: see Queries::area.
  SMALL u32 ask_area(u32& from, u32 most) {
    if (store_.seen.lost()) return unknown;
    if (!can_answer()) return 0;
    wrap();
    Queries<D> queries(index(), asked);
    u32 found = queries.area(from, most, answers);
    index().looked_at(queries.looks());
    return found;
  }

  /// Answers it with the boxes that are not behind one of the planes: see PlaneQuery::search.
  SMALL u32 ask_planes(u32& from, u32 most) {
    if (store_.seen.lost()) return unknown;
    if (!can_answer()) return 0;
    PlaneQuery<D> query(index(), asked, planes);
    u32 found = query.search(from, most, answers);
    index().looked_at(query.looks());
    return found;
  }

  /// Answers it with what the moving box meets first, or with what is nearest, at most so many and behind `after`:
  /// the answers are in `hits`, in order. Returns how many.
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

  /// Answers many questions, those that are staged or those of all boxes, into `bulk`; `asked` says what they have in
  /// common. Returns how many there are, or `unknown`.
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

  /// From now on the ids are kept that have changed, and what the last update saw. Returns their epoch, or `unknown`.
  SMALL u32 keep_changes() {
    if (store_.seen.lost()) return unknown;
    look();
    return store_.changed.keep();
  }

  /// Whether two boxes overlap, one behind the other, where the world wraps around.
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

  /// Whether there is anything to ask about; if so, the index is made.
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

// The pairs with one other space, of which this one has the lists.
// Idea: each box here has a region, which is the box enlarged by a share of its size, and a list of the other space's
// boxes that overlap the region. While the box stays within its region, its pairs are among these. When it leaves, it
// gets another list: the caller queries the other space, many boxes in one call. A box of the other space that has
// changed is loose: lists ignore it, and it asks this space. If too many are loose, all lists are dropped. Regions of
// fast boxes become larger, those of slow ones smaller. Entries stay in the order of tests, since memory is read ahead.
// Cost: about 12 ns for each box that moved within its region, one query for each that left it, one for each loose box.
// If few boxes here have changed, a pass over the pairs instead of the other boxes.
// From: L. Verlet, "Computer Experiments on Classical Fluids", 1967.
#pragma once
#include "questions/bulk.hpp"
#include "questions/id_marks.hpp"

/// What does not depend on the number of axes: one copy for 2D and 3D, since it is code that runs rarely.
class NeighbourLists {
  static constexpr f64 least_growth = 0.25, most_growth = 1;
  static constexpr u32 query_work = 400;  // of a query, and of making a list, in tests of an entry
  static constexpr u32 least_age = 4;  // calls that a list has to serve: of faster boxes, larger regions would not help
  // Boxes that may be loose: `least_loose`, plus one in `loose_share` of the boxes here.
  static constexpr u32 least_loose = 32, loose_share = 16;
  static constexpr u32 tidy_share = 4;  // entries are tidied once one list in this many has been made again

 protected:
  static constexpr f64 growth = 0.5;  // at first

  /// The list of a box.
  struct List {
    u32 first, count;  // of its entries
    u32 layer, mask;
    u32 made;  // the call in which it was made; 0: there is no list
  };

  u32 axes_ = 0;
  f64 growth_ = 0;  // a region is a box enlarged on each side by this share of its longest side
  u32 calls_ = 0;
  Buffer<List> lists_;  // per slot
  Buffer<f64> regions_;  // per slot, as in a row; NaN: there is no list
  u32 known_ = 0;  // slots that have an entry in these
  Buffer<f64> near_;  // of all lists: what the numbers of the box are compared with
  Buffer<u32> near_ids_;
  Buffer<f64> tidy_near_;  // the same while they are put in order
  Buffer<u32> tidy_ids_;
  u32 end_ = 0, made_ = 0;  // where the entries of all lists end; lists made since these were in the order of slots
  Buffer<u64> pairs_;
  u32 count_ = 0;
  u32 shift_ = 0;  // of the ids from here within a pair
  Buffer<u32> asking_;  // slots of the boxes that ask the other space
  u32 asked_ = 0;
  Buffer<u32> loose_;  // of each loose box the id, and the slot in the other space
  u32 loose_count_ = 0;
  IdMarks loose_at_;  // by id of the other space: its place among these + 1
  IdMarks changed_;  // by id of this space
  Buffer<f64> rows_;  // of loose boxes
  u32 epoch_ = 0, read_ = 0;  // of the list of changes here: its epoch, and how much has been read

  u32 width() const { return 2 * axes_; }
  u32 row() const { return width() + 3; }

  SMALL void drop() {
    loose_at_.forget();
    loose_count_ = known_ = end_ = made_ = 0;
  }

  /// Makes changed boxes of the other space loose: of each the id and the slot. If too many are, drops all lists first.
  SMALL void loosen(const f64* others, u32 many, u32 boxes) {
    if (loose_count_ + many > least_loose + boxes / loose_share) drop();
    loose_.grow(2 * u64(loose_count_ + many) + 1, 2 * loose_count_);
    if (!loose_at_.has_room(loose_count_ + many)) {
      loose_at_.begin(2 * u64(loose_count_ + many));
      for (u32 k = 0; k < loose_count_; k++) loose_at_.add(loose_[2 * k], k + 1);
    }
    for (u32 k = 0; k < many; k++) {
      u32 id = u32(others[2 * k]), at = loose_at_[id];
      if (at == 0) loose_at_.add(id, at = ++loose_count_);
      loose_[2 * at - 2] = id;
      loose_[2 * at - 1] = u32(others[2 * k + 1]);
    }
  }

  /// Makes room for the lists of boxes that are new.
  SMALL void make_room(u32 boxes) {
    lists_.grow(u64(boxes) + 1, known_);
    regions_.grow((u64(boxes) + 1) * width(), u64(known_) * width());
    for (; known_ < boxes; known_++) {
      lists_[known_] = {};
      regions_[known_ * width()] = __builtin_nan("");
    }
  }

  /// Drops the pairs of changed boxes here, and writes their slots; returns how many.
  SMALL u32 take_changed(const ChangedIds& changed, u32 boxes) {
    u32 some = 0;
    const u32* list = changed.list();
    changed_.begin(changed.count() - read_);
    for (u32 k = changed.count(); k-- > read_;) {  // backwards: only the last change of an id counts
      if (changed_[list[2 * k]]) continue;
      changed_.add(list[2 * k], 1);
      if (list[2 * k + 1] < boxes) asking_[some++] = list[2 * k + 1];
    }
    filter(changed_, shift_);
    return some;
  }

  /// Drops the pairs with a marked id in the half that `shift` says.
  SMALL void filter(const IdMarks& marks, u32 shift) {
    u64* list = pairs_.data();
    u32 left = 0;
    for (u32 k = 0; k < count_; k++) {
      u64 pair = list[k];
      list[left] = pair;
      left += marks[u32(pair >> shift)] == 0;
    }
    count_ = left;
  }

  /// Adds the pair of the boxes in two rows, the second from the other space. There must be room for it.
  SMALL void add(const f64* mine, const f64* its) {
    pairs_[count_++] = u64(mine[0]) << shift_ | u64(its[0]) << (32 - shift_);
  }

  /// Changes the growth a little for each list that ends: making one should be as much work as all its tests.
  SMALL void adapt() {
    for (u32 k = 0; k < asked_; k++) {
      const List& list = lists_[asking_[k]];
      u32 age = calls_ - list.made;
      f64 more = age >= least_age && age * list.count < query_work ? growth_ : -growth_;
      if (list.made) growth_ = smaller(larger(growth_ + more / known_, least_growth), most_growth);
    }
  }

  /// Makes the list of a box, of the first of the rows.
  SMALL void make_list(u32 slot, f64* mine, const f64* rows, u32 many, bool touching) {
    enlarge(mine + 1);
    __builtin_memcpy(&regions_[slot * width()], mine + 1, width() * sizeof(f64));
    made_++;
    lists_[slot] = {end_, many, u32(mine[width() + 1]), u32(mine[width() + 2]), calls_};
    for (u32 k = 0; k < many; k++, rows += row(), end_++) {
      near_ids_[end_] = u32(rows[0]);
      face(rows + 1, touching, &near_[end_ * width()]);
    }
  }

  /// Puts the entries of all lists in the order of slots, which is that of the tests, if many are elsewhere.
  SMALL void tidy() {
    if (made_ <= known_ / tidy_share) return;
    f64* near = tidy_near_.reserve(u64(end_) * width());
    u32* ids = tidy_ids_.reserve(end_);
    end_ = made_ = 0;
    for (u32 slot = 0; slot < known_; slot++) {
      List& list = lists_[slot];
      __builtin_memcpy(&near[end_ * width()], &near_[list.first * width()], list.count * width() * sizeof(f64));
      __builtin_memcpy(&ids[end_], &near_ids_[list.first], list.count * sizeof(u32));
      list.first = end_;
      end_ += list.count;
    }
    near_.swap(tidy_near_);
    near_ids_.swap(tidy_ids_);
    tidy_near_.release();
    tidy_ids_.release();
  }

  /// Writes what the numbers of another box are compared with: each is at most this if the boxes overlap. Unless
  /// touching counts, these are the next numbers down.
  SMALL void face(const f64* box, bool touching, f64* to) const {
    for (u32 k = 0; k < width(); k++) {
      f64 bound = box[k < axes_ ? k + axes_ : k - axes_];
      to[k] = -(touching ? bound : next_up(bound));
    }
  }

  /// Enlarges a box to its region.
  SMALL void enlarge(f64* box) const {
    f64 most = 0;
    for (u32 a = 0; a < axes_; a++) {
      f64 size = -box[axes_ + a] - box[a];
      if (size < __builtin_inf()) most = larger(most, size);
    }
    widen(box, most * growth_);
  }

  /// Enlarges a box by `more` on each side, rounded outward. Bounds may be infinite: what lies at infinity comes back to
  /// the largest double, since the bound of another box may overflow when that reaches out.
  SMALL void widen(f64* box, f64 more) const {
    for (u32 k = 0; k < width(); k++) {
      f64 from = smaller(box[k], __DBL_MAX__);
      box[k] = from - (more + (__builtin_fabs(from) + more) * sum_rounding);
    }
  }

  /// Writes the query for the box of a row: without the id, and with maxima that are not negated.
  SMALL void write_question(const f64* from, f64* to, f64 reach) const {
    __builtin_memcpy(to, from + 1, (row() - 1) * sizeof(f64));
    if (reach > 0) widen(to, reach);
    for (u32 k = axes_; k < width(); k++) to[k] = -to[k];
  }

  /// Whether the boxes of two rows overlap, in a world that may wrap around. A query of the second has found the first.
  SMALL bool overlap(const f64* world, const f64* found, const f64* mine, bool touching) const {
    f64 one[9], other[9];
    bool all = true;
    if (!world) {
      face(found + 1, touching, one);
      for (u32 k = 0; k < width(); k++) all &= mine[1 + k] <= one[k];
      return all;
    }
    write_question(found, one, 0);
    write_question(mine, other, 0);
    Copies copies;
    copies.begin(world, axes_, one, one + axes_);
    return copies.meets(other, touching);
  }

 public:
  static constexpr u32 still = -2;  // an answer: nothing has changed

  const u64* pairs() const { return pairs_.data(); }
  u32 count() const { return count_; }
  u32 loose() const { return loose_count_; }

  /// Begins rows with the slots of the loose boxes.
  SMALL void write_loose(f64* to) const {
    for (u32 k = 0; k < loose_count_; k++) to[k * row()] = loose_[2 * k + 1];
  }

  /// Takes these rows, filled by the other space, and writes a query for each loose box that may meet others. Returns
  /// how many.
  SMALL u32 take_loose(Buffer<f64>& given, f64 reach) {
    rows_.swap(given);
    asked_ = 0;
    f64* to = given.reserve(u64(loose_count_) * row());
    for (u32 k = 0; k < loose_count_; k++) {
      const f64* from = &rows_[k * row()];
      if (from[0] < 0) continue;
      write_question(from, to + asked_ * (row() - 1), reach);
      __builtin_memmove(&rows_[asked_++ * row()], from, row() * sizeof(f64));
    }
    return asked_;
  }

  SMALL void release() {
    lists_.release();
    regions_.release();
    near_.release();
    near_ids_.release();
    tidy_near_.release();
    tidy_ids_.release();
    pairs_.release();
    asking_.release();
    loose_.release();
    loose_at_.release();
    changed_.release();
    rows_.release();
    known_ = end_ = made_ = count_ = loose_count_ = epoch_ = 0;
  }
};

template <int D> class Neighbours : public NeighbourLists {
  static constexpr u32 width = 2 * D;
  static constexpr u32 row = width + 3;  // as in Index

 public:
  /// Brings the pairs up to date as far as lists tell. `others`: of `many` changed boxes of the other space the id and
  /// the slot. `same`: they are all that changed there; else the call starts over, and `first` says whether ids from
  /// here come first in pairs. Returns how many boxes have to ask the other space, or `still`.
  SMALL u32 begin(const Index<D>& index, const ChangedIds& changed, u32 epoch, const f64* others, u32 many, bool same,
                  bool first) {
    bool follows = same && epoch == epoch_;
    if (follows && many == 0 && changed.count() == read_) return still;
    u32 n = index.count();
    calls_++;
    if (!same) {
      drop();
      axes_ = D;
      growth_ = growth;
      shift_ = first ? 0 : 32;
    }
    loosen(others, many, n);
    make_room(n);
    tidy();
    asking_.reserve(u64(n) + changed.count() + 1);
    if (!follows) count_ = 0;
    u32 some = follows ? take_changed(changed, n) : n;
    look(index, follows ? asking_.data() : nullptr, some);
    epoch_ = epoch;
    read_ = changed.count();
    return asked_;
  }

  /// Writes the queries of the boxes that ask. `reach`: how far the answers may reach.
  SMALL void write_questions(const Index<D>& index, f64* to, f64 reach) {
    adapt();
    for (u32 k = 0; k < asked_; k++) {
      f64 mine[row];
      index.write_row(asking_[k], mine);
      if (!index.world()) enlarge(mine + 1);
      write_question(mine, to + k * (row - 1), reach);
    }
  }

  /// Takes the answers: rows of the boxes that were found, then where those of each query begin. `exact`: all of them
  /// overlap the box of their query.
  SMALL void take_answers(const Index<D>& index, const f64* rows, u32 total, bool exact, bool touching) {
    const f64* ends = rows + u64(total) * row;
    pairs_.grow(u64(count_) + total, count_);
    near_.grow((u64(end_) + total) * width, u64(end_) * width);
    near_ids_.grow(u64(end_) + total, end_);
    for (u32 k = 0; k < asked_; k++) {
      f64 mine[row];
      index.write_row(asking_[k], mine);
      u32 some = u32(ends[k + 1] - ends[k]);
      if (!index.world()) make_list(asking_[k], mine, rows, some, touching);
      for (; some > 0; some--, rows += row) {
        if (index.world() && (exact || overlap(index.world(), rows, mine, touching))) add(mine, rows);
      }
    }
    if (!index.world()) look(index, asking_.data(), asked_);
  }

  /// Replaces the pairs of loose boxes by those with the slots that their queries found. `exact`: all overlap.
  SMALL void meet_loose(const Index<D>& index, const u32* offsets, const u32* slots, bool exact, bool touching) {
    filter(loose_at_, 32 - shift_);
    pairs_.grow(u64(count_) + offsets[asked_], count_);
    for (u32 k = 0; k < asked_; k++) {
      for (u32 n = offsets[k]; n < offsets[k + 1]; n++) {
        f64 mine[row];
        index.write_row(slots[n], mine);
        if (exact || overlap(index.world(), mine, &rows_[k * row], touching)) add(mine, &rows_[k * row]);
      }
    }
  }

 private:
  /// Appends the pairs of the boxes in these slots, or in all. Those that are not within their regions have to ask:
  /// their slots go to `asking_`, which may be `slots` itself.
  SMALL void look(const Index<D>& index, const u32* slots, u32 many) {
    u64* out = pairs_.grow(u64(count_) + end_ + 1, count_) + count_;
    const u32* ids = near_ids_.data();
    const f64* near = near_.data();
    u32 asked = 0;
    for (u32 k = 0; k < many; k++) {
      u32 slot = slots ? slots[k] : k;
      Rule rule = index.rule(slot);
      if (!rule.meets_some()) continue;
      f64x2 box[D];
      index.turned_box(slot, box);
      const List& list = lists_[slot];
      if (list.layer != rule.layer || list.mask != rule.mask || !is_within(box, &regions_[slot * width])) {
        asking_[asked++] = slot;
        continue;
      }
      u64 mine = u64(index.id_of_slot(slot)) << shift_;
      for (u32 n = list.first, end = n + list.count; n < end; n++) {
        *out = mine | u64(ids[n]) << (32 - shift_);
        out += overlaps(box, near + n * width);
      }
    }
    asked_ = asked;
    count_ = Pairs::between(pairs_.data(), out);
  }

  INLINE static bool is_within(const f64x2* box, const f64* region) {
    i32x4 all = bits<i32x4>(load<f64x2>(region) <= box[0]);
    for (u32 k = 1; k < D; k++) all &= bits<i32x4>(load<f64x2>(region + 2 * k) <= box[k]);
    return bitmask(all) == 15;
  }
  INLINE static bool overlaps(const f64x2* box, const f64* facing) {
    i32x4 all = bits<i32x4>(box[0] <= load<f64x2>(facing));
    for (u32 k = 1; k < D; k++) all &= bits<i32x4>(box[k] <= load<f64x2>(facing + 2 * k));
    return bitmask(all) == 15;
  }
};

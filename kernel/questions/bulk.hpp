// Many queries in one call.
// Idea: the queries are stored one after the other, as doubles, and answered in that order. All answers go into one
// list. A second list has the offset at which the answers of each query begin. Boxes, points, rays and moving boxes go
// down the index together: see together.hpp.
// Cost: for boxes and points, at most half of that of single queries; for rays and moving boxes, about two thirds; for
// other queries, the same without the calls.
// Running them in Hilbert order was slower in all but a few cases: see docs/decisions/0011-many-queries.md.
#pragma once
#include "questions/casts.hpp"
#include "questions/queries.hpp"

/// The kind of all queries of a call.
enum class Asks : u32 { nearest, ray, way, box, within, point, circle, others, meeting };

template <int D> class Bulk {
  static constexpr u32 width = 2 * D;
  // Mean number of answers per query so far. Above this, single queries are faster, since they take whole subtrees.
  static constexpr u32 crowded = 1000;

  Areas<D> areas_;
  Casts<D> casts_;
  Buffer<u32> offsets_;  // per query, where its answers begin; then where those of the last end

  static bool has_box(Asks kind) {
    return kind == Asks::way || kind == Asks::box || kind == Asks::within || kind == Asks::meeting;
  }
  static bool moves(Asks kind) { return kind == Asks::ray || kind == Asks::way; }
  static u32 stride(Asks kind) {
    return (has_box(kind) ? width : u32(D)) + (moves(kind) ? u32(D) : 0) +
           (kind == Asks::circle    ? 1
            : kind == Asks::meeting ? 2
                                    : 0);
  }

 public:
  Buffer<f64> given;  // the numbers of all queries, then the id that each ignores, unless they are for meeting
  Buffer<u32> ids;  // the answers of queries for areas
  Buffer<Hit> hits;  // the answers of queries with an order
  u64 looks = 0;  // blocks visited by all queries of a call

  const u32* offsets() const { return offsets_.data(); }

  /// Room for the numbers of queries.
  SMALL f64* stage(u32 numbers) { return given.reserve(numbers); }

  /// The first query with bad numbers, or -1.
  SMALL i32 first_bad(Asks kind, u32 count) const {
    Question<D> asked;
    for (u32 k = 0; k < count; k++) {
      if (!read(kind, k, asked)) return i32(k);
    }
    return -1;
  }

  /// Answers `count` queries, whose numbers are good. Those with an order get at most `most` answers each. `asked` has
  /// what all queries have in common.
  SMALL void answer(const Index<D>& index, Question<D> asked, Asks kind, u32 count, u32 most, Hits& best) {
    offsets_.reserve(u64(count) + 1)[0] = 0;
    looks = 0;
    for (f64& by : asked.along) by = 0;  // left by an earlier query
    asked.measure_way(false);
    if (moves(kind) && !index.world()) return cast_all(index, asked, kind, count, best);
    bool may = !index.world() && (kind == Asks::box || kind == Asks::point || kind == Asks::meeting), together = false;
    f64 limit = asked.limit;
    // All these answers exist: if there is no memory for them, that is known now, not after minutes.
    bool all = (kind == Asks::nearest || kind == Asks::others) && limit == __builtin_inf() && !index.filtered() &&
               asked.mask;
    if (all) hits.reserve(u64(count) * smaller(most, index.count()));
    for (u32 k = 0, at = 0; k < count; k++) {
      u32 found = offsets_[k], n = k % Areas<D>::most;
      if (n == 0) together = may && found <= u64(k) * crowded;
      if (together && n == 0) ask_together(index, asked, kind, k, count, at = found);
      bool asks = kind == Asks::others ? take_box(index, k, asked) : read(kind, k, asked);
      if (kind < Asks::others) asked.ignored = ignored(kind, k, count);
      if (moves(kind)) asked.measure_way(kind == Asks::ray);
      asked.limit = limit;
      if (index.world()) asked.wrap(index.world());
      if (together) found = name(index, asked, at, areas_.ends[n], found);
      else if (asks) found = ask(index, asked, kind, most, found, best);
      offsets_[k + 1] = found;
    }
  }

  /// Answers rays or moving boxes: in a batch, and alone what the batch has left.
  SMALL void cast_all(const Index<D>& index, const Question<D>& asked, Asks kind, u32 count, Hits& best) {
    CastPace pace;
    for (u32 k = 0, some, found = 0; k < count; k += some) {
      some = smaller(count - k, pace.batch(Casts<D>::most));
      casts_.begin(index);
      for (u32 n = 0; n < some; n++) {
        Question<D>& one = casts_.asked(n) = asked;
        read(kind, k + n, one);
        one.ignored = ignored(kind, k + n, count);
        one.measure_way(kind == Asks::ray);
      }
      u64 together = pace.tries() ? casts_.search(some, pace.reach()) : 0, before = looks;
      u32 missed = 0;
      for (u32 n = 0; n < some; n++) {
        if (!casts_.knows(n)) {
          found = ask(index, casts_.asked(n), kind, 1, found, best);
          missed++;
        } else if (const Hit* hit = casts_.hit(n)) {
          hits.grow(u64(found) + 1, found);
          hits[found++] = *hit;
        }
        pace.note(found > offsets_[k + n] ? hits[found - 1].rank : asked.limit);
        offsets_[k + n + 1] = found;
      }
      pace.judge(some, missed, looks - before, together, asked.limit);
      looks += together;
    }
  }

  /// Fills staged rows, each of which begins with a slot.
  SMALL void fill_rows(const Index<D>& index, u32 count) {
    f64* to = given.data();
    for (u32 k = 0; k < count; k++, to += Index<D>::row) index.write_row(u32(to[0]), to);
  }

  /// Answers `count` queries with nothing.
  SMALL void answer_nothing(u32 count) {
    u32* offsets = offsets_.reserve(u64(count) + 1);
    __builtin_memset(offsets, 0, (u64(count) + 1) * sizeof(u32));
  }

  SMALL void release() {
    given.release();
    casts_.release();
    areas_.release();
    offsets_.release();
    ids.release();
    hits.release();
  }

 private:
  /// Reads a query; false if its numbers are bad.
  bool read(Asks kind, u32 k, Question<D>& to) const {
    const f64* from = given.data() + u64(k) * stride(kind);
    bool boxed = has_box(kind), good = true;
    for (int a = 0; a < D; a++) {
      to.lo[a] = from[a];
      to.hi[a] = from[boxed ? D + a : a];
      good &= to.lo[a] <= to.hi[a] && (boxed || is_finite(to.lo[a]));
    }
    from += boxed ? 2 * D : D;
    to.radius = kind == Asks::within ? Question<D>::within : -1;
    if (kind == Asks::circle) {
      to.radius = from[0];
      return good && to.radius >= 0;
    }
    if (kind == Asks::meeting) {
      to.layer = u32(from[0]);
      to.mask = u32(from[1]);
    }
    for (int a = 0; a < D && moves(kind); a++) {
      to.along[a] = from[a];
      good &= is_finite(from[a]);
    }
    return good;
  }

  /// Runs a batch of box queries together, from query `first` on. The places of the boxes they touch begin at `found`.
  SMALL void ask_together(const Index<D>& index, Question<D>& asked, Asks kind, u32 first, u32 count, u32 found) {
    u32 many = smaller(count - first, Areas<D>::most);
    areas_.begin(index);
    for (u32 n = 0; n < many; n++) {
      read(kind, first + n, asked);
      areas_.aim(n, asked);
    }
    looks += areas_.search(many, ids, found);
  }

  /// Appends the names of the boxes that a query touches in float32: those at the places from `from` on. Leaves out
  /// those that it does not touch in double precision or that it does not ask for. Raises `from` to `until`.
  NOINLINE u32 name(const Index<D>& index, const Question<D>& asked, u32& from, u32 until, u32 found) {
    const Wanted<D> wanted(index, asked);
    const u32* names = asked.layer ? index.slots() : index.ids();
    const bool every = wanted.all(), rounded = index.rounded();
    for (; from < until; from++) {
      u32 place = ids[from];
      if (rounded) {
        f64 box[width];
        index.box(place, box);
        if (!asked.touches(box, false)) continue;
      }
      if (every || wanted(place)) ids[found++] = names[place];
    }
    return found;
  }

  u32 ignored(Asks kind, u32 k, u32 count) const { return u32(given[u64(count) * stride(kind) + k]); }

  /// Makes the box in a slot the query; false if it is off.
  static bool take_box(const Index<D>& index, u32 slot, Question<D>& to) {
    u32 place = index.place(slot);
    if (place == Index<D>::nowhere) return false;
    f64 box[width];
    index.box(place, box);
    __builtin_memcpy(to.lo, box, sizeof(to.lo));
    __builtin_memcpy(to.hi, box + D, sizeof(to.hi));
    to.ignored = index.id(place);
    return true;
  }

  /// Appends the answers of one query; returns how many there are then.
  SMALL u32 ask(const Index<D>& index, const Question<D>& asked, Asks kind, u32 most, u32 found, Hits& best) {
    Queries<D> queries(index, asked);
    if (kind == Asks::nearest || kind == Asks::others || moves(kind)) {
      best.begin(most, asked.limit, nullptr);
      if (moves(kind)) queries.cast(best);
      else queries.near(best);
      looks += queries.looks();
      u32 many = best.finish();
      hits.grow(u64(found) + many, found);
      for (u32 n = 0; n < many; n++) hits[found + n] = best.data()[n];
      return found + many;
    }
    u32 from = 0;
    found = queries.area(from, 0xffffffff, ids, found);
    looks += queries.looks();
    return found;
  }
};

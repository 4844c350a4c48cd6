// Many questions in one call.
// Idea: the questions stand one behind the other, as doubles, and are asked in the order of the Hilbert curve: each finds
// in the caches what the one before has read of the index. The answers of all stand in one list, and beside it where
// those of each question begin and end. Of all boxes asking for their neighbours the index has the order already.
// Cost: that of the questions asked alone, less what the caches save, and a sort of them.
#pragma once
#include "queries.hpp"

/// What all the questions of a call are.
enum class Asks : u32 { nearest, ray, way, box, within, point, circle, others };

template <int D> class Bulk {
  static constexpr u32 width = 2 * D;

  Buffer<f64> given_;   // numbers of all questions, then of each the id it ignores
  Buffer<u32> parts_;   // of each question, where its answers begin and end
  Buffer<f32> places_;  // of each question, the box it begins with
  RadixSort sort_;

  static bool has_box(Asks kind) { return kind == Asks::way || kind == Asks::box || kind == Asks::within; }
  static bool moves(Asks kind) { return kind == Asks::ray || kind == Asks::way; }
  static u32 stride(Asks kind) {
    return (has_box(kind) ? width : u32(D)) + (moves(kind) ? u32(D) : 0) + (kind == Asks::circle ? 1 : 0);
  }
  static bool is_finite(f64 x) { return x - x == 0; }

 public:
  Buffer<u32> ids;   // the answers of all questions: of areas
  Buffer<Hit> hits;  // and where they ask for an order
  u64 looks = 0;     // at blocks, by all questions of a call

  const u32* parts() const { return parts_.data(); }

  /// Room for the numbers of questions.
  COLD f64* stage(u32 numbers) { return given_.reserve(numbers); }

  /// The first question whose numbers are bad, or -1.
  COLD i32 first_bad(Asks kind, u32 count) const {
    Question<D> asked;
    for (u32 k = 0; k < count; k++) {
      if (!read(kind, k, asked)) return i32(k);
    }
    return -1;
  }

  /// Answers so many questions, which are good, each with at most so many boxes where it asks for an order. What they
  /// have in common stands in `asked`.
  COLD void answer(const Index<D>& index, Question<D> asked, Asks kind, u32 count, u32 most, Hits& best) {
    answer_nothing(count);  // nor do boxes that are off find anything
    u32 found = 0;
    looks = 0;
    if (kind == Asks::others) {
      for (u32 place = 0; place < index.places(); place++) {
        u32 slot = index.slot(place);
        if (index.place(slot) != place) continue;  // a hole
        f64 box[width];
        index.box(place, box);
        __builtin_memcpy(asked.lo, box, sizeof(asked.lo));
        __builtin_memcpy(asked.hi, box + D, sizeof(asked.hi));
        asked.ignored = index.id(place);
        parts_[2 * slot] = found;
        parts_[2 * slot + 1] = found = ask(index, asked, kind, most, found, best);
      }
      return;
    }
    put_in_order(kind, count);
    for (u32 n = 0; n < count; n++) {
      u32 k = sort_.index(n);
      read(kind, k, asked);
      asked.ignored = u32(given_[u64(count) * stride(kind) + k]);
      parts_[2 * k] = found;
      parts_[2 * k + 1] = found = ask(index, asked, kind, most, found, best);
    }
  }

  /// As if so many questions had found nothing.
  COLD void answer_nothing(u32 count) {
    u32* parts = parts_.reserve(2 * u64(count) + 1);
    __builtin_memset(parts, 0, 2 * u64(count) * sizeof(u32));
  }

  COLD void release() {
    given_.release();
    parts_.release();
    places_.release();
    sort_.release();
    ids.release();
    hits.release();
  }

 private:
  /// Reads a question; false where its numbers are bad.
  bool read(Asks kind, u32 k, Question<D>& to) const {
    const f64* from = given_.data() + u64(k) * stride(kind);
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
    for (int a = 0; a < D && moves(kind); a++) {
      to.along[a] = from[a];
      good &= is_finite(from[a]);
    }
    to.measure_way(kind == Asks::ray);
    return good;
  }

  /// Adds the answers of one question behind those that were found; returns how many there are then.
  u32 ask(const Index<D>& index, const Question<D>& asked, Asks kind, u32 most, u32 found, Hits& best) {
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

  /// Sorts the questions along the curve.
  COLD void put_in_order(Asks kind, u32 count) {
    places_.reserve(u64(count) * width + 4);
    Question<D> asked;
    for (u32 k = 0; k < count; k++) {
      read(kind, k, asked);
      for (int a = 0; a < D; a++) {
        places_[u64(k) * width + a] = round_down(asked.lo[a]);
        places_[u64(k) * width + D + a] = round_up(asked.hi[a]);
      }
    }
    if (count) sort_along_curve<D>(places_.data(), count, sort_);
  }
};

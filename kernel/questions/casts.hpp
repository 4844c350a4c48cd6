// Many rays or moving boxes at once: the first box that each meets on the first part of its path.
// Idea: see together.hpp. A search alone goes to the nearest blocks first, which takes unpredictable branches. A batch
// visits all blocks along that part, which are more, but each in a third of the time. A hit shortens what is left of
// the path. Rays that meet nobody there are searched alone. How long that part is follows from counted work.
// Cost: about two thirds of that of single queries.
#pragma once
#include "questions/cast_aim.hpp"
#include "questions/together.hpp"

template <int D> class Casts : public Together<D, Casts<D>, CastAim<D>> {
  using Base = Together<D, Casts<D>, CastAim<D>>;
  friend Base;

  static constexpr u32 nobody = ~0u;
  static constexpr u32 looks_of_test = 3;  // a test of a box takes as long as visiting this many blocks
  Buffer<Question<D>> asked_;
  Hit first_[Base::most] = {};  // per query, what it meets first; until then the end of the search
  u64 aimed_ = 0;  // a bit for each query that was searched
  u32 tests_ = 0;

 public:
  SMALL void begin(const Index<D>& index) {
    Base::begin(index);
    asked_.reserve(Base::most);
    aimed_ = 0;
  }

  /// The queries of the batch.
  Question<D>& asked(u32 n) { return asked_[n]; }

  /// Searches `count` paths up to `reach`. Returns the work that it took, in blocks visited.
  SMALL u32 search(u32 count, f64 reach) {
    u32 roots = tests_ = 0;
    for (u32 n = 0; n < count; n++) {
      const Question<D>& asked = asked_[n];
      first_[n] = {smaller(reach, asked.limit), nobody, 0};
      if (!this->aims_[n].take(asked.lo, asked.hi, asked.along) || asked.length == 0) continue;
      shorten(n);
      aimed_ |= u64(1) << n;
      this->roots()[roots++] = this->start(n);
    }
    return this->descend(this->index_->top(), roots) + tests_ * looks_of_test;
  }

  /// Whether the search has answered a query, and its answer: null if it meets nobody.
  bool knows(u32 n) const { return (aimed_ >> n & 1) && (hit(n) || first_[n].rank >= asked_[n].limit); }
  const Hit* hit(u32 n) const { return first_[n].id == nobody ? nullptr : &first_[n]; }

  SMALL void release() {
    Base::release();
    asked_.release();
  }

 private:
  void shorten(u32 n) { this->aims_[n].most = round_up(first_[n].rank * asked_[n].scale()); }

  NOINLINE void finish(const u32* entries, u32 count) {
    for (u32 k = 0; k < count; k++) {
      u32 number = this->number(entries[k]), asks = this->asker(entries[k]);
      Ranks ranks;
      this->aims_[asks].rank(this->index_->block(0, number), ranks);
      for (u32 lane; (lane = ranks.take(this->aims_[asks].most)) < 8; tests_++) offer(asks, number * 8 + lane);
    }
  }

  NOINLINE void offer(u32 n, u32 place) {
    const Question<D>& asked = asked_[n];
    const Wanted<D> wanted(*this->index_, asked);
    if (!wanted.all() && !wanted(place)) return;
    f64 box[2 * D];
    this->index_->box(place, box);
    Hit hit;
    if (!asked.hits(box, this->index_->id(place), hit) || !(hit < first_[n])) return;
    first_[n] = hit;
    shorten(n);
  }
};

/// Decides how far batches search, from the work of those before.
class CastPace {
  static constexpr u32 first = 8;  // rays that are searched alone before the first batch
  static constexpr u32 pause = 256;  // rays that are searched alone after a batch that did not pay
  static constexpr f64 speed = 3;  // blocks that a batch visits while a ray alone visits one

  f64 reach_ = 0, farthest_ = 0, sum_ = 0;  // farthest and sum: of the ranks of hits
  f64 alone_ = 0, looks_ = 0;  // rays searched alone, and blocks that they visited
  u32 seen_ = 0, next_ = 0;

 public:
  /// How far the next batch searches; the number of its rays, at most `most`; whether it is worth trying.
  f64 reach() const { return reach_; }
  u32 batch(u32 most) const { return reach_ > 0 ? most : first; }
  bool tries() const { return reach_ > 0 && seen_ >= next_; }

  /// Records how far a ray went.
  void note(f64 rank) {
    if (!(rank < __builtin_inf())) return;
    farthest_ = larger(farthest_, rank);
    sum_ += rank;
  }

  /// Records the work of a batch of `count` rays: `missed` were searched alone.
  SMALL void judge(u32 count, u32 missed, u64 looks_alone, u64 together, f64 limit) {
    bool tried = tries();
    seen_ += count;
    alone_ += missed;
    looks_ += looks_alone;
    if (reach_ == 0) reach_ = sum_ / seen_;
    if (!tried) return;
    f64 spent = together / speed, look = looks_ / alone_;
    if (spent > look * (count - missed)) next_ = seen_ + pause;
    // It is weighed against rays that were missed, unless the batch has searched all there is.
    f64 fair = count * 2.0 / 3, few = reach_ < limit ? smaller(fair, missed * 2.0) : fair;
    reach_ = smaller(farthest_, reach_ * (spent < look * few ? 1.25 : 0.8));
  }
};

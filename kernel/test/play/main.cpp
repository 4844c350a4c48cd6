// Makes the calls of tapes (test/promises/determinism/tape.ts) on a space, as test/promises/determinism/play.ts does,
// and prints the hash of all answers: `play TECHNIQUE TAPE`, repeated. The kernel alone must answer like the package.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

#include "space/space.hpp"

namespace {

class Hash {
  u32 first_ = 0x811c9dc5, second_ = 0x1b873593;

 public:
  void add(u32 word) {
    first_ = (first_ ^ word) * 0x9e3779b1u;
    first_ ^= first_ >> 15;
    second_ = (second_ ^ word) * 0x85ebca77u;
    second_ ^= second_ >> 13;
  }
  template <class T> void add_all(const T* words, u64 count) {
    add(u32(count));
    for (u64 k = 0; k < count; k++) add(words[k]);
  }
  void add_all(const Pairs& pairs) { add_all(reinterpret_cast<const u32*>(pairs.list.data()), 2 * pairs.count); }
  void print() const { std::printf("%08x%08x\n", first_, second_); }
};

template <int D> class Player {
  static constexpr u32 width = 2 * D;
  Ids ids_;
  Options options_;
  Space<D> space_{ids_, options_};
  std::vector<u8> saved_;
  Hash hash_;
  const f64* at_;
  const f64* end_;
  Ring<D> ring_;

  f64 next() { return *at_++; }
  u32 whole() { return u32(next()); }

 public:
  Player(const std::vector<f64>& tape, u32 technique) : at_(tape.data() + 2), end_(tape.data() + tape.size()) {
    space_.technique = Technique(technique);
    space_.store.keeps_events = u32(tape[1]) & 1;
    options_.touching = !(u32(tape[1]) & 2);
  }

  void run() {
    while (at_ < end_) step();
    hash_.print();
  }

 private:
  void step() {
    switch (whole()) {
      case 0: return set();
      case 1: return hash_.add(space_.store.remove(whole()));
      case 2: return filter();
      case 3: return exclude();
      case 4: return replace();
      case 5: return expose();
      case 6: space_.technique = Technique(whole()); return;
      case 7: return update();
      case 8: return space_.store.clear();
      case 9: return save();
      case 10: return restore();
      case 11: return query_box();
      case 12: return nearest();
      case 13: return sweep();
      case 14: return partners();
      case 15: return enable();
      case 16: return group();
      case 17: return reach();
      case 18: return many();
      default: std::fprintf(stderr, "play: the tape has no such call\n"); std::exit(1);
    }
  }

  void set() {
    u32 id = whole();
    ring_.place(nullptr);
    ring_.first()[0] = id;
    __builtin_memcpy(ring_.first() + 1, at_, width * sizeof(f64));
    space_.store.take(ring_, 1);
    at_ += width;
  }
  void filter() {
    u32 slot = ids_.slot(whole()), layer = whole();
    space_.store.filter(slot, layer, whole());
  }
  void exclude() {
    u32 slot = ids_.slot(whole());
    space_.store.exclude(slot, is_static, next() == 1);
  }
  void enable() {
    u32 slot = ids_.slot(whole());
    space_.store.enable(slot, next() == 1);
  }
  void group() {
    u32 slot = ids_.slot(whole());
    space_.store.put_in_group(slot, whole());
  }
  void reach() {
    u32 slot = ids_.slot(whole());
    space_.store.set_reach(slot, next());
  }
  void replace() {
    u32 count = whole();
    f64* to = space_.store.numbers.stage_exact(count);
    for (u32 k = 0; k < count * width; k++) to[k] = next();
    space_.store.replace(count, true);
  }
  void expose() {
    u32 count = whole();
    f32* to = space_.store.expose(count);
    for (u32 k = 0; k < count * width; k++) to[k] = f32(next());
  }
  void update() {
    space_.update();
    hash_.add_all(space_.pairs);
    hash_.add_all(space_.store.events.began);
    hash_.add_all(space_.store.events.ended);
    hash_.add(u32(space_.stats.candidates));
  }
  void save() {
    space_.save();
    const u8* bytes = reinterpret_cast<const u8*>(space_.snapshot.words());
    saved_.assign(bytes, bytes + space_.snapshot.bytes());
    hash_.add_all(saved_.data(), saved_.size());
  }
  void restore() {
    SnapshotHeader head = load<SnapshotHeader>(saved_.data());
    space_.snapshot.stage(head, u32(saved_.size()), D, built);
    __builtin_memcpy(const_cast<u64*>(space_.snapshot.words()), saved_.data(), saved_.size());
    space_.restore();
  }
  void ask(u32 mask, u32 numbers) {
    Question<D>& question = space_.questions.asked;
    question = {};
    question.radius = -1;
    question.touching = options_.touching;
    question.mask = mask;
    question.ignored = ~0u;
    for (int a = 0; a < D; a++) {
      question.lo[a] = at_[a];
      question.hi[a] = numbers >= width ? at_[D + a] : at_[a];
      if (numbers > width) question.along[a] = at_[width + a];
    }
    at_ += numbers;
  }
  void query_box() {
    u32 mask = whole(), from = 0;
    ask(mask, width);
    u32 count = space_.questions.ask_area(from, ~0u);
    hash_.add_all(space_.questions.answers.data(), count);
  }
  void nearest() {
    u32 most = whole();
    ask(~0u, D);
    space_.questions.asked.limit = __builtin_inf();
    u32 count = space_.questions.ask_order(false, most, nullptr);
    hash_.add(count);
    for (u32 k = 0; k < count; k++) hash_.add(space_.questions.hits.data()[k].id);
  }
  void sweep() {
    ask(~0u, 3 * D);
    space_.questions.asked.limit = space_.questions.asked.length = 1;
    space_.questions.asked.stops = true;
    bool met = space_.questions.ask_order(true, 1, nullptr) > 0;
    u64 time = bits<u64>(met ? space_.questions.hits.data()[0].rank : -1.0);
    u32 words[] = {met ? space_.questions.hits.data()[0].id & ~Hit::corner : ~0u, u32(time), u32(time >> 32)};
    hash_.add_all(words, 3);
  }
  void many() {
    Asks kind = Asks(whole());
    u32 most = whole(), count = whole();
    constexpr u32 numbers[2][8] = {{2, 4, 6, 4, 4, 2, 3, 0}, {3, 6, 9, 6, 6, 3, 4, 0}};
    u32 length = count * numbers[D - 2][u32(kind)];
    f64* to = space_.questions.bulk.stage(length + count);
    for (u32 k = 0; k < length; k++) to[k] = next();
    for (u32 k = 0; k < count; k++) to[length + k] = ~0u;
    space_.questions.asked = {};
    space_.questions.asked.mask = ~0u;
    space_.questions.asked.limit = kind == Asks::way ? 1 : __builtin_inf();
    bool ordered = kind < Asks::box || kind == Asks::others;
    count = space_.questions.ask_many(kind, count, moves(kind) ? 1 : most);
    const u32* offsets = space_.questions.bulk.offsets();
    hash_.add_all(offsets, count + 1);
    u32 total = offsets[count];
    if (!ordered) return hash_.add_all(space_.questions.bulk.ids.data(), total);
    hash_.add(total);
    for (u32 k = 0; k < total; k++) hash_.add(space_.questions.bulk.hits[k].id & ~Hit::corner);
    for (u32 k = 0; k < total; k++) {
      u64 rank = bits<u64>(space_.questions.bulk.hits[k].rank);
      hash_.add(u32(rank));
      hash_.add(u32(rank >> 32));
    }
  }
  static bool moves(Asks kind) { return kind == Asks::ray || kind == Asks::way; }
  void partners() {
    u32 count = space_.partners(whole());
    hash_.add_all(space_.questions.answers.data(), count);
  }
};

}  // namespace

int main(int count, char** arguments) {
  for (int k = 1; k + 1 < count; k += 2) {
    std::ifstream file(arguments[k + 1], std::ios::binary);
    std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    std::vector<f64> tape(bytes.size() / sizeof(f64));
    if (tape.size() < 2) return 1;
    __builtin_memcpy(tape.data(), bytes.data(), tape.size() * sizeof(f64));
    u32 technique = u32(std::atoi(arguments[k]));
    if (tape[0] == 2) std::make_unique<Player<2>>(tape, technique)->run();
    else std::make_unique<Player<3>>(tape, technique)->run();
  }
  return 0;
}

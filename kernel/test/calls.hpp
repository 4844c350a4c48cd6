// Sequences of calls read from bytes, made on a space and on a model of it: the tests feed random bytes, the
// fuzzer its own. Any bytes are a valid sequence; where they end, so does the sequence.
//
// After each call space and model agree on ids and numbers; after each update on the pairs. Some calls are made
// with little memory left: those that fail must have changed nothing.
#pragma once
#include <optional>

#include "check.hpp"
#include "own_calls.hpp"
#include "scenes.hpp"

/// Bytes to decide by; zeros once they are used up.
class Bytes {
  const u8* at_;
  const u8* end_;

 public:
  Bytes(const u8* data, size_t size) : at_(data), end_(data + size) {}
  bool empty() const { return at_ == end_; }
  u8 next() { return empty() ? u8(0) : *at_++; }
  u32 below(u32 end) { return next() % end; }
  u16 next16() {
    u16 low = next();
    return u16(low | next() << 8);
  }
  u64 next64() {
    u64 value = 0;
    for (int k = 0; k < 8; k++) value |= u64(next()) << (8 * k);
    return value;
  }
};

/// The first byte of a sequence: how many dimensions, and the technique to begin with.
struct Beginning {
  int dimensions;
  Technique technique;

  explicit Beginning(u8 byte) : dimensions(2 + byte % 2), technique(Technique(byte / 2 % technique_count)) {}
};

template <int D> class Calls {
  static constexpr u32 width = 2 * D;
  static constexpr u32 most_boxes = 450;  // the model tests all against all
  static constexpr u32 crowded = 12'000;   // pairs
  // What takes its time and finds little more each time: updates that find a crowd, and long runs of updates.
  static constexpr u32 most_crowds = 2, most_spells = 2;

  Bytes& bytes_;
  std::unique_ptr<Instance<D>> instance_;
  Ids& ids_;
  Space<D>& space_;
  Model<D> model_;
  PairList before_;           // of the last update
  bool unsure_ = false;
  bool found_ = false;        // whether they are still the space's: not after memory ended
  std::optional<Model<D>> seen_;  // by the questions: what the last update saw
  bool updated_ = false, asked_ = false;
  u32 crowds_ = 0, spells_left_ = 0;
  bool starved_ = false;  // the next call has little memory

  /// A snapshot, and what it is one of.
  struct Saved {
    std::vector<u64> words;
    Model<D> model;
    PairList before;
    Technique technique;
  };
  std::optional<Saved> saved_;

 public:
  Calls(Bytes& bytes, Technique first)
      : bytes_(bytes), instance_(open<D>(first)), ids_(instance_->ids), space_(instance_->space) {
    // Not the extremes, which take the grid a while and have a test of their own.
    u8 with = bytes_.next();
    space_.keeps_events = with & 16;
    if (with / 32 == 0) spells_left_ = most_spells;  // few sequences have them, so that there is time for many
    for (u32 a = 0; a < D; a++) {
      if (with % 16 == 1) instance_->settings.cell_size[a] = std::exp2(f64(bytes_.below(12)));
      if (with % 16 == 2) {
        f64 low = f64(bytes_.next()) - 128;
        instance_->settings.bounds[a] = low;
        instance_->settings.bounds[D + a] = low + std::exp2(f64(bytes_.below(12)));
      }
      if (with % 16 == 3) instance_->settings.wrap[a] = 64 * (1 + bytes_.below(4)) + 0.1 * bytes_.below(4);
    }
    if (with % 16 == 4) instance_->settings.margin = 0.25 * bytes_.below(32);
    model_.touching = instance_->settings.touching = with % 4 != 3 || bytes_.below(3) > 0;
  }

  /// Makes all calls that the bytes ask for, then compares once more.
  void run() {
    while (!bytes_.empty()) step();
    starved_ = false;
    update();
    compare();
    look();
    if (!wraps()) ask_area();
  }

 private:
  bool wraps() const { return instance_->settings.wrap[0] > 0; }

  /// The pairs there must be. In a world that wraps around, those that a space finds which has just been made: that they
  /// are the right ones is known from tests with whole numbers.
  PairList expected() {
    if (!wraps()) return model_.pairs();
    auto fresh = open<D>(Technique::brute_force);
    fresh->settings = instance_->settings;
    for (u32 id : model_.ids()) {
      ::set(fresh->space, id, model_.at(id).data());
      const Rule& rule = model_.rule(id);
      fresh->space.filter(fresh->ids.slot(id), rule.layer, rule.mask);
      for (u32 bit : {u32(is_static), u32(is_red), u32(is_blue)}) {
        fresh->space.exclude(fresh->ids.slot(id), bit, rule.excluded & bit);
      }
      fresh->space.enable(fresh->ids.slot(id), !rule.is_off());
      fresh->space.put_in_group(fresh->ids.slot(id), model_.group(id));
      fresh->space.set_reach(fresh->ids.slot(id), model_.reach(id));
    }
    CHECK(fresh->space.update() == -1);
    return sorted_pairs(fresh->space);
  }

  void step() {
    u32 what = bytes_.below(32);
    // No questions are asked in a world that wraps around.
    if (wraps() && (what == 23 || (what >= 27 && what <= 29))) return update();
    switch (what) {
      default: return set(id(), box());
      case 7: return give();
      case 8:
      case 9:
      case 10: return remove(id());
      case 11: return replace_by_a_scene();
      case 12: return replace_by_few();
      case 13: return expose();
      case 14: return exclude();
      case 15: return clear();
      case 16: return starve();
      case 17: return reserve();
      case 18: return switch_technique();
      case 19: return look();
      case 20: return compare();
      case 21:
      case 22: return update();
      case 23: return ask_area(true);
      case 24: return filter();
      case 25: return save();
      case 26: return restore();
      case 27: return ask_area();
      case 28: return bytes_.below(3) ? ask_near() : ask_many();
      case 29: return ask_sweep();
      case 30: return ask_partners();
      case 31: return let_time_pass();
    }
  }

  /// Many updates in which little changes, which is when techniques come to keep what they have found: some boxes
  /// move on, now and then turn back; where the bytes say so, others are disturbed, and memory ends once.
  void let_time_pass() {
    update();
    if (spells_left_ == 0) return;
    spells_left_--;
    Random random(bytes_.next16());
    if (model_.count() < 250 || space_.pairs.count > most_boxes)
      replace(as_floats<D>(spread<D>(random, 250 + random.below(200), 0, D == 2 ? 200 : 60, 10)), false);
    u8 how = bytes_.next();
    bool in_place = how & 4, disturbed = how & 8;
    bool keeps = space_.technique >= Technique::aabb_tree || space_.technique == Technique::retained_grid;
    u32 updates = keeps ? 96 + bytes_.below(64) : 4, ends = how & 16 ? random.below(updates) : updates;
    u32 movers = how % 4 == 0 ? 0 : how % 4 == 1 ? 5 : how % 4 == 2 ? model_.count() / 10 : most_boxes;
    f64 speed = std::exp2(-f64(how >> 5));
    for (u32 k = 0; k < updates; k++) {
      testing::Where where("update " + std::to_string(k) + " of a spell");
      std::vector<u32> all = model_.ids();
      f32* boxes = in_place ? space_.expose(model_.count()) : nullptr;
      if (in_place) model_.expose(model_.count());
      for (u32 n = 0; n < smaller(movers, u32(all.size())); n++) {
        u32 id = in_place ? n : all[n];
        Box<D> box = model_.at(id);
        for (u32 a = 0; a < D; a++) {
          f64 step = (f64((id * 7 + a * 5) % 9) - 4) * speed * (k / 40 % 2 ? -1 : 1);
          box[a] += step;
          box[D + a] += step;
        }
        if (!in_place) {
          set(id, box);
          continue;
        }
        for (u32 w = 0; w < width; w++) {
          boxes[u64(id) * width + w] = outward(box[w], w >= D);
          box[w] = boxes[u64(id) * width + w];
        }
        model_.set(id, box);
      }
      if (disturbed && random.below(4) == 0) disturb(random);
      starved_ = k == ends;
      update(k % 16 == 15 || k + 1 == updates);
      if (space_.pairs.count > 8 * most_boxes) return update();
    }
  }

  /// One box comes, goes, jumps, stops being huge or becomes it, or gets another rule.
  void disturb(Random& random) {
    std::vector<u32> all = model_.ids();
    if (all.empty()) return;
    u32 someone = all[random.below(u32(all.size()))];
    f64 size = std::exp2(f64(random.below(9)));
    Box<D> box = box_of<D>([&](u32) { return Extent{f64(random.below(200)), size}; });
    switch (random.below(9)) {
      case 8: {
        u32 group = random.below(3);
        space_.put_in_group(ids_.slot(someone), group);
        f64 reach = random.below(3) == 0 ? 0.25 * random.below(8) : 0;
        space_.set_reach(ids_.slot(someone), reach);
        model_.set_reach(someone, reach);
        return model_.put_in_group(someone, group);
      }
      case 0: return set(model_.count(), box);
      case 1: return remove(someone);
      case 2:
      case 3: return set(someone, box);
      case 4: return set(someone, cube<D>(-std::numeric_limits<f64>::infinity(), box[D]));
      case 5: {
        u32 bit = u32(is_static) >> random.below(3);
        bool on = random.below(3) > 0;
        space_.exclude(ids_.slot(someone), bit, on);
        return model_.exclude(someone, bit, on);
      }
      case 6: {
        u32 layer = 1 + random.below(3), mask = 1 + random.below(7);
        space_.filter(ids_.slot(someone), layer, mask);
        return model_.filter(someone, layer, mask);
      }
      case 7: return set(someone, model_.at(all[random.below(u32(all.size()))]));
    }
  }

  /// Makes a call; returns whether there was memory for it. `recover` is what abi.cpp does after a trap. Where memory
  /// ended, `unmade` sees to it that nothing has changed.
  template <class Call> bool made(Call call) {
    return made(call, [&] { compare(); });
  }
  template <class Call, class Unmade> bool made(Call call, Unmade unmade) {
    const u64 limit = heap::limit;
    if (starved_) heap::limit = heap::used + 64 * u64(bytes_.next());
    bool ended = false;
    try {
      call();
    } catch (const Failure& failure) {
      ended = true;
      CHECK(failure.what == Fault::out_of_memory && failure.bytes > 0);
    }
    CHECK(!ended || starved_);
    heap::limit = limit;
    starved_ = false;
    if (!ended) return true;
    space_.recover();
    found_ = false;
    unsure_ = true;  // whether the questions see what this update saw, or what the one before did
    unmade();
    return false;
  }

  void set(u32 id, const Box<D>& box) {
    if (!model_.has(id) && model_.count() >= most_boxes) return;
    if (made([&] { ::set(space_, id, box.data()); })) model_.set(id, box);
  }

  void remove(u32 id) {
    bool was = false;
    if (made([&] { was = space_.remove(id); })) CHECK(was == model_.remove(id));
  }

  void replace(const Boxes<D>& boxes, bool doubles) {
    i32 bad = -1;
    if (!made([&] { bad = ::replace(space_, boxes, doubles); })) return;
    i32 expected = -1;
    for (u32 k = 0; k < boxes.size() && expected < 0; k++) {
      for (u32 a = 0; a < D; a++) {
        if (!(boxes[k][a] <= boxes[k][D + a])) expected = i32(k);
      }
    }
    CHECK(bad == expected);
    if (bad < 0) model_.replace(boxes);
  }

  void replace_by_a_scene() {
    const auto& all = scenes<D>();
    const Boxes<D>& boxes = all[bytes_.next() % all.size()].boxes;
    u32 count = smaller(u32(boxes.size()), bytes_.next16() % most_boxes);
    u32 from = count < boxes.size() ? bytes_.next16() % (u32(boxes.size()) - count) : 0;
    Boxes<D> some(boxes.begin() + from, boxes.begin() + from + count);
    bool doubles = bytes_.below(2);
    replace(doubles ? some : as_floats<D>(some), doubles);
  }

  void replace_by_few() {
    Boxes<D> boxes(bytes_.below(12));
    for (auto& each : boxes) each = box();
    if (!boxes.empty() && bytes_.below(8) == 0) boxes[bytes_.next() % boxes.size()] = bad_box();
    bool doubles = bytes_.below(2);
    replace(doubles ? boxes : as_floats<D>(boxes), doubles);
  }

  /// Writes some boxes in place; some of them bad, which only the next update says.
  void expose() {
    u32 count = bytes_.below(3) ? bytes_.below(40) : smaller(model_.count(), most_boxes);
    f32* boxes = nullptr;
    if (!made([&] { boxes = space_.expose(count); })) return;
    model_.expose(count);
    for (u32 k = bytes_.below(8); count > 0 && k > 0; k--) {
      u32 id = bytes_.next() % count;
      Box<D> given = box(), floats;
      for (u32 n = 0; n < width; n++) {
        boxes[id * width + n] = outward(given[n], n >= D);
        floats[n] = boxes[id * width + n];
      }
      model_.set(id, floats);
    }
    if (count > 0 && bytes_.below(4) == 0) write_bad(boxes, count);
  }

  /// Writes a bad box in place: the next update names it, wherever it stands by then, and changes nothing.
  void write_bad(f32* boxes, u32 count) {
    u32 bad = bytes_.next() % count, other = bytes_.next() % count;
    Box<D> good = model_.at(bad), wrong = bad_box();
    for (u32 n = 0; n < width; n++) boxes[bad * width + n] = f32(wrong[n]);
    if (other != bad) {
      if (bytes_.below(2)) remove(other);
      else set(other, box());
    }
    u64 pairs = space_.pairs.count;
    CHECK(space_.update() == i32(bad));
    CHECK(space_.pairs.count == pairs);
    u32 detail;
    CHECK(space_.validate(detail) == 0);
    set(bad, good);
  }

  void exclude() {
    if (model_.count() == 0) return;
    std::vector<u32> all = model_.ids();
    u32 id = all[bytes_.next16() % all.size()], which = bytes_.below(4),
        bit = which < 3 ? u32(is_static) >> which : Rule::off;
    bool on = bytes_.below(4) > 0;
    auto exclude = [&] {
      if (bit == Rule::off) space_.enable(ids_.slot(id), !on);
      else space_.exclude(ids_.slot(id), bit, on);
    };
    if (made(exclude)) model_.exclude(id, bit, on);
  }

  void clear() {
    space_.clear();
    model_.clear();
  }

  void reserve() {
    u32 count = bytes_.next16();
    made([&] { space_.reserve(count); });
  }

  void starve() { starved_ = true; }

  void switch_technique() { space_.technique = Technique(bytes_.below(technique_count)); }

  void filter() {
    static const u32 bits[] = {~0u, 1, 2, 3, 6, 0, 0x80000000};
    if (model_.count() == 0) return;
    u32 id = someone();
    u32 layer = bits[bytes_.next() % std::size(bits)], mask = bits[bytes_.next() % std::size(bits)];
    if (bytes_.below(8) == 0) layer = mask = 1u << bytes_.below(32) | bytes_.next();  // many kinds
    if (made([&] { space_.filter(ids_.slot(id), layer, mask); })) model_.filter(id, layer, mask);
  }

  void give() {
    Own own = Own::from(bytes_);
    if (model_.count() == 0) return;
    u32 id = someone();
    if (made([&] { own.give(space_, ids_.slot(id)); })) model_.put_in_group(id, own.group);
    if (made([&] { own.give_reach(space_, ids_.slot(id)); })) model_.set_reach(id, own.reach);
  }

  u32 someone() {
    std::vector<u32> all = model_.ids();
    return all[bytes_.next16() % all.size()];
  }

  void save() {
    if (!made([&] { CHECK(space_.save() == -1); })) return;
    const Snapshot& made = space_.snapshot;
    saved_ = Saved{{made.words(), made.words() + made.bytes() / 8}, model_, before_, space_.technique};
  }

  /// Goes back to what was saved; or tries to with other bytes, which must change nothing. Where memory ends, all is as it
  /// was, or the boxes are restored and there are no pairs.
  void restore() {
    if (!saved_) return;
    std::vector<u64> words = saved_->words;
    u8 how = bytes_.below(4);
    u64 size = words.size() * 8;
    u8* bytes = reinterpret_cast<u8*>(words.data());
    if (how == 1) bytes[bytes_.next16() % size] ^= u8(1u << bytes_.below(8));
    if (how == 2) size = bytes_.next16() % size;
    // Bytes of anybody's making behind a right checksum: what they say may be restored, but must be in order.
    if (how == 3) bytes[bytes_.next16() % size] = bytes_.next();
    SnapshotHeader head = {};
    __builtin_memcpy(&head, bytes, smaller(size, u64(sizeof(head))));
    SnapshotFault fault = SnapshotFault::none;
    // The technique tells whether anything was restored: meanwhile it is another than that of the snapshot.
    Technique mine = space_.technique,
              other = head.technique == u8(Technique::brute_force) ? Technique::automatic : Technique::brute_force;
    space_.technique = other;
    bool done = made(
        [&] {
          fault = space_.snapshot.stage(head, u32(size), D, built);
          if (fault != SnapshotFault::none) return;
          __builtin_memcpy(const_cast<u64*>(space_.snapshot.words()), bytes, size);
          if (how == 3) space_.snapshot.seal();
          fault = space_.restore();
          CHECK(how == 0 || how == 3 || fault != SnapshotFault::none);
          CHECK(how != 0 || fault == SnapshotFault::none);
        },
        [&] { CHECK(space_.technique == other || space_.pairs.count == 0); });
    if (space_.technique == other) {
      space_.technique = mine;
      return compare();
    }
    if (how == 3) {
      u32 detail;
      CHECK(space_.validate(detail) == 0);
      restored_others();
    } else {
      model_ = saved_->model;
      before_ = saved_->before;
      CHECK(space_.technique == saved_->technique);
      if (done) CHECK(sorted_pairs(space_) == expected());
    }
    seen_ = model_;
    updated_ = true;
    unsure_ = found_ = false;
    compare();
  }

  /// The model of what stands in the space, whatever it is.
  void restored_others() {
    bool touching = model_.touching;
    model_ = Model<D>();
    model_.touching = touching;
    Boxes<D> boxes;
    for (u32 s = 0; s < ids_.count(); s++) {
      Box<D> box;
      CHECK(space_.get(ids_.id(s), box.data()));
      model_.set(ids_.id(s), box);
    }
    // Filters and pairs before cannot be asked for: what they are shows in a space that saves again.
    CHECK(space_.save() == -1);
    CHECK(space_.update() == -1);
    u32 detail;
    CHECK(space_.validate(detail) == 0);
    for (u32 id : model_.ids()) {
      space_.filter(ids_.slot(id), ~0u, ~0u);
      for (u32 bit : {u32(is_static), u32(is_red), u32(is_blue)}) space_.exclude(ids_.slot(id), bit, false);
      space_.enable(ids_.slot(id), true);
      space_.put_in_group(ids_.slot(id), 0);
      space_.set_reach(ids_.slot(id), 0);
    }
    CHECK(space_.update() == -1);
    updated_ = true;
    before_ = expected();
    seen_ = model_;
  }

  void update(bool whole = true) {
    if (!made([&] { CHECK(space_.update() == -1); })) return;
    CHECK(space_.stats.pairs == f64(space_.pairs.count));
    CHECK(space_.stats.candidates >= space_.stats.pairs);
    CHECK(space_.stats.bytes == f64(heap::used));
    if (whole || space_.keeps_events) {
      PairList now = sorted_pairs(space_);
      if (whole) CHECK(now == expected());
      if (space_.keeps_events) check_events(now);
      before_ = now;
    }
    updated_ = found_ = true;
    model_.updated();
    seen_ = model_;
    unsure_ = false;
    if (space_.pairs.count > crowded && ++crowds_ > most_crowds) clear();
  }

  void check_events(const PairList& now) {
    CHECK(sorted(space_.events.began) == without(now, before_));
    CHECK(sorted(space_.events.ended) == without(before_, now));
  }

  /// What the one list has and the other one has not; pairs of boxes that were deleted in between count as another.
  PairList without(const PairList& list, PairList others) const {
    std::erase_if(others, [&](u64 pair) { return model_.is_gone(pair); });
    PairList rest;
    std::set_difference(list.begin(), list.end(), others.begin(), others.end(), std::back_inserter(rest));
    return rest;
  }

  static PairList sorted(const Pairs& pairs) {
    PairList list(pairs.list.data(), pairs.list.data() + pairs.count);
    std::sort(list.begin(), list.end());
    return list;
  }

  /// Asks; returns whether there was memory for it.
  template <class Ask> bool asked(Ask ask) {
    // A large space that was never asked may not know what the last update saw.
    if (unsure_ || (!asked_ && ids_.count() > 4000)) update();
    asked_ = true;
    bool done = made(ask);
    if (!done) {
      update();
      ask();
    }
    return done;
  }

  Question<D>& question() {
    Question<D>& question = space_.question;
    question = {};
    question.radius = -1;
    question.touching = bytes_.below(3) > 0;
    question.mask = bytes_.below(3) ? ~0u : bytes_.below(8);
    question.ignored = bytes_.below(3) ? ~0u : id();
    Box<D> given = box();
    for (u32 a = 0; a < D; a++) {
      question.lo[a] = given[a];
      question.hi[a] = given[D + a];
    }
    return question;
  }

  /// The ids that a question is about.
  std::vector<u32> eligible(const Question<D>& question) const {
    std::vector<u32> ids;
    if (!seen_) return ids;
    for (u32 id : seen_->ids()) {
      bool wanted = question.mask == ~0u || (seen_->rule(id).layer & question.mask);
      if (wanted && id != question.ignored && !seen_->rule(id).is_off()) ids.push_back(id);
    }
    return ids;
  }

  /// Makes it a question about a point.
  void from_a_point(Question<D>& asks) {
    for (u32 a = 0; a < D; a++) asks.lo[a] = asks.hi[a] = f64(bytes_.below(40));
  }

  /// From the point that is asked about to a box: without overflow.
  static f64 distance(const Question<D>& asks, const Box<D>& box) {
    f64 all = 0;
    for (u32 a = 0; a < D; a++) all = std::hypot(all, std::max({box[a] - asks.lo[a], asks.lo[a] - box[D + a], 0.0}));
    return all;
  }
  static f64 squared_distance(const Question<D>& asks, const Box<D>& box) {
    f64 sum = 0;
    for (u32 a = 0; a < D; a++) {
      f64 apart = std::max({box[a] - asks.lo[a], asks.lo[a] - box[D + a], 0.0});
      sum += apart * apart;
    }
    return sum;
  }

  void ask_area(bool is_circle = false) {
    Question<D> asks = question();
    if (is_circle) {
      from_a_point(asks);
      asks.radius = bytes_.below(8) ? bytes_.below(200) * 0.25 : std::numeric_limits<f64>::infinity();
    }
    std::vector<u32> answer;
    asked([&] {
      space_.question = asks;
      answer.clear();
      u32 from = 0, part = 7;  // in parts, as visitors are served
      for (;;) {
        u32 count = space_.ask_area(from, part);
        answer.insert(answer.end(), space_.answers.data(), space_.answers.data() + count);
        if (count < part) break;
      }
    });
    Box<D> box;
    for (u32 a = 0; a < D; a++) {
      box[a] = asks.lo[a];
      box[D + a] = asks.hi[a];
    }
    std::vector<u32> expected;
    for (u32 id : eligible(asks)) {
      const Box<D>& its = seen_->at(id);
      // Squares tell where they are exact; those of what is very far away overflow, which only an endless radius reaches.
      bool is_endless = asks.radius == std::numeric_limits<f64>::infinity();
      f64 far = is_endless ? distance(asks, its) : squared_distance(asks, its);
      f64 most = is_endless ? asks.radius : asks.radius * asks.radius;
      // A circle without size, where touching does not count, is a point.
      bool is_round = is_circle && (asks.touching || asks.radius > 0);
      bool within = !is_round       ? overlap(box.data(), its.data(), D, asks.touching)
                    : asks.touching ? far <= most
                                    : far < most;
      if (within) expected.push_back(id);
    }
    std::sort(answer.begin(), answer.end());
    CHECK(answer == expected);
  }

  /// Up to rounding: the nearest, in order.
  void ask_near() {
    const f64 tiny = 1e-150;  // the squares of less are not exact
    Question<D> asks = question();
    from_a_point(asks);
    asks.limit = bytes_.below(2) ? std::numeric_limits<f64>::infinity() : f64(bytes_.next()) * 4;
    u32 most = 1 + bytes_.below(64);
    std::vector<Hit> hits;
    asked([&] {
      space_.question = asks;
      u32 count = space_.ask_order(false, most, nullptr);
      hits.assign(space_.hits.data(), space_.hits.data() + count);
    });
    CHECK(hits.size() <= most);
    bool good = true;
    std::map<u32, f64> distances;
    for (u32 id : eligible(asks)) distances[id] = distance(asks, seen_->at(id));
    for (size_t k = 0; k < hits.size(); k++) {
      good &= k == 0 || hits[k - 1] < hits[k];
      good &= distances.count(hits[k].id) > 0;
      if (!good) break;
      f64 is = distances[hits[k].id];
      good &= is == hits[k].rank || std::fabs(is - hits[k].rank) <= 1e-12 * is + tiny;
      distances.erase(hits[k].id);
    }
    f64 last = hits.size() == most ? hits.back().rank : asks.limit;
    for (const auto& [id, left] : distances) good &= !(left < last * (1 - 1e-12));
    CHECK(good);
  }

  void ask_sweep() {
    Question<D> asks = question();
    for (u32 a = 0; a < D; a++) asks.along[a] = f64(bytes_.next()) - 128;
    asks.limit = asks.length = 1;
    std::vector<Hit> hits;
    asked([&] {
      space_.question = asks;
      u32 count = space_.ask_order(true, 3, nullptr);
      hits.assign(space_.hits.data(), space_.hits.data() + count);
    });
    std::vector<u32> ids = eligible(asks);
    bool good = hits.size() <= 3;
    for (const Hit& hit : hits) {
      good &= hit.rank >= 0 && hit.rank <= 1 && std::binary_search(ids.begin(), ids.end(), hit.id & ~Hit::corner);
    }
    CHECK(good);
  }

  /// Many questions in one call: each answered as if it were asked alone. Of all boxes: each, and none itself.
  void ask_many() {
    Question<D> common = question();
    common.limit = f64(bytes_.next());
    u32 count = bytes_.below(20), most = 1 + bytes_.below(8);
    std::vector<Box<D>> boxes;
    std::vector<u32> ignored;
    for (u32 k = 0; k < count; k++) {
      boxes.push_back(box());
      ignored.push_back(id());
    }
    bool good = true;
    asked([&] {
      space_.question = common;
      f64* to = space_.bulk.stage(count * (width + 1));
      for (u32 k = 0; k < count; k++) {
        std::copy(boxes[k].begin(), boxes[k].end(), to + k * width);
        to[count * width + k] = ignored[k];
      }
      good = space_.bulk.first_bad(Asks::box, count) == -1 && space_.ask_many(Asks::box, count, 0) == count;
      for (u32 k = 0; k < count; k++) {
        const u32* part = space_.bulk.offsets() + k;
        std::vector<u32> many(space_.bulk.ids.data() + part[0], space_.bulk.ids.data() + part[1]);
        space_.question = common;
        space_.question.ignored = ignored[k];
        std::copy_n(boxes[k].begin(), D, space_.question.lo);
        std::copy_n(boxes[k].begin() + D, D, space_.question.hi);
        u32 from = 0, alone = space_.ask_area(from, ~0u);
        good &= many == std::vector<u32>(space_.answers.data(), space_.answers.data() + alone);
      }
      space_.question = common;
      u32 all = space_.ask_many(Asks::others, 0, most);
      good &= all == (seen_ ? seen_->count() : 0);
      for (u32 k = 0; k < all; k++) {
        const u32* part = space_.bulk.offsets() + k;
        good &= part[1] - part[0] <= most;
        for (u32 n = part[0]; n < part[1]; n++) {
          const Hit& hit = space_.bulk.hits[n];
          good &= hit.rank <= common.limit && hit.id != space_.answers[k];
          good &= n == part[0] || space_.bulk.hits[n - 1] < hit;
        }
      }
    });
    CHECK(good);
  }

  void ask_partners() {
    if (!found_) return;
    u32 mine = model_.count() ? someone() : id();
    std::vector<u32> answer;
    if (!made([&] {
          u32 count = space_.partners(mine);
          answer.assign(space_.answers.data(), space_.answers.data() + count);
        })) {
      return;
    }
    std::sort(answer.begin(), answer.end());
    std::vector<u32> expected;
    for (u64 pair : before_) {
      if (u32(pair) == mine) expected.push_back(u32(pair >> 32));
      if (u32(pair >> 32) == mine) expected.push_back(u32(pair));
    }
    std::sort(expected.begin(), expected.end());
    CHECK(answer == expected);
    u32 other = expected.empty() ? id() : expected[bytes_.next() % expected.size()];
    bool met = false;
    if (made([&] { met = space_.is_pair(mine, other); })) CHECK(met == !expected.empty() || expected.empty());
  }

  /// The structure is made of boxes.
  void look() {
    if (!made([&] { space_.structure(); })) return;
    bool good = true;
    for (u64 c = 0; c < space_.cell_count; c++) {
      for (u32 a = 0; a < D; a++) good &= space_.cells[c * width + a] <= space_.cells[c * width + D + a];
    }
    CHECK(good);
  }

  void compare() {
    u32 detail;
    CHECK(space_.validate(detail) == 0);
    CHECK(ids_.count() == model_.count());
    bool same = true;
    for (u32 id : model_.ids()) {
      Box<D> held;
      same &= space_.get(id, held.data()) && held == model_.at(id);
      same &= space_.group(ids_.slot(id)) == model_.group(id);
      same &= space_.reach_of(ids_.slot(id)) == model_.reach(id);
    }
    CHECK(same);
    u32 other = id();
    CHECK((ids_.slot(other) != Ids::none) == model_.has(other));
  }

  u32 id() {
    u8 kind = bytes_.next();
    if (kind < 200) return kind % 100;
    if (kind < 230) return bytes_.next16();
    if (kind < 250) return model_.count() % max_slots;
    return (max_slots - 1 - bytes_.next()) % max_slots;
  }

  f64 number() {
    static const f64 special[] = {std::numeric_limits<f64>::infinity(),
                                  -std::numeric_limits<f64>::infinity(),
                                  std::numeric_limits<f64>::max(),
                                  -std::numeric_limits<f64>::max(),
                                  std::numeric_limits<f32>::max(),
                                  -std::numeric_limits<f32>::max(),
                                  1e39,
                                  -1e39,
                                  1e9,
                                  -1e9,
                                  1e-45,
                                  -1e-45,
                                  1e-320,
                                  -1e-320,
                                  -0.0,
                                  0.1};
    u8 kind = bytes_.next();
    if (kind < 128) return kind % 32;
    if (kind < 180) return (kind - 128) * 0.1;
    if (kind < 220) return f64(bytes_.next16()) * 0x1p-6;
    if (kind < 250) return special[kind % std::size(special)];
    f64 any = bits<f64>(bytes_.next64());
    return any == any ? any : 0;
  }

  Box<D> box() {
    Box<D> box;
    for (u32 a = 0; a < D; a++) {
      f64 one = number(), other = bytes_.below(4) ? one + bytes_.below(8) : number();
      box[a] = smaller(one, other);
      box[D + a] = larger(one, other);
    }
    return box;
  }

  Box<D> bad_box() {
    Box<D> bad = box();
    u32 k = bytes_.below(2 * width);
    if (k < width) {
      bad[k] = std::nan("");
    } else {
      bad[k % D] = 1;
      bad[D + k % D] = 0;
    }
    return bad;
  }
};

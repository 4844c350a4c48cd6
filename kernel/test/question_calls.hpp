// Queries, chosen by bytes: each answer must be the model's.
#pragma once
#include "around.hpp"
#include "trial.hpp"

template <int D> class QuestionCalls {
  static constexpr u32 width = 2 * D;

  Trial<D>& trial_;
  Bytes& bytes_;
  Ids& ids_;
  Space<D>& space_;
  Model<D>& model_;
  u8 flavour_ = 0;  // of the query: its kind among alike ones

 public:
  explicit QuestionCalls(Trial<D>& trial)
      : trial_(trial), bytes_(trial.bytes), ids_(trial.ids), space_(trial.space), model_(trial.model) {}

  void ask_area(bool is_circle = false) {
    Question<D> asks = question();
    if (!is_circle && flavour_ % 4 == 3) asks.radius = Question<D>::within;
    if (is_circle) {
      from_a_point(asks);
      asks.radius = bytes_.below(8) ? bytes_.below(200) * 0.25 : std::numeric_limits<f64>::infinity();
      if (flavour_ / 16 % 4 == 0) touch_someone(asks);
    }
    std::vector<u32> answer;
    trial_.asked([&] {
      space_.questions.asked = asks;
      answer.clear();
      u32 from = 0, part = flavour_ < 64 ? ~0u : flavour_ < 128 ? 7 : 100;  // in parts, as visitors are served
      for (;;) {
        u32 count = space_.questions.ask_area(from, part);
        answer.insert(answer.end(), space_.questions.answers.data(), space_.questions.answers.data() + count);
        if (count < part) break;
      }
    });
    Around<D> around(asks, world());
    std::vector<u32> ids = eligible(asks), expected;
    std::sort(answer.begin(), answer.end());
    CHECK(std::adjacent_find(answer.begin(), answer.end()) == answer.end());
    CHECK(std::includes(ids.begin(), ids.end(), answer.begin(), answer.end()));
    std::erase_if(answer, [&](u32 id) { return !can_decide(around, id); });
    for (u32 id : ids) {
      const f64* box = trial_.seen->at(id).data();
      if (can_decide(around, id) && is_within(around, asks, is_circle, box)) expected.push_back(id);
    }
    CHECK(answer == expected);
  }

  /// Up to rounding: the nearest, in order.
  void ask_near() {
    const f64 tiny = 1e-150;  // squares of smaller numbers are not exact
    Question<D> asks = question();
    from_a_point(asks);
    asks.limit = bytes_.below(2) ? std::numeric_limits<f64>::infinity() : f64(bytes_.next()) * 4;
    u32 most = 1 + bytes_.below(64);
    bool all;
    std::vector<Hit> hits = ask_in_order(asks, false, flavour_ % 4 == 3 ? 260 : most, all);
    Around<D> around(asks, world());
    bool good = true;
    std::map<u32, f64> distances;
    for (u32 id : eligible(asks)) {
      distances[id] = can_decide(around, id) ? around.distance(trial_.seen->at(id).data()) : 0;
    }
    for (size_t k = 0; k < hits.size(); k++) {
      good &= k == 0 || hits[k - 1] < hits[k];
      good &= distances.count(hits[k].id) > 0;
      if (!good) break;
      f64 is = distances[hits[k].id];
      bool same = is == hits[k].rank || std::fabs(is - hits[k].rank) <= 1e-12 * is + tiny;
      good &= same || !can_decide(around, hits[k].id);
      distances.erase(hits[k].id);
    }
    f64 last = all ? asks.limit : hits.back().rank;
    for (const auto& [id, left] : distances) good &= !(left < last * (1 - 1e-12)) || !can_decide(around, id);
    CHECK(good);
  }

  /// What a moving box or a ray meets first, in order.
  void ask_cast() {
    static const u32 parts[] = {1, 3, 64, 260};
    Question<D> asks = question();
    const bool is_ray = flavour_ % 2;
    for (u32 a = 0; a < D; a++) asks.along[a] = f64(bytes_.next()) - 128;
    asks.limit = 1;
    if (is_ray) {
      if (std::count(asks.along, asks.along + D, 0) == D) asks.along[0] = 1;
      for (u32 a = 0; a < D; a++) asks.hi[a] = asks.lo[a] = std::isfinite(asks.lo[a]) ? asks.lo[a] : 0;
      asks.limit = flavour_ % 8 > 4 ? std::numeric_limits<f64>::infinity() : flavour_;
    }
    asks.measure_way(is_ray);
    bool all;
    std::vector<Hit> hits = ask_in_order(asks, true, parts[flavour_ / 16 % 4], all);
    Around<D> around(asks, world());
    std::vector<u32> ids = eligible(asks);
    std::vector<std::vector<Hit>> expected;  // of each box its first hits
    for (u32 id : ids) {
      if (!can_decide(around, id)) continue;
      std::vector<Hit> first = around.hits(trial_.seen->at(id), id);
      if (!first.empty()) expected.push_back(first);
    }
    std::sort(expected.begin(), expected.end(), [](const auto& one, const auto& other) { return one[0] < other[0]; });
    bool good = true;
    size_t known = 0;
    for (size_t k = 0; k < hits.size() && good; k++) {
      const Hit& hit = hits[k];
      u32 id = hit.id & ~Hit::corner;
      good &= (k == 0 || hits[k - 1] < hit) && hit.rank >= 0 && std::binary_search(ids.begin(), ids.end(), id);
      if (!good || !can_decide(around, id)) continue;
      good &= known < expected.size() && contains(expected[known], hit);
      known++;
    }
    bool rest = all ? known == expected.size() : known == expected.size() || !(expected[known][0] < hits.back());
    CHECK(good && rest);
  }

  /// Many queries in one call: each is answered as if it were made alone. For all boxes: each asks, and none finds
  /// itself.
  void ask_many() {
    static const Asks kinds[] = {Asks::box,    Asks::box,     Asks::within, Asks::point,
                                 Asks::circle, Asks::nearest, Asks::ray,    Asks::way};
    Question<D> common = question();
    Asks kind = kinds[flavour_ % 8];
    common.limit = f64(bytes_.next());
    u32 count = bytes_.below(20), most = 1 + bytes_.below(8);
    std::vector<Question<D>> asks;
    for (u32 k = 0; k < count; k++) {
      Box<D> box = any_box<D>(bytes_);
      asks.push_back(common);
      std::copy_n(box.begin(), D, asks[k].lo);
      std::copy_n(box.begin() + D, D, asks[k].hi);
      asks[k].ignored = trial_.id();
    }
    bool good = true;
    trial_.asked([&] {
      good = answers_agree(kind, common, asks, most);
      if (count) good &= casts_agree(common, asks);
      space_.questions.asked = common;
      u32 all = space_.questions.ask_many(Asks::others, 0, most);
      good &= all == (trial_.seen ? trial_.seen->count() : 0);
      for (u32 k = 0; k < all; k++) good &= is_like_near(k, common, most);
    });
    CHECK(good);
  }

  void ask_partners() {
    if (!trial_.found) return;
    u32 mine = model_.count() ? trial_.someone() : trial_.id();
    std::vector<u32> answer;
    if (!trial_.made([&] {
          u32 count = space_.partners(mine);
          answer.assign(space_.questions.answers.data(), space_.questions.answers.data() + count);
        })) {
      return;
    }
    std::sort(answer.begin(), answer.end());
    std::vector<u32> expected;
    for (u64 pair : trial_.before) {
      if (u32(pair) == mine) expected.push_back(u32(pair >> 32));
      if (u32(pair >> 32) == mine) expected.push_back(u32(pair));
    }
    std::sort(expected.begin(), expected.end());
    CHECK(answer == expected);
    u32 other = expected.empty() ? trial_.id() : expected[bytes_.next() % expected.size()];
    bool met = false;
    if (trial_.made([&] { met = space_.is_pair(mine, other); })) CHECK(met == !expected.empty() || expected.empty());
  }

  /// The structure consists of boxes.
  void look() {
    if (!trial_.made([&] { space_.structure(); })) return;
    bool good = true;
    for (u64 c = 0; c < space_.finder.cell_count; c++) {
      for (u32 a = 0; a < D; a++) good &= space_.finder.cells[c * width + a] <= space_.finder.cells[c * width + D + a];
    }
    CHECK(good);
  }

 private:
  Question<D>& question() {
    Question<D>& question = space_.questions.asked;
    question = {};
    question.radius = -1;
    flavour_ = bytes_.next();
    question.touching = flavour_ % 3 > 0;
    question.mask = bytes_.below(3) ? ~0u : bytes_.below(8);
    question.ignored = bytes_.below(3) ? ~0u : trial_.id();
    Box<D> given = any_box<D>(bytes_);
    for (u32 a = 0; a < D; a++) {
      question.lo[a] = given[a];
      question.hi[a] = given[D + a];
    }
    return question;
  }

  static bool has_box(Asks kind) { return kind == Asks::box || kind == Asks::within || kind == Asks::way; }
  static bool moves(Asks kind) { return kind == Asks::ray || kind == Asks::way; }

  /// Stages queries, made from these as their kind requires, and asks them.
  bool stage(Asks kind, std::vector<Question<D>>& asks) {
    std::vector<f64> numbers;
    for (Question<D>& one : asks) {
      bool is_zero = true;
      for (u32 a = 0; a < D; a++) {
        if (!has_box(kind)) one.lo[a] = one.hi[a] = std::isfinite(one.lo[a]) ? one.lo[a] : 1;
        is_zero &= one.along[a] == 0;
      }
      if (is_zero && kind == Asks::ray) one.along[0] = 1;
      if (kind == Asks::circle) one.radius = smaller(std::fabs(one.hi[0]), 40.0);
      if (kind == Asks::within) one.radius = Question<D>::within;
      if (kind == Asks::way) one.limit = 1;
      numbers.insert(numbers.end(), one.lo, one.lo + D);
      if (has_box(kind)) numbers.insert(numbers.end(), one.hi, one.hi + D);
      if (moves(kind)) numbers.insert(numbers.end(), one.along, one.along + D);
      if (kind == Asks::circle) numbers.push_back(one.radius);
      one.measure_way(kind == Asks::ray);
    }
    for (const Question<D>& one : asks) numbers.push_back(one.ignored);
    std::copy(numbers.begin(), numbers.end(), space_.questions.bulk.stage(u32(numbers.size())));
    return space_.questions.bulk.first_bad(kind, u32(asks.size())) == -1;
  }

  /// Whether queries in one call are answered as each is alone.
  bool answers_agree(Asks kind, const Question<D>& common, std::vector<Question<D>> asks, u32 most) {
    if (moves(kind)) most = 1;
    bool good = stage(kind, asks);
    space_.questions.asked = common;
    if (kind == Asks::way) space_.questions.asked.limit = 1;
    good = good && space_.questions.ask_many(kind, u32(asks.size()), most) == asks.size();
    for (u32 k = 0; k < asks.size() && good; k++) {
      u32 from = space_.questions.bulk.offsets()[k], count = space_.questions.bulk.offsets()[k + 1] - from, resume = 0;
      space_.questions.asked = asks[k];
      if (moves(kind) || kind == Asks::nearest) {
        good = space_.questions.ask_order(moves(kind), most, nullptr) == count;
        const Hit *many = space_.questions.bulk.hits.data() + from, *alone = space_.questions.hits.data();
        good = good && std::equal(many, many + count, alone, is_same);
      } else {
        good = space_.questions.ask_area(resume, ~0u) == count;
        const u32 *many = space_.questions.bulk.ids.data() + from, *alone = space_.questions.answers.data();
        good = good && std::equal(many, many + count, alone);
      }
    }
    return good;
  }

  /// The same for many rays, or boxes that move from one of these places to others.
  bool casts_agree(const Question<D>& common, const std::vector<Question<D>>& places) {
    constexpr f64 far = 200;  // in a world that wraps around, each turn of a path takes time
    std::vector<Question<D>> asks;
    for (u32 k = 0; k < 150; k++) {
      const Question<D>&from = places[k % places.size()], &other = places[k * k % places.size()];
      asks.push_back(from);
      for (u32 a = 0; a < D; a++) {
        f64 along = k % 3 ? (other.lo[a] - from.lo[a]) * 3 : 50.0 * (a == k % D);
        asks[k].along[a] = !std::isfinite(along) ? 1 : trial_.wraps() ? smaller(larger(along, -far), far) : along;
      }
    }
    return answers_agree(flavour_ / 8 % 2 ? Asks::ray : Asks::way, common, asks, 1);
  }

  /// Whether the k-th box found its neighbours, which are those that a single query finds.
  bool is_like_near(u32 k, Question<D> asks, u32 most) {
    constexpr u32 compared = 8;
    const u32 id = space_.questions.answers[k], from = space_.questions.bulk.offsets()[k];
    const Hit* many = space_.questions.bulk.hits.data() + from;
    u32 count = space_.questions.bulk.offsets()[k + 1] - from;
    bool good = count <= most;
    for (u32 n = 0; n < count; n++) {
      good &= many[n].rank <= asks.limit && many[n].id != id;
      good &= n == 0 || many[n - 1] < many[n];
    }
    if (k >= compared || !good) return good;
    if (trial_.seen->rule(id).is_off()) return count == 0;
    std::copy_n(trial_.seen->at(id).begin(), D, asks.lo);
    std::copy_n(trial_.seen->at(id).begin() + D, D, asks.hi);
    asks.ignored = id;
    space_.questions.asked = asks;
    return space_.questions.ask_order(false, most, nullptr) == count &&
           std::equal(many, many + count, space_.questions.hits.data(), is_same);
  }

  static bool is_same(const Hit& one, const Hit& other) {
    return one.rank == other.rank && one.id == other.id && one.side == other.side;
  }
  static bool contains(const std::vector<Hit>& hits, const Hit& hit) {
    return std::any_of(hits.begin(), hits.end(), [&](const Hit& one) { return is_same(one, hit); });
  }

  /// Hits in order, at most `most` in each part, which continues after the last hit of the one before, as visitors are
  /// served. `all`: whether there are no more.
  std::vector<Hit> ask_in_order(const Question<D>& asks, bool moving, u32 most, bool& all) {
    std::vector<Hit> hits;
    trial_.asked([&] {
      hits.clear();
      all = false;
      for (u32 part = 0; part < 5 && !all; part++) {
        space_.questions.asked = asks;
        Hit last = hits.empty() ? Hit{} : hits.back();
        u32 count = space_.questions.ask_order(moving, most, hits.empty() ? nullptr : &last);
        CHECK(count <= most);
        hits.insert(hits.end(), space_.questions.hits.data(), space_.questions.hits.data() + count);
        all = count < most;
      }
    });
    return hits;
  }

  /// Makes a circle as large as the distance to a box.
  void touch_someone(Question<D>& asks) const {
    if (!trial_.seen || trial_.seen->count() == 0) return;
    std::vector<u32> ids = trial_.seen->ids();
    u32 id = ids[flavour_ % ids.size()];
    Around<D> around(asks, world());
    if (can_decide(around, id)) asks.radius = around.distance(trial_.seen->at(id).data());
  }

  const f64* world() const { return trial_.instance->options.wrap; }

  bool can_decide(const Around<D>& around, u32 id) const {
    return around.can_decide() && around.can_decide(trial_.seen->at(id).data());
  }

  /// Whether a box touches an area, or is within it.
  static bool is_within(const Around<D>& around, const Question<D>& asks, bool is_circle, const f64* box) {
    // A circle of radius 0 is a point if touching does not count.
    bool is_round = is_circle && (asks.touching || asks.radius > 0);
    if (!is_round) return around.touches(box, asks.radius == Question<D>::within);
    // Compares squares if they are exact. Those of very distant boxes overflow: only an infinite radius reaches them.
    bool is_endless = asks.radius == std::numeric_limits<f64>::infinity();
    f64 away = is_endless ? around.distance(box) : around.squared_distance(box);
    f64 most = is_endless ? asks.radius : asks.radius * asks.radius;
    return asks.touching ? away <= most : away < most;
  }

  /// The ids that a query asks for.
  std::vector<u32> eligible(const Question<D>& question) const {
    std::vector<u32> ids;
    if (!trial_.seen) return ids;
    for (u32 id : trial_.seen->ids()) {
      bool wanted = question.mask == ~0u || (trial_.seen->rule(id).layer & question.mask);
      if (wanted && id != question.ignored && !trial_.seen->rule(id).is_off()) ids.push_back(id);
    }
    return ids;
  }

  /// Makes it a query at a point.
  void from_a_point(Question<D>& asks) {
    for (u32 a = 0; a < D; a++) asks.lo[a] = asks.hi[a] = trial_.wraps() ? bytes_.next() * 4.0 - 512 : bytes_.below(40);
  }
};

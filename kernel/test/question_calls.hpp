// Queries, chosen by bytes: each answer must be the model's.
#pragma once
#include "trial.hpp"

template <int D> class QuestionCalls {
  static constexpr u32 width = 2 * D;

  Trial<D>& trial_;
  Bytes& bytes_;
  Ids& ids_;
  Space<D>& space_;
  Model<D>& model_;

 public:
  explicit QuestionCalls(Trial<D>& trial)
      : trial_(trial), bytes_(trial.bytes), ids_(trial.ids), space_(trial.space), model_(trial.model) {}

  void ask_area(bool is_circle = false) {
    Question<D> asks = question();
    if (is_circle) {
      from_a_point(asks);
      asks.radius = bytes_.below(8) ? bytes_.below(200) * 0.25 : std::numeric_limits<f64>::infinity();
    }
    std::vector<u32> answer;
    trial_.asked([&] {
      space_.questions.asked = asks;
      answer.clear();
      u32 from = 0, part = 7;  // in parts, as visitors are served
      for (;;) {
        u32 count = space_.questions.ask_area(from, part);
        answer.insert(answer.end(), space_.questions.answers.data(), space_.questions.answers.data() + count);
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
      const Box<D>& its = trial_.seen->at(id);
      // Compares squares if they are exact. Those of very distant boxes overflow: only an infinite radius reaches them.
      bool is_endless = asks.radius == std::numeric_limits<f64>::infinity();
      f64 far = is_endless ? distance(asks, its) : squared_distance(asks, its);
      f64 most = is_endless ? asks.radius : asks.radius * asks.radius;
      // A circle of radius 0 is a point if touching does not count.
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
    const f64 tiny = 1e-150;  // squares of smaller numbers are not exact
    Question<D> asks = question();
    from_a_point(asks);
    asks.limit = bytes_.below(2) ? std::numeric_limits<f64>::infinity() : f64(bytes_.next()) * 4;
    u32 most = 1 + bytes_.below(64);
    std::vector<Hit> hits;
    trial_.asked([&] {
      space_.questions.asked = asks;
      u32 count = space_.questions.ask_order(false, most, nullptr);
      hits.assign(space_.questions.hits.data(), space_.questions.hits.data() + count);
    });
    CHECK(hits.size() <= most);
    bool good = true;
    std::map<u32, f64> distances;
    for (u32 id : eligible(asks)) distances[id] = distance(asks, trial_.seen->at(id));
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
    trial_.asked([&] {
      space_.questions.asked = asks;
      u32 count = space_.questions.ask_order(true, 3, nullptr);
      hits.assign(space_.questions.hits.data(), space_.questions.hits.data() + count);
    });
    std::vector<u32> ids = eligible(asks);
    bool good = hits.size() <= 3;
    for (const Hit& hit : hits) {
      good &= hit.rank >= 0 && hit.rank <= 1 && std::binary_search(ids.begin(), ids.end(), hit.id & ~Hit::corner);
    }
    CHECK(good);
  }

  /// Many queries in one call: each is answered as if it were made alone. For all boxes: each asks, and none finds
  /// itself.
  void ask_many() {
    Question<D> common = question();
    common.limit = f64(bytes_.next());
    u32 count = bytes_.below(20), most = 1 + bytes_.below(8);
    std::vector<Box<D>> boxes;
    std::vector<u32> ignored;
    for (u32 k = 0; k < count; k++) {
      boxes.push_back(any_box<D>(bytes_));
      ignored.push_back(trial_.id());
    }
    bool good = true;
    trial_.asked([&] {
      space_.questions.asked = common;
      f64* to = space_.questions.bulk.stage(count * (width + 1));
      for (u32 k = 0; k < count; k++) {
        std::copy(boxes[k].begin(), boxes[k].end(), to + k * width);
        to[count * width + k] = ignored[k];
      }
      good = space_.questions.bulk.first_bad(Asks::box, count) == -1 &&
             space_.questions.ask_many(Asks::box, count, 0) == count;
      for (u32 k = 0; k < count; k++) {
        const u32* part = space_.questions.bulk.offsets() + k;
        std::vector<u32> many(space_.questions.bulk.ids.data() + part[0], space_.questions.bulk.ids.data() + part[1]);
        space_.questions.asked = common;
        space_.questions.asked.ignored = ignored[k];
        std::copy_n(boxes[k].begin(), D, space_.questions.asked.lo);
        std::copy_n(boxes[k].begin() + D, D, space_.questions.asked.hi);
        u32 from = 0, alone = space_.questions.ask_area(from, ~0u);
        good &= many == std::vector<u32>(space_.questions.answers.data(), space_.questions.answers.data() + alone);
      }
      if (count) good &= casts_agree(common, boxes, ignored);
      space_.questions.asked = common;
      u32 all = space_.questions.ask_many(Asks::others, 0, most);
      good &= all == (trial_.seen ? trial_.seen->count() : 0);
      for (u32 k = 0; k < all; k++) {
        const u32* part = space_.questions.bulk.offsets() + k;
        good &= part[1] - part[0] <= most;
        for (u32 n = part[0]; n < part[1]; n++) {
          const Hit& hit = space_.questions.bulk.hits[n];
          good &= hit.rank <= common.limit && hit.id != space_.questions.answers[k];
          good &= n == part[0] || space_.questions.bulk.hits[n - 1] < hit;
        }
      }
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
    question.touching = bytes_.below(3) > 0;
    question.mask = bytes_.below(3) ? ~0u : bytes_.below(8);
    question.ignored = bytes_.below(3) ? ~0u : trial_.id();
    Box<D> given = any_box<D>(bytes_);
    for (u32 a = 0; a < D; a++) {
      question.lo[a] = given[a];
      question.hi[a] = given[D + a];
    }
    return question;
  }

  /// Whether boxes that move from one of these places to others meet in one call what each meets alone.
  bool casts_agree(const Question<D>& common, const std::vector<Box<D>>& boxes, const std::vector<u32>& ignored) {
    constexpr u32 stride = 3 * D, count = 150;
    std::vector<Question<D>> asks(count, common);
    f64* to = space_.questions.bulk.stage(count * (stride + 1));
    for (u32 k = 0; k < count; k++) {
      const Box<D>&from = boxes[k % boxes.size()], &other = boxes[k * k % boxes.size()];
      std::copy_n(from.begin(), D, asks[k].lo);
      std::copy_n(from.begin() + D, D, asks[k].hi);
      for (u32 a = 0; a < D; a++) {
        f64 along = k % 3 ? (other[a] - from[a]) * 3 : 50.0 * (a == k % D);
        asks[k].along[a] = std::isfinite(along) ? along : 1;
      }
      asks[k].ignored = ignored[k % boxes.size()];
      asks[k].limit = 1;
      asks[k].measure_way(false);
      std::copy_n(asks[k].lo, D, to + k * stride);
      std::copy_n(asks[k].hi, D, to + k * stride + D);
      std::copy_n(asks[k].along, D, to + k * stride + 2 * D);
      to[count * stride + k] = asks[k].ignored;
    }
    space_.questions.asked = common;
    space_.questions.asked.limit = 1;
    bool good = space_.questions.bulk.first_bad(Asks::way, count) == -1 &&
                space_.questions.ask_many(Asks::way, count, 1) == count;
    for (u32 k = 0; k < count && good; k++) {
      u32 at = space_.questions.bulk.offsets()[k], many = space_.questions.bulk.offsets()[k + 1] - at;
      space_.questions.asked = asks[k];
      good = space_.questions.ask_order(true, 1, nullptr) == many;
      if (!many || !good) continue;
      const Hit &one = space_.questions.hits.data()[0], &hit = space_.questions.bulk.hits[at];
      good = one.rank == hit.rank && one.id == hit.id && one.side == hit.side;
    }
    return good;
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
    for (u32 a = 0; a < D; a++) asks.lo[a] = asks.hi[a] = f64(bytes_.below(40));
  }

  /// The distance from the query's point to a box, without overflow.
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
};

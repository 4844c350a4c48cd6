// Calls that change the contents of a space, chosen by bytes.
#pragma once
#include "scenes.hpp"
#include "trial.hpp"

template <int D> class ChangeCalls {
  static constexpr u32 width = 2 * D;

  Trial<D>& trial_;
  Bytes& bytes_;
  Ids& ids_;
  Space<D>& space_;
  Model<D>& model_;

 public:
  explicit ChangeCalls(Trial<D>& trial)
      : trial_(trial), bytes_(trial.bytes), ids_(trial.ids), space_(trial.space), model_(trial.model) {}

  void set(u32 id, const Box<D>& box) {
    if (!model_.has(id) && model_.count() >= Trial<D>::most_boxes) return;
    if (trial_.made([&] { ::set(space_, id, box.data()); })) model_.set(id, box);
  }

  void remove(u32 id) {
    bool was = false;
    if (trial_.made([&] { was = space_.store.remove(id); })) CHECK(was == model_.remove(id));
  }

  void replace(const Boxes<D>& boxes, bool doubles) {
    i32 bad = -1;
    if (!trial_.made([&] { bad = ::replace(space_, boxes, doubles); })) return;
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
    u32 count = smaller(u32(boxes.size()), bytes_.next16() % Trial<D>::most_boxes);
    u32 from = count < boxes.size() ? bytes_.next16() % (u32(boxes.size()) - count) : 0;
    Boxes<D> some(boxes.begin() + from, boxes.begin() + from + count);
    bool doubles = bytes_.below(2);
    replace(doubles ? some : as_floats<D>(some), doubles);
  }

  void replace_by_few() {
    Boxes<D> boxes(bytes_.below(12));
    for (auto& each : boxes) each = any_box<D>(bytes_);
    if (!boxes.empty() && bytes_.below(8) == 0) boxes[bytes_.next() % boxes.size()] = bad_box<D>(bytes_);
    bool doubles = bytes_.below(2);
    replace(doubles ? boxes : as_floats<D>(boxes), doubles);
  }

  /// Writes some boxes in place. Some of them are bad, which only the next update reports.
  void expose() {
    u32 count = bytes_.below(3) ? bytes_.below(40) : smaller(model_.count(), Trial<D>::most_boxes);
    f32* boxes = nullptr;
    if (!trial_.made([&] { boxes = space_.store.expose(count); })) return;
    model_.expose(count);
    for (u32 k = bytes_.below(8); count > 0 && k > 0; k--) {
      u32 id = bytes_.next() % count;
      Box<D> given = any_box<D>(bytes_), floats;
      for (u32 n = 0; n < width; n++) {
        boxes[id * width + n] = outward(given[n], n >= D);
        floats[n] = boxes[id * width + n];
      }
      model_.set(id, floats);
    }
    if (count > 0 && bytes_.below(4) == 0) write_bad(boxes, count);
  }

  void exclude() {
    if (model_.count() == 0) return;
    std::vector<u32> all = model_.ids();
    u32 id = all[bytes_.next16() % all.size()], which = bytes_.below(4),
        bit = which < 3 ? u32(is_static) >> which : Rule::off;
    bool on = bytes_.below(4) > 0;
    auto exclude = [&] {
      if (bit == Rule::off) space_.store.enable(ids_.slot(id), !on);
      else space_.store.exclude(ids_.slot(id), bit, on);
    };
    if (trial_.made(exclude)) model_.exclude(id, bit, on);
  }

  void reserve() {
    u32 count = bytes_.next16();
    trial_.made([&] { space_.store.reserve(count); });
  }

  void filter() {
    static const u32 bits[] = {~0u, 1, 2, 3, 6, 0, 0x80000000};
    if (model_.count() == 0) return;
    u32 id = trial_.someone();
    u32 layer = bits[bytes_.next() % std::size(bits)], mask = bits[bytes_.next() % std::size(bits)];
    if (bytes_.below(8) == 0) layer = mask = 1u << bytes_.below(32) | bytes_.next();  // many kinds
    if (trial_.made([&] { space_.store.filter(ids_.slot(id), layer, mask); })) model_.filter(id, layer, mask);
  }

  void give() {
    Given own = Given::from(bytes_);
    if (model_.count() == 0) return;
    u32 id = trial_.someone();
    if (trial_.made([&] { own.give(space_, ids_.slot(id)); })) model_.put_in_group(id, own.group);
    if (trial_.made([&] { own.give_reach(space_, ids_.slot(id)); })) model_.set_reach(id, own.reach);
  }

  /// One box is added, deleted, jumps, becomes huge or stops being so, or gets another rule.
  void disturb(Random& random) {
    std::vector<u32> all = model_.ids();
    if (all.empty()) return;
    u32 someone = all[random.below(u32(all.size()))];
    f64 size = std::exp2(f64(random.below(9)));
    Box<D> box = box_of<D>([&](u32) { return Extent{f64(random.below(200)), size}; });
    switch (random.below(9)) {
      case 8: {
        u32 group = random.below(3);
        space_.store.put_in_group(ids_.slot(someone), group);
        f64 reach = random.below(3) == 0 ? 0.25 * random.below(8) : 0;
        space_.store.set_reach(ids_.slot(someone), reach);
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
        space_.store.exclude(ids_.slot(someone), bit, on);
        return model_.exclude(someone, bit, on);
      }
      case 6: {
        u32 layer = 1 + random.below(3), mask = 1 + random.below(7);
        space_.store.filter(ids_.slot(someone), layer, mask);
        return model_.filter(someone, layer, mask);
      }
      case 7: return set(someone, model_.at(all[random.below(u32(all.size()))]));
    }
  }

 private:
  /// Writes a bad box in place: the next update names it, whichever slot it is in by then, and changes nothing.
  void write_bad(f32* boxes, u32 count) {
    u32 bad = bytes_.next() % count, other = bytes_.next() % count;
    Box<D> good = model_.at(bad), wrong = bad_box<D>(bytes_);
    for (u32 n = 0; n < width; n++) boxes[bad * width + n] = f32(wrong[n]);
    if (other != bad) {
      if (bytes_.below(2)) remove(other);
      else set(other, any_box<D>(bytes_));
    }
    u64 pairs = space_.pairs.count;
    CHECK(space_.update() == i32(bad));
    CHECK(space_.pairs.count == pairs);
    u32 detail;
    CHECK(space_.validate(detail) == Broken::nothing);
    set(bad, good);
  }
};

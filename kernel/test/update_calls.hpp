// Runs of updates, and snapshots to restore, chosen by bytes.
#pragma once
#include "change_calls.hpp"

template <int D> class UpdateCalls {
  static constexpr u32 width = 2 * D;

  ChangeCalls<D>& changes_;
  Trial<D>& trial_;
  Bytes& bytes_;
  Ids& ids_;
  Space<D>& space_;
  Model<D>& model_;

  /// A snapshot, and the model of the space it was taken of.
  struct Saved {
    std::vector<u64> words;
    Model<D> model;
    PairList before;
    Technique technique;
  };
  std::optional<Saved> saved_;

 public:
  u32 spells_left = 0;  // runs of updates left to make

  UpdateCalls(Trial<D>& trial, ChangeCalls<D>& changes)
      : changes_(changes),
        trial_(trial),
        bytes_(trial.bytes),
        ids_(trial.ids),
        space_(trial.space),
        model_(trial.model) {}

  /// Many updates in which little changes, so that techniques retain what they find. Some boxes move on, and turn back
  /// now and then. If the bytes say so, others are disturbed, and memory runs out once.
  void let_time_pass() {
    trial_.update();
    if (spells_left == 0) return;
    spells_left--;
    Random random(bytes_.next16());
    if (model_.count() < 250 || space_.pairs.count > Trial<D>::most_boxes)
      changes_.replace(as_floats<D>(spread<D>(random, 250 + random.below(200), 0, D == 2 ? 200 : 60, 10)), false);
    u8 how = bytes_.next();
    bool in_place = how & 4, disturbed = how & 8;
    bool keeps = space_.technique >= Technique::aabb_tree || space_.technique == Technique::retained_grid;
    u32 updates = keeps ? 96 + bytes_.below(64) : 4, ends = how & 16 ? random.below(updates) : updates;
    u32 movers = how % 4 == 0 ? 0 : how % 4 == 1 ? 5 : how % 4 == 2 ? model_.count() / 10 : Trial<D>::most_boxes;
    f64 speed = std::exp2(-f64(how >> 5));
    for (u32 k = 0; k < updates; k++) {
      testing::Where where("update " + std::to_string(k) + " of a spell");
      std::vector<u32> all = model_.ids();
      f32* boxes = in_place ? space_.store.expose(model_.count()) : nullptr;
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
          changes_.set(id, box);
          continue;
        }
        for (u32 w = 0; w < width; w++) {
          boxes[u64(id) * width + w] = outward(box[w], w >= D);
          box[w] = boxes[u64(id) * width + w];
        }
        model_.set(id, box);
      }
      if (disturbed && random.below(4) == 0) changes_.disturb(random);
      trial_.starved = k == ends;
      trial_.update(k % 16 == 15 || k + 1 == updates);
      if (space_.pairs.count > 8 * Trial<D>::most_boxes) return trial_.update();
    }
  }

  void save() {
    if (!trial_.made([&] { CHECK(space_.save() == -1); })) return;
    const Snapshot& made = space_.snapshot;
    saved_ = Saved{{made.words(), made.words() + made.bytes() / 8}, model_, trial_.before, space_.technique};
  }

  /// Restores a snapshot; or tries to restore other bytes, which must change nothing. If memory runs out, nothing has
  /// changed, or the boxes are restored and there are no pairs.
  void restore() {
    if (!saved_) return;
    std::vector<u64> words = saved_->words;
    u8 how = bytes_.below(4);
    u64 size = words.size() * 8;
    u8* bytes = reinterpret_cast<u8*>(words.data());
    if (how == 1) bytes[bytes_.next16() % size] ^= u8(1u << bytes_.below(8));
    if (how == 2) size = bytes_.next16() % size;
    // Arbitrary bytes with a correct checksum: they may be restored, but then the space must be valid.
    if (how == 3) bytes[bytes_.next16() % size] = bytes_.next();
    SnapshotHeader head = {};
    __builtin_memcpy(&head, bytes, smaller(size, u64(sizeof(head))));
    SnapshotFault fault = SnapshotFault::none;
    // The technique shows whether anything was restored: until then it differs from that of the snapshot.
    Technique mine = space_.technique,
              other = head.technique == u8(Technique::brute_force) ? Technique::automatic : Technique::brute_force;
    space_.technique = other;
    bool done = trial_.made(
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
      return trial_.compare();
    }
    if (how == 3) {
      u32 detail;
      CHECK(space_.validate(detail) == Broken::nothing);
      restored_others();
    } else {
      model_ = saved_->model;
      trial_.before = saved_->before;
      CHECK(space_.technique == saved_->technique);
      if (done) CHECK(sorted_pairs(space_) == trial_.expected());
    }
    trial_.seen = model_;
    trial_.updated = true;
    trial_.unsure = trial_.found = false;
    trial_.compare();
  }

 private:
  /// A model of the present contents of the space.
  void restored_others() {
    bool touching = model_.touching;
    model_ = Model<D>();
    model_.touching = touching;
    Boxes<D> boxes;
    for (u32 s = 0; s < ids_.count(); s++) {
      Box<D> box;
      CHECK(space_.store.get(ids_.id(s), box.data()));
      model_.set(ids_.id(s), box);
    }
    // Filters and the previous pairs cannot be read: saving again shows them.
    CHECK(space_.save() == -1);
    CHECK(space_.update() == -1);
    u32 detail;
    CHECK(space_.validate(detail) == Broken::nothing);
    for (u32 id : model_.ids()) {
      space_.store.filter(ids_.slot(id), ~0u, ~0u);
      for (u32 bit : {u32(is_static), u32(is_red), u32(is_blue)}) space_.store.exclude(ids_.slot(id), bit, false);
      space_.store.enable(ids_.slot(id), true);
      space_.store.put_in_group(ids_.slot(id), 0);
      space_.store.set_reach(ids_.slot(id), 0);
    }
    CHECK(space_.update() == -1);
    trial_.updated = true;
    trial_.before = trial_.expected();
    trial_.seen = model_;
  }
};

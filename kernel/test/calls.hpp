// Sequences of calls read from bytes, made on a space and on a model of it: the tests feed random bytes, the
// fuzzer its own. Any bytes are a valid sequence, which ends with them. This file chooses the next call; the calls are
// in change_calls.hpp, update_calls.hpp and question_calls.hpp.
#pragma once
#include "question_calls.hpp"
#include "update_calls.hpp"

template <int D> class Calls {
  // Long runs of updates are slow, and each further one finds little more.
  static constexpr u32 most_spells = 2;

  Bytes& bytes_;
  Trial<D> trial_;
  ChangeCalls<D> changes_{trial_};
  UpdateCalls<D> updates_{trial_, changes_};
  QuestionCalls<D> questions_{trial_};

 public:
  Calls(Bytes& bytes, Technique first) : bytes_(bytes), trial_(bytes, first) {
    Options& options = trial_.instance->options;
    // Without extremes, which are slow for the grid and have a test of their own.
    u8 with = bytes_.next();
    trial_.space.store.keeps_events = with & 16;
    if (with / 32 == 0)
      updates_.spells_left = most_spells;  // few sequences have them, so that there is time for many sequences
    for (u32 a = 0; a < D; a++) {
      if (with % 16 == 1) options.cell_size[a] = std::exp2(f64(bytes_.below(12)));
      if (with % 16 == 2) {
        f64 low = f64(bytes_.next()) - 128;
        options.bounds[a] = low;
        options.bounds[D + a] = low + std::exp2(f64(bytes_.below(12)));
      }
      if (with % 16 == 3) options.wrap[a] = 64 * (1 + bytes_.below(4)) + 0.1 * bytes_.below(4);
    }
    if (with % 16 == 4) options.margin = 0.25 * bytes_.below(32);
    trial_.model.touching = options.touching = with % 4 != 3 || bytes_.below(3) > 0;
  }

  /// Makes all calls that the bytes encode, then compares once more.
  void run() {
    while (!bytes_.empty()) step();
    trial_.starved = false;
    trial_.update();
    trial_.compare();
    questions_.look();
    questions_.ask_area();
  }

 private:
  void step() {
    u32 what = bytes_.below(32);
    switch (what) {
      default: return changes_.set(trial_.id(), any_box<D>(bytes_));
      case 7: return changes_.give();
      case 8:
      case 9:
      case 10: return changes_.remove(trial_.id());
      case 11: return changes_.replace_by_a_scene();
      case 12: return changes_.replace_by_few();
      case 13: return changes_.expose();
      case 14: return changes_.exclude();
      case 15: return trial_.clear();
      case 16: return starve();
      case 17: return changes_.reserve();
      case 18: return switch_technique();
      case 19: return questions_.look();
      case 20: return trial_.compare();
      case 21:
      case 22: return trial_.update();
      case 23: return questions_.ask_area(true);
      case 24: return changes_.filter();
      case 25: return updates_.save();
      case 26: return updates_.restore();
      case 27: return questions_.ask_area();
      case 28: return bytes_.below(3) ? questions_.ask_near() : questions_.ask_many();
      case 29: return questions_.ask_cast();
      case 30: return questions_.ask_partners();
      case 31: return updates_.let_time_pass();
    }
  }

  void starve() { trial_.starved = true; }

  void switch_technique() { trial_.space.technique = Technique(bytes_.below(technique_count)); }
};

// The exported functions: the only thing JavaScript calls. One instance of the module is one space.
// Numbers that do not fit in a return value are passed through `io`, an array of doubles.
#include "space/space.hpp"

// Placement new, as in <new>, which is missing without a standard library.
inline void* operator new(size_t, void* at) noexcept { return at; }

// Next to each other in the module: see BOTH in techniques.hpp.
BOTH(Index)
BOTH(Queries)
BOTH(PlaneQuery)
BOTH(Bulk)
BOTH(Neighbours)
BOTH(Numbers)
BOTH(Store)
BOTH(Questions)
BOTH(SceneBuilder)
BOTH(Finder)
BOTH(Space)

namespace {

// constinit: nothing runs when the module is instantiated.
constinit Ids ids;
constinit Options options;
f64 io[48];
#if defined(DIMENSIONS)
constexpr bool is_flat = DIMENSIONS == 2;
constinit Space<DIMENSIONS> only(ids, options);
Ring<DIMENSIONS> only_ring;

/// Calls `what` with the space and its ring.
template <class What> auto with_ring(What what) { return what(only, only_ring); }
#else
constinit Space<2> flat(ids, options);
constinit Space<3> solid(ids, options);
bool is_flat = true;
Ring<2> flat_ring;
Ring<3> solid_ring;

/// Calls `what` with the space in use and its ring.
template <class What> auto with_ring(What what) { return is_flat ? what(flat, flat_ring) : what(solid, solid_ring); }
#endif

/// The bytes of a space as it was in the beginning.
template <int D> u8 initial[sizeof(Space<D>)];

/// Calls `what` with the space in use.
template <class What> auto with_space(What what) {
  return with_ring([&](auto& space, auto&) { return what(space); });
}

/// Calls `what` with the store and the slot of a box; returns 0 if there is no such box, else 1.
template <class What> u32 with_slot(u32 id, What what) {
  u32 slot = ids.slot(id);
  if (slot == Ids::none) return 0;
  with_space([&](auto& space) { what(space.store, slot); });
  return 1;
}

}  // namespace

#define EXPORT(name) extern "C" __attribute__((export_name(#name))) auto name

EXPORT(io_address)() -> f64* { return io; }

/// Called once, first; then the setters of the options that the user gives: margin, and from io cell size, wrap, bounds.
EXPORT(open_space)([[maybe_unused]] u32 dimensions) -> void {
#if !defined(DIMENSIONS)
  is_flat = dimensions == 2;
#endif
  with_space([]<int D>(Space<D>& space) { __builtin_memcpy(initial<D>, &space, sizeof space); });
}
EXPORT(set_cell_size)() -> void {
  for (int k = 0; k < 3; k++) options.cell_size[k] = io[k];
}
EXPORT(set_margin)(f64 margin) -> void { options.margin = margin; }
EXPORT(set_touching)(u32 on) -> void { options.touching = on != 0; }
EXPORT(set_wrap)() -> void {
  for (int k = 0; k < 3; k++) options.wrap[k] = io[k];
}
EXPORT(set_bounds)() -> void {
  for (int k = 0; k < 6; k++) options.bounds[k] = io[k];
}

EXPORT(reserve)(u32 count) -> void {
  with_space([&](auto& space) { space.store.reserve(count); });
}
EXPORT(ring_address)() -> f64* {
  return with_ring([](auto&, auto& ring) {
    if (!ring.address) ring.place(nullptr);
    return &ring.dense;
  });
}
/// Adds or moves the boxes that wait in the ring.
EXPORT(take)(u32 count) -> void {
  with_ring([&](auto& space, auto& ring) { space.store.take(ring, count); });
}
EXPORT(remove)(u32 id) -> u32 {
  return with_space([&](auto& space) { return space.store.remove(id); });
}
EXPORT(has)(u32 id) -> u32 { return ids.slot(id) != Ids::none; }
EXPORT(get)(u32 id) -> u32 {
  return with_space([&](auto& space) { return space.store.get(id, io); });
}
EXPORT(size)() -> u32 { return ids.count(); }
EXPORT(clear)() -> void {
  with_space([](auto& space) { space.store.clear(); });
}

/// The setters of rules, and get_rule, return 0 if there is no such box.
EXPORT(set_filter)(u32 id, u32 layer, u32 mask) -> u32 {
  return with_slot(id, [&](auto& store, u32 slot) { store.filter(slot, layer, mask); });
}
EXPORT(set_static)(u32 id, u32 on) -> u32 {
  return with_slot(id, [&](auto& store, u32 slot) { store.exclude(slot, is_static, on != 0); });
}
EXPORT(set_enabled)(u32 id, u32 on) -> u32 {
  return with_slot(id, [&](auto& store, u32 slot) { store.enable(slot, on != 0); });
}
EXPORT(set_group)(u32 id, u32 group) -> u32 {
  return with_slot(id, [&](auto& store, u32 slot) { store.put_in_group(slot, group); });
}
EXPORT(set_reach)(u32 id, f64 distance) -> u32 {
  return with_slot(id, [&](auto& store, u32 slot) { store.set_reach(slot, distance); });
}
/// Writes the settings of a box to io, in the order of RulePlace.
EXPORT(get_rule)(u32 id) -> u32 {
  return with_slot(id, [](auto& store, u32 slot) { store.own.write(slot, io); });
}
/// Writes the ids to answers, in the order in which they were added; returns how many.
EXPORT(list_ids)() -> u32 {
  return with_space([](auto& space) {
    ids.in_order(space.questions.answers);
    return ids.count();
  });
}
EXPORT(contents)() -> void {
  with_space([](auto& space) { space.store.contents(io); });
}

EXPORT(stage)(u32 count) -> f32* {
  return with_space([&](auto& space) { return space.store.numbers.stage(count); });
}
EXPORT(stage_exact)(u32 count) -> f64* {
  return with_space([&](auto& space) { return space.store.numbers.stage_exact(count); });
}
EXPORT(replace)(u32 count, u32 doubles) -> i32 {
  return with_space([&](auto& space) { return space.store.replace(count, doubles != 0); });
}
EXPORT(expose)(u32 count) -> f32* {
  return with_space([&](auto& space) { return space.store.expose(count); });
}

/// The bytes of a snapshot. In io: how many, and the first bad id among boxes written in place (-1: none).
EXPORT(save)() -> const u64* {
  return with_space([](auto& space) {
    io[1] = space.save();
    io[0] = space.snapshot.bytes();
    return space.snapshot.words();
  });
}
/// Room for a snapshot of `size` bytes, whose header is in io. Then io[0] is what is wrong with the header, or 0.
EXPORT(stage_snapshot)(u32 size) -> const u64* {
  return with_space([&](auto& space) {
    io[0] = f64(u32(space.snapshot.stage(load<SnapshotHeader>(io), size, is_flat ? 2 : 3, built)));
    return space.snapshot.words();
  });
}
/// What is wrong with the staged snapshot; 0: nothing, and it is restored.
EXPORT(restore)() -> u32 {
  return with_space([](auto& space) { return u32(space.restore()); });
}

/// Marks boxes 0 … red - 1 as red and the rest as blue: only pairs of both colours are reported.
EXPORT(split)(u32 red) -> void {
  with_space([&](auto& space) {
    for (u32 slot = 0; slot < ids.count(); slot++) space.store.exclude(slot, slot < red ? is_red : is_blue, true);
  });
}

/// The techniques of this build: a bit for each, in the order of their names.
EXPORT(techniques)() -> u32 {
  return built;
}
EXPORT(set_technique)(u32 technique) -> void {
  with_space([&](auto& space) { space.technique = Technique(technique); });
}
/// Adds or moves the boxes that wait in the ring, and brings the pairs up to date. Where these are is in the counters.
EXPORT(update)(u32 waiting) -> i32 {
  return with_ring([&](auto& space, auto& ring) {
    if (waiting) space.store.take_for_update(ring, waiting);
    return space.update();
  });
}
/// Turns events on: each update records the pairs that began and ended.
EXPORT(set_events)() -> void {
  with_space([](auto& space) { space.store.keeps_events = true; });
}
/// The pairs that began with the last update, or those that ended. In io: how many.
EXPORT(events)(u32 ended) -> u64* {
  return with_space([&](auto& space) {
    const Pairs& pairs = ended ? space.store.events.ended : space.store.events.began;
    io[0] = f64(pairs.count);
    return pairs.list.data();
  });
}
EXPORT(is_pair)(u32 a, u32 b) -> u32 {
  return with_space([&](auto& space) { return space.is_pair(a, b); });
}
/// Returns the number of ids in answers.
EXPORT(partners)(u32 id) -> u32 {
  return with_space([&](auto& space) { return space.partners(id); });
}
EXPORT(answers_address)() -> u32* {
  return with_space([](auto& space) { return space.questions.answers.data(); });
}
/// Queries. Their arguments are in io: the box, or twice the point; the displacement; then at fixed places: whether
/// touching counts (for areas), the radius or one of its codes, the limit, the rank of the hit to resume after, whose id
/// is `after`, and the planes, each a normal and an offset.
enum Place : u32 { touching_at = 11, radius_at = 12, limit_at = 13, after_at = 14, planes_at = 15 };
inline constexpr u32 no_id = 0xffffffff;
/// What hits are ordered by: distance, distance along a ray, or the time of a box that stops.
enum class Order : u32 { near, ray, way };

template <int D> NOINLINE static void read_question(Question<D>& to, u32 mask, u32 ignored) {
  for (int a = 0; a < D; a++) {
    to.lo[a] = io[a];
    to.hi[a] = io[D + a];
    to.along[a] = io[2 * D + a];
  }
  to.radius = io[radius_at];
  to.limit = io[limit_at];
  to.touching = io[touching_at] != 0;
  to.mask = mask;
  to.ignored = ignored;
}

/// Returns the number of ids in answers. io[0] says where to resume, or is -1 if there are no more.
EXPORT(ask_area)(u32 mask, u32 ignored, u32 from, u32 most) -> u32 {
  return with_space([&](auto& space) {
    read_question(space.questions.asked, mask, ignored);
    u32 count = space.questions.ask_area(from, most);
    io[0] = count < most || count == space.questions.unknown ? -1 : f64(from);
    return count;
  });
}
/// The same for the boxes that are not behind one of the planes; ids may have the flag PlaneQuery::inside.
EXPORT(ask_planes)(u32 planes, u32 mask, u32 ignored, u32 from, u32 most) -> u32 {
  return with_space([&]<int D>(Space<D>& space) {
    read_question(space.questions.asked, mask, ignored);
    space.questions.planes.count = planes;
    for (u32 p = 0; p < planes; p++) {
      const f64* plane = io + planes_at + p * (D + 1);
      for (int a = 0; a < D; a++) space.questions.planes.normal[p][a] = plane[a];
      space.questions.planes.offset[p] = plane[D];
    }
    u32 count = space.questions.ask_planes(from, most);
    io[0] = count < most || count == space.questions.unknown ? -1 : f64(from);
    return count;
  });
}
/// Returns the number of hits, in the order of this kind.
EXPORT(ask_order)(u32 kind, u32 mask, u32 ignored, u32 after, u32 most) -> u32 {
  return with_space([&](auto& space) {
    read_question(space.questions.asked, mask, ignored);
    space.questions.asked.measure_way(Order(kind) == Order::ray);
    Hit last{io[after_at], after, 0};
    return space.questions.ask_order(Order(kind) != Order::near, most, after == no_id ? nullptr : &last);
  });
}
/// Many queries at once: room for their numbers, followed by the id that each ignores.
EXPORT(stage_questions)(u32 numbers) -> f64* {
  return with_space([&](auto& space) { return space.questions.bulk.stage(numbers); });
}
/// The first query with bad numbers, or -1.
EXPORT(bad_question)(u32 kind, u32 count) -> i32 {
  return with_space([&](auto& space) { return space.questions.bulk.first_bad(Asks(kind), count); });
}
/// Returns the number of queries. offsets_address has, for each, where its answers begin among all, and finally where
/// the last ones end. Answers are ids for areas, else hits. For `others`, the ids of the boxes that ask are in answers.
EXPORT(ask_many)(u32 kind, u32 count, u32 mask, u32 most) -> u32 {
  return with_space([&](auto& space) {
    read_question(space.questions.asked, mask, no_id);
    return space.questions.ask_many(Asks(kind), count, most);
  });
}
EXPORT(offsets_address)() -> const u32* {
  return with_space([](auto& space) { return space.questions.bulk.offsets(); });
}
EXPORT(many_ids_address)() -> const u32* {
  return with_space([](auto& space) { return space.questions.bulk.ids.data(); });
}
EXPORT(many_hits_address)() -> const Hit* {
  return with_space([](auto& space) { return space.questions.bulk.hits.data(); });
}
/// What read_log and the functions for pairs with another space write to io, in this order: of the list of changes its
/// length, its address, and how far boxes reach; the address and the number of the pairs, and of loose boxes how many.
enum LogPlace : u32 { log_count_at, log_at, most_reach_at };
enum MetPlace : u32 { met_at, met_count_at, loose_count_at };
/// For spaces that keep pairs with this one: the epoch of the list of changes, which is described in changed_ids.hpp.
/// -1: no copy was kept of what the last update saw.
EXPORT(read_log)() -> u32 {
  return with_space([](auto& space) {
    u32 epoch = space.questions.keep_changes();
    io[log_count_at] = space.store.changed.count();
    io[log_at] = f64(reinterpret_cast<size_t>(space.store.changed.list()));
    io[most_reach_at] = space.questions.index().most_reach();
    return epoch;
  });
}
/// Fills rows that were staged instead of queries, and begin with a slot: see Bulk::fill_rows.
EXPORT(see_rows)(u32 count) -> void {
  with_space([&](auto& space) { space.questions.bulk.fill_rows(space.questions.index(), count); });
}
/// Calls `what` with the queries, then says which pairs a set has.
template <class What> static auto with_met(u32 set, What what) {
  return with_space([&](auto& space) {
    u32 result = what(space.questions);
    auto& near = space.questions.neighbours[set];
    io[met_at] = f64(reinterpret_cast<size_t>(near.pairs()));
    io[met_count_at] = near.count();
    io[loose_count_at] = near.loose();
    return result;
  });
}
/// Brings the pairs with another space up to date as far as lists tell: see Questions::begin_pairs.
EXPORT(begin_pairs)(u32 set, u32 changes, u32 same, u32 first, f64 reach) -> u32 {
  return with_met(set, [&](auto& asks) { return asks.begin_pairs(set, changes, same != 0, first != 0, reach); });
}
/// Takes the staged answers of the other space.
EXPORT(take_answers)(u32 set, u32 total, u32 exact) -> u32 {
  return with_met(set, [&](auto& asks) { return asks.take_answers(set, total, exact != 0); });
}
/// Stages rows that begin with the slots of the loose boxes in the other space.
EXPORT(stage_loose)(u32 set) -> void {
  with_space([&](auto& space) { space.questions.stage_loose(set); });
}
/// Finds the pairs of the loose boxes, whose rows are staged.
EXPORT(meet_loose)(u32 set) -> u32 {
  return with_met(set, [&](auto& asks) { return asks.meet_loose(set); });
}
EXPORT(hits_address)() -> const Hit* {
  return with_space([](auto& space) { return space.questions.hits.data(); });
}
EXPORT(updates)() -> u32 {
  return with_space([](auto& space) { return space.updates; });
}
EXPORT(stats_address)() -> Stats* {
  return with_space([](auto& space) { return &space.stats; });
}
EXPORT(structure)() -> f32* {
  return with_space([](auto& space) {
    space.structure();
    return space.finder.cells.data();
  });
}
EXPORT(structure_count)() -> u32 {
  return with_space([](auto& space) { return space.finder.cell_count; });
}
EXPORT(validate)() -> u32 {
  return with_space([](auto& space) {
    u32 detail;
    Broken broken = space.validate(detail);
    io[0] = detail;
    return u32(broken);
  });
}

#if defined(__wasm__)
/// After a trap: returns its cause, with the number of bytes asked for in io[0], and makes the space usable again.
EXPORT(recover)() -> u32 {
  Fault what = fault;
  io[0] = fault_bytes;
  fault = Fault::none;
  if (what != Fault::none) with_space([](auto& space) { space.recover(); });
  return u32(what);
}

/// Resets everything as in a new instance, except that memory stays grown. Returns the largest number of bytes that were
/// ever in use. Objects get their first bytes rather than being emptied, so that nothing can be missed.
SMALL EXPORT(begin_anew)() -> size_t {
  new (&ids) Ids;
  options = Options{};
  with_ring([]<int D>(Space<D>& space, Ring<D>& ring) {
    __builtin_memcpy(static_cast<void*>(&space), initial<D>, sizeof space);
    ring.address = 0;
  });
  return heap::forget_all();
}
#endif

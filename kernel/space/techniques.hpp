// The techniques of one space, by name. A new one is a header in techniques/, and four lines here. A build may leave
// some out: TECHNIQUES has a bit for each that it includes, in the order of the enumeration.
#pragma once

#include "coherence/incremental.hpp"
#include "techniques/aabb_tree.hpp"
#include "techniques/brute_force.hpp"
#include "techniques/bsp_tree.hpp"
#include "techniques/hierarchical_grid.hpp"
#include "techniques/home_cell_grid.hpp"
#include "techniques/quadtree.hpp"
#include "techniques/r_tree.hpp"
#include "techniques/retained_grid.hpp"
#include "techniques/spatial_grid.hpp"
#include "techniques/strip_sweep.hpp"
#include "techniques/sweep_and_prune.hpp"

/// In the order of BroadPhase.techniques, which scripts/abi.mjs makes from this list. Their numbers are stored in
/// snapshots, so new ones go before `automatic`, which has another number there.
enum class Technique : u32 {
  brute_force,
  spatial_grid,
  retained_grid,
  home_cell_grid,
  hierarchical_grid,
  sweep_and_prune,
  strip_sweep,
  quadtree,
  bsp_tree,
  r_tree,
  aabb_tree,
  incremental,
  automatic,
};

#if !defined(TECHNIQUES)
#define TECHNIQUES ~0u
#endif
inline constexpr u32 built = TECHNIQUES & ((2u << u32(Technique::automatic)) - 1);

constexpr bool is_built(Technique name) { return built >> u32(name) & 1; }

/// A technique finds all pairs of a scene, writes its cells as boxes, and releases its memory.
template <class Kind, int D>
concept FindsPairs = requires(Kind kind, const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats,
                              Buffer<f32>& cells, u32& cell_count) {
  kind.update(scene, options, pairs, stats);
  kind.structure(cells, cell_count, stats);
  kind.release();
};

/// What a technique declares of itself: a constant of that name says so.
struct Traits {
  bool follows_changes = false;  // it uses the list of changes, and may retain the pairs it found
  bool varies_order = false;  // earlier updates affect the order of its pairs
  bool notes_doubts = false;  // it records which of its pairs are in doubt (see Pairs::watch); otherwise all are
};

/// Replaces a technique that is not built in, and so is never called.
struct LeftOut {
  template <class... Any> constexpr LeftOut(Any&...) {}
};

template <class Kind, bool built> struct OrLeftOut {
  using type = Kind;
};
template <class Kind> struct OrLeftOut<Kind, false> {
  using type = LeftOut;
};

template <int D> class Techniques {
  template <Technique name, FindsPairs<D> Kind> using IfBuilt = typename OrLeftOut<Kind, is_built(name)>::type;

  IfBuilt<Technique::brute_force, BruteForce<D>> brute_force_;
  IfBuilt<Technique::spatial_grid, SpatialGrid<D>> spatial_grid_;
  IfBuilt<Technique::retained_grid, RetainedGrid<D>> retained_grid_;
  IfBuilt<Technique::home_cell_grid, HomeCellGrid<D>> home_cell_grid_;
  IfBuilt<Technique::hierarchical_grid, HierarchicalGrid<D>> hierarchical_grid_;
  IfBuilt<Technique::sweep_and_prune, SweepAndPrune<D>> sweep_and_prune_;
  IfBuilt<Technique::strip_sweep, StripSweep<D>> strip_sweep_;
  IfBuilt<Technique::quadtree, Quadtree<D>> quadtree_;
  IfBuilt<Technique::bsp_tree, BspTree<D>> bsp_tree_;
  IfBuilt<Technique::r_tree, RTree<D>> r_tree_;
  IfBuilt<Technique::aabb_tree, AabbTree<D>> aabb_tree_;
  IfBuilt<Technique::incremental, Incremental<D>> incremental_{strip_sweep_};

  template <class What, class Kind> static void call(What& what, Kind& kind) { what(kind); }
  template <class What> static void call(What&, LeftOut&) {}

 public:
  /// Calls `what` with the technique of that name, which must be built in and not `automatic`.
  template <class What> void with(Technique name, What what) {
    switch (name) {
      case Technique::brute_force: return call(what, brute_force_);
      case Technique::spatial_grid: return call(what, spatial_grid_);
      case Technique::retained_grid: return call(what, retained_grid_);
      case Technique::home_cell_grid: return call(what, home_cell_grid_);
      case Technique::hierarchical_grid: return call(what, hierarchical_grid_);
      case Technique::sweep_and_prune: return call(what, sweep_and_prune_);
      case Technique::quadtree: return call(what, quadtree_);
      case Technique::bsp_tree: return call(what, bsp_tree_);
      case Technique::r_tree: return call(what, r_tree_);
      case Technique::aabb_tree: return call(what, aabb_tree_);
      case Technique::incremental: return call(what, incremental_);
      default: return call(what, strip_sweep_);
    }
  }

  Traits traits(Technique name) {
    Traits its;
    with(name, [&]<class Kind>(Kind&) {
      its = {requires { Kind::follows_changes; }, requires { Kind::varies_order; }, requires { Kind::notes_doubts; }};
    });
    return its;
  }
};

// Puts both dimensions of each class next to each other in the module, so that gzip finds what they share: it makes the
// module an eighth smaller. A build may have only one dimension: DIMENSIONS is then 2 or 3. With TWINS, builds without
// some techniques have the others side by side too: scripts/technique-sizes.mjs compares such.
#if defined(DIMENSIONS)
#define BOTH(Kind) template class Kind<DIMENSIONS>;
#else
#define BOTH(Kind)        \
  template class Kind<2>; \
  template class Kind<3>;
#endif
BOTH(Incremental)
BOTH(StripSweep)
BOTH(SweepList)
BOTH(BruteForce)
#if TECHNIQUES == ~0u || defined(TWINS)
BOTH(AabbTree)
BOTH(BspTree)
BOTH(HierarchicalGrid)
BOTH(HomeCellGrid)
BOTH(Quadtree)
BOTH(RTree)
BOTH(RetainedGrid)
BOTH(SpatialGrid)
BOTH(SweepAndPrune)
#endif

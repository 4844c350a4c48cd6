// The techniques of one space, by name. A new one is a header in techniques/, and four lines here.
#pragma once
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

/// In the order of BroadPhase.techniques.
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
  automatic,
};

template <int D> class Techniques {
  BruteForce<D> brute_force_;
  SpatialGrid<D> spatial_grid_;
  RetainedGrid<D> retained_grid_;
  HomeCellGrid<D> home_cell_grid_;
  HierarchicalGrid<D> hierarchical_grid_;
  SweepAndPrune<D> sweep_and_prune_;
  StripSweep<D> strip_sweep_;
  Quadtree<D> quadtree_;
  BspTree<D> bsp_tree_;
  RTree<D> r_tree_;
  AabbTree<D> aabb_tree_;

 public:
  /// Calls `what` with the technique of that name, which must not be `automatic`.
  template <class What> void with(Technique name, What what) {
    switch (name) {
      case Technique::brute_force: return what(brute_force_);
      case Technique::spatial_grid: return what(spatial_grid_);
      case Technique::retained_grid: return what(retained_grid_);
      case Technique::home_cell_grid: return what(home_cell_grid_);
      case Technique::hierarchical_grid: return what(hierarchical_grid_);
      case Technique::sweep_and_prune: return what(sweep_and_prune_);
      case Technique::quadtree: return what(quadtree_);
      case Technique::bsp_tree: return what(bsp_tree_);
      case Technique::r_tree: return what(r_tree_);
      case Technique::aabb_tree: return what(aabb_tree_);
      default: return what(strip_sweep_);
    }
  }
};

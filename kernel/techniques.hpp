// The techniques of one space, by name. A new one is a header in techniques/, and four lines here.
#pragma once
#include "techniques/aabb_tree.hpp"
#include "techniques/brute_force.hpp"
#include "techniques/bsp_tree.hpp"
#include "techniques/quadtree.hpp"
#include "techniques/r_tree.hpp"
#include "techniques/spatial_grid.hpp"
#include "techniques/strip_sweep.hpp"

/// In the order of BroadPhase.techniques.
enum class Technique : u32 { brute_force, spatial_grid, strip_sweep, quadtree, bsp_tree, r_tree, aabb_tree, automatic };

template <int D> class Techniques {
  BruteForce<D> brute_force_;
  SpatialGrid<D> spatial_grid_;
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
      case Technique::quadtree: return what(quadtree_);
      case Technique::bsp_tree: return what(bsp_tree_);
      case Technique::r_tree: return what(r_tree_);
      case Technique::aabb_tree: return what(aabb_tree_);
      default: return what(strip_sweep_);
    }
  }
};

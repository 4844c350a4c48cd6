// R-tree: packed along the Hilbert curve, rebuilt each update, joined with itself.
//
// Idea: boxes next to each other on the curve share a node, so nodes are small and full, and nothing is ever inserted.
// In the self-join, two nodes that overlap pass on only their overlapping children.
// Cost: build O(n), one radix sort of the places on the curve; pairs O(n + pairs of nodes that overlap); about 63 (2D)
// or 86 (3D) bytes a box. Nothing is updated.
// Wins when sizes and density vary widely: it has no cell size to choose. Otherwise loses to strip sweep, whose order
// is cheaper to build, and when long boxes make its nodes overlap.
// From: I. Kamel and C. Faloutsos, "On Packing R-trees", CIKM 1993; the join from Brinkhoff, Kriegel & Seeger,
// "Efficient Processing of Spatial Joins Using R-trees", SIGMOD 1993.
#pragma once
#include "search/packed_tree.hpp"
#include "search/options.hpp"

template <int D> class RTree {
  PackedTree<D> tree_;

 public:
  void update(const Scene<D>& scene, const Options&, Pairs& pairs, Stats& stats) {
    if (scene.count == 0) return tree_.release();
    tree_.build(scene, 0);
    tree_.join(pairs, stats);
    stats.cells = tree_.nodes();
    stats.entries = scene.count;
  }

  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats&) const { tree_.structure(boxes, count); }

  SMALL void release() { tree_.release(); }
};

// Bullet: its dynamic tree, in which boxes move without a margin, against itself. Flat boxes lie in the plane z = 0.
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include "play.hpp"

struct Bullet {
  btDbvt tree;
  std::vector<btDbvtNode*> leaves;
  int dimensions;

  Bullet(int dimensions, uint32_t count, const float* frame) : leaves(count), dimensions(dimensions) {
    for (uintptr_t id = 0; id < count; id++) {
      leaves[id] = tree.insert(volume(frame + 2 * dimensions * id), reinterpret_cast<void*>(id));
    }
    tree.optimizeTopDown();
  }

  btDbvtVolume volume(const float* box) const {
    const bool flat = dimensions == 2;
    return btDbvtVolume::FromMM(btVector3(box[0], box[1], flat ? 0 : box[2]),
                                btVector3(box[dimensions], box[dimensions + 1], flat ? 0 : box[5]));
  }

  struct Collector : btDbvt::ICollide {
    Pairs& pairs;
    explicit Collector(Pairs& pairs) : pairs(pairs) {}
    void Process(const btDbvtNode* a, const btDbvtNode* b) override {
      pairs.emplace_back(uint32_t(reinterpret_cast<uintptr_t>(a->data)), uint32_t(reinterpret_cast<uintptr_t>(b->data)));
    }
  };

  void update(const float* frame, Pairs& pairs) {
    for (size_t id = 0; id < leaves.size(); id++) {
      btDbvtVolume moved = volume(frame + 2 * dimensions * id);
      tree.update(leaves[id], moved);
    }
    tree.optimizeIncremental(1 + int(leaves.size()) / 100);
    Collector collector(pairs);
    tree.collideTT(tree.m_root, tree.m_root, collector);
  }
};

int main(int arguments, char** values) { return play<Bullet>(arguments, values); }

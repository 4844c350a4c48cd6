// Boxes that broad phases get wrong, as in test/support/hostile-boxes.ts: all in one place, all far apart, zero size,
// infinite, numbers at the limits of float32 and beyond; and ordinary random ones.
#pragma once
#include <cmath>
#include <limits>

#include "model.hpp"
#include "random.hpp"

template <int D> struct TestScene {
  const char* name;
  Boxes<D> boxes;
};

/// The same extent along every axis.
template <int D> Box<D> cube(f64 low, f64 high) {
  Box<D> box;
  for (u32 a = 0; a < D; a++) {
    box[a] = low;
    box[D + a] = high;
  }
  return box;
}

/// A box from the minimum and the size that `extent(axis)` gives.
template <int D, class Extent> Box<D> box_of(Extent extent) {
  Box<D> box;
  for (u32 a = 0; a < D; a++) {
    auto [low, size] = extent(a);
    box[a] = low;
    box[D + a] = low + size;
  }
  return box;
}

struct Extent {
  f64 low, size;
};

/// Boxes of size up to `size` anywhere between `low` and `high`.
template <int D> Boxes<D> spread(Random& random, u32 count, f64 low, f64 high, f64 size) {
  Boxes<D> boxes;
  for (u32 k = 0; k < count; k++) {
    boxes.push_back(box_of<D>([&](u32) {
      f64 at = low + random.fraction() * (high - low);
      return Extent{at, random.fraction() * size};
    }));
  }
  return boxes;
}

template <int D> std::vector<TestScene<D>> make_scenes() {
  constexpr f64 infinity = std::numeric_limits<f64>::infinity();
  constexpr f64 most = std::numeric_limits<f64>::max(), most_float = std::numeric_limits<f32>::max();
  std::vector<TestScene<D>> all;
  Random random(8);
  auto add = [&](const char* name, Boxes<D> boxes) { all.push_back({name, std::move(boxes)}); };
  auto many = [](u32 count, auto make) {
    Boxes<D> boxes;
    for (u32 k = 0; k < count; k++) boxes.push_back(make(k));
    return boxes;
  };
  auto join = [](std::initializer_list<Boxes<D>> parts) {
    Boxes<D> boxes;
    for (const auto& part : parts) boxes.insert(boxes.end(), part.begin(), part.end());
    return boxes;
  };
  auto whole = [&](u32 count, f64 below) { return f64(random.below(count)) * below; };
  auto cells = [&](auto cut) {
    u32 side = D == 2 ? 20 : 8, count = D == 2 ? side * side : side * side * side;
    return many(count, [&](u32 k) {
      u32 rest = k;
      Box<D> box;
      for (u32 a = 0; a < D; a++) {
        box[a] = cut(rest % side);
        box[D + a] = cut(rest % side + 1);
        rest /= side;
      }
      return box;
    });
  };

  add("no box", {});
  add("one box", {cube<D>(1, 2)});
  add("one box of no size", {cube<D>(0, 0)});
  add("two boxes that overlap", {cube<D>(0, 2), cube<D>(1, 3)});
  add("two boxes apart", {cube<D>(0, 1), cube<D>(2, 3)});
  add("all boxes identical", Boxes<D>(300, cube<D>(1, 2)));
  add("all boxes the same point", Boxes<D>(300, cube<D>(0, 0)));
  add("boxes nested in one another", many(300, [](u32 k) { return cube<D>(-f64(k), k); }));

  add("evenly spread", spread<D>(random, 1500, 0, 300, 12));
  add("evenly spread, small", spread<D>(random, 1500, -1000, 1000, 1));
  add("evenly spread, large", spread<D>(random, 500, 0, 30, 20));
  add("sizes from small to large", many(1000, [&](u32) {
        f64 size = 0.5 / (0.01 + random.fraction());
        return box_of<D>([&](u32) { return Extent{random.fraction() * 500, random.fraction() * size}; });
      }));
  add("clusters", many(1500, [&](u32 k) {
        f64 at = f64(k % 7) * 100;
        return box_of<D>([&](u32) { return Extent{at + random.fraction() * random.fraction() * 10, 0.5}; });
      }));

  for (u32 line = 0; line < D; line++) {
    add("all in one line", many(1000, [&](u32) {
          return box_of<D>([&](u32 a) { return a == line ? Extent{random.fraction() * 1000, 1} : Extent{5, 1}; });
        }));
    add("all in one column", many(1000, [&](u32) {
          return box_of<D>([&](u32 a) { return a == line ? Extent{5, 1} : Extent{random.fraction() * 100, 1}; });
        }));
    add("long bars that cross", many(300, [&](u32 k) {
          u32 along = k % 2 ? line : (line + 1) % D;
          return box_of<D>([&](u32 a) { return a == along ? Extent{0, 1000} : Extent{random.fraction() * 1000, 1}; });
        }));
  }
  add("one box over everything", join({spread<D>(random, 1000, 0, 500, 10), {cube<D>(-1, 511)}}));
  add("one small box among boxes in descending order",
      join({{cube<D>(7.5, 7.6)}, many(500, [](u32 k) { return cube<D>(500 - f64(k), 500.5 - f64(k)); })}));

  add("cells that touch", cells([](u32 k) { return f64(k); }));
  add("cells that touch at tenths", cells([](u32 k) { return k * 0.1; }));
  Boxes<D> apart = cells([](u32 k) { return k * 0.1; });
  for (size_t k = 0; k < apart.size(); k += 2) {
    for (u32 a = D; a < 2 * D; a++) apart[k][a] -= 1e-12;
  }
  add("cells that miss each other by 1e-12", apart);
  add("cells that touch around zero", {cube<D>(-1, -0.0), cube<D>(0, 1), cube<D>(-0.0, -0.0), cube<D>(0, 0)});
  add("points on a lattice among boxes",
      join({many(500, [&](u32) { return box_of<D>([&](u32) { return Extent{whole(12, 1), 0}; }); }),
            many(100, [&](u32) { return box_of<D>([&](u32) { return Extent{whole(12, 1), 2}; }); })}));

  auto slab = [&](u32 k, f64 low, f64 high) {
    Box<D> box = cube<D>(-infinity, infinity);
    box[k % D] = low;
    box[D + k % D] = high;
    return box;
  };
  add("half spaces, slabs, whole spaces and boxes",
      join({spread<D>(random, 700, -100, 100, 5), many(30, [&](u32 k) { return slab(k, 100 - f64(k) * 7, infinity); }),
            many(30, [&](u32 k) { return slab(k, -infinity, f64(k) * 7 - 100); }),
            many(30, [&](u32 k) { return slab(k, f64(k) - 2, f64(k) + 2); }),
            Boxes<D>(10, cube<D>(-infinity, infinity))}));
  add("nothing but whole spaces", Boxes<D>(200, cube<D>(-infinity, infinity)));
  add("places at infinity itself",
      {cube<D>(infinity, infinity), cube<D>(-infinity, -infinity), cube<D>(0, infinity), cube<D>(-infinity, 0),
       cube<D>(infinity, infinity), cube<D>(1e308, 1.5e308), cube<D>(3, 4)});
  add("many places at infinity itself", many(200, [&](u32 k) {
        return k % 4 == 0   ? cube<D>(infinity, infinity)
               : k % 4 == 1 ? cube<D>(-infinity, -infinity)
               : k % 4 == 2 ? cube<D>(f64(k), infinity)
                            : cube<D>(f64(k), f64(k) + 5);
      }));

  add("coordinates of 1e9", spread<D>(random, 800, 1e9, 1e9 + 200, 10));
  add("coordinates of -1e9", spread<D>(random, 800, -1e9 - 200, -1e9, 10));
  add("coordinates of 1e-30", spread<D>(random, 800, 0, 2e-28, 1e-29));
  add("coordinates of 1e9 and of 1e-30", join({spread<D>(random, 400, -1e-28, 1e-28, 1e-29),
                                               spread<D>(random, 400, 1e9 - 200, 1e9, 10),
                                               spread<D>(random, 50, -1e9, 1e9, 1e8),
                                               {cube<D>(0, 1e9), cube<D>(-1e9, 1e-30)}}));
  add("denormals of float32",
      many(500, [&](u32) { return box_of<D>([&](u32) { return Extent{whole(80, 0x1p-149), 0x3p-149}; }); }));
  add("denormals of double",
      many(500, [&](u32) { return box_of<D>([&](u32) { return Extent{whole(80, 5e-324), 15e-324}; }); }));
  add("sizes and places over 200 powers of two", many(800, [&](u32) {
        f64 scale = std::exp2(200 * random.fraction() - 100);
        return box_of<D>([&](u32) { return Extent{(random.fraction() - 0.5) * scale, random.fraction() * scale}; });
      }));
  add("the largest numbers of float32, and larger ones",
      {cube<D>(most_float, most_float), cube<D>(most_float, 1e39), cube<D>(3.41e38, 3.42e38), cube<D>(3.43e38, 1e300),
       cube<D>(1e300, 1e300), cube<D>(1.1e300, most), cube<D>(-most, -1e39), cube<D>(-1e39, -most_float),
       cube<D>(0, infinity), cube<D>(most, infinity)});
  add("the whole range of float32",
      many(300, [&](u32) { return box_of<D>([&](u32) { return Extent{(random.fraction() - 0.5) * 6.8e38, 1e37}; }); }));

  add("a tiny cluster and outliers", join({spread<D>(random, 1000, 0, 1e-3, 4e-5), many(10, [](u32 k) {
                                             f64 at = (f64(k) - 5) * 1e9;
                                             return cube<D>(at, at + 1);
                                           })}));
  add("two clusters far apart", join({spread<D>(random, 500, 0, 20, 1), spread<D>(random, 500, 1e6, 1e6 + 20, 1)}));
  add("doubles that float32 cannot tell apart", many(500, [&](u32) {
        return box_of<D>([&](u32) { return Extent{1 + whole(40, 0x1p-50), whole(12, 0x1p-50)}; });
      }));
  add("doubles that float32 cannot hold among floats", many(800, [&](u32 k) {
        f64 nudge = k % 2 ? 0 : 1e-12;
        return box_of<D>([&](u32) { return Extent{whole(60, 1) + whole(2, nudge), whole(4, 1) + whole(2, nudge)}; });
      }));
  return all;
}

/// All scenes, made once.
template <int D> const std::vector<TestScene<D>>& scenes() {
  static const std::vector<TestScene<D>> made = make_scenes<D>();
  return made;
}

/// The scene's boxes as float32 holds them, rounded to the nearest.
template <int D> Boxes<D> as_floats(Boxes<D> boxes) {
  for (auto& box : boxes) {
    for (auto& number : box) number = f32(number);
  }
  return boxes;
}

// Arrays that grow and go, and the chunks they stand in.
#include "arena.hpp"

#include "check.hpp"
#include "random.hpp"

TEST("arena arrays keep their contents while others come and go, and an empty arena has no memory") {
  constexpr u32 many = 40, most = 3000;
  Random random(8);
  size_t before = heap::used;
  for (u32 chunk : {0u, 1000u, 65536u}) {
    Arena arena;
    arena.chunk_bytes = chunk;
    Arena::Place places[many] = {};
    u32 counts[many] = {};
    auto numbers = [&](u32 which) { return reinterpret_cast<u32*>(places[which].at); };
    for (u32 step = 0; step < 4000; step++) {
      u32 which = random.below(many), had = counts[which];
      if (random.below(8) == 0) {
        arena.release(places[which]);
        CHECK(places[which].at == nullptr && places[which].bytes == 0);
        counts[which] = 0;
      } else {
        u32 count = counts[which] = random.below(20) == 0 ? random.below(20 * most) : had + random.below(most / 10);
        arena.grow(places[which], count * sizeof(u32), smaller(had, count) * sizeof(u32));
        CHECK(places[which].bytes >= count * sizeof(u32) && reinterpret_cast<size_t>(places[which].at) % 16 == 0);
        for (u32 k = had; k < count; k++) numbers(which)[k] = which * 10000000 + k;
      }
      bool kept = true;
      for (u32 other = 0; other < many; other++) {
        for (u32 k = 0; k < counts[other]; k++) kept &= numbers(other)[k] == other * 10000000 + k;
      }
      CHECK(kept);
    }
    for (Arena::Place& place : places) arena.release(place);
    CHECK(heap::used == before);
  }
}

TEST("arena arrays that are made anew in turns stand in their order, without gaps, in memory that stays what it is") {
  constexpr u32 many = 200, rounds = 20, chunk = 1 << 14;
  Random random(9);
  Arena arena;
  arena.chunk_bytes = chunk;
  Arena::Place places[many] = {};
  size_t used = 0;
  for (u32 round = 0; round < rounds; round++) {
    for (Arena::Place& place : places) {
      arena.release(place);
      for (u32 bytes = 0; bytes < 300; bytes += 1 + random.below(100)) arena.grow(place, bytes, place.bytes);
    }
    u32 follow = 0;
    for (u32 k = 1; k < many; k++) follow += places[k].at == places[k - 1].at + places[k - 1].bytes;
    CHECK(follow >= many * 9 / 10);
    if (round == 1) used = heap::used;
    if (round > 1) CHECK(heap::used <= used + 2 * chunk);
  }
  for (Arena::Place& place : places) arena.release(place);
}

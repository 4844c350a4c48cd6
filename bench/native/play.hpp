// What every program in C++ shares; src/lib.rs is the same in Rust.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

inline uint32_t mix(uint32_t hash) {
  hash = (hash ^ (hash >> 16)) * 0x7feb352du;
  hash = (hash ^ (hash >> 15)) * 0x846ca68bu;
  return hash ^ (hash >> 16);
}

/// `Library` has `Library(int dimensions, uint32_t count, const float* first)` and `update(const float* boxes, Pairs&)`.
template <class Library> int play(int arguments, char** values) {
  if (arguments < 2) return 1;
  FILE* file = fopen(values[1], "rb");
  if (!file) return 1;
  uint32_t header[2];
  if (fread(header, 4, 2, file) != 2) return 1;
  const size_t stride = size_t(2) * header[0] * header[1];
  std::vector<std::vector<float>> frames;
  for (std::vector<float> frame(stride); fread(frame.data(), 4, stride, file) == stride;) frames.push_back(frame);
  fclose(file);
  Library library(int(header[0]), header[1], frames[0].data());
  Pairs pairs;
  size_t next = 0;
  puts("ready");
  fflush(stdout);
  for (int wanted; scanf("%d", &wanted) == 1;) {
    for (; wanted > 0; wanted--, next++) {
      const float* boxes = frames[next].data();
      const auto start = std::chrono::steady_clock::now();
      pairs.clear();
      library.update(boxes, pairs);
      const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
      uint32_t first = 0, second = 0, seen = uint32_t(stride);
      for (auto [a, b] : pairs) {
        const uint32_t low = std::min(a, b), high = std::max(a, b);
        first += mix(low * 0x9e3779b1u ^ mix(high));
        second += mix(high * 0x85ebca77u ^ mix(low + 0x5bd1e995u));
      }
      for (uint32_t k = 0; k < stride; k++) {
        uint32_t bits;
        memcpy(&bits, boxes + k, 4);
        seen = (seen ^ bits) * 0x01000193u + k;
      }
      printf("%g %zu %x %x %x\n", time.count(), pairs.size(), first, second, seen);
    }
    puts(".");
    fflush(stdout);
  }
  return 0;
}

// The floor's wasm: the kernel's own radix sort, of keys that JavaScript has written.
#include "radix_sort.hpp"

namespace {
constinit RadixSort radix;
constinit Buffer<f32> keys;
}  // namespace

extern "C" __attribute__((export_name("reserve"))) f32* reserve(u32 count) { return keys.reserve(count); }

extern "C" __attribute__((export_name("sort"))) void sort(u32 count) {
  radix.begin(count);
  for (u32 k = 0; k < count; k++) radix.put(k, keys[k]);
  radix.sort(count);
}

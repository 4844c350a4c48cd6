// Size classes and growable arrays.
#include "base/heap.hpp"

#include "check.hpp"
#include "random.hpp"

TEST("heap classes hold what was asked for") {
  // Every size up to 64 KiB, then around every class border up to 4 GiB.
  auto fits = [](u64 bytes) {
    u32 c = heap::size_class(size_t(bytes));
    return heap::class_bytes(c) >= bytes && (c == 0 || heap::class_bytes(c - 1) < bytes);
  };
  for (u64 bytes = 0; bytes <= 65536; bytes++) CHECK(fits(bytes));
  for (u32 c = 0; heap::class_bytes(c) < u64(1) << 32; c++) {
    u64 border = heap::class_bytes(c);
    CHECK(heap::size_class(size_t(border)) == c);
    CHECK(heap::size_class(size_t(border + 1)) == c + 1);
    CHECK(border % 16 == 0);
    CHECK(c == 0 || 4 * border <= 5 * heap::class_bytes(c - 1));
  }
}

TEST("heap arrays keep their contents when they grow") {
  Random random(1);
  size_t before = heap::used;
  {
    Buffer<u32> array;
    u64 count = 0;
    while (count < 100000) {
      u64 more = count + 1 + random.below(u32(count / 4 + 3));
      array.grow(more, count);
      CHECK(array.capacity() >= more);
      for (u64 k = count; k < array.capacity(); k++) array[k] = u32(k * 2654435761u);
      count = array.capacity();
      bool kept = true;
      for (u64 k = 0; k < count; k++) kept &= array[k] == u32(k * 2654435761u);
      CHECK(kept);
    }
    u32* at = array.data();
    CHECK(array.grow(count, count) == at);
    CHECK(array.reserve(count) == at);
    CHECK(heap::used - before == array.capacity() * sizeof(u32));

    Buffer<u32> other;
    CHECK(other.reserve(0) != nullptr);
    other.swap(array);
    CHECK(other.data() == at && other.capacity() == count);
    other.release();
    CHECK(other.data() == nullptr && other.capacity() == 0);
    other.release();
    CHECK(other.grow(3, 0) != nullptr);
  }
  CHECK(heap::used == before);
}

TEST("heap that runs out of memory changes nothing") {
  u64 limit = heap::limit;
  Buffer<u32> array;
  array.reserve(16);
  for (u32 k = 0; k < 16; k++) array[k] = k;
  heap::limit = heap::used + 1000;
  bool failed = false;
  try {
    array.grow(1000, 16);
  } catch (const Failure& failure) {
    failed = failure.what == Fault::out_of_memory && failure.bytes >= 4000;
  }
  heap::limit = limit;
  CHECK(failed);
  for (u32 k = 0; k < 16; k++) CHECK(array[k] == k);

  failed = false;
  try {
    array.grow(u64(1) << 31, 16);
  } catch (const Failure&) {
    failed = true;
  }
  CHECK(failed);
  CHECK(array[15] == 15);
}

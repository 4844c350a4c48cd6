// Fuzz target: bytes are a sequence of calls, made on a space and on its model (calls.hpp). Whatever the bytes, both
// agree and no sanitizer complains. `npm run fuzz` builds and runs it.
#include "calls.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes bytes(data, size);
  Beginning beginning(bytes.next());
  if (beginning.dimensions == 2) Calls<2>(bytes, beginning.technique).run();
  else Calls<3>(bytes, beginning.technique).run();
  CHECK(heap::used == 0);
  if (testing::failures > 0) {
    std::fflush(stdout);  // the checks that failed
    std::abort();
  }
  return 0;
}

// Runs the native tests whose name contains the first argument, or all, and says how long each took.
#include <chrono>
#include <cstring>

#include "base/heap.hpp"
#include "check.hpp"

int main(int count, char** arguments) {
  using Clock = std::chrono::steady_clock;
  auto seconds = [](Clock::time_point since) { return std::chrono::duration<double>(Clock::now() - since).count(); };
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a sanitizer's report must stand behind the name of the test
  auto begun = Clock::now();
  size_t run = 0;
  for (const auto& test : testing::tests) {
    if (count > 1 && !std::strstr(test.name, arguments[1])) continue;
    if (test.dimensions) std::printf("%s, %dD\n", test.name, test.dimensions);
    else std::printf("%s\n", test.name);
    auto started = Clock::now();
    try {
      test.run();
    } catch (const Failure& failure) {
      testing::places.clear();
      testing::check(failure.what == Fault::none, "memory lasts", __FILE__, __LINE__);
    }
    if (seconds(started) > 1) std::printf("  %.1f s\n", seconds(started));
    run++;
  }
  testing::check(heap::used == 0, "all memory is given back", __FILE__, __LINE__);
  std::printf("%zu tests, %d checks, %d failures, %.1f s\n", run, testing::checks, testing::failures, seconds(begun));
  return testing::failures > 0 || run == 0;
}

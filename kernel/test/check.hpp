// The test framework: TEST defines a test, CHECK asserts, and `Where` adds what was being done to the message.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace testing {

struct Test {
  const char* name;
  int dimensions;  // 0: the same for all
  void (*run)();
};
inline std::vector<Test> tests;
inline std::vector<std::string> places;  // what is being done, outermost first
inline int checks = 0, failures = 0;
inline constexpr int most_failures = 20;

/// Adds to the message of every check that fails while it lives.
struct Where {
  explicit Where(std::string what) { places.push_back(std::move(what)); }
  ~Where() { places.pop_back(); }
  Where(const Where&) = delete;
  Where& operator=(const Where&) = delete;
};

inline void check(bool holds, const char* condition, const char* file, int line) {
  checks++;
  if (holds) return;
  std::printf("  %s:%d: does not hold: %s\n", file, line, condition);
  for (const auto& place : places) std::printf("    in %s\n", place.c_str());
  if (++failures >= most_failures) std::exit(1);
}

inline bool list(std::initializer_list<Test> more) {
  tests.insert(tests.end(), more);
  return true;
}

}  // namespace testing

#define CHECK(...) testing::check((__VA_ARGS__), #__VA_ARGS__, __FILE__, __LINE__)
#define TEST(name) TEST_ON(name, __LINE__)
#define TEST_ON(name, line) TEST_AT(name, line)
#define TEST_AT(name, line)                                                  \
  static void test_##line();                                                 \
  static const bool listed_##line = testing::list({{name, 0, test_##line}}); \
  static void test_##line()

// All tests of spaces in 2D. Each dimension is a source of its own, so that both compile in parallel.
#include "memory.hpp"
#include "spaces.hpp"
#include "wrap.hpp"

static const bool listed = (list_space_tests<2>(), list_memory_tests<2>(), list_wrap_tests<2>(), true);

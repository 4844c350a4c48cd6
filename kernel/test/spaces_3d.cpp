// All tests of spaces in 3D. Each dimension is a source of its own, so that both compile in parallel.
#include "memory.hpp"
#include "spaces.hpp"
#include "wrap.hpp"

static const bool listed = (list_space_tests<3>(), list_memory_tests<3>(), list_wrap_tests<3>(), true);

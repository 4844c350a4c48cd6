// The fuzzer's corpus: sequences of calls that together cover all lines of the kernel that it has reached.
#pragma once
#include <vector>

#include "base/simd.hpp"

const std::vector<std::vector<u8>>& corpus();

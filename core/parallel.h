// One pool of threads for the whole program (TBB, shared with Embree); --threads sets it.
#pragma once
#include <cstddef>
#include <functional>

namespace bpms {
void set_threads(int count);  // 0 = all cores
int threads();
// body(i) for i in [0, count), in any order. The first exception is rethrown.
// Results must not depend on the order: give each i its own place to write to.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);
}  // namespace bpms

#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace bpms {
namespace {
int wanted = 0;
std::unique_ptr<tbb::global_control> control;
std::unique_ptr<tbb::task_arena> arena;
}  // namespace

void set_threads(int count) {
  wanted = count;
  arena.reset();
  control.reset();
  if (count <= 0) return;
  // More threads than cores are allowed: that is how the tests see 7 threads on 2 cores.
  control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(count));
  arena = std::make_unique<tbb::task_arena>(count);
}

int threads() {
  return wanted > 0 ? wanted : tbb::info::default_concurrency();
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const auto run = [&] {
    tbb::parallel_for(
        std::size_t{0}, count, [&](std::size_t i) { body(i); }, tbb::simple_partitioner{});
  };
  if (arena) {
    arena->execute(run);
  } else {
    run();
  }
}

}  // namespace bpms

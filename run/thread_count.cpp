#include "run/thread_count.hpp"

#include <algorithm>

#include "core/processors.hpp"
#include "sim/parallel/loops.hpp"

namespace drape {
namespace {

/// Minimum for one thread: two threads share the smallest cloth that is divided.
constexpr int vertices_of_a_thread = worth_dividing / 2;

}  // namespace

SimulationSettings with_threads(SimulationSettings settings, int asked, bool drawn) {
  settings.threads = asked;
  if (asked > 0) return settings;
  const int gain = std::min(settings.cloth.vertex_count() / vertices_of_a_thread, most_automatic_threads);
  settings.threads = std::clamp(processors_left() - (drawn ? 1 : 0), 1, std::max(1, gain));
  settings.spare_threads = true;
  return settings;
}

}  // namespace drape

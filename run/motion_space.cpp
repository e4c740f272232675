#include "run/motion_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "run/outputs.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

// The packed share of a state's 48 bytes per vertex. States further apart are predicted less well from one another.
constexpr double expected_share = 0.6, expected_share_apart = 0.85, undamped = 1.25;

std::string size_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.3g} MB", bytes / 1e6);
  return fmt::format("{:.3g} GB", bytes / 1e9);
}

/// Returns the folder of a file, or its nearest existing parent folder.
fs::path folder_there(const fs::path& file) {
  std::error_code ignored;
  fs::path folder = fs::absolute(file, ignored).parent_path();
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

}  // namespace

std::string MotionSpace::text(const std::string& file) const {
  return fmt::format("{} will take about {} (at most {}), and {} are free there", file, size_text(expected),
                     size_text(most), size_text(free));
}

MotionSpace motion_space(const Scene& scene, const RunOptions& options) {
  const MotionOptions& motion = *options.motion;
  const FilmExtent extent = film_extent(scene, options);
  const auto steps = static_cast<double>(extent.steps);
  const double states = motion.recorded.every ? steps / static_cast<double>(*motion.recorded.every) + 2
                                              : std::min(steps + 1, 2.0 * extent.frames.count() + 2);
  const auto vertices = static_cast<double>(scene.simulation.cloth.vertex_count());
  const double colliders = static_cast<double>(scene.simulation.effects.size());
  const double most = states * (64 + 48 * vertices) + (steps + 1) * (72 + 32 * colliders);

  const double usual = motion.recorded.every == 1 ? expected_share : expected_share_apart;
  // Motions without numerical damping are less smooth and harder to predict.
  const double share = is_explicit(scene.simulation.integrator.method) ? std::min(1.0, undamped * usual) : usual;
  std::error_code error;
  const double there = options.from ? static_cast<double>(options.from->length) : 0;
  const fs::space_info space = fs::space(folder_there(motion.path), error);
  // If the file system does not tell its free space, assume that there is enough.
  const double free = error ? most : static_cast<double>(space.available);
  return {.expected = std::max(0.0, share * most - there), .most = std::max(0.0, most - there), .free = free};
}

void require_motion_file(const MotionOptions& options, const MotionSpace& space, bool begun) {
  if (!begun) {
    require_writable(options.path);
    require_not_growing(options.path);
  }
  if (space.expected <= space.free) return;
  throw UsageError(
      space.text(options.path) +
      ": free some space, or store fewer states with --every frames or --every N, or use a shorter [time] duration");
}

}  // namespace drape

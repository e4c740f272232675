#include "check/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "check/golden_file.hpp"
#include "check/manifest.hpp"
#include "check/motion_file.hpp"
#include "core/hash.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t most_manifest = std::uintmax_t{64} << 20;

/// How many words motion.bin can have beside a manifest.
std::uint64_t most_words(const Manifest& manifest) {
  std::uint64_t steps = 0;
  for (const WindowSummary& window : manifest.windows) {
    steps += static_cast<std::uint64_t>(window.last_step - window.first_step);
  }
  return most_motion_words(manifest.windows.size(), static_cast<std::uint64_t>(manifest.golden.vertex_count), steps);
}

/// A hair more than the words have bytes: what zlib cannot make smaller, it keeps as it is.
std::uintmax_t most_bytes(std::uint64_t words) { return 8 * words + words / 64 + 1024; }

bool fits_vertices(const GoldenWindow& window, int count) {
  const auto fits = [&](const Vertices& x) { return x.rows() == count; };
  return fits(window.start.x) && (!window.shown || fits(*window.shown)) &&
         std::all_of(window.steps.begin(), window.steps.end(), [&](const GoldenStep& step) { return fits(step.x); });
}

/// Whether all windows that pass through a step have the same state there.
bool windows_agree(const std::vector<GoldenWindow>& windows) {
  std::map<std::int64_t, std::uint64_t> known;
  const auto agrees = [&](std::int64_t step, std::uint64_t bits) {
    return known.emplace(step, bits).first->second == bits;
  };
  bool good = true;
  for (const GoldenWindow& window : windows) {
    std::int64_t step = window.start.step;
    good = good && agrees(step, state_bits(window.start));
    for (const GoldenStep& next : window.steps) good = good && agrees(++step, next.bits);
  }
  return good;
}

/// The windows of motion.bin must fit together with the manifest and each other.
void check_windows(const Golden& golden, const std::vector<WindowSummary>& summaries, const fs::path& file) {
  const std::vector<GoldenWindow>& windows = golden.windows;
  if (windows.empty()) fail_to_read(file, "holds no motion");
  bool good = windows.size() == summaries.size();
  for (std::size_t i = 0; good && i < windows.size(); ++i) {
    good = fits_vertices(windows[i], golden.vertex_count) && summary_of(windows[i]) == summaries[i];
  }
  if (!good) fail_to_read(file, "does not belong to the manifest beside it");
  const auto ascending = [](const GoldenWindow& a, const GoldenWindow& b) {
    return a.start.step <= b.start.step && a.time <= b.time && b.frame && (!a.frame || *a.frame < *b.frame);
  };
  for (std::size_t i = 1; i < windows.size(); ++i) good = good && ascending(windows[i - 1], windows[i]);
  if (!good) fail_to_read(file, "holds windows that are not in order");
  if (!windows_agree(windows))
    fail_to_read(file, "contradicts itself: two windows have another state at the same step");
}

}  // namespace

std::uint64_t state_bits(const State& state) {
  Hash hash;
  hash.add(state.x.data(), sizeof(double) * static_cast<std::size_t>(state.x.size()));
  hash.add(state.v.data(), sizeof(double) * static_cast<std::size_t>(state.v.size()));
  return hash.value();
}

fs::path golden_folder(const fs::path& scene_file) {
  fs::path folder = scene_file;
  return folder.replace_extension(".golden");
}

fs::path golden_picture(const fs::path& folder, int frame) {
  return folder / "frames" / fmt::format("{:04}.png", frame);
}

Golden read_golden(const fs::path& folder) {
  const fs::path manifest_file = folder / "manifest.json", motion_file = folder / "motion.bin";
  Manifest manifest;
  try {
    manifest = read_manifest(read_golden_file(manifest_file, most_manifest));
  } catch (const std::invalid_argument& error) {
    fail_to_read(manifest_file, error.what());
  }
  Golden& golden = manifest.golden;
  try {
    const std::uint64_t words = most_words(manifest);
    golden.windows = unpack_motion(read_golden_file(motion_file, most_bytes(words)), golden.quantum, words);
  } catch (const std::invalid_argument& error) {
    fail_to_read(motion_file, error.what());
  }
  check_windows(golden, manifest.windows, motion_file);
  return std::move(manifest.golden);
}

}  // namespace drape

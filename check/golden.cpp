#include "check/golden.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "check/golden_file.hpp"
#include "check/manifest.hpp"
#include "check/motion_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/text.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t most_manifest = std::uintmax_t{64} << 20;
constexpr std::size_t most_pins = 64;  // stored with their positions for every step

/// Returns the numbers that describe a body's position.
std::vector<double> numbers_of(const Collider& collider) {
  if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
    return {sphere->center[0], sphere->center[1], sphere->center[2], sphere->radius};
  }
  if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
    // Three of its vertices show its position and rotation, and most changes of its shape.
    std::vector<double> numbers;
    for (const Eigen::Index i : {Eigen::Index{0}, mesh->positions.rows() / 2, mesh->positions.rows() - 1}) {
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(mesh->positions(i, axis));
    }
    return numbers;
  }
  const auto& ground = std::get<GroundShape>(collider);
  return {ground.normal[0], ground.normal[1], ground.normal[2], ground.height, ground.thickness};
}

std::vector<int> some_pins(const std::vector<int>& pins) {
  std::vector<int> some;
  const std::size_t count = std::min(pins.size(), most_pins);
  for (std::size_t i = 0; i < count; ++i) some.push_back(pins[i * pins.size() / count]);
  return some;
}

void add(Hash& hash, const Vertices& values) {
  hash.add(values.data(), sizeof(double) * static_cast<std::size_t>(values.size()));
}

}  // namespace

std::uint32_t step_hash(const Simulation& simulation) {
  Hash hash;
  add(hash, simulation.state().x);
  add(hash, simulation.state().v);
  for (const Collider& collider : simulation.colliders(simulation.time())) {
    const std::vector<double> numbers = numbers_of(collider);
    hash.add(numbers.data(), sizeof(double) * numbers.size());
  }
  const std::vector<int>& pins = simulation.cloth().pins;
  hash.add(pins.data(), sizeof(int) * pins.size());
  return static_cast<std::uint32_t>(hash.value() ^ hash.value() >> 32);
}

std::vector<double> body_numbers(const Simulation& simulation) {
  std::vector<double> all;
  for (const Collider& collider : simulation.colliders(simulation.time())) {
    const std::vector<double> numbers = numbers_of(collider);
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  for (const int pin : some_pins(simulation.cloth().pins)) {
    for (int axis = 0; axis < 3; ++axis) all.push_back(simulation.state().x(pin, axis));
  }
  return all;
}

const char* body_kind(const Collider& collider) {
  if (std::holds_alternative<MeshShape>(collider)) return "body";
  return std::holds_alternative<SphereShape>(collider) ? "sphere" : "ground";
}

std::string body_name(const Simulation& simulation, std::size_t index) {
  std::size_t number = 0;
  for (const Collider& collider : simulation.colliders(simulation.time())) {
    ++number;
    const std::size_t count = numbers_of(collider).size();
    if (index < count) return fmt::format("{} {}", body_kind(collider), number);
    index -= count;
  }
  const std::vector<int> pins = some_pins(simulation.cloth().pins);
  return index / 3 < pins.size() ? fmt::format("pin {}", pins[index / 3]) : "a body";
}

std::string pixel_hash(const Image& picture) {
  Hash hash;
  hash.add(picture.pixels.data(), picture.pixels.size());
  return hash.text();
}

std::vector<std::int64_t> window_starts(std::int64_t step_count, std::int64_t window_steps) {
  std::vector<std::int64_t> starts{0};
  for (std::int64_t step = window_steps; step < step_count; step += window_steps) starts.push_back(step);
  starts.push_back(step_count);
  return starts;
}

std::vector<GoldenFrame> chosen_frames(const Golden& golden, const std::vector<int>& wanted, const fs::path& folder) {
  if (wanted.empty()) return golden.frames;
  std::vector<GoldenFrame> frames;
  for (const int number : wanted) {
    const auto found = std::find_if(golden.frames.begin(), golden.frames.end(),
                                    [&](const GoldenFrame& frame) { return frame.frame == number; });
    if (found == golden.frames.end()) {
      std::vector<int> known;
      for (const GoldenFrame& frame : golden.frames) known.push_back(frame.frame);
      throw UsageError(
          fmt::format("--frames: {} has no frame {}, only {}", shown(folder), number, fmt::join(known, ", ")));
    }
    frames.push_back(*found);
  }
  return frames;
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
  try {
    const std::string bytes = read_golden_file(motion_file, most_motion_bytes(manifest.golden));
    if (checksum_of(bytes) != manifest.motion_hash)
      throw std::invalid_argument("has been modified since it was recorded");
    unpack_motion(bytes, manifest.golden);
  } catch (const std::invalid_argument& error) {
    fail_to_read(motion_file, error.what());
  }
  return std::move(manifest.golden);
}

}  // namespace drape

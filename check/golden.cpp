#include "check/golden.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdio.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "check/golden_motion.hpp"
#include "check/manifest.hpp"
#include "check/picture.hpp"
#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"

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

std::vector<double> group_means(const Vertices& x, int groups) {
  std::vector<double> means(3 * static_cast<std::size_t>(groups));
  std::vector<double> sizes(static_cast<std::size_t>(groups));
  std::mt19937 random;  // the standard defines its numbers
  for (Eigen::Index i = 0; i < x.rows() && groups > 0; ++i) {
    const std::size_t group = random() % sizes.size();
    ++sizes[group];
    for (Eigen::Index axis = 0; axis < 3; ++axis) means[3 * group + static_cast<std::size_t>(axis)] += x(i, axis);
  }
  for (std::size_t k = 0; k < means.size(); ++k) means[k] /= std::max(1., sizes[k / 3]);
  return means;
}

GoldenStep golden_step(const Simulation& simulation, int groups) {
  return {.hash = step_hash(simulation),
          .bodies = body_numbers(simulation),
          .groups = group_means(simulation.state().x, groups)};
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

namespace fs = std::filesystem;

namespace {

const std::string remedy = "; restore it, or record it again with drape bless";

}  // namespace

void fail_to_read(const fs::path& file, const std::string& problem) {
  throw UsageError(shown(file) + ": " + problem + remedy);
}

std::string read_golden_file(const fs::path& file, std::uintmax_t most) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail_to_read(file, "is missing");
  if (fs::is_directory(status)) fail_to_read(file, "is a folder, not a file");
  if (error) fail_to_read(file, fmt::format("cannot be read: {}", error.message()));
  if (!fs::is_regular_file(status)) fail_to_read(file, "is not a regular file");
  try {
    return read_file(file, most);
  } catch (const UsageError& problem) {
    throw UsageError(problem.what() + remedy);
  }
}

namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& place, std::string_view what) {
  throw UsageError(fmt::format("{}: {}; drape will not replace it: move it away", shown(place), what));
}

/// Returns true for the file name of a golden picture, see golden_picture(): "0040.png".
bool names_picture(const fs::path& name) {
  const std::string stem = name.stem().string();
  return name.extension() == ".png" && stem.size() >= 4 &&
         std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Returns true if a file or folder within a golden's folder belongs to the golden.
/// @param place relative to the folder
bool is_own(const fs::path& place) {
  const bool in_frames = place.parent_path() == "frames";
  return in_frames ? names_picture(place.filename())
                   : place == "manifest.json" || place == "motion.bin" || place == "frames";
}

/// Returns true if the beginning of a file contains a text.
bool mentions(const fs::path& file, std::string_view words) {
  constexpr std::size_t looked_at = 4096;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::string start(looked_at, '\0');
  stream.read(start.data(), looked_at);
  return start.find(words) != std::string::npos;
}

/// Returns true if a folder holds a golden; one of its two files suffices, so that a damaged one counts.
bool is_golden(const fs::path& folder) {
  return mentions(folder / "manifest.json", "\"scene_hash\"") || mentions(folder / "motion.bin", "drape motion ");
}

/// Checks that a golden's file or folder has the expected type, if it exists.
void require_type(const fs::path& place, fs::file_type type) {
  std::error_code ignored;
  const fs::file_type found = fs::symlink_status(place, ignored).type();
  if (found == type || found == fs::file_type::not_found) return;
  refuse(place, found == fs::file_type::symlink     ? "is a link"
                : found == fs::file_type::directory ? "is a folder"
                : type == fs::file_type::directory  ? "is not a folder"
                                                    : "is not a regular file");
}

void require_own_files(const fs::path& folder) {
  for (const char* name : {"manifest.json", "motion.bin"}) require_type(folder / name, fs::file_type::regular);
  require_type(folder / "frames", fs::file_type::directory);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "frames", ignored)) {
    if (names_picture(entry.path().filename())) require_type(entry.path(), fs::file_type::regular);
  }
}

[[noreturn]] void fail_to_write(const fs::path& folder, const std::error_code& error) {
  throw OutputError(fmt::format("cannot write {}: {}", shown(folder), error.message()));
}

std::error_code last_error() { return {errno, std::generic_category()}; }

/// Copies a file, folder or link; regular files as hard links if the file system supports them.
void keep(const fs::path& from, const fs::path& to) {
  if (fs::is_directory(fs::symlink_status(from))) {
    fs::create_directory(to);
    for (const auto& entry : fs::directory_iterator(from)) keep(entry.path(), to / entry.path().filename());
    fs::permissions(to, fs::status(from).permissions());
    return;
  }
  std::error_code error;
  fs::create_hard_link(from, to, error);
  if (error) fs::copy(from, to, fs::copy_options::copy_symlinks);
}

/// Copies the foreign contents of a golden's folder.
void keep_foreign(const fs::path& from, const fs::path& to) {
  for (const auto& entry : fs::directory_iterator(from)) {
    const fs::path name = entry.path().filename();
    if (name != "manifest.json" && name != "motion.bin" && name != "frames") keep(entry.path(), to / name);
  }
  if (!fs::exists(from / "frames")) return;
  for (const auto& entry : fs::directory_iterator(from / "frames")) {
    const fs::path name = entry.path().filename();
    if (!names_picture(name)) keep(entry.path(), to / "frames" / name);
  }
}

/// Gives the files and folders of a new golden the permissions of those that they replace.
void keep_permissions(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> names{".", "frames", "manifest.json", "motion.bin"};
  for (const auto& entry : fs::directory_iterator(to / "frames")) {
    if (names_picture(entry.path().filename())) names.push_back("frames" / entry.path().filename());
  }
  for (const fs::path& name : names) {
    const fs::path old = from / name;
    if (!fs::exists(old)) continue;
    if (::access(old.c_str(), W_OK) != 0) fail_to_write(old, last_error());
    fs::permissions(to / name, fs::status(old).permissions());
  }
}

/// Renames a complete folder; removal of an older one of that name comes last.
void give_name(const fs::path& complete, const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder)) {
    fs::rename(complete, folder, error);
    if (error) fail_to_write(folder, error);
    return;
  }
  if (::renameat2(AT_FDCWD, complete.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) != 0) {
    // Some file systems cannot exchange two names atomically.
    if (errno != EINVAL && errno != ENOSYS) fail_to_write(folder, last_error());
    const fs::path old = complete.string() + "-old";
    fs::rename(folder, old, error);
    if (error) fail_to_write(folder, error);
    fs::rename(complete, folder, error);
    std::error_code ignored;
    if (error) {
      fs::rename(old, folder, ignored);
      fail_to_write(folder, error);
    }
    fs::rename(old, complete, ignored);
  }
  fs::remove_all(complete, error);
}

std::uintmax_t write_files(const fs::path& folder, const Golden& golden, const std::vector<Png>& pictures) {
  const std::string motion = pack_motion(golden);
  Golden sealed = golden;
  std::uintmax_t size = write_file_atomically(folder / "motion.bin", motion);
  for (std::size_t i = 0; i < golden.frames.size(); ++i) {
    sealed.frames[i].pixels = pixel_hash(decode_png(pictures[i], golden.size));
    size += write_file_atomically(golden_picture(folder, golden.frames[i].frame), pictures[i]);
  }
  return size + write_file_atomically(folder / "manifest.json", manifest_text(sealed, checksum_of(motion)));
}

/// Returns a hidden folder beside another one, unique to this process.
fs::path partial_folder(const fs::path& folder) {
  constexpr std::size_t longest = 200;  // a name has at most 255 bytes
  return folder.parent_path() /
         fmt::format(".{}.partial-{}", folder.filename().string().substr(0, longest), ::getpid());
}

}  // namespace

bool has_golden(const fs::path& folder) {
  std::error_code error;
  const fs::file_type named = fs::symlink_status(folder, error).type();
  if (named == fs::file_type::not_found) return false;
  const fs::file_type type = fs::status(folder, error).type();
  if (type == fs::file_type::not_found) refuse(folder, "is a broken link, where the golden should be");
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", shown(folder), error.message()));
  if (type != fs::file_type::directory) refuse(folder, "is a file, where the golden should be a folder");
  const bool empty = fs::is_empty(folder, error);
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", shown(folder), error.message()));
  if (empty) return false;
  if (!is_golden(folder)) refuse(folder, "is not a golden: it contains other files");
  require_own_files(folder);
  return true;
}

void require_only_golden(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_symlink(fs::symlink_status(folder, ignored))) refuse(folder, "is a link");
  if (!has_golden(folder)) return;
  for (const fs::path& place : {folder, folder / "frames"}) {
    for (const auto& entry : fs::directory_iterator(place, ignored)) {
      if (!is_own(entry.path().lexically_relative(folder))) refuse(entry.path(), "is not a part of a golden");
    }
  }
}

void remove_golden(const fs::path& folder) {
  require_only_golden(folder);
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

std::uintmax_t write_golden(const fs::path& folder, const Golden& golden, const std::vector<Png>& pictures) {
  has_golden(folder);  // throws if foreign data are in its place
  std::error_code error;
  const bool exists = fs::exists(folder);
  const fs::path target = exists ? fs::canonical(folder) : folder;
  const fs::path partial = partial_folder(target);
  fs::remove_all(partial, error);  // left by a killed process with the same number
  try {
    fs::create_directories(partial / "frames");
    const std::uintmax_t size = write_files(partial, golden, pictures);
    if (exists) keep_foreign(target, partial);
    if (exists) keep_permissions(target, partial);
    give_name(partial, target);
    return size;
  } catch (const fs::filesystem_error& problem) {
    fs::remove_all(partial, error);
    fail_to_write(folder, problem.code());
  } catch (...) {
    fs::remove_all(partial, error);
    throw;
  }
}

namespace {

std::vector<double> numbers(const Eigen::Vector2i& size) {
  return {static_cast<double>(size.x()), static_cast<double>(size.y())};
}

}  // namespace

std::optional<Difference> motion_mismatch(const Scene& scene, const Golden& golden) {
  if (const int count = scene.simulation.cloth.vertex_count(); count != golden.vertex_count) {
    return Difference{Property::vertices, {1. * golden.vertex_count}, {1. * count}};
  }
  if (scene.simulation.step != golden.step) return Difference{Property::step, {golden.step}, {scene.simulation.step}};
  if (scene.step_count() != golden.step_count) {
    return Difference{
        Property::steps, {static_cast<double>(golden.step_count)}, {static_cast<double>(scene.step_count())}};
  }
  return std::nullopt;
}

std::optional<Difference> picture_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden,
                                           bool some_frames) {
  if (scene.simulation.cloth.vertex_count() != golden.vertex_count) return Difference{Property::mesh, {}, {}};
  if (const Eigen::Vector2i size = picture_size(scene, settings); size != golden.size) {
    return Difference{Property::size, numbers(golden.size), numbers(size)};
  }
  if (const double seconds = scene.video.speed / scene.video.fps; seconds != golden.seconds_per_frame) {
    return Difference{Property::frame_time, {golden.seconds_per_frame}, {seconds}};
  }
  std::vector<int> recorded;
  for (const GoldenFrame& frame : golden.frames) recorded.push_back(frame.frame);
  if (!some_frames && !settings.frames.empty() && settings.frames != recorded) {
    return Difference{
        Property::frames, {recorded.begin(), recorded.end()}, {settings.frames.begin(), settings.frames.end()}};
  }
  return std::nullopt;
}

std::vector<Difference> film_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden) {
  std::vector<Difference> changes;
  if (!golden.film) return changes;
  const GoldenFilm now = film_of(scene), &then = *golden.film;
  if (now.speed != then.speed) changes.push_back({Property::speed, {then.speed}, {now.speed}});
  if (now.fps != then.fps) changes.push_back({Property::rate, {then.fps}, {now.fps}});
  // Pictures of the film's own size are reported as different anyway.
  if (settings.size && now.size != then.size) {
    changes.push_back({Property::film_size, numbers(then.size), numbers(now.size)});
  }
  if (now.samples != then.samples) {
    changes.push_back({Property::samples, {1. * then.samples}, {1. * now.samples}});
  }
  return changes;
}

bool same_but_for_rounding(const std::vector<View>& a, const std::vector<View>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const View& one, const View& other) {
    constexpr double rounding = 1e-9;
    return one.position.isApprox(other.position, rounding) &&
           (one.target - other.target).norm() <= rounding * one.position.norm() &&
           one.up.isApprox(other.up, rounding) &&
           std::abs(one.field_of_view - other.field_of_view) <= rounding * one.field_of_view;
  });
}

}  // namespace drape

#include "check/golden.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "check/machine.hpp"
#include "check/motion_file.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"

namespace drape {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

constexpr int format_version = 1;

template <int n, class T>
Json array_of(const Eigen::Matrix<T, n, 1>& v) {
  return std::vector<T>(v.data(), v.data() + n);
}

template <int n, class T>
void read_into(const Json& json, Eigen::Matrix<T, n, 1>& v) {
  const auto values = json.get<std::array<T, static_cast<std::size_t>(n)>>();
  std::copy(values.begin(), values.end(), v.data());
}

Json point_or_null(const std::optional<Eigen::Vector3d>& point) { return point ? array_of<3>(*point) : Json(nullptr); }

std::optional<Eigen::Vector3d> point_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  Eigen::Vector3d point;
  read_into(json, point);
  return point;
}

Json to_json(const Camera& camera) {
  return {{"position", point_or_null(camera.position)},
          {"target", point_or_null(camera.target)},
          {"up", array_of<3>(camera.up)},
          {"field_of_view", camera.field_of_view},
          {"azimuth", camera.azimuth},
          {"elevation", camera.elevation},
          {"margin", camera.margin}};
}

Camera camera_from(const Json& json) {
  Camera camera;
  camera.position = point_from(json.at("position"));
  camera.target = point_from(json.at("target"));
  read_into(json.at("up"), camera.up);
  json.at("field_of_view").get_to(camera.field_of_view);
  json.at("azimuth").get_to(camera.azimuth);
  json.at("elevation").get_to(camera.elevation);
  json.at("margin").get_to(camera.margin);
  return camera;
}

Json to_json(const View& view) {
  return {{"position", array_of<3>(view.position)},
          {"target", array_of<3>(view.target)},
          {"up", array_of<3>(view.up)},
          {"field_of_view", view.field_of_view}};
}

View view_from(const Json& json) {
  View view;
  read_into(json.at("position"), view.position);
  read_into(json.at("target"), view.target);
  read_into(json.at("up"), view.up);
  json.at("field_of_view").get_to(view.field_of_view);
  return view;
}

Machine machine_from(const Json& json) {
  return {.drape = json.at("drape"),
          .compiler = json.at("compiler"),
          .system = json.at("system"),
          .processor = json.at("processor"),
          .cpu_flags = json.at("cpu_flags"),
          .kernels = json.at("kernels"),
          .renderer = json.at("renderer")};
}

/// For people: what of the motion is in motion.bin, in a form that a reviewer can compare.
Json window_summary(const GoldenWindow& window) {
  Json json{{"frame", window.frame ? Json(*window.frame) : Json(nullptr)},
            {"time", window.time},
            {"first_step", window.start.step},
            {"last_step", window.start.step + static_cast<std::int64_t>(window.steps.size())}};
  if (!window.steps.empty()) {
    const Energies& e = window.steps.back().energies;
    json["energies"] = {{"kinetic", e.kinetic}, {"gravity", e.gravity}, {"elastic", e.elastic}};
  }
  return json;
}

Json manifest(const Golden& golden) {
  Json windows = Json::array();
  for (const GoldenWindow& window : golden.windows) windows.push_back(window_summary(window));
  return {{"format", format_version},
          {"scene_hash", golden.scene_digest},
          {"date", golden.date},
          {"machine", to_json(golden.machine)},
          {"size", array_of<2>(golden.size)},
          {"step", golden.step},
          {"steps", golden.step_count},
          {"vertices", golden.vertex_count},
          {"seconds_per_frame", golden.seconds_per_frame},
          {"quantum", golden.quantum},
          {"camera", to_json(golden.camera)},
          {"view", to_json(golden.view)},
          {"window_view", to_json(golden.window_view)},
          {"windows", std::move(windows)}};
}

Golden golden_from(const Json& json) {
  Golden golden;
  json.at("scene_hash").get_to(golden.scene_digest);
  json.at("date").get_to(golden.date);
  golden.machine = machine_from(json.at("machine"));
  read_into(json.at("size"), golden.size);
  json.at("step").get_to(golden.step);
  json.at("steps").get_to(golden.step_count);
  json.at("vertices").get_to(golden.vertex_count);
  json.at("seconds_per_frame").get_to(golden.seconds_per_frame);
  json.at("quantum").get_to(golden.quantum);
  golden.camera = camera_from(json.at("camera"));
  golden.view = view_from(json.at("view"));
  golden.window_view = view_from(json.at("window_view"));
  return golden;
}

std::string read_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) throw UsageError(file.string() + ": cannot be read");
  return bytes;
}

[[noreturn]] void fail_to_read(const fs::path& file, const std::string& problem) {
  throw UsageError(fmt::format("{}: {}; restore it, or record it anew with drape bless", file.string(), problem));
}

/// The windows of motion.bin must fit together with the manifest and each other.
void check_windows(const Golden& golden, const fs::path& file) {
  std::int64_t step = -1;
  for (const GoldenWindow& window : golden.windows) {
    const auto fits = [&](const Vertices& x) { return x.rows() == golden.vertex_count; };
    bool good = fits(window.start.x) && (!window.shown || fits(*window.shown)) && window.start.step >= step;
    for (const GoldenStep& s : window.steps) good = good && fits(s.x);
    if (!good) fail_to_read(file, "does not belong to the manifest beside it");
    step = window.start.step;
  }
  if (golden.windows.empty()) fail_to_read(file, "holds no motion");
}

[[noreturn]] void fail_to_replace(const fs::path& folder, const std::error_code& error) {
  throw OutputError(fmt::format("cannot write {}: {}", folder.string(), error.message()));
}

/// Gives a complete folder its name, in the place of an older one, which goes last.
void replace_folder(const fs::path& complete, const fs::path& folder) {
  const fs::path old = complete.string() + "-old";
  std::error_code error;
  const bool exists = fs::exists(folder, error);
  if (exists) fs::rename(folder, old, error);
  if (error) fail_to_replace(folder, error);
  fs::rename(complete, folder, error);
  if (error) {
    std::error_code ignored;
    if (exists) fs::rename(old, folder, ignored);
    fail_to_replace(folder, error);
  }
  if (exists) fs::remove_all(old, error);
}

}  // namespace

bool same_camera(const Camera& a, const Camera& b) { return to_json(a) == to_json(b); }

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
  Golden golden;
  try {
    const Json json = Json::parse(read_bytes(manifest_file));
    if (const int version = json.at("format"); version != format_version) {
      fail_to_read(manifest_file, fmt::format("its format is {}, this drape reads {}", version, format_version));
    }
    golden = golden_from(json);
  } catch (const Json::exception& error) {
    fail_to_read(manifest_file, error.what());
  }
  try {
    golden.windows = unpack_motion(read_bytes(motion_file), golden.quantum);
  } catch (const std::invalid_argument& error) {
    fail_to_read(motion_file, error.what());
  }
  check_windows(golden, motion_file);
  return golden;
}

std::uintmax_t write_golden(const fs::path& folder, const Golden& golden, const std::vector<Png>& pictures) {
  const fs::path partial = folder.parent_path() / fmt::format(".{}.partial-{}", folder.filename().string(), ::getpid());
  std::uintmax_t size = 0;
  try {
    size += write_file_atomically(partial / "manifest.json", manifest(golden).dump(2) + "\n");
    size += write_file_atomically(partial / "motion.bin", pack_motion(golden.windows, golden.quantum));
    auto picture = pictures.begin();
    for (const GoldenWindow& window : golden.windows) {
      if (window.frame) size += write_file_atomically(golden_picture(partial, *window.frame), *picture++);
    }
    replace_folder(partial, folder);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(partial, ignored);
    throw;
  }
  return size;
}

}  // namespace drape

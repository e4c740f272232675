#include "check/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "check/machine.hpp"

namespace drape {
using Json = nlohmann::ordered_json;
namespace {

constexpr int format_version = 1;
constexpr int deepest = 8;  // lists and objects within each other; a manifest has three

template <int n, class T>
Json array_of(const Eigen::Matrix<T, n, 1>& v) {
  return std::vector<T>(v.data(), v.data() + n);
}

Json point_or_null(const std::optional<Eigen::Vector3d>& point) { return point ? array_of<3>(*point) : Json(nullptr); }

Json to_json(const Camera& camera) {
  return {{"position", point_or_null(camera.position)},
          {"target", point_or_null(camera.target)},
          {"up", array_of<3>(camera.up)},
          {"field_of_view", camera.field_of_view},
          {"azimuth", camera.azimuth},
          {"elevation", camera.elevation},
          {"margin", camera.margin}};
}

Json to_json(const View& view) {
  return {{"position", array_of<3>(view.position)},
          {"target", array_of<3>(view.target)},
          {"up", array_of<3>(view.up)},
          {"field_of_view", view.field_of_view}};
}

Json to_json(const WindowSummary& window) {
  Json json{{"frame", window.frame ? Json(*window.frame) : Json(nullptr)},
            {"time", window.time},
            {"first_step", window.first_step},
            {"last_step", window.last_step}};
  if (window.energies) {
    const auto& [kinetic, gravity, elastic] = *window.energies;
    json["energies"] = {{"kinetic", kinetic}, {"gravity", gravity}, {"elastic", elastic}};
  }
  return json;
}

/// The values of a JSON object, each of which must be there and be what it is asked for as.
class Fields {
 public:
  /// @param name what stands before the names of its values in messages: "camera."
  Fields(const Json& json, std::string name) : json_(json), name_(std::move(name)) {
    if (json.is_object()) return;
    throw std::invalid_argument(name_.empty() ? "is no JSON object" : fmt::format("'{}' is no JSON object", name_));
  }

  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
  [[nodiscard]] bool is_null(const char* key) const { return at(key).is_null(); }

  [[nodiscard]] Fields object(const char* key) const { return {at(key), name_ + key + "."}; }

  [[nodiscard]] std::vector<Fields> objects(const char* key) const {
    if (!at(key).is_array()) fail(key, "a list");
    std::vector<Fields> all;
    for (const Json& json : at(key)) all.emplace_back(json, fmt::format("{}{}[{}].", name_, key, all.size()));
    return all;
  }

  [[nodiscard]] std::string text(const char* key) const {
    if (!at(key).is_string()) fail(key, "a text");
    return at(key).get<std::string>();
  }

  [[nodiscard]] double number(const char* key) const { return number(at(key), key); }

  [[nodiscard]] double positive(const char* key, double least = std::numeric_limits<double>::min()) const {
    const double value = number(key);
    if (!(value >= least)) fail(key, fmt::format("a number from {:g} on, found {:g}", least, value));
    return value;
  }

  template <class T>
  [[nodiscard]] T whole(const char* key, std::int64_t least, std::int64_t most) const {
    return static_cast<T>(whole(at(key), key, least, most));
  }

  [[nodiscard]] Eigen::Vector3d point(const char* key) const {
    list(key, 3);
    Eigen::Vector3d values;
    for (int i = 0; i < 3; ++i) values[i] = number(at(key)[static_cast<std::size_t>(i)], key);
    return values;
  }

  [[nodiscard]] std::optional<Eigen::Vector3d> point_or_nothing(const char* key) const {
    return is_null(key) ? std::nullopt : std::optional(point(key));
  }

  [[nodiscard]] Eigen::Vector2i pixels(const char* key) const {
    constexpr std::int64_t least = 16, most = 8192;  // as [check] size
    list(key, 2);
    const auto value = [&](std::size_t i) { return static_cast<int>(whole(at(key)[i], key, least, most)); };
    return {value(0), value(1)};
  }

  [[noreturn]] void fail(const char* key, std::string_view expected) const {
    throw std::invalid_argument(fmt::format("'{}{}': expected {}", name_, key, expected));
  }

 private:
  [[nodiscard]] const Json& at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) throw std::invalid_argument(fmt::format("'{}{}' is missing", name_, key));
    return *found;
  }

  void list(const char* key, std::size_t count) const {
    if (!at(key).is_array() || at(key).size() != count) fail(key, fmt::format("{} numbers", count));
  }

  [[nodiscard]] double number(const Json& json, const char* key) const {
    if (!json.is_number()) fail(key, "a number");
    return json.get<double>();
  }

  [[nodiscard]] std::int64_t whole(const Json& json, const char* key, std::int64_t least, std::int64_t most) const {
    // What is above the largest signed number is stored as an unsigned one.
    const bool fits = json.is_number_integer() &&
                      (!json.is_number_unsigned() || json.get<std::uint64_t>() <= static_cast<std::uint64_t>(most));
    if (!fits || json.get<std::int64_t>() < least || json.get<std::int64_t>() > most) {
      fail(key, fmt::format("a whole number from {} to {}", least, most));
    }
    return json.get<std::int64_t>();
  }

  const Json& json_;
  std::string name_;
};

Camera camera_from(const Fields& fields) {
  Camera camera;
  camera.position = fields.point_or_nothing("position");
  camera.target = fields.point_or_nothing("target");
  camera.up = fields.point("up");
  camera.field_of_view = fields.number("field_of_view");
  camera.azimuth = fields.number("azimuth");
  camera.elevation = fields.number("elevation");
  camera.margin = fields.number("margin");
  return camera;
}

View view_from(const Fields& fields) {
  View view;
  view.position = fields.point("position");
  view.target = fields.point("target");
  view.up = fields.point("up");
  view.field_of_view = fields.positive("field_of_view");
  if (view.position == view.target) fields.fail("target", "another point than the position");
  if (view.up.isZero(0)) fields.fail("up", "a direction");
  if (view.field_of_view >= 180) fields.fail("field_of_view", "an angle below 180 degrees");
  return view;
}

Machine machine_from(const Fields& fields) {
  return {.drape = fields.text("drape"),
          .compiler = fields.text("compiler"),
          .system = fields.text("system"),
          .processor = fields.text("processor"),
          .cpu_flags = fields.text("cpu_flags"),
          .kernels = fields.text("kernels"),
          .renderer = fields.text("renderer")};
}

WindowSummary window_from(const Fields& fields, std::int64_t steps) {
  WindowSummary window;
  if (!fields.is_null("frame")) window.frame = fields.whole<int>("frame", 0, std::numeric_limits<int>::max());
  window.time = fields.number("time");
  window.first_step = fields.whole<std::int64_t>("first_step", 0, steps);
  window.last_step = fields.whole<std::int64_t>("last_step", window.first_step, steps);
  if (fields.has("energies")) {
    const Fields energies = fields.object("energies");
    window.energies = {energies.number("kinetic"), energies.number("gravity"), energies.number("elastic")};
  }
  return window;
}

Manifest manifest_from(const Fields& fields) {
  constexpr std::int64_t most_steps = 1'000'000'000;  // as a scene's
  constexpr std::int64_t any = std::numeric_limits<int>::max();
  const int version = fields.whole<int>("format", -any, any);
  if (version != format_version) {
    throw std::invalid_argument(fmt::format("its format is {}, this drape reads {}", version, format_version));
  }
  Manifest manifest;
  Golden& golden = manifest.golden;
  golden.scene_digest = fields.text("scene_hash");
  golden.date = fields.text("date");
  golden.machine = machine_from(fields.object("machine"));
  golden.size = fields.pixels("size");
  golden.step = fields.positive("step");
  golden.step_count = fields.whole<std::int64_t>("steps", 0, most_steps);
  golden.vertex_count = fields.whole<int>("vertices", 1, any);
  golden.seconds_per_frame = fields.positive("seconds_per_frame");
  golden.quantum = fields.positive("quantum", least_quantum);
  golden.camera = camera_from(fields.object("camera"));
  golden.view = view_from(fields.object("view"));
  golden.window_view = view_from(fields.object("window_view"));
  for (const Fields& window : fields.objects("windows")) {
    manifest.windows.push_back(window_from(window, golden.step_count));
  }
  return manifest;
}

/// JSON whose nesting is bounded: the library takes a stack frame for each level.
Json parse(std::string_view bytes) {
  const auto bounded = [](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest) throw std::invalid_argument(fmt::format("is nested more than {} deep", deepest));
    return true;
  };
  try {
    return Json::parse(bytes, bounded);
  } catch (const Json::parse_error& error) {
    const std::string_view before = bytes.substr(0, error.byte);
    throw std::invalid_argument(fmt::format("is no JSON: something else is expected in line {}",
                                            1 + std::count(before.begin(), before.end(), '\n')));
  } catch (const Json::exception&) {
    throw std::invalid_argument("holds a number that is too large");
  }
}

}  // namespace

bool same_camera(const Camera& a, const Camera& b) { return to_json(a) == to_json(b); }

WindowSummary summary_of(const GoldenWindow& window) {
  WindowSummary summary{.frame = window.frame,
                        .time = window.time,
                        .first_step = window.start.step,
                        .last_step = window.start.step + static_cast<std::int64_t>(window.steps.size()),
                        .energies = std::nullopt};
  if (!window.steps.empty()) {
    const Energies& e = window.steps.back().energies;
    summary.energies = {e.kinetic, e.gravity, e.elastic};
  }
  return summary;
}

std::string manifest_text(const Golden& golden) {
  Json windows = Json::array();
  for (const GoldenWindow& window : golden.windows) windows.push_back(to_json(summary_of(window)));
  const Json json{{"format", format_version},
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
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Manifest read_manifest(std::string_view bytes) { return manifest_from(Fields(parse(bytes), "")); }

}  // namespace drape

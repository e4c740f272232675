#include "check/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "check/json_fields.hpp"
#include "check/machine.hpp"
#include "core/sealed_json.hpp"
#include "core/text.hpp"
#include "scene/method_names.hpp"

namespace drape {
namespace {

constexpr int format_version = 3;
constexpr int indent = 2;  // spaces per level in the text

template <int n, class T>
Json array_of(const Eigen::Matrix<T, n, 1>& v) {
  return std::vector<T>(v.data(), v.data() + n);
}

Json point_or_null(const std::optional<Eigen::Vector3d>& point) { return point ? array_of<3>(*point) : Json(nullptr); }

Json number_or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

Json to_json(const Camera& camera) {
  return {{"position", point_or_null(camera.position)},
          {"target", point_or_null(camera.target)},
          {"up", array_of<3>(camera.up)},
          {"field_of_view", camera.field_of_view},
          {"azimuth", number_or_null(camera.azimuth)},
          {"elevation", number_or_null(camera.elevation)},
          {"margin", camera.margin},
          {"follow", camera.follow},
          {"orbit", camera.orbit}};
}

Json to_json(const View& view) {
  return {{"position", array_of<3>(view.position)},
          {"target", array_of<3>(view.target)},
          {"up", array_of<3>(view.up)},
          {"field_of_view", view.field_of_view}};
}

Json to_json(const GoldenFrame& frame) {
  return {{"frame", frame.frame},
          {"time", frame.time},
          {"why", frame.why},
          {"view", to_json(frame.view)},
          {"pixels", frame.pixels}};
}

Camera camera_from(const Fields& fields) {
  Camera camera;
  camera.position = fields.point_or_nothing("position");
  camera.target = fields.point_or_nothing("target");
  camera.up = fields.point("up");
  camera.field_of_view = fields.number("field_of_view");
  camera.azimuth = fields.number_or_nothing("azimuth");
  camera.elevation = fields.number_or_nothing("elevation");
  camera.margin = fields.number("margin");
  camera.follow = fields.flag("follow");
  camera.orbit = fields.number("orbit");
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
  const auto text = [&](const char* key) { return shown(fields.text(key)); };
  return {.drape = text("drape"),
          .compiler = text("compiler"),
          .system = text("system"),
          .processor = text("processor"),
          .cpu_flags = text("cpu_flags"),
          .kernels = text("kernels"),
          .renderer = text("renderer")};
}

Json to_json(const GoldenFilm& film) {
  return {{"fps", film.fps}, {"speed", film.speed}, {"size", array_of<2>(film.size)}, {"samples", film.samples}};
}

GoldenFilm film_from(const Fields& fields) {
  constexpr int most_samples = 64;  // limit of any OpenGL
  return {.fps = fields.positive("fps"),
          .speed = fields.positive("speed"),
          .size = fields.pixels("size"),
          .samples = fields.whole<int>("samples", 1, most_samples)};
}

Json to_json(const GoldenMethod& method) {
  Json json{{"name", method_name(method.method)}};
  if (method.substeps) json["substeps"] = *method.substeps;
  return json;
}

GoldenMethod method_from(const Fields& fields) {
  GoldenMethod method;
  const std::string name = fields.text("name");
  const auto* const found = std::find(method_names.begin(), method_names.end() - 1, name);
  if (found == method_names.end() - 1) fields.fail("name", "a method");
  method.method = static_cast<Method>(found - method_names.begin());
  if (fields.has("substeps")) method.substeps = fields.whole<int>("substeps", 1, most_substeps);
  return method;
}

Json to_json(const GoldenTime& time) { return {{"steps", time.steps}, {"ratio", time.ratio}}; }

GoldenTime time_from(const Fields& fields, std::int64_t most_steps) {
  return {.steps = fields.whole<std::int64_t>("steps", 1, most_steps), .ratio = fields.positive("ratio")};
}

std::vector<GoldenFrame> frames_from(const std::vector<Fields>& list) {
  std::vector<GoldenFrame> frames;
  for (const Fields& fields : list) {
    const int least = frames.empty() ? 0 : frames.back().frame + 1;
    frames.push_back({.frame = fields.whole<int>("frame", least, std::numeric_limits<int>::max() - 1),
                      .time = fields.number("time"),
                      .why = shown(fields.text("why")),
                      .view = view_from(fields.object("view")),
                      .x = {},
                      .pixels = fields.text("pixels")});
  }
  return frames;
}

/// Reads a quantum for positions; 0 is valid.
double quantum_from(const Fields& fields, const char* key) {
  const double quantum = fields.number(key);
  if (!(quantum == 0 || quantum >= std::numeric_limits<double>::min())) fields.fail(key, "0 or a number above it");
  return quantum;
}

Manifest manifest_from(const Fields& fields) {
  constexpr std::int64_t most_steps = 1'000'000'000;  // as a scene's
  constexpr std::int64_t most_bodies = 1'000'000;
  constexpr std::int64_t any = std::numeric_limits<int>::max();
  Manifest manifest;
  Golden& golden = manifest.golden;
  golden.scene_digest = fields.text("scene_hash");
  golden.date = shown(fields.text("date"));
  golden.machine = machine_from(fields.object("machine"));
  golden.size = fields.pixels("size");
  golden.step = fields.positive("step");
  golden.step_count = fields.whole<std::int64_t>("steps", 0, most_steps);
  golden.window_steps = fields.whole<std::int64_t>("window_steps", 1, most_steps);
  golden.vertex_count = fields.whole<int>("vertices", 1, any);
  golden.row = fields.whole<int>("row", 1, any);
  golden.body_count = fields.whole<int>("bodies", 0, most_bodies);
  golden.seconds_per_frame = fields.positive("seconds_per_frame");
  if (fields.has("film")) golden.film = film_from(fields.object("film"));
  if (fields.has("method")) golden.method = method_from(fields.object("method"));
  if (fields.has("time")) golden.time = time_from(fields.object("time"), golden.step_count);
  const Fields quanta = fields.object("quanta");
  golden.quanta.position = quantum_from(quanta, "position");
  golden.quanta.velocity = quantum_from(quanta, "velocity");
  golden.quanta.compared = quanta.positive("compared", least_quantum);
  golden.camera = camera_from(fields.object("camera"));
  for (const Fields& view : fields.objects("frames_views")) golden.frames_views.push_back(view_from(view));
  golden.frames = frames_from(fields.objects("frames"));
  manifest.motion_hash = fields.text("motion");
  return manifest;
}

/// Checks that this version of drape wrote the manifest, and that it is unmodified.
void require_own(const Json& json, std::string_view bytes) {
  constexpr std::int64_t any = std::numeric_limits<int>::max();
  const int version = Fields(json, "").whole<int>("format", -any, any);
  if (version < format_version) {
    throw std::invalid_argument(
        fmt::format("was recorded by an older drape in format {}; this one reads format {}", version, format_version));
  }
  if (version > format_version) {
    throw std::invalid_argument(
        fmt::format("was recorded by a newer drape in format {}; this one reads format {}", version, format_version));
  }
  if (sealed_json(json, indent) != bytes) throw std::invalid_argument("has been modified since it was recorded");
}

}  // namespace

bool same_camera(const Camera& a, const Camera& b) { return to_json(a) == to_json(b); }

std::string manifest_text(const Golden& golden, const std::string& motion_hash) {
  Json frames = Json::array(), frames_views = Json::array();
  for (const GoldenFrame& frame : golden.frames) frames.push_back(to_json(frame));
  for (const View& view : golden.frames_views) frames_views.push_back(to_json(view));
  const RoundingUnits& quanta = golden.quanta;
  Json json{{"format", format_version},
            {"scene_hash", golden.scene_digest},
            {"date", golden.date},
            {"machine", to_json(golden.machine)},
            {"size", array_of<2>(golden.size)},
            {"step", golden.step},
            {"steps", golden.step_count},
            {"window_steps", golden.window_steps},
            {"vertices", golden.vertex_count},
            {"row", golden.row},
            {"bodies", golden.body_count},
            {"seconds_per_frame", golden.seconds_per_frame},
            {"quanta", {{"position", quanta.position}, {"velocity", quanta.velocity}, {"compared", quanta.compared}}},
            {"camera", to_json(golden.camera)},
            {"frames_views", std::move(frames_views)},
            {"frames", std::move(frames)},
            {"motion", motion_hash}};
  if (golden.film) json["film"] = to_json(*golden.film);
  if (golden.method) json["method"] = to_json(*golden.method);
  if (golden.time) json["time"] = to_json(*golden.time);
  return sealed_json(std::move(json), indent);
}

Manifest read_manifest(std::string_view bytes) {
  const Json json = parse_json(bytes);
  require_own(json, bytes);
  return manifest_from(Fields(json, ""));
}

std::string sealed_manifest(std::string_view text) {
  Json json = parse_json(text);
  if (!json.is_object()) throw std::invalid_argument("is not a JSON object");
  return sealed_json(std::move(json), indent);
}

}  // namespace drape

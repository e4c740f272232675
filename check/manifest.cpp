#include "check/manifest.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "check/name_difference.hpp"
#include "core/bytes.hpp"
#include "core/installation.hpp"
#include "core/sealed_json.hpp"
#include "core/text.hpp"
#include "drape/scene/scene.hpp"

namespace drape {
namespace {

constexpr int deepest = 8;  // levels of nesting; a manifest has three

}  // namespace

Json parse_json(std::string_view bytes) {
  const auto bounded = [](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest) throw std::invalid_argument(fmt::format("is nested more than {} deep", deepest));
    return true;
  };
  try {
    return Json::parse(bytes, bounded);
  } catch (const Json::parse_error& error) {
    const std::string_view before = bytes.substr(0, error.byte);
    throw std::invalid_argument(
        fmt::format("is not valid JSON: syntax error in line {}", 1 + std::count(before.begin(), before.end(), '\n')));
  } catch (const Json::exception&) {
    throw std::invalid_argument("holds a number that is too large");
  }
}

Fields::Fields(const Json& json, std::string name) : json_(json), name_(std::move(name)) {
  if (json.is_object()) return;
  throw std::invalid_argument(name_.empty() ? "is not a JSON object" : fmt::format("'{}' is not a JSON object", name_));
}

std::vector<Fields> Fields::objects(const char* key) const {
  if (!at(key).is_array()) fail(key, "a list");
  std::vector<Fields> all;
  for (const Json& json : at(key)) all.emplace_back(json, fmt::format("{}{}[{}].", name_, key, all.size()));
  return all;
}

std::string Fields::text(const char* key) const {
  if (!at(key).is_string()) fail(key, "a text");
  return at(key).get<std::string>();
}

bool Fields::flag(const char* key) const {
  if (!at(key).is_boolean()) fail(key, "true or false");
  return at(key).get<bool>();
}

double Fields::positive(const char* key, double least) const {
  const double value = number(key);
  if (!(value >= least)) fail(key, fmt::format("a number from {:g} on, found {:g}", least, value));
  return value;
}

Eigen::Vector3d Fields::point(const char* key) const {
  list(key, 3);
  Eigen::Vector3d values;
  for (int i = 0; i < 3; ++i) values[i] = number(at(key)[static_cast<std::size_t>(i)], key);
  return values;
}

Eigen::Vector2i Fields::pixels(const char* key) const {
  constexpr std::int64_t least = 16, most = 8192;  // as [check] size
  list(key, 2);
  const auto value = [&](std::size_t i) { return static_cast<int>(whole(at(key)[i], key, least, most)); };
  return {value(0), value(1)};
}

void Fields::fail(const char* key, std::string_view expected) const {
  throw std::invalid_argument(fmt::format("'{}{}': expected {}", name_, key, expected));
}

const Json& Fields::at(const char* key) const {
  const auto found = json_.find(key);
  if (found == json_.end()) throw std::invalid_argument(fmt::format("'{}{}' is missing", name_, key));
  return *found;
}

void Fields::list(const char* key, std::size_t count) const {
  if (!at(key).is_array() || at(key).size() != count) fail(key, fmt::format("{} numbers", count));
}

double Fields::number(const Json& json, const char* key) const {
  if (!json.is_number()) fail(key, "a number");
  return json.get<double>();
}

std::int64_t Fields::whole(const Json& json, const char* key, std::int64_t least, std::int64_t most) const {
  // Numbers above the largest signed one are stored as unsigned.
  const bool fits = json.is_number_integer() &&
                    (!json.is_number_unsigned() || json.get<std::uint64_t>() <= static_cast<std::uint64_t>(most));
  if (!fits || json.get<std::int64_t>() < least || json.get<std::int64_t>() > most) {
    fail(key, fmt::format("a whole number from {} to {}", least, most));
  }
  return json.get<std::int64_t>();
}

}  // namespace drape

namespace nlohmann {

/// JSON conversion of optional values; an absent value is null.
template <class T>
struct adl_serializer<std::optional<T>> {
  template <class Json>
  static void to_json(Json& json, const std::optional<T>& value) {
    json = value ? Json(*value) : Json(nullptr);
  }
  template <class Json>
  static void from_json(const Json& json, std::optional<T>& value) {
    value = json.is_null() ? std::nullopt : std::optional(json.template get<T>());
  }
};

template <>
struct adl_serializer<Eigen::Vector2i> {
  template <class Json>
  static void to_json(Json& json, const Eigen::Vector2i& value) {
    json = {value.x(), value.y()};
  }
  template <class Json>
  static void from_json(const Json& json, Eigen::Vector2i& value) {
    value = {json.at(0).template get<int>(), json.at(1).template get<int>()};
  }
};

}  // namespace nlohmann

namespace drape {

namespace html {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlayedMotion, description, data, texture, frames, precision, size, vertices,
                                   triangles)
}  // namespace html

// Every member, for both directions: a member missing here is lost when shards are merged.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PictureLimits, channel, pixels, flip)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckSettings, frames, size, window_time, motion_tolerance, limits, time, ignore,
                                   ignore_frames)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PictureDifference, verdict, pixels, fraction, largest_channel, mean_flip, max_flip,
                                   worst_pixel)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrameResult, frame, time, why, judged, difference, kind, expected, actual, amplified,
                                   flip_map)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Deviation, step, vertex, distance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WindowProblem, fault, step, vertex, of, actual, golden)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WindowResult, first_step, last_step, verdict, other_bits, deviations, first, largest,
                                   problem)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Comparison, motion, picture, windows, frames, first_bad_frame)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Machine, drape, compiler, system, processor, cpu_flags, kernels, renderer)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Difference, of, golden, now)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SlowSteps, steps, ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneFinding, kind, text, golden, difference)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneResult, name, file, golden, verdict, error, findings, windows, end_to_end,
                                   settings, film, time, ignored, scene_changed, recorded_at, recorded_on, checked_on,
                                   size, animation, stills, expected, actual, candidate, rerun_command, accept_command,
                                   seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckReport, command, run_options, accept_command, date, machine, scenes, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Shard, number, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckShard, report, places, scenes, shard)

std::string pack_shard(const CheckShard& shard) {
  const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(shard);
  return seal_shard({bytes.begin(), bytes.end()});
}

namespace {

/// Returns the bytes before their checksum; nothing if it does not match.
std::optional<std::string_view> opened(std::string_view sealed) {
  constexpr std::size_t checksum_size = 16;
  if (sealed.size() < checksum_size) return std::nullopt;
  const std::string_view bytes = sealed.substr(0, sealed.size() - checksum_size);
  return sealed.ends_with(checksum_of(bytes)) ? std::optional(bytes) : std::nullopt;
}

/// Parser that only checks the nesting depth of CBOR, since the library takes a stack frame per level.
class DepthLimit final : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= deepest; }
  bool start_array(std::size_t) override { return ++depth_ <= deepest; }
  bool end_object() override { return --depth_ >= 0; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

 private:
  static constexpr int deepest = 32;  // a shard has about ten
  int depth_ = 0;
};

template <class Enumeration>
bool is_one_of(Enumeration value, Enumeration last) {
  return value >= Enumeration{} && value <= last;
}

bool is_sound(const Comparison& comparison) {
  const auto sound_window = [](const WindowResult& window) {
    const bool explained = window.verdict != MotionVerdict::changed || window.problem;
    return is_one_of(window.verdict, MotionVerdict::changed) && (window.other_bits || (explained && !window.first)) &&
           (!window.problem || is_one_of(window.problem->fault, WindowFault::energies));
  };
  const auto sound_frame = [](const FrameResult& frame) {
    return frame.frame >= 0 && is_one_of(frame.difference.verdict, PictureVerdict::changed);
  };
  return is_one_of(comparison.motion, MotionVerdict::changed) &&
         is_one_of(comparison.picture, PictureVerdict::changed) &&
         std::ranges::all_of(comparison.windows, sound_window) && std::ranges::all_of(comparison.frames, sound_frame);
}

bool is_sound(const SceneResult& scene) {
  constexpr int most_pixels = 1 << 14;
  const auto sound_size = [](int pixels) { return pixels >= 0 && pixels <= most_pixels; };
  const auto sound_finding = [](const SceneFinding& f) { return is_one_of(f.kind, FindingKind::no_candidate); };
  return is_one_of(scene.verdict, SceneVerdict::error) && is_one_of(scene.error, ErrorKind::output) &&
         std::ranges::all_of(scene.size, sound_size) && std::ranges::all_of(scene.findings, sound_finding) &&
         is_sound(scene.windows) && (!scene.end_to_end || is_sound(*scene.end_to_end));
}

/// Returns true if the positions of a shard's scenes are ascending, valid and complete.
bool has_places(const CheckShard& shard) {
  const std::vector<std::size_t>& places = shard.places;
  const bool ascending = std::ranges::adjacent_find(places, std::greater_equal()) == places.end();
  return places.size() == shard.report.scenes.size() && ascending && (places.empty() || places.back() < shard.scenes);
}

}  // namespace

namespace {

std::string program_of(const CheckReport& report) {
  return shown(fmt::format("drape {}, {}", report.machine.drape, report.machine.compiler));
}

}  // namespace

std::string seal_shard(std::string cbor) {
  cbor += checksum_of(cbor);
  return cbor;
}

CheckShard unpack_shard(std::string_view bytes, const std::filesystem::path& file) {
  const auto damaged = [&] {
    return UsageError(fmt::format("{}: it is damaged, or of another version of drape check", shown(file)));
  };
  CheckShard shard;
  try {
    DepthLimit limit;
    const std::optional<std::string_view> cbor = opened(bytes);
    if (!cbor || !nlohmann::json::sax_parse(*cbor, &limit, nlohmann::json::input_format_t::cbor)) throw damaged();
    nlohmann::json::from_cbor(*cbor).get_to(shard);
  } catch (const nlohmann::json::exception&) {  // its message adds nothing
    throw damaged();
  }
  const std::vector<SceneResult>& scenes = shard.report.scenes;
  if (!has_places(shard) || shard.shard.number < 1 || shard.shard.number > shard.shard.count) throw damaged();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    name_in_folder(scenes[i].name, file, fmt::format("report.scenes[{}].name", i));
    if (!is_sound(scenes[i])) throw damaged();
  }
  return shard;
}

CheckReport merge_shards(std::vector<CheckShard> shards, const std::vector<std::filesystem::path>& files) {
  CheckReport whole = shards.front().report;
  whole.scenes.clear();
  whole.run_options.clear();
  whole.seconds = 0;
  const std::size_t scenes = shards.front().scenes;
  FoundShards found("check");
  std::map<std::size_t, SceneResult> results;
  for (std::size_t i = 0; i < shards.size(); ++i) {
    CheckReport& report = shards[i].report;
    if (report.command != whole.command || shards[i].scenes != scenes) {
      throw UsageError(fmt::format("{} and {} are not of one check: {}, and {}", shown(files.front()), shown(files[i]),
                                   shown(whole.command), shown(report.command)));
    }
    if (program_of(report) != program_of(whole)) {
      throw UsageError(fmt::format("{} was made by {}, but {} by {}: one check is made by one program",
                                   shown(files.front()), program_of(whole), shown(files[i]), program_of(report)));
    }
    if (!found.add(shards[i].shard, files[i])) continue;
    whole.seconds += report.seconds;
    whole.date = std::min(whole.date, report.date);
    if (whole.machine.renderer.empty()) whole.machine.renderer = report.machine.renderer;
    for (std::size_t s = 0; s < report.scenes.size(); ++s) {
      results.emplace(shards[i].places[s], std::move(report.scenes[s]));
    }
  }
  whole.missing = scenes - results.size();
  for (auto& [place, result] : results) whole.scenes.push_back(std::move(result));
  return whole;
}

namespace {

constexpr int oldest_format = 3;  // without group means
constexpr int format_version = 4;
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
          {"orbit", camera.orbit},
          {"outside", camera.outside}};
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
  if (fields.has("outside")) camera.outside = fields.number("outside");  // newer than format 3
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
  constexpr std::int64_t most_groups = 1000;
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
  if (fields.whole<int>("format", oldest_format, format_version) > oldest_format) {
    golden.group_count = fields.whole<int>("groups", 0, most_groups);
  }
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
  if (version < oldest_format) {
    throw std::invalid_argument(
        fmt::format("was recorded by an older drape in format {}; this one reads formats {} and {}", version,
                    oldest_format, format_version));
  }
  if (version > format_version) {
    throw std::invalid_argument(
        fmt::format("was recorded by a newer drape in format {}; this one reads formats {} and {}", version,
                    oldest_format, format_version));
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
            {"groups", golden.group_count},
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

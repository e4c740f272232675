#include "check/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/hash.hpp"
#include "core/names_in_folders.hpp"
#include "core/text.hpp"

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
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WindowResult, first_step, last_step, verdict, other_bits, deviations, first, largest,
                                   problem)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Comparison, motion, picture, windows, frames, first_bad_frame)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Machine, drape, compiler, system, processor, cpu_flags, kernels, renderer)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneResult, name, file, golden, verdict, error, findings, windows, end_to_end,
                                   settings, film, time, ignored, elsewhere, scene_changed, recorded_at, recorded_on,
                                   renderer, size, animation, stills, expected, actual, candidate, rerun_command,
                                   accept_command, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckReport, command, run_options, accept_command, date, machine, scenes, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckShard, report, places, scenes, whole)

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
    return is_one_of(window.verdict, MotionVerdict::changed);
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
  return is_one_of(scene.verdict, SceneVerdict::error) && is_one_of(scene.error, ErrorKind::output) &&
         std::ranges::all_of(scene.size, sound_size) && is_sound(scene.windows) &&
         (!scene.end_to_end || is_sound(*scene.end_to_end));
}

/// Returns true if the positions of a shard's scenes are ascending, valid and complete.
bool has_places(const CheckShard& shard) {
  const std::vector<std::size_t>& places = shard.places;
  const bool ascending = std::ranges::adjacent_find(places, std::greater_equal()) == places.end();
  return places.size() == shard.report.scenes.size() && ascending && (places.empty() || places.back() < shard.scenes);
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
  if (!has_places(shard)) throw damaged();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    name_in_folder(scenes[i].name, file, fmt::format("report.scenes[{}].name", i));
    if (!is_sound(scenes[i])) throw damaged();
  }
  return shard;
}

CheckShard merge_shards(std::vector<CheckShard> shards, const std::vector<std::filesystem::path>& files) {
  CheckShard whole;
  whole.report = shards.front().report;
  whole.report.scenes.clear();
  whole.report.run_options.clear();
  whole.report.seconds = 0;
  whole.scenes = shards.front().scenes;
  std::map<std::size_t, SceneResult> results;
  for (std::size_t i = 0; i < shards.size(); ++i) {
    CheckReport& report = shards[i].report;
    if (report.command != whole.report.command || shards[i].scenes != whole.scenes) {
      throw UsageError(fmt::format("{} and {} are not of one check: {}, and {}", shown(files.front()), shown(files[i]),
                                   shown(whole.report.command), shown(report.command)));
    }
    whole.report.seconds += report.seconds;
    whole.report.date = std::min(whole.report.date, report.date);
    if (whole.report.machine.renderer.empty()) whole.report.machine.renderer = report.machine.renderer;
    for (std::size_t s = 0; s < report.scenes.size(); ++s) {
      results.emplace(shards[i].places[s], std::move(report.scenes[s]));
    }
  }
  for (auto& [place, result] : results) {
    whole.places.push_back(place);
    whole.report.scenes.push_back(std::move(result));
  }
  return whole;
}

}  // namespace drape

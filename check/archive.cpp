#include "check/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace nlohmann {

/// null where there is nothing.
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

// Every member, in both directions: one that is left out here is lost when shards are merged.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PictureLimits, channel, pixels, flip)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckSettings, frames, size, window_time, motion_tolerance, limits, ignore,
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
                                   settings, ignored, elsewhere, scene_changed, recorded_at, recorded_on, renderer,
                                   size, animation, stills, candidate, rerun_command, accept_command, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckReport, command, run_options, accept_command, date, machine, scenes, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckShard, report, places, scenes, whole)

std::string pack_shard(const CheckShard& shard) {
  const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(shard);
  return {bytes.begin(), bytes.end()};
}

CheckShard unpack_shard(std::string_view bytes, const std::filesystem::path& file) {
  try {
    auto shard = nlohmann::json::from_cbor(bytes.begin(), bytes.end()).get<CheckShard>();
    if (shard.places.size() == shard.report.scenes.size()) return shard;
  } catch (const nlohmann::json::exception&) {  // says no more than the sentence below
  }
  throw UsageError(fmt::format("{}: it is damaged, or of another version of drape check", shown(file)));
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

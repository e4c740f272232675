#include "check/json_report.hpp"

#include <nlohmann/json.hpp>

#include "check/machine.hpp"
#include "core/atomic_file.hpp"

namespace drape {
using Json = nlohmann::ordered_json;
namespace {

Json to_json(const std::optional<Deviation>& deviation) {
  if (!deviation) return nullptr;
  return {{"step", deviation->step}, {"vertex", deviation->vertex}, {"distance", deviation->distance}};
}

Json to_json(const WindowResult& window) {
  Json deviations = Json::array();
  for (const Deviation& deviation : window.deviations) deviations.push_back(to_json(deviation));
  return {{"first_step", window.first_step},
          {"last_step", window.last_step},
          {"verdict", verdict_name(window.verdict)},
          {"other_bits", window.other_bits ? Json(*window.other_bits) : Json(nullptr)},
          {"first", to_json(window.first)},
          {"largest", to_json(window.largest)},
          {"deviations", std::move(deviations)},
          {"problem", window.problem}};
}

/// Returns the JSON of a frame; `prefix` distinguishes the files of an end-to-end comparison.
Json to_json(const SceneResult& scene, const FrameResult& frame, const std::string& prefix) {
  const PictureDifference& d = frame.difference;
  Json json{{"frame", frame.frame},
            {"time", frame.time},
            {"why", frame.why},
            {"verdict", verdict_name(d.verdict)},
            {"pixels", d.pixels},
            {"fraction", d.fraction},
            {"largest_channel", d.largest_channel},
            {"mean_flip", d.mean_flip},
            {"max_flip", d.max_flip},
            {"worst_pixel", d.worst_pixel},
            {"kind", frame.kind},
            {"judged", frame.judged}};
  if (d.verdict == PictureVerdict::exact) return json;
  for (const char* kind : {"expected", "actual", "difference", "flip"}) {
    json["files"][kind] = frame_file(scene, frame.frame, prefix + kind).string();
  }
  return json;
}

Json to_json(const SceneResult& scene, const Comparison& comparison, const std::string& prefix) {
  Json windows = Json::array(), frames = Json::array();
  for (const WindowResult& window : comparison.windows) windows.push_back(to_json(window));
  for (const FrameResult& frame : comparison.frames) frames.push_back(to_json(scene, frame, prefix));
  return {{"motion", verdict_name(comparison.motion)},
          {"picture", verdict_name(comparison.picture)},
          {"first_bad_frame", comparison.first_bad_frame ? Json(*comparison.first_bad_frame) : Json(nullptr)},
          {"windows", std::move(windows)},
          {"frames", std::move(frames)}};
}

Json to_json(const SceneResult& scene) {
  Json json{{"name", scene.name},
            {"file", scene.file.string()},
            {"golden", scene.golden.string()},
            {"verdict", verdict_name(scene.verdict)},
            {"findings", scene.findings},
            {"motion_tolerance", scene.settings.motion_tolerance},
            {"limits",
             {{"channel", scene.settings.limits.channel},
              {"pixels", scene.settings.limits.pixels},
              {"flip", scene.settings.limits.flip}}},
            {"size", scene.size},
            {"film", scene.film},
            {"time", scene.time},
            {"ignored", scene.ignored},
            {"recorded_elsewhere", scene.elsewhere},
            {"scene_changed", scene.scene_changed},
            {"recorded_at", scene.recorded_at},
            {"recorded_on", to_json(scene.recorded_on)},
            {"rerun", scene.rerun_command},
            {"accept", scene.accept_command},
            {"candidate", scene.candidate},
            {"seconds", scene.seconds},
            {"windows", to_json(scene, scene.windows, "")}};
  if (scene.end_to_end) json["end_to_end"] = to_json(scene, *scene.end_to_end, "end_to_end.");
  if (!scene.animation.empty()) json["animation"] = scene.name + "/difference.gif";
  return json;
}

void write_frames(const SceneResult& scene, const Comparison& comparison, const std::string& prefix,
                  const std::filesystem::path& folder) {
  for (const FrameResult& frame : comparison.frames) {
    if (frame.difference.verdict == PictureVerdict::exact) continue;
    const auto write = [&](const char* kind, const Png& png) {
      write_file_atomically(folder / frame_file(scene, frame.frame, prefix + kind), png);
    };
    write("expected", frame.expected);
    write("actual", frame.actual);
    write("difference", frame.amplified);
    write("flip", frame.flip_map);
  }
}

}  // namespace

std::string json_report(const CheckReport& report) {
  Json scenes = Json::array();
  for (const SceneResult& scene : report.scenes) scenes.push_back(to_json(scene));
  const Json json{{"format", 1},
                  {"passed", report.passed()},
                  {"command", full_command(report)},
                  {"date", report.date},
                  {"seconds", report.seconds},
                  {"machine", to_json(report.machine)},
                  {"scenes", std::move(scenes)}};
  // File names may be other than UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_frame_files(const CheckReport& report, const std::filesystem::path& folder) {
  for (const SceneResult& scene : report.scenes) {
    write_frames(scene, scene.windows, "", folder);
    if (scene.end_to_end) write_frames(scene, *scene.end_to_end, "end_to_end.", folder);
  }
}

}  // namespace drape

#include "check/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drape {

namespace {

ExitCode exit_code_of(const SceneResult& scene) {
  switch (scene.verdict) {
    case SceneVerdict::passed:
    case SceneVerdict::updated:
      return ExitCode::ok;
    case SceneVerdict::changed:
    case SceneVerdict::missing:
      return ExitCode::differs;
    case SceneVerdict::error:
      return scene.error;
  }
  return scene.error;
}

}  // namespace

ExitCode CheckReport::exit_code() const {
  ExitCode worst = ExitCode::ok;
  for (const SceneResult& scene : scenes) worst = std::max(worst, exit_code_of(scene));
  return worst;
}

const char* verdict_name(MotionVerdict verdict) {
  switch (verdict) {
    case MotionVerdict::same_bits:
      return "same bits";
    case MotionVerdict::within_tolerance:
      return "within tolerance";
    case MotionVerdict::changed:
      return "changed";
  }
  return "";
}

const char* verdict_name(PictureVerdict verdict) {
  switch (verdict) {
    case PictureVerdict::exact:
      return "exact";
    case PictureVerdict::noise:
      return "noise";
    case PictureVerdict::changed:
      return "changed";
  }
  return "";
}

const char* verdict_name(SceneVerdict verdict) {
  switch (verdict) {
    case SceneVerdict::passed:
      return "passed";
    case SceneVerdict::changed:
      return "changed";
    case SceneVerdict::missing:
      return "missing";
    case SceneVerdict::updated:
      return "updated";
    case SceneVerdict::error:
      return "error";
  }
  return "";
}

std::filesystem::path frame_file(const SceneResult& scene, int frame, const std::string& kind) {
  return std::filesystem::path(scene.name) / fmt::format("frame_{:04}.{}.png", frame, kind);
}

}  // namespace drape

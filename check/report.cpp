#include "check/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drape {

bool CheckReport::passed() const {
  return std::all_of(scenes.begin(), scenes.end(), [](const SceneResult& scene) {
    return scene.verdict == SceneVerdict::passed || scene.verdict == SceneVerdict::updated;
  });
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
  }
  return "";
}

std::filesystem::path frame_file(const SceneResult& scene, int frame, const std::string& kind) {
  return std::filesystem::path(scene.name) / fmt::format("frame_{:04}.{}.png", frame, kind);
}

}  // namespace drape

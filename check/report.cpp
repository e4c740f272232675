#include "check/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace drape {

bool CheckReport::passed() const {
  return std::ranges::all_of(scenes, [](const SceneResult& scene) { return scene.passed(); });
}

std::string describe_ignored(const SceneResult& scene) {
  std::vector<int> frames;
  for (const FrameResult& frame : scene.windows.frames) {
    if (!frame.judged) frames.push_back(frame.frame);
  }
  const std::string part = scene.ignored > 0 ? fmt::format("{:.3g} % of the picture", 100 * scene.ignored) : "";
  const std::string whole =
      frames.empty() ? "" : fmt::format("frame{} {}", frames.size() == 1 ? "" : "s", fmt::join(frames, ", "));
  if (part.empty() && whole.empty()) return {};
  const bool several = frames.size() > 1 || (!part.empty() && !whole.empty());
  return part + (part.empty() || whole.empty() ? "" : " and ") + whole + (several ? " are ignored" : " is ignored");
}

std::string picture_verdict(const SceneResult& scene, const Comparison& comparison) {
  const bool judged = scene.ignored < 1 && std::ranges::any_of(comparison.frames, &FrameResult::judged);
  const bool compared = !comparison.frames.empty() && comparison.picture != PictureVerdict::changed;
  return compared && !judged ? "not judged" : verdict_name(comparison.picture);
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

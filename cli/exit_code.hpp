#pragma once

#include <algorithm>

#include "check/report.hpp"
#include "run/exit_code.hpp"

namespace drape {

/// Of the scene that is worst off, where an error is worse than a change.
inline ExitCode exit_code(const CheckReport& report) {
  ExitCode worst = ExitCode::ok;
  for (const SceneResult& scene : report.scenes) {
    if (scene.passed()) continue;
    worst = std::max(worst, scene.verdict == SceneVerdict::error ? exit_code(scene.error) : ExitCode::differs);
  }
  return worst;
}

}  // namespace drape

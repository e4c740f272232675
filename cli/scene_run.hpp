#pragma once

#include <optional>

#include "cli/command_line.hpp"
#include "cli/run_arguments.hpp"
#include "cli/step_by_step.hpp"
#include "cli/watched.hpp"
#include "run/run_scene.hpp"
#include "run/slow_run.hpp"
#include "scene/scene.hpp"

namespace drape {

/// One scene's run on threads of its own, and what is said of it on the terminal. Its parameters must outlive it.
class SceneRun {
 public:
  SceneRun(const Scene& scene, RunOptions options, const RunArguments& arguments, const CommonOptions& common);

  /// Says what is run.
  void announce() const;

  /// Begins it, unless it has begun.
  void begin();

  /// Shows its progress until every frame is with its outputs, which may still have to be completed.
  void wait_until_drawn() { work_->watch_until_others_may_begin(quiet_); }

  /// Shows its progress until its end, and says how that was.
  /// @throws what run_scene() throws
  ExitCode end();

 private:
  [[nodiscard]] ExitCode conclude() const;

  const Scene& scene_;
  RunOptions options_;
  const RunArguments& arguments_;
  const CommonOptions& common_;
  bool quiet_;
  StepByStep pause_;
  SlowRun slow_;
  RunResult result_;
  std::optional<WatchedWork> work_;  // last: it is waited for before the others go
};

}  // namespace drape

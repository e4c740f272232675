#pragma once

#include <optional>

#include "cli/background_work.hpp"
#include "cli/command_line.hpp"
#include "cli/run_arguments.hpp"
#include "cli/separation.hpp"
#include "cli/step_by_step.hpp"
#include "run/run_scene.hpp"
#include "run/slow_run_warning.hpp"
#include "scene/scene.hpp"

namespace drape {

/// One scene's run on its own threads, with its terminal output. The parameters must outlive it.
class SceneRun {
 public:
  SceneRun(const Scene& scene, RunOptions options, const RunArguments& arguments, const CommonOptions& common);

  /// Prints a description of the run.
  void announce() const;

  /// Starts the run if it is not yet started.
  void begin();

  /// Shows progress until every frame is drawn; the outputs may still need completion.
  void wait_until_drawn() { work_->wait_until_single_core(quiet_); }

  /// Shows progress until the end, then prints the result.
  /// @throws errors of run_scene()
  ExitCode end();

 private:
  [[nodiscard]] ExitCode conclude() const;

  const Scene& scene_;
  RunOptions options_;
  const RunArguments& arguments_;
  const CommonOptions& common_;
  bool quiet_;
  StepByStep pause_;
  SlowRunWarning slow_;
  Separation separation_;
  RunResult result_;
  std::optional<BackgroundWork> work_;  // last member: its destructor waits, and the others are still needed
};

}  // namespace drape

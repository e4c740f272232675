#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/options.hpp"
#include "cli/summary.hpp"
#include "cli/terminal.hpp"
#include "drape/scene/document.hpp"
#include "drape/scene/scene.hpp"
#include "run/progress.hpp"
#include "run/run_scene.hpp"
#include "run/statistics.hpp"
#include "sim/start_overlap.hpp"

namespace drape {

/// Observer that finds when a cloth has left the obstacles that it begins inside or across, see `allow_overlap`. It
/// tests the cloth after every step until no overlap is left. It does not change the motion.
class Separation final : public StepObserver {
 public:
  /// Forwards all calls to another observer.
  void tell_also(StepObserver& next) { next_ = &next; }

  void begin(const Simulation& simulation) override;
  void replay(const StepRow& row, double time, double seconds) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

  /// Returns a line per overlap: "begins with 12 vertices inside the body, up to 0.03 m deep: separated after 0.2 s".
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  struct Part {
    std::size_t effect;
    std::string text;
    std::optional<double> separated;  // first time without overlap [s]
  };
  std::vector<Part> parts_;
  StepObserver* next_ = nullptr;
};

/// Returns warnings about a valid scene, a sentence each with its place: "flag.toml:9:1: line_color: it has no effect
/// without mesh_lines". They cover keys without effect, a camera in the cloth, steps too long for the stiffness, and
/// cloth that starts inside an object.
/// @param document document of the scene
std::vector<std::string> advice_on(const LoadedScene& scene, const TomlValue& document);

/// Explains why a run will be slow and how to speed it up; empty if it is fast. It simulates the first steps for at
/// most a second.
std::string advice_on_pace(const Scene& scene);

/// One scene's run on its own threads, with its terminal output. The parameters must outlive it.
class SceneRun {
 public:
  SceneRun(const LoadedScene& scene, RunOptions options, const RunArguments& arguments, const CommonOptions& common);

  /// Prints a description of the run.
  void announce() const;

  /// Starts the run if it is not yet started.
  void begin();

  /// Shows progress until the end, then prints the result.
  /// @throws errors of run_scene()
  ExitCode end();

 private:
  [[nodiscard]] ExitCode conclude() const;

  const LoadedScene& scene_;
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

#pragma once

#include <array>
#include <filesystem>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "check/manifest.hpp"
#include "cli/command_line.hpp"
#include "reports/diagram.hpp"
#include "run/run_scene.hpp"
#include "run/statistics.hpp"
#include "sweep/results.hpp"

namespace drape {

/// Observer that prints every step's energies and iterations to standard output, then waits for a line of input.
class StepByStep final : public StepObserver {
 public:
  /// @param stop stop source of the run; input q requests a stop, and a stop requested elsewhere ends the wait
  explicit StepByStep(std::stop_source stop) : stop_(std::move(stop)) {}

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  void wait_for_line();

  std::stop_source stop_;
  bool input_ended_ = false;
};

/// Describes a simulation before its start, in one line.
std::string describe(const LoadedScene& scene, const RunOptions& options);

/// Describes the share of each effect in the steps' time, in one line.
std::string effect_shares(const Statistics& statistics);

/// Describes the progress of an interrupted run and its partial files: "after 36 of 417 steps; out/5.gif has …".
/// @param resume command that resumes its motion file, if there is one
std::string describe_end(const RunResult& result, const std::string& resume = {});

/// Returns the reasons to distrust the result of a run, a sentence each.
std::vector<std::string> warnings(const RunResult& result);

/// Lists the files of each output with their sizes, a line each.
std::string describe_files(const std::vector<std::vector<OutputFile>>& outputs);

/// Summarises a run in a few lines without a final line end.
std::string summarize(const RunResult& result);

/// Files of a check's report. No scene folder beside them may have one of these names.
inline constexpr std::array<const char*, 3> check_report_files{"report.html", "report.json", "junit.xml"};

/// Printer of results that records write errors.
class ResultPrinter {
 public:
  /// Prints a line.
  /// @param line escaped, see escape_controls()
  void print(const std::string& line);

  /// Returns the first write error; empty without errors.
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// Prints the result of a scene's check.
void tell(const SceneResult& result, const CommonOptions& common, ResultPrinter& verdicts);

/// Returns for example "drape accept out/check".
std::string accept_command(const std::filesystem::path& report);

/// Writes the report of a check, or of one shard, and the summary for GitHub Actions.
/// @returns the highest code of all scenes; interrupted if scenes are missing
ExitCode conclude_check(const CheckReport& report, const std::filesystem::path& folder, FigureStyle style,
                        const CommonOptions& common, ResultPrinter& verdicts);

/// Writes the report of a sweep and prints a summary.
/// @returns the exit code of the worst run
ExitCode conclude_sweep(const SweepResults& results, const std::filesystem::path& folder, FigureStyle style,
                        const CommonOptions& common);

}  // namespace drape

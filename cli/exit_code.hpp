#pragma once

#include <algorithm>

#include "check/report.hpp"
#include "drape/core/error.hpp"
#include "sweep/results.hpp"

namespace drape {

/// Exit code of the process. The highest code of several results counts.
enum class ExitCode : int {
  ok = 0,
  differs = 1,       ///< images or motion differ from the golden ones, or an audit has found errors
  usage = 2,         ///< error in the command line, the scene or a file it names
  diverged = 3,      ///< the simulation became non-finite
  output = 4,        ///< drawing, encoding or writing failed
  interrupted = 130  ///< Ctrl-C or SIGTERM
};

inline ExitCode exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return ExitCode::usage;
    case ErrorKind::diverged:
      return ExitCode::diverged;
    case ErrorKind::output:
      return ExitCode::output;
  }
  return ExitCode::usage;
}

/// Returns the highest exit code of all scenes; an error is higher than a difference.
inline ExitCode exit_code(const CheckReport& report) {
  ExitCode worst = ExitCode::ok;
  for (const SceneResult& scene : report.scenes) {
    if (scene.passed()) continue;
    worst = std::max(worst, scene.verdict == SceneVerdict::error ? exit_code(scene.error) : ExitCode::differs);
  }
  return worst;
}

/// Returns the exit code of one run.
inline ExitCode exit_code(const RunRecord& record) {
  switch (record.outcome) {
    case RunOutcome::completed:
      return ExitCode::ok;
    case RunOutcome::diverged:
      return ExitCode::diverged;
    case RunOutcome::refused:
      return ExitCode::usage;
    case RunOutcome::failed:
      return ExitCode::output;
    case RunOutcome::not_run:
      return record.damaged ? ExitCode::usage : ExitCode::interrupted;
  }
  return ExitCode::interrupted;
}

/// Returns the exit code of the worst run. A missing run counts as interrupted, a damaged record as usage.
inline ExitCode exit_code(const SweepResults& results) {
  ExitCode worst = ExitCode::ok;
  for (const SweepRow& row : results.rows) worst = std::max(worst, exit_code(row.record));
  return worst;
}

}  // namespace drape

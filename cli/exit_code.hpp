#pragma once

#include <algorithm>

#include "check/report.hpp"
#include "core/error.hpp"
#include "sweep/results.hpp"

namespace drape {

/// What the drape process returns to its caller. Of several, the largest.
enum class ExitCode : int {
  ok = 0,
  differs = 1,       ///< images or motion differ from the golden ones, or an audit has found something
  usage = 2,         ///< the command line, the scene or a file it names is wrong
  diverged = 3,      ///< the simulation left the range of finite numbers
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

/// Of the scene that is worst off, where an error is worse than a change.
inline ExitCode exit_code(const CheckReport& report) {
  ExitCode worst = ExitCode::ok;
  for (const SceneResult& scene : report.scenes) {
    if (scene.passed()) continue;
    worst = std::max(worst, scene.verdict == SceneVerdict::error ? exit_code(scene.error) : ExitCode::differs);
  }
  return worst;
}

/// That a run would have had alone.
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

/// Exit code of the worst run. A run that was not run counts as interrupted, or as usage if its record is damaged.
inline ExitCode exit_code(const SweepResults& results) {
  ExitCode worst = ExitCode::ok;
  for (const SweepRow& row : results.rows) worst = std::max(worst, exit_code(row.record));
  return worst;
}

}  // namespace drape

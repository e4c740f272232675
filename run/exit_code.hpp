#pragma once

#include "core/error.hpp"

namespace drape {

/// What the drape process returns to its caller, and what the record of a run keeps. Of several, the largest.
enum class ExitCode : int {
  ok = 0,
  differs = 1,       ///< images or motion differ from the golden ones
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

}  // namespace drape

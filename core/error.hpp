#pragma once

#include <stdexcept>
#include <string>

namespace drape {

/// What the drape process returns to its caller.
enum class ExitCode : int {
  ok = 0,
  differs = 1,       ///< images or motion differ from the golden ones
  usage = 2,         ///< the command line, the scene or a file it names is wrong
  diverged = 3,      ///< the simulation left the range of finite numbers
  output = 4,        ///< drawing, encoding or writing failed
  interrupted = 130  ///< Ctrl-C or SIGTERM
};

/// A failure with a message for the person at the terminal and the exit code it leads to. The message is complete: it
/// names the file or key, what was expected and what was found.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The command line, a scene or an input file is wrong. The message may have several lines, one per problem.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// Drawing, encoding or writing a file failed.
class OutputError : public Error {
 public:
  explicit OutputError(const std::string& message) : Error(ExitCode::output, message) {}
};

}  // namespace drape

#pragma once

// Example:
//   try {
//     drape::load_scene("scene.toml");
//   } catch (const drape::Error& error) {
//     std::fputs(error.what(), stderr);  // every problem, a line each
//   }

#include <stdexcept>
#include <string>

namespace drape {

/// What an error is of, the worse the later: several errors together are of the kind of the worst.
enum class ErrorKind {
  usage,     ///< what is asked for, the scene or a file it names is wrong
  diverged,  ///< the simulation left the range of finite numbers, or gained energy out of nothing
  output     ///< drawing, encoding or writing failed
};

/// A failure with a message for people. The message is complete: it names the file or key, what was expected and what
/// was found.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// What is asked for, a scene or an input file is wrong. The message may have several lines, one per problem.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ErrorKind::usage, message) {}
};

/// The motion blew up, or left the range of finite numbers.
class DivergedError : public Error {
 public:
  explicit DivergedError(const std::string& message) : Error(ErrorKind::diverged, message) {}
};

/// Drawing, encoding or writing a file failed.
class OutputError : public Error {
 public:
  explicit OutputError(const std::string& message) : Error(ErrorKind::output, message) {}
};

}  // namespace drape

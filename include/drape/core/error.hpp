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

/// Category of an error, by increasing severity. Several errors together have the most severe category.
enum class ErrorKind {
  usage,     ///< the command, the scene or one of its files is wrong
  diverged,  ///< the simulation reached non-finite numbers, or gained energy
  output     ///< drawing, encoding or writing failed
};

/// A failure with a complete message for people: the file or key, the expected value and the one found.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// A wrong command, scene or input file. The message may have several lines, one per problem.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ErrorKind::usage, message) {}
};

/// A motion that blew up or reached non-finite numbers.
class DivergedError : public Error {
 public:
  explicit DivergedError(const std::string& message) : Error(ErrorKind::diverged, message) {}
};

/// A failure to draw, encode or write a file.
class OutputError : public Error {
 public:
  explicit OutputError(const std::string& message) : Error(ErrorKind::output, message) {}
};

}  // namespace drape

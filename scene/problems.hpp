#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/document.hpp"

namespace drape {

/// A scene whose values are valid one by one but not together, for example steps too long for the method.
class SceneConflict : public UsageError {
 public:
  using UsageError::UsageError;
};

/// Collector of a scene's problems, so that users see all of them at once.
class Problems {
 public:
  /// @param file      scene file name for messages
  /// @param overrides "key.path=value", in order
  Problems(std::filesystem::path file, std::vector<std::string> overrides)
      : file_(std::move(file)), overrides_(std::move(overrides)) {}

  /// @param message a sentence without a full stop; further lines are shown below it
  void add(const Place& place, std::string message) { found_.push_back({place, std::move(message)}); }

  [[nodiscard]] std::size_t count() const { return found_.size(); }

  /// Returns "scene.toml:4:9" or "--set key.path=value"; the file alone for a place without a text.
  [[nodiscard]] std::string text(const Place& place) const;

  /// Lists the problems in the order of their places, a line each: at most a hundred, then the number of others.
  [[nodiscard]] std::string text() const;

  /// @throws Wrong with all problems, if there are any
  template <class Wrong = UsageError>
  void throw_if_any() const {
    if (!found_.empty()) throw Wrong(text());
  }

 private:
  struct Problem {
    Place place;
    std::string message;
  };
  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  std::vector<Problem> found_;
};

}  // namespace drape

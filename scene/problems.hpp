#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/document.hpp"

namespace drape {

/// A scene whose values are all valid, but not together: its steps are too long for its method, say.
class SceneConflict : public UsageError {
 public:
  using UsageError::UsageError;
};

/// Collects what is wrong with a scene, so that a person sees all of it at once.
class Problems {
 public:
  /// @param file      the scene's name, as messages show it
  /// @param overrides "key.path=value", in order
  Problems(std::filesystem::path file, std::vector<std::string> overrides)
      : file_(std::move(file)), overrides_(std::move(overrides)) {}

  /// @param message a sentence without a full stop; it may have more lines, which are shown below it
  void add(const Place& place, std::string message) { found_.push_back({place, std::move(message)}); }

  [[nodiscard]] std::size_t count() const { return found_.size(); }

  /// "scene.toml:4:9" or "--set key.path=value"; the file alone for a place that is in no text.
  [[nodiscard]] std::string text(const Place& place) const;

  /// What lists the problems in the order of their places, a line each; of many the first hundred and how many more
  /// there are.
  [[nodiscard]] std::string text() const;

  /// @throws Wrong that says so, if there are any
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

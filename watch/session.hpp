#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <vector>

#include "run/progress.hpp"
#include "run/run_scene.hpp"
#include "scene/scene.hpp"
#include "watch/file_stamps.hpp"

namespace drape {

/// What a watched scene shows.
struct WatchedFilm {
  std::int64_t version = 0;         ///< grows with every change of what follows
  bool running = false;             ///< the scene as it is now is being drawn
  std::vector<std::string> errors;  ///< of the scene as it is now, "flag.toml:3:9: …"; then the film is an older one's
  std::vector<std::string> hints;   ///< what may not be meant
  std::string summary;              ///< "30×20 cells …", a line
  std::string film;                 ///< bytes of a GIF; empty until there is one
  std::int64_t film_number = 0;     ///< grows with every film
  double load = 0, simulate = 0, draw = 0, encode = 0, total = 0;  ///< time of its stages [s]
};

/// Draws a scene's film whenever one of the files that it is read from is saved. What is still being drawn then is
/// stopped.
class WatchSession {
 public:
  /// How a scene is described in a line.
  using Describe = std::function<std::string(const Scene&, const RunOptions&)>;

  /// @param overrides as load_scene() takes them
  WatchSession(std::filesystem::path file, std::vector<std::string> overrides, GlBackend backend, Describe describe);

  /// Watches until a stop is requested.
  void run(const std::stop_token& stop);

  /// What there is to show at present. From any thread.
  [[nodiscard]] WatchedFilm film() const;

  /// How far the film that is being drawn is. From any thread.
  [[nodiscard]] const Progress& progress() const { return progress_; }

 private:
  /// Loads and draws the scene as it is now, until it changes.
  void draw(const std::stop_token& stop);
  void publish(const std::function<void(WatchedFilm&)>& change);
  [[nodiscard]] bool changed() const { return !(FileStamps(inputs_) == stamps_); }

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  GlBackend backend_;
  Describe describe_;
  std::vector<std::filesystem::path> inputs_;  // that are watched
  FileStamps stamps_;
  Progress progress_;
  mutable std::mutex mutex_;  // guards what follows
  WatchedFilm film_;
};

}  // namespace drape

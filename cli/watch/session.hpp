#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "run/progress.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// Modification times and sizes of some files. Two are equal if no file changed in between. A missing file differs from
/// every existing one.
class FileStamps {
 public:
  FileStamps() = default;
  explicit FileStamps(const std::vector<std::filesystem::path>& files);

  /// Changes the set of files: known files keep their stamps, new ones get current stamps.
  void follow(const std::vector<std::filesystem::path>& files);

  bool operator==(const FileStamps&) const = default;

 private:
  struct Stamp {
    bool there = false;
    std::filesystem::file_time_type written = {};
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  std::map<std::filesystem::path, Stamp> stamps_;
};

/// The published state of a watched scene.
struct WatchedFilm {
  std::int64_t version = 0;         ///< grows with every change of the members below
  bool running = false;             ///< the current scene is being drawn
  std::vector<std::string> errors;  ///< errors of the current scene, "flag.toml:3:9: …"; then the film is an older one
  std::vector<std::string> hints;   ///< settings that may be mistakes
  std::string summary;              ///< "30×20 cells …", one line
  std::string film;                 ///< bytes of a GIF; empty until the first film
  std::int64_t film_number = 0;     ///< grows with every film
  double load = 0, simulate = 0, draw = 0, encode = 0, total = 0;  ///< time of each stage [s]
};

/// A session that redraws a scene's film whenever one of its files is saved, and stops the drawing in progress.
class WatchSession {
 public:
  /// A function that describes a scene in one line.
  using Describe = std::function<std::string(const LoadedScene&, const RunOptions&)>;

  /// @param overrides as for load_scene()
  WatchSession(std::filesystem::path file, std::vector<std::string> overrides, GlBackend backend, Describe describe);

  /// Watches until a stop is requested.
  void run(const std::stop_token& stop);

  /// Returns the current state. Thread-safe.
  [[nodiscard]] WatchedFilm film() const;

  /// Returns the progress of the current film. Thread-safe.
  [[nodiscard]] const Progress& progress() const { return progress_; }

 private:
  /// Loads and draws the current scene, until it changes.
  void draw(const std::stop_token& stop);
  void publish(const std::function<void(WatchedFilm&)>& change);
  [[nodiscard]] bool changed() const { return !(FileStamps(inputs_) == stamps_); }

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  GlBackend backend_;
  Describe describe_;
  std::vector<std::filesystem::path> inputs_;  // the watched files
  FileStamps stamps_;
  Progress progress_;
  mutable std::mutex mutex_;  // guards film_
  WatchedFilm film_;
};

/// HTTP server on 127.0.0.1 for a session's page, until destroyed. Other machines cannot reach it. A request must name
/// this address, which excludes pages of other sites in the same browser.
class WatchServer {
 public:
  /// @param session outlives the server
  /// @param port    0: any free port
  /// @throws OutputError if the port is not available
  WatchServer(const WatchSession& session, int port);
  ~WatchServer();
  WatchServer(const WatchServer&) = delete;
  WatchServer& operator=(const WatchServer&) = delete;

  /// Returns "http://127.0.0.1:8000/".
  [[nodiscard]] std::string address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace drape

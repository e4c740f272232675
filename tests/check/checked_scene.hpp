#pragma once

#include "check/check_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::test {

inline constexpr const char* small_swing = R"(
[cloth]
mesh = { grid = [6, 6] }
stiffness = 50
pins = ["corner:x-y-"]
[time]
step = 0.02
duration = 2
[integrator]
method = "liu13"
tolerance = 1e-3
[effects.gravity]
[video]
fps = 30
size = [64, 48]
[check]
frames = [0, 10, 25]
)";

/// A scene of a small cloth that swings for two seconds, in its own folder.
class CheckedScene : public InScratchFolder {
 protected:
  CheckedScene() { put(folder_ / "swing.toml", small_swing); }

  [[nodiscard]] LoadedScene scene(const std::vector<std::string>& overrides = {}) const {
    return load_scene(folder_ / "swing.toml", overrides);
  }
  void bless() { bless_scene(scene(), scene().check, GlBackend::automatic, {}, progress_); }

  SceneResult check_read(const LoadedScene& of, const CheckOptions& options = {.update = UpdateMode::none}) {
    return check_scene(of, of.name, of.check, options, {}, progress_);
  }
  SceneResult check(const std::vector<std::string>& overrides = {},
                    const CheckOptions& options = {.update = UpdateMode::none}) {
    return check_read(scene(overrides), options);
  }

  [[nodiscard]] std::filesystem::path golden() const { return folder_ / "swing.golden"; }

  const std::vector<std::string> as_written;  // no overrides
  Progress progress_;
};

}  // namespace drape::test

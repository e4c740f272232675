#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/temporary_folder.hpp"
#include "motion/reader.hpp"
#include "scene/scene.hpp"

namespace drape {

/// The scene of a motion, put into a folder of its own for as long as this lives: its texture is read from there.
class MotionScene {
 public:
  /// @throws UsageError  if the scene is not that of the motion any more
  /// @throws OutputError if there is no room for it
  explicit MotionScene(const MotionReader& motion);

  /// As it was when the motion was computed.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// With overrides, see load_scene().
  [[nodiscard]] Scene load(const std::vector<std::string>& overrides) const;

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_;
  Scene scene_;
};

/// Looks whether a scene moves as another one.
/// @param name of where the other one is from
/// @throws UsageError that lists the keys that differ
void require_same_physics(const std::string& motion, const Scene& scene, const Scene& other, const std::string& name);

}  // namespace drape

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/temporary_folder.hpp"
#include "motion/reader.hpp"
#include "scene/scene.hpp"

namespace drape {

/// The scene of a motion, unpacked into a temporary folder for the lifetime of this object, e.g. for its texture.
class MotionScene {
 public:
  /// @throws UsageError  if the unpacked scene no longer matches the motion
  /// @throws OutputError if it cannot be written to disk
  explicit MotionScene(const MotionReader& motion);

  /// Returns the scene as it was when the motion was computed.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// Loads the scene with overrides, see load_scene().
  [[nodiscard]] Scene load(const std::vector<std::string>& overrides) const;

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_;
  Scene scene_;
};

/// Checks that two scenes have the same physics.
/// @param name name of the source of `other`
/// @throws UsageError that lists the keys that differ
void require_same_physics(const std::string& motion, const Scene& scene, const Scene& other, const std::string& name);

}  // namespace drape

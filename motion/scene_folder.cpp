#include "motion/scene_folder.hpp"

#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "scene/physics.hpp"
#include "scene/quality.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

/// Loads the scene of a motion; problems name the motion's file.
Scene load_scene_of(const MotionReader& motion, const fs::path& file) {
  try {
    return load_scene(file);
  } catch (const UsageError& error) {
    const std::string folder = file.parent_path().string() + "/";
    std::string text = error.what();
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) text.erase(at, folder.size());
    throw UsageError(fmt::format("{}: the file's scene cannot be read: {}", shown(motion.file()), text));
  }
}

/// Checks that the motion contains all input files of its scene. @throws UsageError if the scene names a file elsewhere
void require_own_inputs(const MotionReader& motion, const Scene& scene, const fs::path& folder) {
  for (const fs::path& input : scene.inputs) {
    if (input.lexically_normal().parent_path() == folder.lexically_normal()) continue;
    throw UsageError(
        fmt::format("{}: the file's scene names a file that is not in it: {}", shown(motion.file()), shown(input)));
  }
}

}  // namespace

MotionScene::MotionScene(const MotionReader& motion) : folder_("drape-scene") {
  const MotionHeader& header = motion.header();
  for (std::size_t k = 0; k < header.files.size(); ++k) {
    write_file_atomically(folder_.path() / header.files[k], motion.scene_file(k));
  }
  file_ = folder_.path() / (header.name + ".toml");
  write_file_atomically(file_, header.scene);
  scene_ = load_scene_of(motion, file_);
  require_own_inputs(motion, scene_, folder_.path());
  const Cloth& cloth = scene_.simulation.cloth;
  if (cloth.vertex_count() != header.vertices || static_cast<int>(cloth.triangles.size()) != header.triangles) {
    throw UsageError(shown(motion.file()) + ": the file's scene has another cloth than its motion");
  }
  if (scene_.simulation.step != header.step) {
    throw UsageError(shown(motion.file()) + ": the file's scene has another time step than its motion");
  }
  if (physics_hash(physics_values(scene_)) != header.physics) {
    throw UsageError(
        fmt::format("{}: this drape interprets its scene differently from drape {}, which computed the motion",
                    shown(motion.file()), shown(header.program)));
  }
}

Scene MotionScene::load(const std::vector<std::string>& overrides) const {
  return load_scene(file_, overrides, cells_of(scene_));
}

void require_same_physics(const std::string& motion, const Scene& scene, const Scene& other, const std::string& name) {
  const std::string difference = physics_difference(physics_values(scene), physics_values(other), name);
  if (difference.empty()) return;
  throw UsageError(
      fmt::format("{} is a different motion from what {} gives: simulate again, or leave these values unchanged\n{}",
                  motion, name, difference));
}

}  // namespace drape

#include "motion/scene_folder.hpp"

#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "scene/physics.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

/// What a motion's own files are called is chosen by drape, and leads to no other folder.
void require_plain_name(const MotionReader& motion, const std::string& name) {
  if (fs::path(name).filename() == name && name != "." && name != "..") return;
  throw UsageError(fmt::format("{}: the file names a file of its scene '{}'", shown(motion.file()), shown(name)));
}

}  // namespace

MotionScene::MotionScene(const MotionReader& motion) : folder_("drape-scene") {
  const MotionHeader& header = motion.header();
  for (std::size_t k = 0; k < header.files.size(); ++k) {
    require_plain_name(motion, header.files[k]);
    write_file_atomically(folder_.path() / header.files[k], motion.scene_file(k));
  }
  require_plain_name(motion, header.name + ".toml");
  file_ = folder_.path() / (header.name + ".toml");
  write_file_atomically(file_, header.scene);
  scene_ = load_scene(file_);
  const Cloth& cloth = scene_.simulation.cloth;
  if (cloth.vertex_count() != header.vertices || static_cast<int>(cloth.triangles.size()) != header.triangles) {
    throw UsageError(shown(motion.file()) + ": the file's scene has another cloth than its motion");
  }
  if (physics_hash(physics_values(scene_)) != header.physics) {
    throw UsageError(
        fmt::format("{}: this drape interprets its scene differently from drape {}, which computed the motion",
                    shown(motion.file()), shown(header.program)));
  }
}

Scene MotionScene::load(const std::vector<std::string>& overrides) const { return load_scene(file_, overrides); }

void require_same_physics(const std::string& motion, const Scene& scene, const Scene& other, const std::string& name) {
  const std::string difference = physics_difference(physics_values(scene), physics_values(other), name);
  if (difference.empty()) return;
  throw UsageError(
      fmt::format("{} is a different motion from what {} gives: simulate again, or leave these values unchanged\n{}",
                  motion, name, difference));
}

}  // namespace drape

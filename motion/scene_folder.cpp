#include "motion/scene_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "scene/physics.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

fs::path new_folder() {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "drape-scene-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    throw OutputError(fmt::format("cannot make a folder for the motion's scene in {}: {}",
                                  fs::path(name).parent_path().string(), std::generic_category().message(errno)));
  }
  return name;
}

/// A motion's scene, whose problems are those of the motion's file.
Scene load_scene_of(const MotionReader& motion, const fs::path& file) {
  try {
    return load_scene(file);
  } catch (const UsageError& error) {
    const std::string folder = file.parent_path().string() + "/";
    std::string text = error.what();
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) text.erase(at, folder.size());
    throw UsageError(fmt::format("{}: the file's scene cannot be read: {}", motion.file().string(), text));
  }
}

/// The file has all that its scene is read from. @throws UsageError if the scene names a file elsewhere
void require_own_inputs(const MotionReader& motion, const Scene& scene, const fs::path& folder) {
  for (const fs::path& input : scene.inputs) {
    if (input.lexically_normal().parent_path() == folder.lexically_normal()) continue;
    throw UsageError(escape_controls(fmt::format("{}: the file's scene names a file that is not in it: {}",
                                                 motion.file().string(), input.string())));
  }
}

}  // namespace

MotionScene::MotionScene(const MotionReader& motion) : folder_(new_folder()) {
  const MotionHeader& header = motion.header();
  try {
    for (std::size_t k = 0; k < header.files.size(); ++k) {
      write_file_atomically(folder_ / header.files[k], motion.scene_file(k));
    }
    file_ = folder_ / (header.name + ".toml");
    write_file_atomically(file_, header.scene);
    scene_ = load_scene_of(motion, file_);
    require_own_inputs(motion, scene_, folder_);
    const Cloth& cloth = scene_.simulation.cloth;
    if (cloth.vertex_count() != header.vertices || static_cast<int>(cloth.triangles.size()) != header.triangles) {
      throw UsageError(motion.file().string() + ": the file's scene has another cloth than its motion");
    }
    if (scene_.simulation.step != header.step) {
      throw UsageError(motion.file().string() + ": the file's scene has another time step than its motion");
    }
    if (physics_hash(physics_values(scene_)) != header.physics) {
      throw UsageError(
          fmt::format("{}: this drape interprets its scene differently from drape {}, which computed the motion",
                      motion.file().string(), header.program));
    }
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

Scene MotionScene::load(const std::vector<std::string>& overrides) const { return load_scene(file_, overrides); }

MotionScene::~MotionScene() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void require_same_physics(const std::string& motion, const Scene& scene, const Scene& other, const std::string& name) {
  const std::string difference = physics_difference(physics_values(scene), physics_values(other), name);
  if (difference.empty()) return;
  throw UsageError(
      fmt::format("{} is a different motion from what {} gives: simulate again, or leave these values unchanged\n{}",
                  motion, name, difference));
}

}  // namespace drape

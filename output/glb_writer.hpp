#pragma once

#include <memory>
#include <string>
#include <vector>

#include "output/collider_mesh.hpp"
#include "output/format.hpp"
#include "output/gltf_mesh.hpp"

namespace drape {

/// Writes the motion as binary glTF 2.0: the cloth with one morph target per frame and an animation of their weights,
/// and the colliders. In metres, rotated to glTF's y up, in single precision.
class GlbWriter final : public MotionWriter {
 public:
  GlbWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  /// A sphere: a mesh around the origin, placed by its node.
  struct Ball {
    SphereShape first;
    std::unique_ptr<Surface> surface;
    std::unique_ptr<GltfMorphedMesh> mesh;
    std::vector<float> places;
    bool moves = false;
  };
  /// A body, or a ground, which is static.
  struct Solid {
    std::string name;
    std::shared_ptr<const std::vector<Triangle>> triangles;
    std::unique_ptr<GltfMorphedMesh> mesh;
    bool is_ground = false;
  };

  void add_first(const Frame& frame);
  [[nodiscard]] std::string json(GltfParts& parts, std::vector<std::string>& tail);

  FilmInfo film_;
  PartialFile file_;
  GroundPatch patch_;
  std::unique_ptr<GltfMorphedMesh> cloth_;
  std::vector<Ball> balls_;
  std::vector<Solid> solids_;
  std::vector<float> times_;
};

OutputFormat glb_format();

}  // namespace drape

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "output/collider_mesh.hpp"
#include "output/format.hpp"
#include "output/gltf_mesh.hpp"

namespace drape {

/// The motion as binary glTF 2.0: the cloth with a morph target for each frame, whose weights an animation goes
/// through, and what it may touch. In metres, turned so that y is up, as glTF has it; in single precision.
class GlbWriter final : public MotionWriter {
 public:
  GlbWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  /// A sphere is a mesh around the origin, whose place is its node's.
  struct Ball {
    SphereShape first;
    std::unique_ptr<Surface> surface;
    std::unique_ptr<GltfMorphedMesh> mesh;
    std::vector<float> places;
    bool moves = false;
  };
  /// A body, or a ground, which rests.
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

#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "drape/sim/mesh.hpp"
#include "output/mesh_writers.hpp"
#include "output/registry.hpp"

namespace drape {

/// JSON objects of a glTF file, and the layout of the bytes that they refer to.
class GltfParts {
 public:
  /// Adds a view of the next bytes in file order. @returns its index
  int add_view(std::uint64_t size, const std::string& more = {});
  /// Adds an accessor. @param more fields beside the view: "\"componentType\": 5126, …" @returns its index
  int add_accessor(int view, std::uint64_t offset, std::uint64_t count, const std::string& more);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::vector<std::string>& views() const { return views_; }
  [[nodiscard]] const std::vector<std::string>& accessors() const { return accessors_; }

 private:
  std::uint64_t size_ = 0;  // of all views [bytes]
  std::vector<std::string> views_, accessors_;
};

/// A moving triangle mesh as glTF stores it: the first frame, and for each later one a morph target with the
/// displacements from the first. Vertices are spooled to disk.
class GltfMorphedMesh {
 public:
  /// @param uvs    per triangle corner, or empty. A vertex with several is duplicated; duplicates follow all vertices.
  /// @param smooth writes vertex normals; otherwise triangles look flat
  /// @param output destination file, beside which vertices are spooled
  GltfMorphedMesh(const PartialFile& output, const std::vector<Triangle>& triangles,
                  const std::vector<std::array<float, 2>>& uvs, Eigen::Index vertices, bool smooth);

  /// Adds the next frame.
  void add(const Vertices& x);

  [[nodiscard]] bool moves() const { return moves_; }
  /// Adds the views and accessors of the bytes that write() will write. @returns the mesh's primitive
  std::string describe(GltfParts& parts, int material);
  void write(PartialFile& file);

 private:
  using Singles = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  struct Bounds {
    Eigen::RowVector3f low, high;
  };

  [[nodiscard]] Singles split(const Vertices& of_vertices) const;
  [[nodiscard]] Vertices normals(const Vertices& x) const;
  [[nodiscard]] std::string attributes(int position, std::optional<int> normal) const;

  const std::vector<Triangle>& triangles_;
  bool smooth_, moves_ = false;
  std::vector<int> vertex_of_;             // per glTF vertex
  std::vector<std::array<float, 2>> uvs_;  // per glTF vertex, or empty
  std::vector<std::uint32_t> indices_;
  Singles first_x_, first_n_;
  std::vector<Bounds> bounds_;
  Spool positions_, normals_;
};

/// Writes the motion as binary glTF 2.0: each cloth with one morph target per frame and an animation of their weights,
/// and the colliders. In metres, rotated to glTF's y up, in single precision.
class GlbWriter final : public MotionWriter {
 public:
  GlbWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  /// A sphere: a mesh around the origin, placed and scaled by its node.
  struct Ball {
    SphereShape first;
    std::unique_ptr<Surface> surface;
    std::unique_ptr<GltfMorphedMesh> mesh;
    std::vector<float> places, scales;
    bool moves = false, grows = false;
  };
  /// A body, or a ground, which is static.
  struct Solid {
    std::string name;
    std::shared_ptr<const std::vector<Triangle>> triangles;
    std::unique_ptr<GltfMorphedMesh> mesh;
    bool is_ground = false;
  };

  /// A cloth: all vertices and triangles, or those of one of several cloths with a name.
  struct Sheet {
    std::string name;
    int first_vertex = 0, vertex_count = 0;
    std::vector<Triangle> triangles;  // their vertices count from the cloth's first
    std::unique_ptr<GltfMorphedMesh> mesh;
  };

  void add_sheets(const Frame& frame);
  void add_first(const Frame& frame);
  /// Returns the materials of the sheets, and adds the bytes of their textures to the tail.
  /// @param images fields of the textures, if any
  [[nodiscard]] std::vector<std::string> sheet_materials(GltfParts& parts, std::vector<std::string>& tail,
                                                         std::string& images) const;
  /// Returns the field of the animation, empty if nothing moves, and adds its bytes to the tail.
  /// @param morphing nodes whose meshes change their shape
  [[nodiscard]] std::string animation(GltfParts& parts, std::vector<std::string>& tail,
                                      const std::vector<std::size_t>& morphing) const;
  [[nodiscard]] std::string json(GltfParts& parts, std::vector<std::string>& tail);

  FilmInfo film_;
  PartialFile file_;
  GroundPatch patch_;
  std::deque<Sheet> sheets_;  // keeps the places of triangles, to which meshes refer
  std::vector<Ball> balls_;
  std::vector<Solid> solids_;
  std::vector<float> times_;
};

OutputFormat glb_format();

}  // namespace drape

#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/files.hpp"
#include "drape/sim/mesh.hpp"
#include "drape/sim/state.hpp"
#include "output/registry.hpp"

namespace drape {

/// Surface of colliders, for formats with only triangles.
struct Surface {
  Vertices positions;  ///< n×3 [m]
  std::vector<Triangle> triangles;
};

/// Part of an infinite ground that is shown: a square around the initial cloth.
struct GroundPatch {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the cloth; projected onto the ground [m]
  double side = 4;                                   ///< side of the square [m]
};

/// Returns a patch four times as wide as the cloth.
GroundPatch ground_patch(const Vertices& cloth);

/// Returns the corners of a square of a ground, counterclockwise seen from above it: 4×3 [m].
Vertices ground_corners(const GroundShape& ground, const GroundPatch& patch);

/// Returns all colliders as one surface: inscribed spheres of 48 by 24 parts, and squares of grounds.
Surface surface_of(const std::vector<Collider>& colliders, const GroundPatch& patch);

/// Possible entries of OutputFormat::beside.
inline constexpr const char* first_mesh = ".obj";
inline constexpr const char* cloth_frames = "/{frame}.vtp";
inline constexpr const char* collider_frames = "/colliders-{frame}.vtp";

/// Returns the default number of digits of a frame's number: those of the film's last frame, so that files sort by
/// name.
int frame_digits(const FilmInfo& film);

/// Returns the name of a companion file: replaces the extension of `file` by an entry of OutputFormat::beside.
std::string file_beside(const std::filesystem::path& file, const char* beside, const FilmInfo& film, int frame);

/// Returns a function that writes a frame's cloth as a Wavefront OBJ file. v has nine digits, exact for single
/// precision [m]; vt lists each pair of texture coordinates once; f is counterclockwise from the front. Vertices keep
/// their numbers, counted from 1. z is up, as everywhere in drape; OBJ defines no axis. Spheres and bodies follow as
/// objects sphere1, body1 and so on; the cloth is then the object "cloth". Grounds are infinite and left out.
/// @param film its triangles and texture coordinates are read now
std::function<std::string(const Frame&)> obj_writer(const FilmInfo& film);
/// Returns a function that writes the cloth alone.
std::function<std::string(const Frame&)> cloth_obj_writer(const FilmInfo& film);

OutputFormat obj_format();

/// Returns a function that writes a frame's cloth as a binary PLY file, little endian: x, y, z in double precision [m,
/// z up], and its triangles. Texture coordinates belong to corners, not vertices, and are left out, as are colliders.
/// @param film its triangles are read now
std::function<std::string(const Frame&)> ply_writer(const FilmInfo& film);

OutputFormat ply_format();

/// Writes the motion as a Point Cache 2, which Blender's Mesh Cache modifier and others play on a mesh with the same
/// vertices: NAME.obj beside it, the cloth of the first frame. Points are in single precision [m, z up], with one
/// sample per frame; the first is at frame 0 of the cache.
class Pc2Writer final : public MotionWriter {
 public:
  Pc2Writer(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  [[nodiscard]] std::string header(Eigen::Index points, int samples) const;

  int expected_;
  PartialFile file_, mesh_;
  std::function<std::string(const Frame&)> mesh_text_;
  Eigen::Index points_ = 0;
  int samples_ = 0;
};

OutputFormat pc2_format();

}  // namespace drape

#pragma once

#include <bit>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/files.hpp"
#include "drape/core/error.hpp"
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

/// Returns a function that writes a frame's cloth as PolyData in VTK's XML: points in double precision [m], with
/// velocity [m/s] and stretch (VertexStretch); texture coordinates unless a seam gives a vertex several; time,
/// energies, spheres and grounds as field data. Numbers are in base64, so the file is pure XML.
/// @param film its cloth is read now
std::function<std::string(const Frame&)> vtp_writer(const FilmInfo& film);

/// Writes a motion for ParaView: NAME.pvd lists the files of each moment in the folder NAME. FRAME.vtp has the cloth;
/// colliders-FRAME.vtp, written only when they have moved, has the colliders' surfaces.
class PvdWriter final : public MotionWriter {
 public:
  PvdWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  void add_part(double time, int part, const std::filesystem::path& file);

  FilmInfo film_;
  PartialFile file_;
  std::function<std::string(const Frame&)> cloth_;
  GroundPatch patch_;
  std::string colliders_, colliders_file_;  // last written surfaces, and their file
  std::string lines_;                       // of the .pvd
  std::vector<OutputFile> written_;
};

OutputFormat vtp_format();
OutputFormat pvd_format();

static_assert(std::endian::native == std::endian::little, "files have the machine's own byte order, and say little");

/// Appends a number's bytes, the least significant first.
template <class Number>
void append_number(std::string& bytes, std::type_identity_t<Number> number) {
  static_assert(std::is_arithmetic_v<Number>);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// @throws OutputError if a number was too large for single precision and became infinite
template <class Singles>
void require_single_precision(const Singles& numbers) {
  if (numbers.allFinite()) return;
  throw OutputError("a position beyond 3.4e38 m does not fit into the single precision of .pc2 and .usda files");
}

/// Returns the bytes of all vertices: x, y, z of each.
/// @tparam Number type of the file's numbers
/// @throws OutputError if a coordinate is too large for it
template <class Number>
std::string vertex_bytes(const Vertices& vertices) {
  const Eigen::Matrix<Number, Eigen::Dynamic, 3, Eigen::RowMajor> rows = vertices.template cast<Number>();
  if constexpr (std::is_same_v<Number, float>) require_single_precision(rows);
  return {reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.size()) * sizeof(Number)};
}

/// Returns the bytes of a vector of trivially copyable items.
template <class Thing>
std::string_view bytes_of(const std::vector<Thing>& things) {
  static_assert(std::is_trivially_copyable_v<Thing>);
  return {reinterpret_cast<const char*>(things.data()), things.size() * sizeof(Thing)};
}

}  // namespace drape

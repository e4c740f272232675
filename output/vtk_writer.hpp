#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "core/files.hpp"
#include "drape/core/error.hpp"
#include "drape/sim/mesh.hpp"
#include "output/mesh_writers.hpp"
#include "output/registry.hpp"

namespace drape {

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

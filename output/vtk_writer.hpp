#pragma once

#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "output/collider_mesh.hpp"
#include "output/format.hpp"

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

}  // namespace drape

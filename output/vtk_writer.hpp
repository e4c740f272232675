#pragma once

#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "output/collider_mesh.hpp"
#include "output/format.hpp"

namespace drape {

/// The cloth of a frame as PolyData in VTK's XML: points in double precision [m], of each its velocity [m/s] and how
/// far it is stretched (VertexStretch), its texture coordinates unless it has several at a seam; time, energies,
/// spheres and grounds as field data. Numbers are in base64, so the file is XML throughout.
/// @param film whose cloth is read now
std::function<std::string(const Frame&)> vtp_writer(const FilmInfo& film);

/// A motion for ParaView: NAME.pvd says which files of the folder NAME make up which moment, FRAME.vtp with the cloth
/// and, where there are any, colliders-FRAME.vtp with their surfaces, which is written only when they have moved.
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
  std::string colliders_, colliders_file_;  // the last that were written, and where to
  std::string lines_;                       // of the .pvd
  std::vector<OutputFile> written_;
};

OutputFormat vtp_format();
OutputFormat pvd_format();

}  // namespace drape

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "motion/import/motion_source.hpp"
#include "run/progress.hpp"

namespace drape {

/// Opens a sequence of mesh files (.obj, .ply, .vtp, .vtu, .vtk), "meshes/{frame:04}.obj", or a single one. A file is
/// read on request of its moment.
std::unique_ptr<MotionSource> open_mesh_sequence(const std::filesystem::path& file);

/// Opens a ParaView collection (.pvd) of .vtp files. Part 0 is the cloth. Other parts are bodies, without the
/// surfaces of spheres and grounds in the cloth's files, as drape writes them.
std::unique_ptr<MotionSource> open_pvd(const std::filesystem::path& file);

/// Opens an archive of numpy arrays (.npz): positions, f×n×3, and faces; optionally times, velocities, energies, rest,
/// uvs, fps, spheres, grounds, and bodyK_positions with bodyK_faces. Compressed arrays are read as streams.
std::unique_ptr<MotionSource> open_npz(const std::filesystem::path& file);

/// Opens a point cache (.pc2), whose faces are in a mesh file.
/// @param mesh empty: the .obj of the same name beside it
std::unique_ptr<MotionSource> open_pc2(const std::filesystem::path& file, const std::filesystem::path& mesh);

/// Opens a Mesh of an ASCII USD file, in metres with z up. Only the places of its point samples are in memory. Spheres
/// and Planes become spheres and grounds.
/// @param prim path; empty: the Mesh called Cloth, or the only one. Other meshes become bodies then.
std::unique_ptr<MotionSource> open_usd(const std::filesystem::path& file, const std::string& prim);

/// Conversion of a file's coordinates to metres with z up.
struct ImportAxes {
  bool y_up = false;  ///< true: (x, y, z) becomes (x, −z, y)
  double scale = 1;   ///< metres per unit of the file
};

/// Opens a motion in any of the formats above, by its name.
/// @param mesh mesh file of a .pc2
/// @param prim prim of a .usda
/// @throws UsageError also for an unknown format
std::unique_ptr<MotionSource> open_motion_source(const std::filesystem::path& file, const std::filesystem::path& mesh,
                                                 const std::string& prim);
/// Returns true for the name of an importable motion: a film, a sequence, or a single mesh.
bool is_importable(const std::filesystem::path& file);

/// Converts a motion to metres with z up.
std::unique_ptr<MotionSource> with_axes(std::unique_ptr<MotionSource> source, const ImportAxes& axes);

/// Joins several cloths into one mesh, in sequence.
/// @throws UsageError if their numbers of moments differ
std::unique_ptr<MotionSource> joined(std::vector<std::unique_ptr<MotionSource>> sources);

/// Options for importing a motion.
struct ImportOptions {
  std::vector<std::string> cloths = {};  ///< files or sequences, at least one; several become one mesh
  std::vector<std::string> bodies = {};  ///< files or sequences, each a separate body
  std::string mesh = {}, prim = {};      ///< see open_motion_source()
  ImportAxes axes = {};
  std::optional<double> fps = {};  ///< frames per second; absent: the times in the files, otherwise 25
};

/// Properties of an imported motion.
struct ImportedMotion {
  std::int64_t frames = 0;
  double step = 0;  ///< frame interval [s]
  int vertices = 0, triangles = 0, bodies = 0;
  std::vector<std::filesystem::path> files = {};  ///< files that were read
  std::uint64_t size = 0;                         ///< file size [bytes]
};

/// Imports a motion into a motion file without physics: velocities that the files lack are differences of positions,
/// energies are 0. Memory holds three moments of the cloth and all of moving bodies.
/// @param file name ending in .drape
/// @throws UsageError  naming the faulty input
/// @throws OutputError if the file cannot be written
/// @throws Interrupted if a stop is requested; no file remains
ImportedMotion import_motion(const ImportOptions& options, const std::filesystem::path& file,
                             const std::stop_token& stop, Progress& progress);

}  // namespace drape

#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "import/motion_source.hpp"

namespace drape {

/// A sequence of mesh files (.obj, .ply, .vtp, .vtu, .vtk), "meshes/{frame:04}.obj", or a single one. A file is read
/// when its moment is asked for.
std::unique_ptr<MotionSource> open_mesh_sequence(const std::filesystem::path& file);

/// A ParaView collection (.pvd) of .vtp files. Its part 0 is the cloth; other parts are bodies, unless the files of the
/// cloth name the spheres and grounds that drape draws there.
std::unique_ptr<MotionSource> open_pvd(const std::filesystem::path& file);

/// numpy's arrays (.npz): positions, f×n×3, and faces; if there are any, times, velocities, energies, rest, uvs, fps,
/// spheres, grounds, and bodyK_positions with bodyK_faces. An array that is compressed is read as a stream.
std::unique_ptr<MotionSource> open_npz(const std::filesystem::path& file);

/// A point cache (.pc2), whose faces are in a mesh file.
/// @param mesh empty: the .obj of the same name beside it
std::unique_ptr<MotionSource> open_pc2(const std::filesystem::path& file, const std::filesystem::path& mesh);

/// A Mesh of an ASCII USD file, in metres with z up. Of its samples of points only the places are in memory. Spheres
/// and Planes are spheres and grounds.
/// @param prim its path; empty: the one that is called Cloth, or the only one. Other meshes are bodies then.
std::unique_ptr<MotionSource> open_usd(const std::filesystem::path& file, const std::string& prim);

/// How a file's coordinates become metres with z up.
struct ImportAxes {
  bool y_up = false;  ///< (x, y, z) becomes (x, −z, y)
  double scale = 1;   ///< metres of its unit
};

/// Opens a motion of any of the formats above, which its name says.
/// @param mesh of a .pc2
/// @param prim of a .usda
/// @throws UsageError also for a name that is none of them
std::unique_ptr<MotionSource> open_motion_source(const std::filesystem::path& file, const std::filesystem::path& mesh,
                                                 const std::string& prim);
/// Returns true if a name is that of a motion that can be imported: a film or a sequence, or a single mesh.
bool is_importable(const std::filesystem::path& file);

/// The same motion in metres with z up.
std::unique_ptr<MotionSource> with_axes(std::unique_ptr<MotionSource> source, const ImportAxes& axes);

/// Several cloths as one mesh, one after another.
/// @throws UsageError if they do not have as many moments
std::unique_ptr<MotionSource> joined(std::vector<std::unique_ptr<MotionSource>> sources);

}  // namespace drape

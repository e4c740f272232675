#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/energies.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// A file that holds one moment of a motion.
struct MeshFrame {
  Mesh mesh;
  std::optional<double> time = {};  ///< [s]
  Vertices velocities = {};         ///< n×3 [m/s]; empty: unknown
  std::optional<Energies> energies = {};
  std::vector<Eigen::Vector4d> spheres = {}, grounds = {};  ///< centre and radius; normal and height
  std::vector<Mesh> bodies = {};
  std::optional<std::uint64_t> polygons = {};  ///< a hash of the faces, where the triangles depend on their shape
};

/// Turns faces of any number of corners into the triangles of a mesh whose positions are known.
/// @param sizes   corners of each face
/// @param corners of all faces, one face after another; numbers of vertices
/// @throws UsageError "name: …" if a face has fewer than three corners, or one that is no vertex
void add_faces(const std::string& name, const std::vector<std::size_t>& sizes, const std::vector<double>& corners,
               Mesh& mesh);

/// Rows of three numbers.
/// @throws UsageError if there are not three for each vertex
Vertices vertices_of(const std::string& name, const std::vector<double>& numbers);

}  // namespace drape

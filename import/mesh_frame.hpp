#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/energies.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// The content of a file with one moment of a motion.
struct MeshFrame {
  Mesh mesh;
  std::optional<double> time = {};  ///< [s]
  Vertices velocities = {};         ///< n×3 [m/s]; empty: unknown
  std::optional<Energies> energies = {};
  std::vector<Eigen::Vector4d> spheres = {}, grounds = {};  ///< centre and radius; normal and height
  std::vector<Mesh> bodies = {};
  std::optional<std::uint64_t> polygons = {};  ///< hash of the faces, if their shape determines the triangles
};

/// Triangulates faces with any number of corners and adds them to a mesh with known positions.
/// @param sizes   corners per face
/// @param corners vertices of all faces in sequence
/// @throws UsageError "name: …" if a face has fewer than three corners, or an invalid vertex
void add_faces(const std::string& name, const std::vector<std::size_t>& sizes, const std::vector<double>& corners,
               Mesh& mesh);

/// Groups numbers into rows of three.
/// @throws UsageError unless there are three for each vertex
Vertices vertices_of(const std::string& name, const std::vector<double>& numbers);

}  // namespace drape

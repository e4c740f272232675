#pragma once

#include <filesystem>
#include <string>

#include "import/mesh_frame.hpp"

namespace drape {

/// Reads one mesh file, by its ending. @throws UsageError that names it
MeshFrame read_mesh_frame(const std::filesystem::path& file);

/// Looks whether a frame has the vertices and triangles of the first, at finite places.
/// @throws UsageError "name: …" with the first difference
void require_same_mesh(const std::string& name, const Mesh& first, const Mesh& mesh);

/// ".obj" for "A.OBJ".
std::string lower_ending(const std::filesystem::path& file);

}  // namespace drape

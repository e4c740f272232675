#pragma once

#include <filesystem>
#include <string>

#include "import/mesh_frame.hpp"

namespace drape {

/// Reads one mesh file, by its extension. @throws UsageError that names it
MeshFrame read_mesh_frame(const std::filesystem::path& file);

/// Checks that a frame has the vertices and triangles of the first one, and finite positions.
/// @throws UsageError "name: …" with the first difference
void require_same_mesh(const std::string& name, const Mesh& first, const Mesh& mesh);

/// Returns the extension in lower case: ".obj" for "A.OBJ".
std::string lower_ending(const std::filesystem::path& file);

}  // namespace drape

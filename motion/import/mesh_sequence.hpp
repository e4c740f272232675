#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motion/import/motion_source.hpp"

namespace drape {

/// Reads one mesh file, by its extension. @throws UsageError that names it
MeshFrame read_mesh_frame(const std::filesystem::path& file);

/// Checks that a frame has the vertices and triangles of the first one, and finite positions.
/// @throws UsageError "name: …" with the first difference
void require_same_mesh(const std::string& name, const Mesh& first, const Mesh& mesh);

/// Returns the extension in lower case: ".obj" for "A.OBJ".
std::string lower_ending(const std::filesystem::path& file);

/// Reads a PLY mesh: ASCII or binary of either byte order, with x, y, z of the element "vertex" and the list
/// "vertex_indices" or "vertex_index" of the element "face". Other elements and properties are ignored.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_ply(const std::string& name, std::string_view text);

}  // namespace drape

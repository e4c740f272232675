#pragma once

#include <filesystem>

#include "sim/mesh.hpp"

namespace drape {

/// Reads a mesh from a Wavefront OBJ (.obj) or an ASCII USD file (.usda, or .usd with such content), in metres with z
/// up. What is read of each format: see read_obj_mesh and read_usd_mesh.
/// @throws UsageError "file:line:column: message", or "file: message" where no place is at fault
Mesh read_mesh(const std::filesystem::path& file);

}  // namespace drape

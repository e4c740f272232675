#pragma once

#include <functional>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Returns a function that writes a frame's cloth as a binary PLY file, little endian: x, y, z in double precision [m,
/// z up], and its triangles. Texture coordinates belong to corners, not vertices, and are left out, as are colliders.
/// @param film its triangles are read now
std::function<std::string(const Frame&)> ply_writer(const FilmInfo& film);

OutputFormat ply_format();

}  // namespace drape

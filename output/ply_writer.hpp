#pragma once

#include <functional>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Writes the cloth of a frame as a binary PLY file, little endian: x, y, z in double precision [m, z up], and its
/// triangles. Texture coordinates, which belong to corners and not to vertices, are left out, as are spheres and
/// ground.
/// @param film whose triangles are read now
std::function<std::string(const Frame&)> ply_writer(const FilmInfo& film);

OutputFormat ply_format();

}  // namespace drape

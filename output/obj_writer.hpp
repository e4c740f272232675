#pragma once

#include <functional>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Writes the cloth of a frame as a Wavefront OBJ file: v with nine digits, which tell every two numbers in single
/// precision apart [m]; vt where the cloth has texture coordinates, each pair once; f, counterclockwise from the front.
/// Vertices keep their numbers, counted from 1. OBJ knows no axis: z is up, as everywhere in drape. Spheres and the
/// ground are left out: OBJ has nothing for them but more triangles.
/// @param film whose triangles and texture coordinates are read now
std::function<std::string(const Frame&)> obj_writer(const FilmInfo& film);

OutputFormat obj_format();

}  // namespace drape

#pragma once

#include <functional>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Returns a function that writes a frame's cloth as a Wavefront OBJ file. v has nine digits, exact for single
/// precision [m]; vt lists each pair of texture coordinates once; f is counterclockwise from the front. Vertices keep
/// their numbers, counted from 1. z is up, as everywhere in drape; OBJ defines no axis. Spheres and bodies follow as
/// objects sphere1, body1 and so on; the cloth is then the object "cloth". Grounds are infinite and left out.
/// @param film its triangles and texture coordinates are read now
std::function<std::string(const Frame&)> obj_writer(const FilmInfo& film);
/// Returns a function that writes the cloth alone.
std::function<std::string(const Frame&)> cloth_obj_writer(const FilmInfo& film);

OutputFormat obj_format();

}  // namespace drape

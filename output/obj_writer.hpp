#pragma once

#include <functional>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Writes the cloth of a frame as a Wavefront OBJ file: v with nine digits, which tell every two numbers in single
/// precision apart [m]; vt where the cloth has texture coordinates, each pair once; f, counterclockwise from the front.
/// Vertices keep their numbers, counted from 1. OBJ knows no axis: z is up, as everywhere in drape. Where there
/// are spheres or bodies, they follow as objects, body1, sphere1 and so on, and the cloth is the object "cloth".
/// Grounds, which have no end, are left out.
/// @param film whose triangles and texture coordinates are read now
std::function<std::string(const Frame&)> obj_writer(const FilmInfo& film);
/// Writes the cloth alone.
std::function<std::string(const Frame&)> cloth_obj_writer(const FilmInfo& film);

OutputFormat obj_format();

}  // namespace drape

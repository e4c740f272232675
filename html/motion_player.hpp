#pragma once

#include <cstddef>
#include <string>

#include "html/markup.hpp"

namespace drape::html {

/// A motion that a page can play, see output/motion_packer.hpp and motion_data.js.
struct PlayedMotion {
  std::string description;  ///< JSON: sizes, times, colours
  std::string data;         ///< its numbers, a zlib stream
  std::string texture;      ///< of the cloth, a PNG file; empty: it has none
  int frames = 0;
  double precision = 0;  ///< coordinates are whole multiples of it [m]
  double size = 0;       ///< diagonal of the box around the motion [m]
  std::size_t vertices = 0, triangles = 0;
};

/// A cloth to turn: WebGL shows a motion from any side, plays it, and colours it by its stretch. Without WebGL 2 or a
/// script a sentence stands in its place.
/// @param label of the canvas, for who cannot see it: "The cloth of scene 5"
Markup motion_player(const std::string& id, const PlayedMotion& motion, const std::string& label);

/// Describes a motion's size and precision in a sentence.
std::string describe(const PlayedMotion& motion);

}  // namespace drape::html

#pragma once

#include <cstddef>
#include <string>

#include "html/markup.hpp"

namespace drape::html {

/// A motion for playback in a page, see output/motion_packer.hpp and motion_data.js.
struct PlayedMotion {
  std::string description;  ///< JSON: sizes, times, colours
  std::string data;         ///< numbers of the motion, a zlib stream
  std::string texture;      ///< texture of the cloth, a PNG file; empty: none
  int frames = 0;
  double precision = 0;  ///< unit of the coordinates [m]
  double size = 0;       ///< diagonal of the motion's bounding box [m]
  std::size_t vertices = 0, triangles = 0;
};

/// Returns an interactive WebGL view of a motion: it can be turned, played, and coloured by its stretch. It shows the
/// poster frame until a moment is chosen, and plays from the start. Without WebGL 2 or scripts a sentence replaces it.
/// @param label name of the canvas for screen readers: "The cloth of scene 5"
Markup motion_player(const std::string& id, const PlayedMotion& motion, const std::string& label);

/// Describes a motion's size and precision in a sentence.
std::string describe(const PlayedMotion& motion);

}  // namespace drape::html

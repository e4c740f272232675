#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drape {

/// Properties of a film's frame for the choice of compared frames.
struct FrameProperties {
  std::uint64_t touched = 0;        ///< bit k: the cloth is within the contact range of body k
  std::size_t pins = 0;             ///< number of pinned vertices
  double kinetic = 0, elastic = 0;  ///< energies [J]
  double area = 0;    ///< area of the triangles projected towards the camera, without perspective or occlusion [m²]
  double change = 0;  ///< summed vertex movement across the picture since the previous frame [m]
};

/// Properties of all frames of a film.
struct FilmFacts {
  std::vector<std::string> bodies;      ///< "the sphere", "ground 2"
  std::vector<FrameProperties> frames;  ///< from frame 0
};

/// A frame to compare, with the reason.
struct ChosenFrame {
  int frame = 0;
  std::string why;  ///< "first contact with the sphere"
};

/// Chooses the significant frames of a film: start, first contact with each body, releases of pins, largest change of
/// the picture, extremes of energy and screen area. An event close to a chosen frame is added to its reason. At most
/// twelve, ascending.
std::vector<ChosenFrame> choose_frames(const FilmFacts& film);

}  // namespace drape

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drape {

/// What happens at a frame of a film.
struct FrameFacts {
  std::uint64_t touched = 0;        ///< bit k: the cloth is where body k pushes
  std::size_t pins = 0;             ///< vertices that are held
  double kinetic = 0, elastic = 0;  ///< energies [J]
  double area = 0;                  ///< of the triangles as the camera sees them, near or far, covered or not [m²]
  double change = 0;  ///< by how much the vertices have moved across the picture since the frame before, in sum [m]
};

/// A film, by what happens in it.
struct FilmFacts {
  std::vector<std::string> bodies;  ///< "the sphere", "ground 2"
  std::vector<FrameFacts> frames;   ///< of the film, from 0 on
};

/// A frame that is compared, and why.
struct ChosenFrame {
  int frame = 0;
  std::string why;  ///< "first contact with the sphere"
};

/// The frames in which a film does what it is there for: its start, the first contact with every body, the release of
/// pins, the largest change of the picture, the extremes of energy and of the area on screen. What happens close to a
/// frame that is there already is told with that one. At most a dozen, ascending.
std::vector<ChosenFrame> choose_frames(const FilmFacts& film);

}  // namespace drape

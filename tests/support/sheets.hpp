#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/cloth.hpp"

namespace drape::test {

/// A square of 2×2 m with cells of 25 cm, so that the smallest height of a triangle is 25 cm/√2.
inline constexpr int cells = 8;
inline constexpr double height = 0.25 / 1.4142135623730951;

Cloth square(int count = cells);

/// A hexagon of equilateral triangles, with so many of them along a side of 1 m.
Cloth hexagon(int count);

/// A square without its triangles whose middle is in a rectangle.
Cloth cut_square(int count, double from_x, double to_x, double from_y, double to_y);
Cloth holed(int count = cells);
Cloth notched(int count = cells);

/// As many zeros as a cloth's vertices have coordinates.
Vertices at_rest(const Cloth& cloth);

/// The smallest distance of features that share no vertex, while they move, and the smallest part that any keeps of
/// what it begins with: by looking at all pairs at many times.
struct Nearness {
  double distance, part;
};
Nearness nearness(const Cloth& cloth, const Vertices& from, const Vertices& moves);

}  // namespace drape::test

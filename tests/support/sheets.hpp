#pragma once

#include <Eigen/Core>
#include <vector>

#include "drape/sim/cloth.hpp"

namespace drape::test {

/// A square of 2×2 m with cells of 25 cm, so that the smallest height of a triangle is 25 cm/√2.
inline constexpr int cells = 8;
inline constexpr double height = 0.25 / 1.4142135623730951;

Cloth square(int count = cells);

/// Makes a hexagon of equilateral triangles, `count` of them along a side of 1 m.
Cloth hexagon(int count);

/// Makes a square without the triangles whose middle is in a rectangle.
Cloth cut_square(int count, double from_x, double to_x, double from_y, double to_y);
Cloth holed(int count = cells);
Cloth notched(int count = cells);

/// Returns zeros of the shape of a cloth's positions.
Vertices at_rest(const Cloth& cloth);

/// Smallest distance of features without a common vertex during a motion, and smallest ratio of a distance to its
/// initial value, found by testing all pairs at many times.
struct Nearness {
  double distance, part;
};
Nearness nearness(const Cloth& cloth, const Vertices& from, const Vertices& moves);

}  // namespace drape::test

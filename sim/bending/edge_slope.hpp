#pragma once

#include <utility>
#include <vector>

#include "sim/bending/rest_surface.hpp"

namespace drape {

/// A linear function of the vertices' places, Σ weight·x(vertex). A vertex may come more than once.
using LinearForm = std::vector<std::pair<int, double>>;

/// The slope of a function on a triangle, linear between its vertices, along a unit vector of the triangle's plane.
LinearForm slope_inside(const RestSurface& surface, const PlacedTriangle& t, const Eigen::Vector2d& along);

/// The slope of a smooth function across a side of a triangle, at the side's middle, out of the triangle, from the
/// function's values at the vertices around. Exact for quadratic functions of the unfolded rest shape.
///
/// Where the triangle and its neighbour are a parallelogram, their four vertices determine it. Else it is that of the
/// quadratic function with the least squares of differences to the values at the vertices of both, of what lies beyond
/// their sides, and so on while those do not determine it. Beyond a held triangle's side lies a clamp: a patch ends
/// there, and its function is fitted to the clamp's slope; if the side itself is a clamp's, that slope is the result.
/// @param t    a triangle that is free
/// @param side with a triangle beyond it
LinearForm edge_slope(const RestSurface& surface, const PlacedTriangle& t, int side);

}  // namespace drape

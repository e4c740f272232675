#pragma once

#include <utility>
#include <vector>

#include "sim/bending/rest_surface.hpp"

namespace drape {

/// A linear function of the vertices' positions, Σ weight·x(vertex). Vertices may repeat.
using LinearForm = std::vector<std::pair<int, double>>;

/// Returns the slope of a linear function on a triangle along a unit vector of its plane.
LinearForm slope_inside(const RestSurface& surface, const PlacedTriangle& t, const Eigen::Vector2d& along);

/// Returns the outward slope of a smooth function across a side of a triangle, at the middle of the side, from the
/// function's values at the surrounding vertices. Exact for quadratic functions of the unfolded rest shape.
///
/// If the triangle and its neighbour form a parallelogram, their four vertices determine the slope. Otherwise a
/// quadratic function is fitted by least squares to the vertices of both and of the triangles beyond their sides.
/// Further rings are added until it is determined. A patch ends at a clamp, and its function is fitted to the clamp's
/// slope. At the side of a clamp, the clamp's slope is the result.
/// @param t    a free triangle
/// @param side with a triangle beyond it
LinearForm edge_slope(const RestSurface& surface, const PlacedTriangle& t, int side);

}  // namespace drape

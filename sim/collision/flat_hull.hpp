#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Where the vertices of a cloth are that lies flat [m].
using FlatPlaces = Eigen::Matrix<double, Eigen::Dynamic, 2>;

/// The sides of triangles that have no other triangle beside them, with their triangle on the left. Nothing where two
/// triangles have the same side the same way round.
std::optional<std::vector<Edge>> border_of(const std::vector<Triangle>& triangles);

/// The corners of the convex hull of what has this border, counterclockwise (Andrew 1979).
std::vector<Eigen::RowVector2d> hull_of(const FlatPlaces& flat, const std::vector<Edge>& border);

/// The area that corners enclose counterclockwise [m²].
double area_of(const std::vector<Eigen::RowVector2d>& corners);

/// Whether all of a border is on the hull.
/// @param same what is no difference [m]
bool is_hull(const FlatPlaces& flat, const std::vector<Edge>& border, const std::vector<Eigen::RowVector2d>& hull,
             double same);

/// Triangles of a cloth's vertices that fill its holes, and what is between it and its convex hull. They are found by
/// cutting off ears (Meisters 1975); where a border touches or crosses itself, some are missing.
std::vector<Triangle> filling_of(const FlatPlaces& flat, const std::vector<Edge>& border,
                                 const std::vector<Eigen::RowVector2d>& hull, double same);

}  // namespace drape

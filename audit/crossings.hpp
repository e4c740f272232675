#pragma once

#include <string>
#include <vector>

#include "audit/surface.hpp"

namespace drape::audit {

/// An edge that intersects a triangle at one moment.
struct Crossing {
  Owner edge_owner = Owner::cloth;
  Edge edge = {};
  Owner triangle_owner = Owner::cloth;
  Triangle triangle = {};

  bool operator==(const Crossing&) const = default;
};

/// Returns for example "cloth edge 3 4 goes through body triangle 7 8 9".
std::string describe(const Crossing& crossing);

/// Finds all edges of a mesh that intersect its triangles, sorted.
///
/// An edge intersects a triangle if two conditions hold: its ends lie strictly on both sides of the triangle's plane,
/// and the triangle or its boundary contains a point of the edge. Signs are exact. An edge that ends exactly in the
/// plane only touches; find_passages with from = to finds touching features.
///
/// Pairs with a common vertex are skipped, which loses no intersection: two triangles with one common vertex meet in
/// a line from that vertex. It ends at an edge of one of them, in general the one opposite to the vertex.
/// Two triangles with a common edge meet only there unless they are coplanar.
/// @throws std::invalid_argument if a position is non-finite or a triangle's vertex does not exist
std::vector<Crossing> find_crossings(const Surface& cloth);

/// Finds all edges of the cloth that intersect triangles of the body, and of the body likewise, sorted.
std::vector<Crossing> find_crossings(const Surface& cloth, const Surface& body);

/// Sorts like find_crossings: by owners, edge and triangle.
void sort(std::vector<Crossing>& crossings);

/// Returns true if one edge intersects one triangle, see find_crossings.
bool goes_through(const std::array<Eigen::Vector3d, 2>& edge, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace drape::audit

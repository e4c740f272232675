#pragma once

#include <string>
#include <vector>

#include "audit/surface.hpp"

namespace drape::audit {

/// An edge that goes through a triangle at one moment.
struct Crossing {
  Owner edge_owner = Owner::cloth;
  Edge edge = {};
  Owner triangle_owner = Owner::cloth;
  Triangle triangle = {};

  bool operator==(const Crossing&) const = default;
};

/// "cloth edge 3 4 goes through body triangle 7 8 9"
std::string describe(const Crossing& crossing);

/// Finds all edges of a mesh that go through its triangles, sorted.
///
/// An edge goes through a triangle if its ends lie strictly on both sides of the triangle's plane and the triangle, its
/// border included, has a point of it. Signs are exact. An edge that ends exactly in the plane only touches;
/// find_passages with from = to finds what touches.
///
/// Pairs with a common vertex are left out, and no intersection is lost by it: two triangles with one common vertex
/// meet in a line from that vertex, which ends at an edge of one of them, in general the one opposite to the vertex;
/// two with a common edge meet in it alone unless they lie in one plane.
/// @throws std::invalid_argument if a position is not finite or a triangle's vertex does not exist
std::vector<Crossing> find_crossings(const Surface& cloth);

/// Finds all edges of the cloth that go through triangles of the body, and of the body through the cloth, sorted.
std::vector<Crossing> find_crossings(const Surface& cloth, const Surface& body);

/// Sorts as find_crossings does: by owners, edge and triangle.
void sort(std::vector<Crossing>& crossings);

/// Decides whether one edge goes through one triangle, see find_crossings.
bool goes_through(const std::array<Eigen::Vector3d, 2>& edge, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace drape::audit

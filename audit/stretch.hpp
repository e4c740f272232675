#pragma once

#include <string>
#include <vector>

#include "sim/mesh.hpp"

namespace drape::audit {

/// An edge longer than allowed.
struct StretchedEdge {
  Edge edge = {};
  double stretch = 0;  ///< length over rest length; infinite where the rest length is zero
};

/// Returns for example "cloth edge 3 4 is stretched to 1.2".
std::string describe(const StretchedEdge& stretched);

/// Finds the edges longer than `limit` times their rest length, most stretched first. Non-finite lengths count.
/// @param rest rest positions [m], as many as x
/// @throws std::invalid_argument if rest and x differ in size
std::vector<StretchedEdge> find_stretched(const std::vector<Edge>& edges, const Vertices& rest, const Vertices& x,
                                          double limit);

}  // namespace drape::audit

#pragma once

#include <string>
#include <vector>

#include "motion/vertex_order.hpp"
#include "scene/scene.hpp"

namespace drape {

/// A mapping of a scene's vertices to those of the first scene.
struct VertexMatch {
  bool comparable = true;  ///< both have the same number of vertices
  VertexOrder order;       ///< index in the first scene, by vertex of this scene; empty: equal indices
  std::string note;        ///< end of a sentence that begins with the scene's name, unless indices are equal
};

/// Matches the vertices of each scene with those of the first. Indices are kept if the triangles or the start positions
/// are the same. Otherwise vertices are matched by their start positions, if possible.
std::vector<VertexMatch> match_scenes(const std::vector<Scene>& scenes);

}  // namespace drape

#pragma once

#include <string>
#include <vector>

#include "motion/vertex_order.hpp"
#include "scene/scene.hpp"

namespace drape {

/// The vertices of the first scene that those of another one are compared with.
struct VertexMatch {
  bool comparable = true;  ///< it has as many
  VertexOrder order;       ///< by vertex of this scene that of the first; empty: the same number
  std::string note;        ///< the end of a sentence that begins with the scene's name, where numbers are not enough
};

/// Matches the vertices of each scene with those of the first. They have the same numbers where the triangles are the
/// same, or where they start at the same places. Otherwise they are matched by where they start, if that is possible.
std::vector<VertexMatch> match_scenes(const std::vector<Scene>& scenes);

}  // namespace drape

#include "render/occluders.hpp"

#include <algorithm>

namespace drape {

void Occluders::take(const Vertices& cloth, const Frame& frame) {
  cloth_positions_ = &cloth;
  copied_ = std::ranges::any_of(frame.colliders,
                                [](const Collider& collider) { return std::holds_alternative<MeshShape>(collider); });
  if (!copied_) return;
  Eigen::Index count = cloth.rows();
  for (const Collider& collider : frame.colliders) {
    if (const auto* mesh = std::get_if<MeshShape>(&collider)) count += mesh->positions.rows();
  }
  positions_.resize(count, 3);
  positions_.topRows(cloth.rows()) = cloth;
  triangles_ = cloth_;
  Eigen::Index first = cloth.rows();
  for (const Collider& collider : frame.colliders) {
    const auto* mesh = std::get_if<MeshShape>(&collider);
    if (mesh == nullptr) continue;
    positions_.middleRows(first, mesh->positions.rows()) = mesh->positions;
    const int shift = static_cast<int>(first);
    for (const auto& [a, b, c] : *mesh->triangles) triangles_.push_back({shift + a, shift + b, shift + c});
    first += mesh->positions.rows();
  }
}

}  // namespace drape

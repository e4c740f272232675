#include "scene/mesh/builder.hpp"

#include <Eigen/Geometry>
#include <numeric>

namespace drape {
namespace {

/// A flat polygon, seen from its front.
class Outline {
 public:
  explicit Outline(std::span<const Eigen::Vector3d> points) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      // Subtract one corner: far from the origin, products of the coordinates themselves cancel badly.
      const Eigen::Vector3d p = points[i] - points[0];
      const Eigen::Vector3d q = points[(i + 1) % points.size()] - points[0];
      normal += p.cross(q);
    }
    // Drop the normal's largest component: this projection does not flatten the polygon to a line.
    Eigen::Index drop = 2;
    normal.cwiseAbs().maxCoeff(&drop);
    const Eigen::Index u = (drop + 1) % 3, v = (drop + 2) % 3;
    const double side = normal[drop] < 0 ? -1 : 1;
    for (const Eigen::Vector3d& p : points) flat_.emplace_back(p[u] - points[0][u], side * (p[v] - points[0][v]));
  }

  /// Returns twice the signed area of the triangle of three corners: positive for a left turn at b.
  [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
    const Eigen::Vector2d p = flat_[b] - flat_[a], q = flat_[c] - flat_[a];
    return p.x() * q.y() - p.y() * q.x();
  }

  [[nodiscard]] bool convex() const {
    const std::size_t n = flat_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (area(i, (i + 1) % n, (i + 2) % n) < 0) return false;
    }
    return true;
  }

  /// Returns true if the triangle a, b, c can be cut off: it turns left and contains no other corner of `rest`.
  [[nodiscard]] bool is_ear(std::size_t a, std::size_t b, std::size_t c, const std::vector<std::size_t>& rest) const {
    if (area(a, b, c) <= 0) return false;
    for (const std::size_t other : rest) {
      if (other == a || other == b || other == c) continue;
      if (area(a, b, other) >= 0 && area(b, c, other) >= 0 && area(c, a, other) >= 0) return false;
    }
    return true;
  }

 private:
  std::vector<Eigen::Vector2d> flat_;
};

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Eigen::Vector3d> points) {
  std::vector<std::array<std::size_t, 3>> triangles;
  const Outline outline(points);
  if (points.size() == 3 || outline.convex()) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) triangles.push_back({0, i, i + 1});
    return triangles;
  }
  std::vector<std::size_t> rest(points.size());
  std::iota(rest.begin(), rest.end(), std::size_t{0});
  while (rest.size() > 3) {
    // If no ear exists (the outline crosses itself or is flat), cut any corner, so that every corner stays in use.
    std::size_t ear = 1;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const std::size_t before = rest[(i + rest.size() - 1) % rest.size()], after = rest[(i + 1) % rest.size()];
      if (outline.is_ear(before, rest[i], after, rest)) {
        ear = i;
        break;
      }
    }
    triangles.push_back({rest[(ear + rest.size() - 1) % rest.size()], rest[ear], rest[(ear + 1) % rest.size()]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({rest[0], rest[1], rest[2]});
  return triangles;
}

void MeshBuilder::add_triangle(const std::array<std::size_t, 3>& of, std::span<const int> corners,
                               std::span<const Uv> uvs) {
  triangles_.push_back({corners[of[0]], corners[of[1]], corners[of[2]]});
  if (uvs.empty()) return;
  uvs_.resize(3 * (triangles_.size() - 1), Uv{0, 0});
  for (const std::size_t corner : of) uvs_.push_back(uvs[corner]);
}

bool MeshBuilder::add_polygon(std::span<const int> corners, std::span<const Uv> uvs) {
  if (corners.size() == 3) {
    add_triangle({0, 1, 2}, corners, uvs);
    return true;
  }
  std::vector<Eigen::Vector3d> points;
  points.reserve(corners.size());
  for (const int corner : corners) points.push_back(positions_[static_cast<std::size_t>(corner)]);
  if (points.size() > most_concave_corners && !Outline(points).convex()) return false;
  for (const auto& triangle : triangulate(points)) add_triangle(triangle, corners, uvs);
  return true;
}

Mesh MeshBuilder::finish() {
  Mesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(positions_.size()), 3);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    mesh.positions.row(static_cast<Eigen::Index>(i)) = positions_[i].transpose();
  }
  if (!uvs_.empty()) uvs_.resize(3 * triangles_.size(), Uv{0, 0});
  mesh.triangles = std::move(triangles_);
  mesh.uvs = std::move(uvs_);
  return mesh;
}

}  // namespace drape

#include "audit/touches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <span>

namespace drape::audit {

Eigen::Vector3d direction(int number) {
  // The axes and diagonals of a cube, turned.
  static const std::array<Eigen::Vector3d, 7> ways = [] {
    std::array<Eigen::Vector3d, 7> cube{Eigen::Vector3d(1, 0, 0),  {0, 1, 0},  {0, 0, 1}, {1, 1, 1},
                                        Eigen::Vector3d(1, 1, -1), {1, -1, 1}, {-1, 1, 1}};
    const Eigen::AngleAxisd turn(0.3713, Eigen::Vector3d(0.317, 0.593, 0.741).normalized());
    for (Eigen::Vector3d& way : cube) way = turn * way.normalized();
    return cube;
  }();
  const Eigen::Vector3d& way = ways.at(static_cast<std::size_t>(number / 2));
  return number % 2 == 0 ? way : Eigen::Vector3d(-way);
}

double displacement(const Vertices& a, const Vertices& b) {
  double largest = 0;
  for (const Vertices* x : {&a, &b}) {
    if (x->size() > 0) largest = std::max(largest, x->cwiseAbs().maxCoeff());
  }
  return 0x1p-36 * largest;
}

std::vector<std::vector<int>> triangles_at_vertices(const Topology& mesh, Eigen::Index vertices) {
  std::vector<std::vector<int>> at(static_cast<std::size_t>(vertices));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) at[static_cast<std::size_t>(v)].push_back(static_cast<int>(t));
  }
  return at;
}

namespace {

/// Returns the opposite directions.
Directions reversed(Directions set) { return ((set & 0x5555U) << 1U) | ((set >> 1U) & 0x5555U); }

/// A mesh of the step with its triangles at vertices.
struct TouchedMesh {
  explicit TouchedMesh(const SurfaceMotion& step)
      : motion(step), triangles_at(triangles_at_vertices(step.topology, step.from.rows())) {}

  [[nodiscard]] Way way(int v, const Eigen::Vector3d& moved) const {
    return {motion.from.row(v).transpose() + moved, motion.to.row(v).transpose() + moved};
  }

  /// Calls visit(t) for each triangle with all vertices of a feature.
  template <class Visit>
  void for_triangles_with(std::span<const int> feature, Visit visit) const {
    for (const int t : triangles_at[static_cast<std::size_t>(feature[0])]) {
      const Triangle& triangle = motion.topology.triangles[static_cast<std::size_t>(t)];
      if (std::ranges::all_of(feature, [&](int v) { return std::ranges::find(triangle, v) != triangle.end(); }))
        visit(t);
    }
  }

  const SurfaceMotion& motion;
  std::vector<std::vector<int>> triangles_at;
};

/// Returns the directions in which the displaced first feature surely meets the second.
Directions directions_met(const Passage& p, const TouchedMesh& first, const TouchedMesh& second, double length) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const auto& v = p.vertices;
  Directions met = 0;
  for (int k = 0; k < direction_count; ++k) {
    const Eigen::Vector3d moved = length * direction(k);
    const auto meeting =
        p.kind == Passage::Kind::vertex_triangle
            ? vertex_meets_triangle(first.way(v[0], moved),
                                    {second.way(v[1], none), second.way(v[2], none), second.way(v[3], none)})
            : edges_meet({first.way(v[0], moved), first.way(v[1], moved)},
                         {second.way(v[2], none), second.way(v[3], none)});
    if (meeting && !meeting->touch) met |= 1U << static_cast<unsigned>(k);
  }
  return met;
}

/// A pair that touches, and the directions of its first feature in which it meets.
struct Touch {
  Passage* passage;
  Directions met;

  /// Returns true if it meets under the fixed displacement, of the cloth or of lower vertices by direction 0.
  [[nodiscard]] bool chosen() const {
    const Passage& p = *passage;
    const auto middle = p.vertices.begin() + (p.kind == Passage::Kind::vertex_triangle ? 1 : 2);
    const bool lower = *std::min_element(p.vertices.begin(), middle) < *std::min_element(middle, p.vertices.end());
    const bool forwards = p.first_owner == p.second_owner ? lower : p.first_owner == Owner::cloth;
    return (met & (forwards ? 1U : 2U)) != 0;
  }
};

/// The touches of one triangle.
struct TouchedTriangle {
  Directions met = 0;  // of the triangle, this step
  std::vector<const Touch*> touches;
};

}  // namespace

void Touches::resolve(const SurfaceMotion& cloth, const SurfaceMotion* body, std::vector<Passage>& found) {
  std::vector<Touch> touches;
  for (Passage& passage : found) {
    if (passage.touch) touches.push_back({&passage, 0});
  }
  std::map<std::pair<Owner, int>, TouchedTriangle> triangles;
  if (!touches.empty()) {
    const TouchedMesh own(cloth), other(body != nullptr ? *body : cloth);
    const double length =
        std::max(displacement(cloth.from, cloth.to), displacement(other.motion.from, other.motion.to));
    const auto mesh = [&](Owner owner) -> const TouchedMesh& { return owner == Owner::cloth ? own : other; };
    for (Touch& touch : touches) {
      const Passage& p = *touch.passage;
      const TouchedMesh &first = mesh(p.first_owner), &second = mesh(p.second_owner);
      touch.met = directions_met(p, first, second, length);
      const std::size_t middle = p.kind == Passage::Kind::vertex_triangle ? 1 : 2;
      const auto add = [&](Owner owner, int t, Directions met) {
        TouchedTriangle& triangle = triangles[{owner, t}];
        triangle.met |= met;
        triangle.touches.push_back(&touch);
      };
      const std::span<const int> all(p.vertices);
      first.for_triangles_with(all.first(middle), [&](int t) { add(p.first_owner, t, touch.met); });
      second.for_triangles_with(all.subspan(middle), [&](int t) { add(p.second_owner, t, reversed(touch.met)); });
    }
  }
  std::map<std::pair<Owner, int>, Directions> before;
  before.swap(met_);
  for (const auto& [name, triangle] : triangles) {
    const auto kept = before.find(name);
    const Directions earlier = kept == before.end() ? 0 : kept->second;
    met_[name] = triangle.met != 0 ? triangle.met : earlier;
    if ((triangle.met | earlier) != all_directions || triangle.met == 0) continue;
    bool any = false;
    for (const Touch* touch : triangle.touches) {
      if (!touch->chosen()) continue;
      touch->passage->touch = false;
      any = true;
    }
    if (any || triangle.met == all_directions) continue;
    // The triangle met the surface in the chosen direction one step earlier.
    for (const Touch* touch : triangle.touches) {
      if (touch->met == 0) continue;
      touch->passage->touch = false;
      break;
    }
  }
}

}  // namespace drape::audit

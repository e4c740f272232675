#include "sim/start_overlap.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <memory>

#include "core/keys.hpp"
#include "sim/collision/distance.hpp"
#include "sim/collision/placed_mesh.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

/// Returns true if a sorted list has one of the vertices of an edge or a triangle.
template <class Vertices>
bool has_any(const std::vector<int>& sorted, const Vertices& vertices) {
  return std::ranges::any_of(vertices, [&](int v) { return std::ranges::binary_search(sorted, v); });
}

/// Finds edges that pass through triangles, also where they are aligned exactly; sorted by edges.
std::vector<Intersection> all_intersections(const std::vector<Edge>& edges, const std::vector<Triangle>& triangles,
                                            const std::vector<Point>& points) {
  std::vector<Intersection> found = find_intersections(edges, triangles, points);
  const std::vector<Intersection> aligned = find_intersections_at_vertices(edges, triangles, points);
  found.insert(found.end(), aligned.begin(), aligned.end());
  std::ranges::stable_sort(found, {}, &Intersection::edge);
  return found;
}

/// Visitor that collects the overlap of a cloth with a shape.
class OverlapFinder {
 public:
  OverlapFinder(const Cloth& cloth, const Vertices& x, Overlap& overlap)
      : cloth_(cloth), rounding_(1e-12 * std::max(1.0, x.cwiseAbs().maxCoeff())), overlap_(overlap) {
    for (Eigen::Index i = 0; i < x.rows(); ++i) points_.emplace_back(x.row(i).transpose());
  }

  void operator()(const SphereShape& sphere) {
    note([&](const Point& p) { return sphere.radius - (p - sphere.center).norm(); });
  }
  void operator()(const GroundShape& ground) {
    note([&](const Point& p) { return ground.height - ground.normal.dot(p); });
  }
  void operator()(const MeshShape& shape) {
    const auto count = static_cast<int>(shape.positions.rows());
    const PlacedMesh mesh(std::make_shared<MeshTopology>(*shape.triangles, count), shape.positions);
    if (mesh.solid()) {
      note([&](const Point& p) {
        const auto closest = mesh.find(p, 0);
        return closest ? -closest->distance : 0;
      });
    }
    find_across(mesh);
  }
  /// Collects crossings of the cloth with itself, those of pinned triangles as well.
  void find_across_itself() {
    const std::vector<Edge> edges = unique_edges(cloth_.triangles);
    for (const Intersection& found : all_intersections(edges, cloth_.triangles, points_)) {
      crossed_.push_back(static_cast<int>(found.triangle));
      edges_.push_back(found.edge);
    }
    add_crossed();
  }

 private:
  [[nodiscard]] Point crossing_point(const Edge& edge, const Triangle& triangle) const {
    const auto at = [&](int vertex) -> const Point& { return points_[static_cast<std::size_t>(vertex)]; };
    const Point &from = at(edge[0]), &to = at(edge[1]), &corner = at(triangle[0]);
    const Point normal = (at(triangle[1]) - corner).cross(at(triangle[2]) - corner);
    return from + normal.dot(corner - from) / normal.dot(to - from) * (to - from);
  }

  template <class Depth>
  void note(const Depth& depth_of) {
    for (int i = 0; i < cloth_.vertex_count(); ++i) {
      if (std::ranges::binary_search(cloth_.pins, i)) continue;
      const double depth = depth_of(points_[static_cast<std::size_t>(i)]);
      if (!(depth > rounding_)) continue;
      overlap_.vertices.push_back(i);
      overlap_.depth = std::max(overlap_.depth, depth);
    }
    const std::vector<int>& inside = overlap_.vertices;
    for (std::size_t t = 0; t < cloth_.triangles.size(); ++t) {
      if (has_any(inside, cloth_.triangles[t])) crossed_.push_back(static_cast<int>(t));
    }
    add_crossed();
  }

  void find_across(const PlacedMesh& mesh) {
    const auto count = static_cast<int>(points_.size());
    points_.insert(points_.end(), mesh.points().begin(), mesh.points().end());
    std::vector<Triangle> body = mesh.topology().triangles;
    for (Triangle& triangle : body) {
      for (int& vertex : triangle) vertex += count;
    }
    const std::vector<Intersection> all = all_intersections(unique_edges(cloth_.triangles), body, points_);
    for (std::size_t k = 0; k < all.size();) {
      const Edge edge = all[k].edge;
      Point middle = Point::Zero();
      double found = 0;
      for (; k < all.size() && all[k].edge == edge; ++k, ++found) middle += crossing_point(edge, body[all[k].triangle]);
      if (has_any(cloth_.pins, edge)) continue;
      // Cloth on the surface of a solid meets the border of its sides.
      const auto closest = mesh.find(middle / found, 0);
      if (!mesh.solid() || (closest && -closest->distance > rounding_)) edges_.push_back(edge);
    }
    for (const Intersection& found : all_intersections(unique_edges(body), cloth_.triangles, points_)) {
      if (!has_any(cloth_.pins, cloth_.triangles[found.triangle])) {
        crossed_.push_back(static_cast<int>(found.triangle));
      }
    }
    add_crossed();
  }

  void add_crossed() {
    std::ranges::sort(edges_);
    for (std::size_t t = 0; t < cloth_.triangles.size() && !edges_.empty(); ++t) {
      const Triangle& triangle = cloth_.triangles[t];
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax({triangle[c], triangle[(c + 1) % 3]});
        if (std::ranges::binary_search(edges_, Edge{low, high})) crossed_.push_back(static_cast<int>(t));
      }
    }
    std::vector<int>& all = overlap_.triangles;
    all.insert(all.end(), crossed_.begin(), crossed_.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }

  const Cloth& cloth_;
  double rounding_;  // of positions: points this near a surface are not inside [m]
  Overlap& overlap_;
  std::vector<Point> points_;
  std::vector<Edge> edges_;  // of the cloth, that pass through triangles
  std::vector<int> crossed_;
};

std::string triangles_text(const std::vector<int>& triangles) {
  constexpr std::size_t named = 5;
  std::string text = fmt::format("{} triangle{} (number{} ", triangles.size(), triangles.size() == 1 ? "" : "s",
                                 triangles.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(named, triangles.size()); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", triangles[i]);
  }
  return text + (triangles.size() > named ? " …)" : ")");
}

System only(const SimulationSettings& settings, std::size_t effect) {
  System system(settings.cloth, settings.step);
  settings.effects[effect].install(system);
  return system;
}

bool is_contact(const SimulationSettings& settings, std::size_t effect) {
  return !only(settings, effect).contacts.empty();
}

}  // namespace

bool allows_overlap(const Effect& effect) {
  Effect copy = effect;
  Keys keys;
  copy.describe(keys);
  return std::ranges::any_of(keys.all(),
                             [](const Key& key) { return key.name == "allow_overlap" && *key.pointer<bool>(); });
}

std::optional<Overlap> find_overlap(const SimulationSettings& settings, std::size_t effect, const Vertices& x,
                                    double time) {
  if (!settings.effects[effect].touches()) return std::nullopt;
  const System system = only(settings, effect);
  Overlap overlap{.vertices = {}, .triangles = {}, .contact = !system.contacts.empty()};
  OverlapFinder finder(settings.cloth, x, overlap);
  for (const Collider& collider : system.colliders_at(time)) std::visit(finder, collider);
  if (system.colliders.empty()) finder.find_across_itself();
  if (overlap.vertices.empty() && overlap.triangles.empty()) return std::nullopt;
  return overlap;
}

std::vector<StartOverlap> start_overlaps(const SimulationSettings& settings) {
  std::vector<StartOverlap> overlaps;
  for (std::size_t i = 0; i < settings.effects.size(); ++i) {
    if (!settings.effects[i].touches()) continue;
    if (is_contact(settings, i) && !allows_overlap(settings.effects[i])) continue;
    if (auto overlap = find_overlap(settings, i, settings.cloth.positions, 0)) {
      overlaps.push_back({i, *std::move(overlap)});
    }
  }
  return overlaps;
}

std::string describe(const StartOverlap& start, const SimulationSettings& settings) {
  const Overlap& overlap = start.overlap;
  const std::string_view name = settings.effects[start.effect].name();
  std::string text;
  if (!overlap.vertices.empty()) {
    text = fmt::format("{} {} inside the {}, up to {:.3g} m deep", overlap.vertices.size(),
                       overlap.vertices.size() == 1 ? "vertex" : "vertices", name, overlap.depth);
  }
  if (overlap.triangles.empty()) return text;
  if (!text.empty()) text += ", and ";
  text += triangles_text(overlap.triangles);
  if (overlap.vertices.empty())
    text += name == "self_collision" ? " across itself" : fmt::format(" across the {}", name);
  const Triangle& first = settings.cloth.triangles[static_cast<std::size_t>(overlap.triangles.front())];
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  for (const int v : first) middle += settings.cloth.positions.row(v) / 3;
  return text + fmt::format(", the first at [{:.3g}, {:.3g}, {:.3g}]", middle.x() + 0, middle.y() + 0, middle.z() + 0);
}

std::string overlap_advice(const StartOverlap& overlap, const SimulationSettings& settings) {
  return fmt::format("the cloth begins with {}: {}", describe(overlap, settings),
                     overlap.overlap.contact ? "they are separated step by step" : "it is thrown out of there");
}

bool begins_too_near(const SimulationSettings& settings) {
  constexpr double rounding = 1e-6;        // of the contact distance
  SimulationSettings implicit = settings;  // whose system has the contacts
  implicit.integrator = {.method = Method::quasi_newton};
  implicit.accuracy.reset();
  const System system = make_system(implicit);
  const Vertices& x = settings.cloth.positions;
  const std::vector<double> inverse = inverse_masses(settings.cloth);
  std::vector<ContactConstraint> found;
  for (const auto& source : system.contacts) {
    source->begin(x, 0, 1);  // the distance that contacts keep grows with the time until then
    source->find(x, 0, {}, found);
  }
  const bool near = std::ranges::any_of(found, [&](const ContactConstraint& contact) {
    const double now = contact.normal.dot(contact.place(x));
    return contact.can_move(inverse) && now < contact.distance - rounding * std::abs(contact.distance);
  });
  return near || std::ranges::any_of(start_overlaps(settings), [](const auto& start) { return start.overlap.contact; });
}

}  // namespace drape

#include "tests/support/sheets_to_bend.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "drape/sim/mesh.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

using Plane = Eigen::Vector2d;

double twice_area(const Plane& a, const Plane& b, const Plane& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool circumcircle_holds(const Plane& a, const Plane& b, const Plane& c, const Plane& p) {
  const Plane u = a - p, v = b - p, w = c - p;
  return u.squaredNorm() * (v.x() * w.y() - v.y() * w.x()) - v.squaredNorm() * (u.x() * w.y() - u.y() * w.x()) +
             w.squaredNorm() * (u.x() * v.y() - u.y() * v.x()) >
         0;
}

/// Computes the Delaunay triangulation of points (Bowyer 1981, Watson 1981), perturbed by 1e-10 so that no four points
/// lie on a circle.
std::vector<Triangle> delaunay(std::vector<Plane> points) {
  const auto count = static_cast<int>(points.size());
  Random random(9);
  for (Plane& p : points) p += 1e-10 * Plane(random.between(-1, 1), random.between(-1, 1));
  points.insert(points.end(), {{-1e3, -1e3}, {1e3, -1e3}, {0, 1e3}});
  const auto at = [&](int vertex) { return points[static_cast<std::size_t>(vertex)]; };
  std::vector<Triangle> triangles{{count, count + 1, count + 2}};
  for (int p = 0; p < count; ++p) {
    std::map<Edge, int> border;  // edges of the triangles whose circumcircle holds p
    std::erase_if(triangles, [&](const Triangle& t) {
      if (!circumcircle_holds(at(t[0]), at(t[1]), at(t[2]), at(p))) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        if (border.erase({t[(k + 1) % 3], t[k]}) == 0) border[{t[k], t[(k + 1) % 3]}] = 1;
      }
      return true;
    });
    for (const auto& [edge, one] : border) triangles.push_back({edge[0], edge[1], p});
  }
  std::erase_if(triangles, [&](const Triangle& t) { return std::ranges::max(t) >= count; });
  return triangles;
}

/// Places points at least 0.62 spacings apart between fixed ones; relaxed, each at the middle of its triangles.
Mesh random_sheet(std::vector<Plane> points, const Plane& low, const Plane& high, double spacing, bool relaxed) {
  const std::size_t fixed = points.size();
  Random random(5);
  for (int tries = 0; tries < 40 * (high - low).prod() / (spacing * spacing); ++tries) {
    const Plane p(random.between(low.x(), high.x()), random.between(low.y(), high.y()));
    const auto near = [&](const Plane& q) { return (p - q).norm() < 0.62 * spacing; };
    if (std::ranges::none_of(points, near)) points.push_back(p);
  }
  std::vector<Triangle> triangles = delaunay(points);
  for (int round = 0; relaxed && round < 20; ++round) {
    std::vector<Plane> moments(points.size(), Plane::Zero());
    std::vector<double> areas(points.size(), 0);
    for (const auto& t : triangles) {
      const auto [a, b, c] =
          std::array{static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])};
      const double area = twice_area(points[a], points[b], points[c]);
      for (const std::size_t v : {a, b, c}) {
        moments[v] += area * (points[a] + points[b] + points[c]) / 3;
        areas[v] += area;
      }
    }
    for (std::size_t v = fixed; v < points.size(); ++v) points[v] = moments[v] / areas[v];
    triangles = delaunay(points);
  }
  std::erase_if(triangles, [&](const Triangle& t) {
    const auto at = [&](int v) { return points[static_cast<std::size_t>(v)]; };
    return twice_area(at(t[0]), at(t[1]), at(t[2])) < 1e-6 * spacing * spacing;
  });
  Mesh mesh;
  mesh.positions.setZero(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    mesh.positions.row(static_cast<Eigen::Index>(v)).head<2>() = points[v].transpose();
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

bool is_random(Division division) { return division == Division::delaunay || division == Division::relaxed; }

bool is_wide(Division division) { return division == Division::wide_alternating || division == Division::wide_crossed; }

GridPattern pattern_of(Division division) {
  if (division == Division::diagonal) return GridPattern::diagonal;
  const bool alternating = division == Division::alternating || division == Division::wide_alternating;
  return alternating ? GridPattern::alternating : GridPattern::x;
}

Mesh rectangle(Division division, int columns, int rows, const Plane& low, const Plane& high) {
  Mesh mesh = make_grid(
      Grid{.columns = columns, .rows = rows, .pattern = pattern_of(division), .size = Eigen::Vector2d(high - low)});
  mesh.positions.leftCols<2>().rowwise() += (low + high).transpose() / 2;
  return mesh;
}

/// Pins the vertices at positions for which `clamped` is true.
template <class Clamped>
Sheet with_pins(Mesh mesh, Clamped clamped) {
  std::vector<int> pins;
  for (int i = 0; i < static_cast<int>(mesh.positions.rows()); ++i) {
    if (clamped(Plane(mesh.positions(i, 0), mesh.positions(i, 1)))) pins.push_back(i);
  }
  return {std::move(mesh), std::move(pins)};
}

}  // namespace

std::string name_of(Division division) {
  constexpr std::array names{"Diagonal",    "Alternating", "Crossed", "WideAlternating",
                             "WideCrossed", "Delaunay",    "Relaxed"};
  return names[static_cast<std::size_t>(division)];
}

std::vector<Division> all_divisions() {
  return {Division::diagonal,     Division::alternating, Division::crossed, Division::wide_alternating,
          Division::wide_crossed, Division::delaunay,    Division::relaxed};
}

Sheet clamped_strip(Division division, int cells, int across, double length) {
  const double cell = length / cells, width = across * cell;
  const auto clamped = [&](const Plane& p) { return p.x() < 0.01 * cell; };
  if (!is_random(division)) {
    const int rows = is_wide(division) ? std::max(1, across / 4) : across;
    return with_pins(rectangle(division, cells + 1, rows, {-cell, 0}, {length, width}), clamped);
  }
  std::vector<Plane> border;
  for (int j = 0; j <= across; ++j) {
    for (const double x : {-cell, 0.0, length}) border.emplace_back(x, width * j / across);
  }
  for (int i = 1; i < cells; ++i) border.insert(border.end(), {{i * cell, 0}, {i * cell, width}});
  const Plane margin = Plane::Constant(0.35 * cell);
  return with_pins(
      random_sheet(std::move(border), margin, Plane(length, width) - margin, cell, division == Division::relaxed),
      clamped);
}

double tip_drop(const Sheet& strip, const Vertices& x) {
  const auto& from = strip.mesh.positions;
  const double end = from.col(0).maxCoeff() - 1e-9;
  double sum = 0;
  int tips = 0;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    if (from(i, 0) < end) continue;
    sum -= x(i, 2);
    ++tips;
  }
  return sum / tips;
}

Sheet clamped_square(Division division, int n) {
  const double cell = 1.0 / n;
  const auto clamped = [](const Plane& p) { return p.minCoeff() < 1e-9 || p.maxCoeff() > 1 - 1e-9; };
  if (!is_random(division)) {
    const int rows = is_wide(division) ? n / 4 : n;
    const Plane frame(cell, 1.0 / rows);
    return with_pins(rectangle(division, n + 2, rows + 2, -frame, Plane::Ones() + frame), clamped);
  }
  std::vector<Plane> border;
  for (int i = 0; i <= n; ++i) {
    for (const double side : {-cell, 0.0, 1.0, 1.0 + cell}) {
      border.emplace_back(i * cell, side);
      if ((i > 0 && i < n) || side < 0 || side > 1) border.emplace_back(side, i * cell);
    }
  }
  const Plane margin = Plane::Constant(0.35 * cell);
  return with_pins(random_sheet(std::move(border), margin, Plane::Ones() - margin, cell, division == Division::relaxed),
                   clamped);
}

Cloth cloth_of(const Sheet& sheet, double density) {
  Cloth cloth = cloth_of(sheet.mesh, 1, 1, sheet.pins);
  share_mass_by_area(density, cloth);
  return cloth;
}

}  // namespace drape::test

#include "sim/bending/curvature.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/bending/hinges.hpp"

namespace drape {
namespace {

constexpr double least_eigenvalue = 0.1;
// A triangle is taken to have no area below this fraction of its longest edge's square.
constexpr double least_area = 1e-9;
// A rest shape bent by less than this fraction of what folding it over would be is flat.
constexpr double flat = 1e-9;

using Plane = Eigen::Vector2d;
using Point = Eigen::Vector3d;

/// The triangle next to another one, unfolded into its plane.
struct Flap {
  int edge;    // from corner `edge` to the next
  int vertex;  // opposite to it
  bool held;   // all of it is pinned
  Plane place;
};

/// A triangle laid into its plane, corner 0 at the origin, corner 1 on the positive x axis.
struct Layout {
  std::array<Plane, 3> corners;
  double area;
};

double height_over(const Point& p, const Point& from, const Point& to) {
  const Point along = (to - from).normalized();
  return (p - from - along * along.dot(p - from)).norm();
}

bool has_area(const Triangle& t, const Vertices& x) {
  const Point a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > least_area * longest;
}

Layout lay_out(const Triangle& t, const Vertices& x) {
  const Point a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]);
  const double length = (b - a).norm(), height = height_over(c, a, b);
  return {{Plane(0, 0), Plane(length, 0), Plane((c - a).dot(b - a) / length, height)}, length * height / 2};
}

Plane unfold(const Layout& layout, const Triangle& t, int edge, int vertex, const Vertices& x) {
  const auto e = static_cast<std::size_t>(edge), next = (e + 1) % 3;
  const Point from = x.row(t[e]), to = x.row(t[next]), flap = x.row(vertex);
  const Plane along = (layout.corners[next] - layout.corners[e]).normalized();
  const double foot = (flap - from).dot(to - from) / (to - from).norm();
  return layout.corners[e] + foot * along + height_over(flap, from, to) * Plane(along.y(), -along.x());
}

/// One hinge: the weights of g times half the sum of its heights, and with them M's row.
void add_hinge(const Layout& layout, const Flap& flap, int row, int column, Eigen::Matrix<double, 3, 6>& weights,
               Eigen::Matrix3d& measured) {
  const int from = flap.edge, to = (from + 1) % 3, apex = (from + 2) % 3;
  const auto corner = [&](int k) { return layout.corners[static_cast<std::size_t>(k)]; };
  const Plane edge = corner(to) - corner(from);
  const double length = edge.norm();
  const auto split = [&](const Plane& p) {
    const Plane d = p - corner(from);
    return std::pair{d.dot(edge) / (length * length), std::abs(d.x() * edge.y() - d.y() * edge.x()) / length};
  };
  const auto [alpha, h] = split(corner(apex));
  const auto [beta, h_flap] = split(flap.place);
  const double bent = flap.held ? h : h + h_flap;  // how far the cloth is curved across the edge
  const double scale = 2 / bent;
  auto w = weights.row(row);
  w[apex] += scale / h;
  w[column] += scale / h_flap;
  w[from] -= scale * ((1 - alpha) / h + (1 - beta) / h_flap);
  w[to] -= scale * (alpha / h + beta / h_flap);

  if (flap.held) {
    const Plane across = Plane(edge.y(), -edge.x()) / length;
    measured.row(row) << across.x() * across.x(), across.y() * across.y(), std::sqrt(2.0) * across.x() * across.y();
    return;
  }
  const Plane middle = (corner(0) + corner(1) + corner(2)) / 3;
  const auto bend = [&](const Plane& p, double weight) -> Eigen::RowVector3d {
    const Plane d = p - middle;
    return weight * Eigen::RowVector3d(d.x() * d.x() / 2, d.y() * d.y() / 2, d.x() * d.y() / std::sqrt(2.0));
  };
  measured.row(row) = bend(flap.place, w[column]);
  for (int k = 0; k < 3; ++k) measured.row(row) += bend(corner(k), w[k]);
}

/// A triangle's neighbour, before it is unfolded.
struct Neighbour {
  int edge, vertex;  // as in Flap
  bool held;
};

CurvatureElement make_element(const Triangle& t, const std::vector<Neighbour>& neighbours, double rigidity,
                              const Vertices& x) {
  const Layout layout = lay_out(t, x);
  const auto hinges = static_cast<int>(neighbours.size());
  CurvatureElement element{.count = 3 + hinges, .vertices = {t[0], t[1], t[2]}, .weights = {}, .rest = {}};
  Eigen::Matrix<double, 3, 6> weights = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Matrix3d measured = Eigen::Matrix3d::Zero();
  for (int k = 0; k < hinges; ++k) {
    const auto [edge, vertex, held] = neighbours[static_cast<std::size_t>(k)];
    element.vertices[static_cast<std::size_t>(k) + 3] = vertex;
    add_hinge(layout, {edge, vertex, held, unfold(layout, t, edge, vertex, x)}, k, 3 + k, weights, measured);
  }

  const auto rows = measured.topRows(hinges);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(rows * rows.transpose());
  element.weights.setZero();
  for (int k = 0; k < hinges; ++k) {
    const double factor = std::sqrt(rigidity * layout.area / std::max(gram.eigenvalues()[k], least_eigenvalue));
    element.weights.row(k) = factor * gram.eigenvectors().col(k).transpose() * weights.topRows(hinges);
  }

  for (int k = 0; k < 3; ++k) {
    Point bent = Point::Zero();
    double whole = 0;
    for (int c = 0; c < element.count; ++c) {
      const Point d = (x.row(element.vertices[static_cast<std::size_t>(c)]) - x.row(t[0])).transpose();
      bent += element.weights(k, c) * d;
      whole += std::abs(element.weights(k, c)) * d.norm();
    }
    element.rest[k] = bent.norm() > flat * whole ? bent.norm() : 0;
  }
  return element;
}

}  // namespace

std::vector<CurvatureElement> curvature_elements(const Cloth& cloth, double rigidity) {
  const Vertices& x = cloth.rest;
  std::vector<bool> pinned(static_cast<std::size_t>(cloth.vertex_count()), false);
  for (const int pin : cloth.pins) pinned[static_cast<std::size_t>(pin)] = true;
  const auto held = [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](int vertex) { return pinned[static_cast<std::size_t>(vertex)]; });
  };
  std::vector<std::vector<Neighbour>> neighbours(cloth.triangles.size());
  for_neighbours(edge_sides(cloth.triangles), [&](const EdgeSide& side, const EdgeSide& next) {
    const Triangle& t = cloth.triangles[static_cast<std::size_t>(side.triangle)];
    const Triangle& beyond = cloth.triangles[static_cast<std::size_t>(next.triangle)];
    if (!has_area(t, x) || !has_area(beyond, x) || held(t)) return;
    const auto apex = static_cast<int>(std::find(t.begin(), t.end(), side.opposite) - t.begin());
    neighbours[static_cast<std::size_t>(side.triangle)].push_back({(apex + 1) % 3, next.opposite, held(beyond)});
  });
  std::vector<CurvatureElement> elements;
  for (std::size_t t = 0; t < neighbours.size(); ++t) {
    if (!neighbours[t].empty()) elements.push_back(make_element(cloth.triangles[t], neighbours[t], rigidity, x));
  }
  return elements;
}

}  // namespace drape

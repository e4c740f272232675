#include "sim/bending/curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/bending/edge_slope.hpp"

namespace drape {
namespace {

// Largest curvature of a rest shape that counts as flat, as a fraction of a complete fold.
constexpr double flat = 1e-9;
// Relative size of weights that are zero up to rounding.
constexpr double rounding = 1e-12;

using Plane = Eigen::Vector2d;
using Point = Eigen::Vector3d;

/// Returns the symmetric part of u⊗v as components xx, yy and √2 xy, whose squares sum to those of the matrix.
Eigen::Vector3d symmetric(const Plane& u, const Plane& v) {
  return {u.x() * v.x(), u.y() * v.y(), (u.x() * v.y() + u.y() * v.x()) / std::sqrt(2.0)};
}

/// Second derivatives of a triangle, as weights of vertices.
class SecondDerivatives {
 public:
  SecondDerivatives(const RestSurface& surface, const PlacedTriangle& t) {
    const Triangle& vertices = surface.triangle(t.triangle);
    const Plane u = t.corners[1] - t.corners[0], v = t.corners[2] - t.corners[0];
    area_ = (u.x() * v.y() - u.y() * v.x()) / 2;
    for (const int vertex : vertices) add(vertex, Point::Zero());
    for (int side = 0; side < 3; ++side) {
      const auto p = static_cast<std::size_t>(side), q = (p + 1) % 3;
      const Plane edge = t.corners[q] - t.corners[p], normal = outward(t, side);
      const Point twist = symmetric(edge.normalized(), normal) / area_;
      add(vertices[q], twist);
      add(vertices[p], -twist);
      if (surface.beyond(t.triangle, side).triangle < 0) {
        free_.push_back(symmetric(normal, normal));
        continue;
      }
      const Point bend = symmetric(normal, normal) * (edge.norm() / area_);
      for (const auto& [vertex, weight] : edge_slope(surface, t, side)) add(vertex, weight * bend);
    }
  }

  [[nodiscard]] double area() const { return area_; }

  [[nodiscard]] CurvatureElement element() const {
    const Eigen::Matrix3d projection = without_free();
    std::vector<Point> weights;
    double largest = 0;
    for (const Point& weight : weights_) {
      weights.push_back(projection * weight);
      largest = std::max(largest, weights.back().norm());
    }
    CurvatureElement element;
    element.weights.resize(3, static_cast<Eigen::Index>(weights.size()));
    Eigen::Index count = 0;
    for (std::size_t c = 0; c < weights.size(); ++c) {
      if (c >= 3 && weights[c].norm() <= rounding * largest) continue;  // the triangle's own vertices come first
      element.vertices.push_back(vertices_[c]);
      element.weights.col(count++) = weights[c];
    }
    element.weights.conservativeResize(3, count);
    return element;
  }

 private:
  void add(int vertex, const Point& weight) {
    const auto place = std::ranges::find(vertices_, vertex);
    if (place == vertices_.end()) {
      vertices_.push_back(vertex);
      weights_.push_back(weight);
    } else {
      weights_[static_cast<std::size_t>(place - vertices_.begin())] += weight;
    }
  }

  /// Returns the projection onto the part that free slopes cannot change.
  [[nodiscard]] Eigen::Matrix3d without_free() const {
    Eigen::Matrix3d projection = Eigen::Matrix3d::Identity();
    for (const Point& direction : free_) {  // at most two, in different directions
      const Point left = (projection * direction).normalized();
      projection -= left * left.transpose();
    }
    return projection;
  }

  double area_;
  std::vector<int> vertices_;
  std::vector<Point> weights_;
  std::vector<Point> free_;
};

/// Returns the three components of the rest shape, one per row.
Eigen::Matrix3d components(const CurvatureElement& element, const RestSurface& surface) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const Point origin = surface.place(element.vertices[0]);
  for (std::size_t c = 0; c < element.vertices.size(); ++c) {
    sum +=
        element.weights.col(static_cast<Eigen::Index>(c)) * (surface.place(element.vertices[c]) - origin).transpose();
  }
  return sum;
}

bool is_flat(const Eigen::Matrix3d& bent, const CurvatureElement& element, const RestSurface& surface) {
  const Point origin = surface.place(element.vertices[0]);
  double whole = 0;
  for (std::size_t c = 0; c < element.vertices.size(); ++c) {
    whole +=
        element.weights.col(static_cast<Eigen::Index>(c)).norm() * (surface.place(element.vertices[c]) - origin).norm();
  }
  return bent.norm() <= flat * whole;
}

/// Makes the curvature of the rest shape normal to the triangle and confined to the first component.
void bend_at_rest(CurvatureElement& element, const PlacedTriangle& t, const RestSurface& surface) {
  const Eigen::Matrix3d bent = components(element, surface);
  if (is_flat(bent, element, surface)) return;
  const Triangle& vertices = surface.triangle(t.triangle);
  const Point x = (surface.place(vertices[1]) - surface.place(vertices[0])).normalized();
  const Point normal = x.cross(surface.place(vertices[2]) - surface.place(vertices[0])).normalized();
  const Point y = normal.cross(x);
  const auto subtract = [&](const Point& tangent, const Plane& along) {
    for (const auto& [vertex, weight] : slope_inside(surface, t, along)) {
      const auto column = std::ranges::find(element.vertices, vertex) - element.vertices.begin();
      element.weights.col(column) -= bent * tangent * weight;
    }
  };
  subtract(x, Plane::UnitX());
  subtract(y, Plane::UnitY());
  const Point curvature = bent * normal;
  element.rest = curvature.norm();
  if (element.rest > 0) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond::FromTwoVectors(curvature, Point(Point::UnitX())).toRotationMatrix();
    element.weights = turn * element.weights;
  }
}

}  // namespace

std::vector<CurvatureElement> curvature_elements(const Cloth& cloth, double rigidity) {
  const RestSurface surface(cloth);
  std::vector<CurvatureElement> elements;
  for (int t = 0; t < surface.triangle_count(); ++t) {
    if (!surface.bends(t)) continue;
    const PlacedTriangle placed = surface.lay_out(t);
    const SecondDerivatives derivatives(surface, placed);
    CurvatureElement element = derivatives.element();
    element.weights *= std::sqrt(rigidity * derivatives.area());
    bend_at_rest(element, placed, surface);
    elements.push_back(std::move(element));
  }
  return elements;
}

}  // namespace drape

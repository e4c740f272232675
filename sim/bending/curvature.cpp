#include "sim/bending/curvature.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "drape/sim/cloth.hpp"
#include "sim/bending/bending_energy.hpp"

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

  /// Replaces the three components by linear combinations of them.
  void transform(const Eigen::Matrix3d& matrix) {
    for (Point& weight : weights_) weight = matrix * weight;
    for (Point& direction : free_) direction = matrix * direction;
  }

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

/// Returns the matrix that turns the components of S in a triangle's frame into those of Q S Q, with the eigenvalues
/// D₁^¼ and D₂^¼ of Q along the warp and the weft.
/// @param warp angle of the warp in the triangle [rad]
Eigen::Matrix3d weave(const WarpWeft& rigidity, double warp) {
  const double c = std::cos(warp), s = std::sin(warp), root = std::sqrt(2.0);
  Eigen::Matrix3d turn;
  turn << c * c, s * s, root * c * s, s * s, c * c, -root * c * s, -root * c * s, root * c * s, c * c - s * s;
  const double one = std::sqrt(rigidity.warp), two = std::sqrt(rigidity.weft);
  return Point(one, two, std::sqrt(one * two)).asDiagonal() * turn;
}

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

/// Returns the shortest rotation of a unit vector to the x axis. Eigen's FromTwoVectors has the same bits, but half of
/// this file's compile time, for its singular value decomposition of opposite vectors.
Eigen::Quaterniond rotation_to_x(const Point& from) {
  constexpr double opposite = 1e-12;
  const Point axis(0, from.z(), -from.y());  // from × x
  const double twice = 1 + from.x();         // 2 cos² of half the angle
  if (twice < opposite) {
    const Point any = axis.isZero(0) ? Point(Point::UnitZ()) : Point(axis.normalized());
    return {0, any.x(), any.y(), any.z()};
  }
  const double s = std::sqrt(twice * 2), inverse = 1 / s;
  return {s * 0.5, axis.x() * inverse, axis.y() * inverse, axis.z() * inverse};
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
    const Eigen::Matrix3d turn = rotation_to_x(curvature.normalized()).toRotationMatrix();
    element.weights = turn * element.weights;
  }
}

}  // namespace

std::vector<CurvatureElement> curvature_elements(const Cloth& cloth, const WarpWeft& rigidity) {
  const RestSurface surface(cloth);
  std::vector<CurvatureElement> elements;
  // The rigidity in all directions where the warp has none.
  const double mean = rigidity.isotropic() ? rigidity.warp : std::sqrt(rigidity.warp * rigidity.weft);
  for (int t = 0; t < surface.triangle_count(); ++t) {
    if (!surface.bends(t)) continue;
    const PlacedTriangle placed = surface.lay_out(t);
    SecondDerivatives derivatives(surface, placed);
    std::optional<double> warp;
    if (!rigidity.isotropic()) warp = warp_angle(cloth, surface.triangle(t), rigidity.angle);
    if (warp) derivatives.transform(weave(rigidity, *warp));
    CurvatureElement element = derivatives.element();
    element.weights *= std::sqrt(warp ? derivatives.area() : mean * derivatives.area());
    bend_at_rest(element, placed, surface);
    elements.push_back(std::move(element));
  }
  return elements;
}

namespace {

using Plane = Eigen::Vector2d;

// Largest distance between the middles of a parallelogram's diagonals, as a fraction of its height.
constexpr double parallel = 1e-3;
// Least ratio of the eigenvalues of a fit that determines a quadratic function.
constexpr double determined = 1e-3;
// Maximum number of rings; only patches of tiny cloths remain undetermined.
constexpr int most_rings = 3;

/// A value or slope for the fit of a patch's function.
struct Sample {
  LinearForm form;
  Plane place;
  std::optional<Plane> along;  // set for a slope
};

Plane middle(const PlacedTriangle& t, int side) {
  const auto p = static_cast<std::size_t>(side);
  return (t.corners[p] + t.corners[(p + 1) % 3]) / 2;
}

/// Two triangles at a side and their surroundings, unfolded into one plane.
class Surroundings {
 public:
  Surroundings(const RestSurface& surface, const PlacedTriangle& t, int side) : surface_(surface) {
    add(t);
    add(surface.unfold(t, side));
  }

  /// Adds the neighbours of the triangles added last.
  void grow() {
    const std::size_t first = grown_, last = triangles_.size();
    grown_ = last;
    for (std::size_t k = first; k < last; ++k) {
      for (int side = 0; side < 3; ++side) {
        const PlacedTriangle from = triangles_[k];
        const int next = surface_.beyond(from.triangle, side).triangle;
        const auto is_next = [&](const PlacedTriangle& t) { return t.triangle == next; };
        if (next < 0 || std::ranges::any_of(triangles_, is_next)) continue;
        const PlacedTriangle placed = surface_.unfold(from, side);
        if (surface_.held(next)) {
          const Plane along = outward(from, side);
          samples_.push_back({slope_inside(surface_, placed, along), middle(from, side), along});
        } else {
          add(placed);
        }
      }
    }
  }

  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

 private:
  void add(const PlacedTriangle& t) {
    triangles_.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const int vertex = surface_.triangle(t.triangle)[k];
      if (std::ranges::find(vertices_, vertex) != vertices_.end()) continue;
      vertices_.push_back(vertex);
      samples_.push_back({{{vertex, 1.0}}, t.corners[k], {}});
    }
  }

  const RestSurface& surface_;
  std::vector<PlacedTriangle> triangles_;
  std::vector<int> vertices_;
  std::vector<Sample> samples_;
  std::size_t grown_ = 0;  // number of triangles whose neighbours have been added
};

/// Fit of a quadratic function to samples, in coordinates where their scatter is isotropic.
class Fit {
 public:
  Fit(const std::vector<Sample>& samples, const Plane& origin) : scales_(samples.size(), 1) {
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const Sample& s : samples) scatter += (s.place - origin) * (s.place - origin).transpose();
    frame_.compute(scatter / static_cast<double>(samples.size()));
    linear_.resize(static_cast<Eigen::Index>(samples.size()), 3);
    bent_.resize(linear_.rows(), 3);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const Plane d = frame_.matrixL().solve(samples[k].place - origin);
      if (!samples[k].along) {
        linear_.row(row) << 1, d.x(), d.y();
        bent_.row(row) << d.x() * d.x() / 2, d.x() * d.y(), d.y() * d.y() / 2;
        continue;
      }
      Plane n = frame_.matrixL().solve(*samples[k].along);
      scales_[k] = 1 / n.norm();
      n *= scales_[k];
      linear_.row(row) << 0, n.x(), n.y();
      bent_.row(row) << d.x() * n.x(), d.x() * n.y() + d.y() * n.x(), d.y() * n.y();
    }
    // Fit the linear part exactly, independent of the quadratic one.
    gram_.compute(linear_.transpose() * linear_);
    mixed_ = linear_.transpose() * bent_;
    rest_ = bent_ - linear_ * gram_.solve(mixed_);
    bending_.compute(rest_.transpose() * rest_);
  }

  [[nodiscard]] bool determined() const {
    return bending_.eigenvalues()[0] > drape::determined * bending_.eigenvalues()[2];
  }

  /// Returns the weights of the samples in the function's slope at the origin.
  [[nodiscard]] std::vector<double> slope(const Plane& along) const {
    const Plane n = frame_.matrixL().solve(along);
    const Eigen::Vector3d linear = gram_.solve(Eigen::Vector3d(0, n.x(), n.y()));
    Eigen::Vector3d bent = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      if (bending_.eigenvalues()[k] <= drape::determined * bending_.eigenvalues()[2]) continue;
      const Eigen::Vector3d direction = bending_.eigenvectors().col(k);
      bent += direction * (direction.dot(mixed_.transpose() * linear) / bending_.eigenvalues()[k]);
    }
    const Eigen::VectorXd weights = linear_ * linear - rest_ * bent;
    std::vector<double> scaled(scales_);
    for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] *= weights[static_cast<Eigen::Index>(k)];
    return scaled;
  }

 private:
  std::vector<double> scales_;  // per sample
  Eigen::LLT<Eigen::Matrix2d> frame_;
  // Values of 1, x, y and x²/2, xy, y²/2 at the samples.
  Eigen::Matrix<double, Eigen::Dynamic, 3> linear_, bent_, rest_;
  Eigen::LLT<Eigen::Matrix3d> gram_;
  Eigen::Matrix3d mixed_;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> bending_;
};

/// Returns the slope across a parallelogram's diagonal, from its four corners.
std::optional<LinearForm> slope_of_parallelogram(const RestSurface& surface, const PlacedTriangle& t, int side) {
  const auto p = static_cast<std::size_t>(side), q = (p + 1) % 3, apex = (p + 2) % 3;
  const int opposite = surface.beyond(t.triangle, side).opposite;
  const PlacedTriangle next = surface.unfold(t, side);
  const Triangle& far = surface.triangle(next.triangle);
  const Plane flap = next.corners[static_cast<std::size_t>(std::ranges::find(far, opposite) - far.begin())];
  const Plane across = flap - t.corners[apex], edge = t.corners[q] - t.corners[p];
  const double height = across.dot(outward(t, side));
  if ((flap + t.corners[apex] - t.corners[p] - t.corners[q]).norm() > parallel * height) return {};
  const Triangle& vertices = surface.triangle(t.triangle);
  const double along = across.dot(edge) / edge.squaredNorm();
  return LinearForm{{opposite, 1 / height},
                    {vertices[apex], -1 / height},
                    {vertices[q], -along / height},
                    {vertices[p], along / height}};
}

}  // namespace

LinearForm slope_inside(const RestSurface& surface, const PlacedTriangle& t, const Eigen::Vector2d& along) {
  LinearForm form;
  for (int side = 0; side < 3; ++side) {
    const auto p = static_cast<std::size_t>(side), apex = (p + 2) % 3;
    const Plane normal = outward(t, side);
    const double height = normal.dot(t.corners[p] - t.corners[apex]);
    form.emplace_back(surface.triangle(t.triangle)[apex], -normal.dot(along) / height);
  }
  return form;
}

LinearForm edge_slope(const RestSurface& surface, const PlacedTriangle& t, int side) {
  const Plane along = outward(t, side);
  if (surface.held(surface.beyond(t.triangle, side).triangle)) {
    return slope_inside(surface, surface.unfold(t, side), along);
  }
  if (auto form = slope_of_parallelogram(surface, t, side)) return *form;
  Surroundings patch(surface, t, side);
  patch.grow();
  Fit fit(patch.samples(), middle(t, side));
  for (int ring = 1; ring < most_rings && !fit.determined(); ++ring) {
    patch.grow();
    fit = Fit(patch.samples(), middle(t, side));
  }
  const std::vector<double> weights = fit.slope(along);
  LinearForm form;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    for (const auto& [vertex, weight] : patch.samples()[k].form) form.emplace_back(vertex, weights[k] * weight);
  }
  return form;
}

namespace {

// Least ratio of a triangle's area to its longest edge's square; below, it counts as having no area.
constexpr double least_area = 1e-9;

using Plane = Eigen::Vector2d;
using Point = Eigen::Vector3d;

bool has_area(const Triangle& t, const Vertices& x) {
  const Point a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > least_area * longest;
}

std::size_t corner_of(const Triangle& t, int vertex) {
  return static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

}  // namespace

RestSurface::RestSurface(const Cloth& cloth) : cloth_(cloth), beyond_(3 * cloth.triangles.size()) {
  std::vector<bool> pinned(static_cast<std::size_t>(cloth.vertex_count()), false);
  for (const int pin : cloth.pins) pinned[static_cast<std::size_t>(pin)] = true;
  for (const Triangle& t : cloth.triangles) {
    held_.push_back(std::ranges::all_of(t, [&](int vertex) { return pinned[static_cast<std::size_t>(vertex)]; }));
  }
  for_neighbours(edge_sides(cloth.triangles), [&](const EdgeSide& side, const EdgeSide& next) {
    const Triangle& t = triangle(side.triangle);
    if (!has_area(t, cloth.rest) || !has_area(triangle(next.triangle), cloth.rest)) return;
    const std::size_t apex = corner_of(t, side.opposite);
    beyond_[3 * static_cast<std::size_t>(side.triangle) + (apex + 1) % 3] = {next.triangle, next.opposite};
  });
}

bool RestSurface::bends(int t) const {
  return !held(t) && (beyond(t, 0).triangle >= 0 || beyond(t, 1).triangle >= 0 || beyond(t, 2).triangle >= 0);
}

PlacedTriangle RestSurface::lay_out(int t) const {
  const auto& [a, b, c] = triangle(t);
  const Point along = place(b) - place(a), up = place(c) - place(a);
  const double length = along.norm();
  return {t, {Plane(0, 0), Plane(length, 0), Plane(up.dot(along), along.cross(up).norm()) / length}};
}

PlacedTriangle RestSurface::unfold(const PlacedTriangle& from, int side) const {
  const auto p = static_cast<std::size_t>(side), q = (p + 1) % 3;
  const Triangle& t = triangle(from.triangle);
  const auto [next, opposite] = beyond(from.triangle, side);
  const Point edge = place(t[q]) - place(t[p]), up = place(opposite) - place(t[p]);
  const double length = edge.norm();
  const Plane along = (from.corners[q] - from.corners[p]).normalized();
  PlacedTriangle placed{.triangle = next, .corners = {}};
  placed.corners[corner_of(triangle(next), t[p])] = from.corners[p];
  placed.corners[corner_of(triangle(next), t[q])] = from.corners[q];
  placed.corners[corner_of(triangle(next), opposite)] =
      from.corners[p] + up.dot(edge) / length * along + edge.cross(up).norm() / length * outward(from, side);
  return placed;
}

Eigen::Vector2d outward(const PlacedTriangle& t, int side) {
  const auto p = static_cast<std::size_t>(side), q = (p + 1) % 3, apex = (p + 2) % 3;
  const Plane along = (t.corners[q] - t.corners[p]).normalized(), normal(along.y(), -along.x());
  return normal.dot(t.corners[apex] - t.corners[p]) < 0 ? normal : -normal;
}

}  // namespace drape

#include "sim/bending/edge_slope.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>

namespace drape {
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

}  // namespace drape

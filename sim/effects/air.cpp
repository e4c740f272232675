#include "drape/sim/effects/air.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/keys.hpp"
#include "sim/parallel/loops.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

/// Drag and lift on every triangle (Keckeisen, Kimmerle, Thomaszewski and Wacker, "Modelling Effects of Wind Fields in
/// Cloth Animations", 2004, section 4; after Ling, Damodaran and Gay 1996). Consider a triangle of area A and unit
/// normal n, with the air's mean velocity u relative to its vertices. Each vertex receives a third of
///   F = ρA/2 (C_D |c| ‖u‖ u + C_L c (‖u‖² n − (n·u) u)),   c = n·u/‖u‖.
/// Drag is parallel and lift perpendicular to the flow; both are independent of the sign of n.
///
/// The force is stable for any step: the impulse J = h·F is shortened until J·(u − J/µ) ≥ 0. It then goes no further
/// than to stop a mass µ with the velocity u. Here 1/µ = Σ dᵢ/9mᵢ over the triangle's free vertices, with dᵢ triangles
/// at vertex i. Cauchy's inequality for the dᵢ impulses at a vertex bounds the sum over all triangles. The kinetic
/// energy relative to a steady wind changes by at most −Σ J·u/2 ≤ 0.
class AirForce final : public Force {
 public:
  AirForce(const Air& values, const Cloth& cloth, double h, const Threads& threads)
      : values_(values),
        gusts_(values.gusts, values.velocity),
        triangles_(cloth.triangles),
        step_(h),
        threads_(cloth.vertex_count() < worth_dividing ? one_thread() : threads) {
    Eigen::VectorXd share = cloth.masses.cwiseInverse() / 9;
    for (const int pin : cloth.pins) share[pin] = 0;
    Eigen::VectorXd valence = Eigen::VectorXd::Zero(share.size());
    for (const Triangle& t : triangles_) {
      for (const int vertex : t) valence[vertex] += 1;
    }
    for (const Triangle& t : triangles_) {
      double inverse = 0;
      for (const int vertex : t) inverse += valence[vertex] * share[vertex];
      inverse_masses_.push_back(inverse);
    }
    slip_.resize(cloth.vertex_count(), 3);
    if (threads_.count() == 1) return;
    around_ = Incidence(triangles_, cloth.vertex_count());
    thirds_.resize(triangle_count(), 3);
  }

  [[nodiscard]] bool depends_on_velocity() const override { return true; }

  void add(const State& state, double time, Vertices& force) const override {
    for_ranges(threads_, slip_.rows(), [&](Eigen::Index first, Eigen::Index count) {
      std::optional<Gusts::Cell> cell;
      for (Eigen::Index i = first; i < first + count; ++i) {
        Eigen::Vector3d wind = values_.velocity;
        if (values_.gusts.speed > 0) wind += gusts_.at(state.x.row(i).transpose(), time, cell);
        slip_.row(i) = wind.transpose() - state.v.row(i);
      }
    });
    if (threads_.count() == 1) {
      for (Eigen::Index t = 0; t < triangle_count(); ++t) {
        const Eigen::RowVector3d third = third_on(t, state.x);
        for (const int vertex : triangles_[static_cast<std::size_t>(t)]) force.row(vertex) += third;
      }
      return;
    }
    for_ranges(threads_, triangle_count(), [&](Eigen::Index first, Eigen::Index count) {
      for (Eigen::Index t = first; t < first + count; ++t) thirds_.row(t) = third_on(t, state.x);
    });
    // Sum each vertex's forces in the order of a single thread, for identical results.
    for_ranges(threads_, force.rows(), [&](Eigen::Index first, Eigen::Index count) {
      for (Eigen::Index i = first; i < first + count; ++i) {
        for (const int t : around_.of(i)) force.row(i) += thirds_.row(t);
      }
    });
  }

 private:
  [[nodiscard]] Eigen::Index triangle_count() const { return static_cast<Eigen::Index>(triangles_.size()); }

  /// Returns a third of the force on a triangle [N].
  [[nodiscard]] Eigen::RowVector3d third_on(Eigen::Index triangle, const Vertices& x) const {
    const auto t = static_cast<std::size_t>(triangle);
    const auto [a, b, c] = triangles_[t];
    const Eigen::RowVector3d u = (slip_.row(a) + slip_.row(b) + slip_.row(c)) / 3;
    const Eigen::RowVector3d p = x.row(b) - x.row(a), q = x.row(c) - x.row(a);
    return force_on(u, p.cross(q), inverse_masses_[t]) / 3;
  }

  /// Returns the force on a triangle [N].
  /// @param u            velocity of the air relative to the triangle [m/s]
  /// @param cross        normal with the length of twice the area [m²]
  /// @param inverse_mass 1/µ [1/kg]
  [[nodiscard]] Eigen::RowVector3d force_on(const Eigen::RowVector3d& u, const Eigen::RowVector3d& cross,
                                            double inverse_mass) const {
    const double twice_area = cross.norm(), speed = u.norm();
    if (!(twice_area > 0) || !(speed > 0)) return Eigen::RowVector3d::Zero();
    const Eigen::RowVector3d n = cross / twice_area;
    const double normal_speed = n.dot(u), c = normal_speed / speed;
    const Eigen::RowVector3d force =
        (0.25 * values_.density * twice_area) *
        (values_.drag * std::abs(c) * speed * u + values_.lift * c * (speed * speed * n - normal_speed * u));
    const double power = force.dot(u), stopped = step_ * inverse_mass * force.squaredNorm();
    return stopped > power ? force * (power / stopped) : force;
  }

  Air values_;
  Gusts gusts_;
  std::vector<Triangle> triangles_;
  std::vector<double> inverse_masses_;  // 1/µ per triangle [1/kg]
  double step_;
  const Threads& threads_;  // a single thread for small cloth
  Incidence around_;        // triangles at each vertex, if several threads are used
  // Scratch memory:
  mutable Vertices slip_;    // velocity of the air relative to each vertex [m/s]
  mutable Vertices thirds_;  // a third of each triangle's force, if several threads are used [N]
};

}  // namespace

void Air::describe(Keys& keys) {
  keys.add("velocity", &velocity, "m/s", "Velocity of the wind. Still air slows the cloth down.");
  keys.add("density", &density, "kg/m³", "Density of the air.").at_least(0);
  keys.add("drag", &drag, "", "Drag coefficient C_D, for the force along the flow past a triangle.").at_least(0);
  keys.add("lift", &lift, "", "Lift coefficient C_L, for the force across the flow.").at_least(0);
  gusts.describe(keys);
}

void Air::check(const SimulationSettings&, const ProblemSink& problem) const {
  if (lift > 0 && drag == 0) problem("lift", "lift needs drag: expected 0, or a drag above 0");
}

void Air::install(System& system) const {
  system.forces.push_back(std::make_unique<AirForce>(*this, system.cloth, system.step, system.threads));
}

namespace {

constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;  // 2⁶⁴ divided by the golden ratio

/// Returns a hash of a 64-bit number (the finaliser of SplitMix64, Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

/// Returns three numbers in [−1, 1), each from 21 bits.
Eigen::Vector3d random_vector(std::uint64_t bits) {
  constexpr std::uint64_t mask = (1U << 21) - 1;
  constexpr double half = 1 << 20;
  return {static_cast<double>(bits & mask) / half - 1, static_cast<double>(bits >> 21 & mask) / half - 1,
          static_cast<double>(bits >> 42 & mask) / half - 1};
}

}  // namespace

void GustValues::describe(Keys& keys) {
  keys.add("gust", &speed, "m/s", "Largest change of each component of the wind by gusts; 0 is a steady wind.")
      .at_least(0);
  keys.add("gust_size", &size, "m", "Distance from one gust to the next.").above(0);
  keys.add("gust_duration", &duration, "s", "Lifetime of a gust, in the frame moving with the wind.").above(0);
  keys.add("seed", &seed, "", "Different numbers give different gusts.");
}

Eigen::Vector3d Gusts::at(const Eigen::Vector3d& place, double time, std::optional<Cell>& last) const {
  const Eigen::Vector3d carried = (place - time * wind_) / values_.size;
  const std::array<double, 4> point{carried[0], carried[1], carried[2], time / values_.duration};
  std::array<double, 4> weight{};
  std::array<std::int64_t, 4> cell{};
  for (std::size_t d = 0; d < 4; ++d) {
    const double below = std::floor(point[d]), s = point[d] - below;
    cell[d] = static_cast<std::int64_t>(below);
    weight[d] = s * s * (3 - 2 * s);
  }
  if (!last || cell != last->place) last = cell_at(cell);
  std::array<double, 16> share{1};
  for (std::size_t d = 0, corners = 1; d < 4; ++d, corners *= 2) {
    for (std::size_t k = 0; k < corners; ++k) {
      share[k + corners] = share[k] * weight[d];
      share[k] *= 1 - weight[d];
    }
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < share.size(); ++k) sum += share[k] * last->corners[k];
  return values_.speed * sum;
}

Gusts::Cell Gusts::cell_at(const std::array<std::int64_t, 4>& place) const {
  // Each dimension splits the previous corners into lower and upper ones.
  std::array<std::uint64_t, 16> bits{mixed(static_cast<std::uint64_t>(values_.seed))};
  for (std::size_t d = 0, corners = 1; d < 4; ++d, corners *= 2) {
    const std::uint64_t lower = static_cast<std::uint64_t>(place[d]) * odd;
    for (std::size_t k = 0; k < corners; ++k) {
      bits[k + corners] = mixed(bits[k] + lower + odd);
      bits[k] = mixed(bits[k] + lower);
    }
  }
  Cell cell{.place = place, .corners = {}};
  std::ranges::transform(bits, cell.corners.begin(), random_vector);
  return cell;
}

}  // namespace drape

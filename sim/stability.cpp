#include "sim/stability.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace drape {
namespace {

constexpr double tolerance = 1e-4;
constexpr int max_iterations = 300;
constexpr int check_every = 10;

/// Computes S v with S = M^-1/2 L M^-1/2 over the free vertices; `scale` is 1/√m, 0 on pins.
void apply(const std::vector<Spring>& bound, const Eigen::VectorXd& scale, const Eigen::VectorXd& v,
           Eigen::VectorXd& product) {
  product.setZero();
  for (const Spring& s : bound) {
    const double pull = s.stiffness * (scale[s.i] * v[s.i] - scale[s.j] * v[s.j]);
    product[s.i] += scale[s.i] * pull;
    product[s.j] -= scale[s.j] * pull;
  }
}

/// Returns a fixed unit vector with components in every direction, zero on pins.
Eigen::VectorXd starting_vector(const Eigen::VectorXd& scale) {
  Eigen::VectorXd v(scale.size());
  std::uint32_t random = 1;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    random = random * 1664525U + 1013904223U;  // generator of Numerical Recipes
    v[i] = scale[i] == 0 ? 0 : 1 + static_cast<double>(random) / 4294967296.0;
    if (i % 2 == 1) v[i] = -v[i];
  }
  return v.norm() > 0 ? Eigen::VectorXd(v.normalized()) : v;
}

/// Returns the largest eigenvalue of a tridiagonal matrix T from above, to a relative 1e-12, by bisection between a
/// lower bound and Gershgorin's bound. A value is above it if all pivots of value·I − T are positive. Eigen would
/// compute all eigenvalues, which for small cloth takes longer than the Lanczos iterations.
double largest_of_tridiagonal(const std::vector<double>& alpha, const std::vector<double>& beta, double least) {
  const std::size_t k = alpha.size();
  double most = least;
  for (std::size_t i = 0; i < k; ++i) {
    const double after = i + 1 < k ? beta[i] : 0, before = i > 0 ? beta[i - 1] : 0;
    most = std::max(most, alpha[i] + after + before);
  }
  const auto above = [&](double value) {
    double pivot = value - alpha[0];
    for (std::size_t i = 1; i < k && pivot > 0; ++i) pivot = value - alpha[i] - beta[i - 1] * beta[i - 1] / pivot;
    return pivot > 0;
  };
  for (int halving = 0; halving < 60 && most - least > 1e-12 * most; ++halving) {
    const double middle = least + (most - least) / 2;
    (above(middle) ? most : least) = middle;
  }
  return most;
}

/// Returns the last component of the unit eigenvector for the largest eigenvalue of a tridiagonal matrix T. With
/// value·I − T = L D Lᵀ the last entry of D is zero, and the vector solves Lᵀ p = (0, …, 0, 1) up to its length. Eigen
/// would take k³ operations for all eigenvectors, more than the Lanczos iterations of a small cloth.
double last_component(const std::vector<double>& alpha, const std::vector<double>& beta, double value) {
  const std::size_t k = alpha.size();
  std::vector<double> pivots(k);
  for (std::size_t i = 0; i < k; ++i) {
    pivots[i] = value - alpha[i] - (i == 0 ? 0 : beta[i - 1] * beta[i - 1] / pivots[i - 1]);
  }
  double component = 1, squares = 1;
  for (std::size_t i = k - 1; i-- > 0;) {
    component *= beta[i] / pivots[i];
    squares += component * component;
  }
  // NaN from a zero pivot: the iteration had converged before.
  return std::isnan(squares) ? 0 : 1 / std::sqrt(squares);
}

/// Returns an upper bound on the largest eigenvalue of S [1/s²].
double largest_eigenvalue(const std::vector<Spring>& bound_of_stiffness, const Eigen::VectorXd& scale,
                          const Stop& stop) {
  Eigen::VectorXd v = starting_vector(scale), previous = Eigen::VectorXd::Zero(v.size()), w(v.size());
  std::vector<double> alpha, beta;
  double bound = 0, value = 0;
  for (int k = 1; k <= max_iterations; ++k) {
    stop.check();
    apply(bound_of_stiffness, scale, v, w);
    alpha.push_back(v.dot(w));
    w -= alpha.back() * v;
    if (!beta.empty()) w -= beta.back() * previous;
    beta.push_back(w.norm());
    if (!std::isfinite(alpha.back() + beta.back())) return std::numeric_limits<double>::infinity();
    const bool exhausted = beta.back() <= std::numeric_limits<double>::epsilon() * std::abs(alpha.front());
    if (exhausted || k % check_every == 0) {
      // The value never falls below that of fewer iterations, whose matrices are submatrices of this one.
      value = largest_of_tridiagonal(alpha, beta, value);
      // The residual of the Ritz vector bounds the error of the eigenvalue.
      const double error = beta.back() * last_component(alpha, beta, value);
      bound = value + error;
      if (exhausted || error <= tolerance * value) break;
    }
    previous = v;
    v = w / beta.back();
  }
  return bound;
}

/// Fingerprint of all inputs of an eigenvalue.
struct Fingerprint {
  std::array<std::uint64_t, 2> state{0x9e3779b97f4a7c15U, 0xc2b2ae3d27d4eb4fU};

  void add(std::uint64_t word) {
    state[0] = (state[0] ^ word) * 0x100000001b3U;
    state[1] = (state[1] + word) * 0xd6e8feb86659fd93U;
    for (std::uint64_t& half : state) half ^= half >> 29U;
  }
  bool operator==(const Fingerprint&) const = default;
};

Fingerprint fingerprint(const std::vector<Spring>& bound, const Eigen::VectorXd& scale) {
  Fingerprint result;
  for (const Spring& s : bound) {
    result.add(static_cast<std::uint64_t>(s.i) << 32U | static_cast<std::uint64_t>(s.j));
    result.add(std::bit_cast<std::uint64_t>(s.stiffness));
  }
  for (const double one : scale) result.add(std::bit_cast<std::uint64_t>(one));
  return result;
}

/// Returns the same bound, cached: a scene's check asks for it before its simulation does.
double remembered_largest_eigenvalue(const std::vector<Spring>& bound, const Eigen::VectorXd& scale, const Stop& stop) {
  static std::mutex mutex;
  static std::optional<std::pair<Fingerprint, double>> last;
  const Fingerprint key = fingerprint(bound, scale);
  {
    const std::lock_guard lock(mutex);
    if (last && last->first == key) return last->second;
  }
  const double value = largest_eigenvalue(bound, scale, stop);
  const std::lock_guard lock(mutex);
  last.emplace(key, value);
  return value;
}

/// Returns an even binary exponent of about this size.
int even_exponent(double size) {
  int exponent = 0;
  std::frexp(size, &exponent);
  return std::isfinite(size) ? exponent / 2 * 2 : 0;
}

/// Returns the sum of bounds of position-dependent forces [1/s²].
double pushes_bound(const System& system) {
  double pushes = 0;
  for (const auto& force : system.forces) pushes += force->stiffness_bound();
  return pushes;
}

}  // namespace

double highest_frequency(const System& system) {
  Eigen::VectorXd free = Eigen::VectorXd::Ones(system.cloth.masses.size());
  for (const int pin : system.cloth.pins) free[pin] = 0;
  for (const PinRelease& release : system.pin_releases) {
    for (const int vertex : release.vertices) free[vertex] = 1;
  }
  // Scale to about the largest stiffness and the smallest mass, to keep products within the range of a double. The
  // units are powers of four and change no bit of the result.
  std::vector<Spring> bound;
  system.stiffness_bound().for_each_pair([&](const Spring& pair) { bound.push_back(pair); });
  double stiffest = 0;
  for (const Spring& s : bound) stiffest = std::max(stiffest, std::abs(s.stiffness));
  const int unit_of_stiffness = even_exponent(stiffest);
  const int unit_of_mass = even_exponent(system.cloth.masses.minCoeff());
  for (Spring& s : bound) s.stiffness = std::ldexp(s.stiffness, -unit_of_stiffness);
  const auto scale = [&](double mass) { return 1 / std::sqrt(std::ldexp(mass, -unit_of_mass)); };
  const double largest =
      remembered_largest_eigenvalue(bound, free.cwiseProduct(system.cloth.masses.unaryExpr(scale)), system.stop);
  return std::ldexp(std::sqrt(largest), (unit_of_stiffness - unit_of_mass) / 2);
}

double safe_step(const System& system) {
  double frequency = highest_frequency(system);
  double pushes = pushes_bound(system);
  for (const auto& field : system.fields) pushes += field->stiffness_bound();
  if (pushes > 0) frequency = std::hypot(frequency, std::sqrt(pushes));
  return frequency > 0 ? 2 / frequency : std::numeric_limits<double>::infinity();
}

double safe_step_of_pushes(const System& system) {
  const double pushes = pushes_bound(system);
  return pushes > 0 && std::isfinite(pushes) ? 2 / std::sqrt(pushes) : std::numeric_limits<double>::infinity();
}

double condition_bound(const System& system) {
  const Eigen::VectorXd& masses = system.cloth.masses;
  StiffnessBound bound = system.stiffness_bound();
  Eigen::VectorXd& stiffness = bound.vertices;
  bound.for_each_pair([&](const Spring& pair) { add_row_sums(pair, stiffness); });
  for (const int pin : system.cloth.pins) stiffness[pin] = 0;
  const double h = system.step;
  return 1 + (h * h * stiffness.array() / masses.array()).maxCoeff();
}

namespace {

Eigen::Index worst_vertex(const State& state) {
  Eigen::Index fastest = 0;
  for (Eigen::Index i = 0; i < state.v.rows(); ++i) {
    if (!state.x.row(i).allFinite() || !state.v.row(i).allFinite()) return i;
    if (state.v.row(i).stableNorm() > state.v.row(fastest).stableNorm()) fastest = i;
  }
  return fastest;
}

}  // namespace

double BlowUpWatch::limit(double ratio) {
  if (ratio >= 1) return limit_of_unstable_steps;
  return std::min(limit_of_unstable_steps, 4 * (1 + ratio) / (1 - ratio));
}

double energy_rounding(const System& system) {
  double scale = std::numeric_limits<double>::min();
  for (const Spring& s : system.springs) scale += s.stiffness * s.rest_length * s.rest_length;
  return std::numeric_limits<double>::epsilon() * scale;
}

BlowUpWatch::BlowUpWatch(const System& system, double limit, int interval)
    : step_(system.whole_step), limit_(limit), interval_(interval), rounding_(energy_rounding(system)) {}

void BlowUpWatch::begin(const State& state, double energy) {
  memory_ = {.explained = std::max(energy, rounding_), .checked_at = state.x, .work = 0, .energy = {}};
}

std::optional<double> BlowUpWatch::check_step(const State& state, const Vertices& push, bool constant,
                                              const std::function<double(double enough)>& energy) {
  if (!constant) memory_.work += step_ * std::abs(push.cwiseProduct(state.v).sum());
  if (state.step % interval_ != 0) return std::nullopt;
  if (constant) memory_.work = std::abs(push.cwiseProduct(state.x - memory_.checked_at).sum());
  memory_.explained += memory_.work;
  memory_.checked_at = state.x;
  memory_.work = 0;
  const double now = energy(limit_ * memory_.explained);
  if (!(now > limit_ * memory_.explained)) return std::nullopt;
  return now / memory_.explained;
}

DivergedError diverged(const State& state, double time, std::optional<double> growth, const std::string& remedy) {
  const Eigen::Index worst = worst_vertex(state);
  const double speed = state.v.row(worst).stableNorm();
  std::string text =
      fmt::format("the simulation diverged at step {} (t = {:g} s): vertex {} ", state.step, time, worst);
  text += std::isfinite(speed) && state.x.row(worst).allFinite() ? fmt::format("moves at {:.3g} m/s", speed)
                                                                 : "is no longer at a finite position";
  text += growth ? fmt::format(
                       " and the energy has grown to {:.2g} times the cloth's initial energy plus the work done on it",
                       *growth)
                 : " and the energy has grown without bound";
  return DivergedError(text + remedy);
}

}  // namespace drape

#include "sim/solvers/newton.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/machine.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr int newton_iterations = 20;  // the homework's
constexpr double fast = 0.5;           // ratio of successive ‖∇g‖ above which negative eigenvalues are used

std::unique_ptr<NewtonSolver> make_solver(LinearSolver choice, const System& system, const StepObjective& objective) {
  switch (choice) {
    case LinearSolver::cholesky:
      return std::make_unique<NewtonCholesky>(system, objective);
    case LinearSolver::conjugate_gradients:
      return std::make_unique<ConjugateGradients>(system, objective);
    case LinearSolver::automatic:
      break;
  }
  return std::make_unique<CheaperNewton>(system, objective);
}

}  // namespace

Newton::Newton(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : Minimiser(system, objective, settings, default_iterations(settings, newton_iterations)),
      solver_(make_solver(settings.linear_solver, system, objective)),
      direction_(system.cloth.vertex_count(), 3) {}

void Newton::start() {
  concavity_ = 0;
  solver_->begin();
}

void Newton::find_newton_step(const Iterate& point, Vertices& direction) {
  solver_->solve(point.x, point.gradient, 0, direction);
}

double Newton::iterate(Iterate& point) {
  const Threads& threads = objective().threads();
  const double before = norm(threads, point.gradient);
  solver_->solve(point.x, point.gradient, concavity_, direction_);
  const double length = descend(point, direction_, dot(threads, point.gradient, direction_));
  const bool creeps = !(norm(threads, point.gradient) < fast * before);
  if (creeps && accuracy().rule != StoppingRule::change) concavity_ = 1;
  return length * norm(threads, direction_);
}

namespace {

// Rings of neighbours around vertices above the tolerance, at least and at most. They are added until the patches hold
// this fraction of all vertices, which justifies the passes over the whole cloth. Wider patches move their rims less.
constexpr int least_rings = 2, most_rings = 16;
constexpr double worthwhile = 0.02;
// After the first iterations the error is mostly at the rims, where more iterations do not help.
constexpr int patch_iterations = 2;
constexpr double margin = 0.5;  // fraction of the tolerance, to leave some for the rims
// Maximum number of vertices in patches, independent of the machine's memory as it affects the motion. Each takes up to
// 5 kB for the factor and its construction.
constexpr double most_vertices = 200'000, bytes_per_vertex = 5e3;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

Incidence springs_at(const System& system) {
  std::vector<int> ends;
  ends.reserve(2 * system.springs.size());
  for (const Spring& spring : system.springs) ends.insert(ends.end(), {spring.i, spring.j});
  return {ends, 2, system.cloth.vertex_count()};
}

/// Returns the rows of the given vertices.
Vertices rows_of(const Vertices& all, const std::vector<int>& vertices) {
  Vertices some(static_cast<Eigen::Index>(vertices.size()), 3);
  for (Eigen::Index row = 0; const int vertex : vertices) some.row(row++) = all.row(vertex);
  return some;
}

}  // namespace

PatchNewton::PatchNewton(const System& system, const StepObjective& objective)
    : system_(system),
      objective_(objective),
      springs_at_(springs_at(system)),
      places_(at(system.cloth.vertex_count())),
      numbers_(places_.size()) {
  const double most = std::min(most_vertices, usual_share * static_cast<double>(places_.size()));
  require_memory(fmt::format("Newton's method on patches of {:.0f} vertices", most), bytes_per_vertex * most,
                 "use a coarser cloth or another method");
}

void PatchNewton::surround(std::size_t first, Place place) {
  const std::size_t end = vertices_.size();
  for (std::size_t v = first; v < end; ++v) {
    const int vertex = vertices_[v];
    for (const int number : springs_at_.of(vertex)) {
      const Spring& spring = system_.springs[at(number)];
      const int neighbour = spring.i == vertex ? spring.j : spring.i;
      if (places_[at(neighbour)] != Place::outside) continue;
      places_[at(neighbour)] = place;
      vertices_.push_back(neighbour);
    }
  }
}

void PatchNewton::find_patches(const Vertices& gradient, double tolerance) {
  const Eigen::VectorXd& inertia = objective_.inertia();
  std::fill(places_.begin(), places_.end(), Place::outside);
  vertices_.clear();
  for (int i = 0; i < static_cast<int>(gradient.rows()); ++i) {
    if (!(gradient.row(i).norm() > tolerance * inertia[i])) continue;
    places_[at(i)] = Place::inside;
    vertices_.push_back(i);
  }
  const auto enough = static_cast<std::size_t>(worthwhile * static_cast<double>(places_.size()));
  std::size_t last_ring = 0;
  for (int ring = 0; ring < most_rings && (ring < least_rings || vertices_.size() < enough); ++ring) {
    const std::size_t end = vertices_.size();
    surround(last_ring, Place::inside);
    last_ring = end;
  }
  inside_ = vertices_.size();
  surround(last_ring, Place::rim);
  for (const int pin : system_.cloth.pins) {
    if (places_[at(pin)] == Place::inside) places_[at(pin)] = Place::rim;
  }
  std::sort(vertices_.begin(), vertices_.end());
  for (int number = 0; const int vertex : vertices_) numbers_[at(vertex)] = number++;
}

Cloth PatchNewton::cut_out(const Vertices& x) {
  const Cloth& whole = system_.cloth;
  Cloth cloth;
  cloth.positions = rows_of(x, vertices_);
  cloth.velocities = Vertices::Zero(cloth.positions.rows(), 3);
  if (whole.rest.rows() == x.rows()) cloth.rest = rows_of(whole.rest, vertices_);
  cloth.masses.resize(cloth.positions.rows());
  for (const int vertex : vertices_) {
    const int number = numbers_[at(vertex)];
    cloth.masses[number] = whole.masses[vertex];
    if (places_[at(vertex)] == Place::rim) cloth.pins.push_back(number);
  }
  for (const Spring& spring : system_.springs) {
    const Place one = places_[at(spring.i)], other = places_[at(spring.j)];
    if (one == Place::outside || other == Place::outside || (one == Place::rim && other == Place::rim)) continue;
    cloth.springs.push_back(spring);
    cloth.springs.back().i = numbers_[at(spring.i)];
    cloth.springs.back().j = numbers_[at(spring.j)];
  }
  return cloth;
}

double PatchNewton::minimise_patches(Iterate& point, double share, double tolerance) {
  find_patches(point.gradient, tolerance);
  const double most = std::min(most_vertices, share * static_cast<double>(places_.size()));
  if (inside_ == 0 || static_cast<double>(inside_) > most) return 0;
  const Cloth cloth = cut_out(point.x);
  System system(cloth, system_.step, system_.threads);
  system.stop = system_.stop;
  StepObjective objective(system, objective_.duration());
  // Without velocities and forces, y equals the given start.
  Vertices y = rows_of(objective_.y(), vertices_);
  for (const int pin : cloth.pins) y.row(pin) = cloth.positions.row(pin);
  objective.begin(y, cloth.velocities, Vertices::Zero(y.rows(), 3), objective_.time());
  Iterate patch{.x = cloth.positions, .gradient = Vertices::Zero(y.rows(), 3)};
  patch.value = objective.evaluate(patch.x, patch.gradient);
  IntegratorSettings settings;
  settings.stop = StoppingRule::error;
  settings.tolerance = margin * tolerance;
  settings.max_iterations = patch_iterations;
  settings.linear_solver = LinearSolver::cholesky;
  try {
    Newton(system, objective, settings).minimise(patch, [] { return true; });
  } catch (const FactorTooExpensive&) {
    return 0;
  }
  for (Eigen::Index row = 0; const int vertex : vertices_) point.x.row(vertex) = patch.x.row(row++);
  point.value = objective_.evaluate(point.x, point.gradient);
  return (patch.x - cloth.positions).norm();
}

}  // namespace drape

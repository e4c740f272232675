// Whole runs over all kinds of contact with static obstacles: the total energy never rises, and nothing passes through.
// DRAPE_ENERGY_RUNS sets the number of the 1500 runs of 30×30 cells in Nightly/ObstaclesAtRest, and
// DRAPE_ENERGY_SECONDS the CPU time after which such a run ends; script/contact-energy makes a table of them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "drape/sim/cloth.hpp"
#include "tests/contact/contact_setup.hpp"
#include "tests/support/audited_run.hpp"
#include "tests/support/random.hpp"

namespace drape::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double side = 1;       // of the sheets [m]
constexpr double depth = 0.4;    // of the ground below the other obstacles [m]
constexpr double stable = 0.01;  // largest rise, as a fraction of the cloth's available energy
enum class Obstacle { ground, sphere, box, pole, itself };
constexpr std::array obstacles{"ground", "sphere", "box", "pole", "itself"};
constexpr std::array steps{0.001, 0.002, 0.005, 0.01, 0.02};     // [s]
constexpr std::array stiffnesses{18.0, 180.0, 1800.0, 18000.0};  // [N/m]

const std::vector<Fabric>& measured_fabrics() {
  static const std::vector<Fabric> measured = [] {
    std::vector<Fabric> found;
    std::ranges::copy_if(fabrics(), std::back_inserter(found), &Fabric::measured);
    return found;
  }();
  return measured;
}

/// One run of a set, fully determined by its number.
struct Trial {
  int number;
  bool impulses = false;  ///< computed by an explicit method
  bool nightly = false;   ///< of the large set, which has every method and scheme

  [[nodiscard]] int cells() const { return nightly ? 30 : 12; }
  [[nodiscard]] Obstacle obstacle() const { return static_cast<Obstacle>(place() % 5); }
  [[nodiscard]] double step() const {
    return steps[static_cast<std::size_t>((nightly ? place() / 70 : number / 5 + number) % 5)];
  }
  [[nodiscard]] const NamedMethod& method() const {
    if (nightly)
      return all_contact_methods[static_cast<std::size_t>((place() + place() / 5 + place() / 70 + number / 350) % 8)];
    if (impulses) return contact_methods[solving_methods.size() + static_cast<std::size_t>((number + number / 5) % 2)];
    return solving_methods[static_cast<std::size_t>((number + number / 15) % 3)];
  }
  [[nodiscard]] std::size_t material() const { return static_cast<std::size_t>(nightly ? place() / 5 : number) % 14; }
  [[nodiscard]] std::string title() const {
    const bool fabric = material() < measured_fabrics().size();
    std::string cloth = fabric ? std::string(measured_fabrics()[material()].name)
                               : "k" + std::to_string(std::lround(stiffnesses[material() - measured_fabrics().size()]));
    std::erase(cloth, '-');
    return "Run" + std::to_string(number) + "_" + obstacles[static_cast<std::size_t>(obstacle())] + "_" + cloth + "_" +
           std::to_string(std::lround(step() * 1000)) + "ms_" + method().name;
  }

 private:
  /// Its place in the large set, where 350 runs have every obstacle, material and step together: far from that of the
  /// run before, so that few runs have much of everything.
  [[nodiscard]] int place() const { return nightly ? 149 * number % 350 : number; }
};

Mesh folded_square(int cells) {
  Mesh mesh = level_square(side, cells, 0);
  const double fold = 0.1;
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const double beyond = mesh.positions(i, 0) - fold;
    if (beyond <= 0) continue;
    // A bend of three cells' width, then flat.
    const double radius = 0.08, angle = std::min(beyond / radius, std::numbers::pi);
    mesh.positions(i, 0) = fold + radius * std::sin(angle) - std::max(0.0, beyond - std::numbers::pi * radius);
    mesh.positions(i, 2) += radius * (1 - std::cos(angle));
  }
  return mesh;
}

/// Returns the sheet in a random pose, without initial contact; folded over itself if it is its own obstacle.
Mesh pose(Obstacle obstacle, int cells, Random& random) {
  Mesh mesh = obstacle == Obstacle::itself ? folded_square(cells) : level_square(side, cells, 0);
  const double most = obstacle == Obstacle::itself ? 0.3 : 0.5 * std::numbers::pi;
  const Vector3d axis = random_point(random).normalized();
  const Matrix3d turn = AngleAxisd(random.between(0, most), axis).toRotationMatrix();
  mesh.positions = (mesh.positions * turn.transpose()).eval();
  mesh.positions.col(2).array() += 1.5 * distance + random.between(0, 0.03) - mesh.positions.col(2).minCoeff();
  return mesh;
}

Vertices velocities(const Trial& run, const Cloth& cloth, Random& random) {
  const double speed = run.number % 3 == 0 ? 0 : random.between(0, 5);
  Vector3d way = random_point(random).normalized();
  way.z() = -std::abs(way.z());
  Vertices v = (speed * way.transpose()).replicate(cloth.vertex_count(), 1);
  if (run.obstacle() != Obstacle::itself) return v;
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    if (cloth.rest(i, 0) > 0.1) v.row(i) << 0.5, 0, -std::max(1.0, speed / 2);  // the flap comes down on the rest
  }
  return v;
}

void add_obstacle(Obstacle obstacle, Effects& effects) {
  Ground ground = solved_ground();
  if (obstacle != Obstacle::ground && obstacle != Obstacle::itself) ground.height = -depth;
  if (obstacle == Obstacle::sphere) {
    const double radius = 0.25;
    effects.add(Sphere{.center = Vector3d(0, 0, -radius),
                       .radius = radius,
                       .thickness = distance,
                       .friction = 0.3,
                       .restitution = 0.5});
  }
  if (obstacle == Obstacle::box) effects.add(solved_box({0.5, 0.4, 0.25}, 0));
  if (obstacle == Obstacle::pole) effects.add(solved_box({0.02, 2, 0.02}, 0));
  effects.add(ground);
  effects.add(solved_self());
}

SimulationSettings make(const Trial& run) {
  Random random(static_cast<std::uint64_t>(1000 + 77 * run.number));
  const Mesh rest = level_square(side, run.cells(), 0), start = pose(run.obstacle(), run.cells(), random);
  SimulationSettings settings;
  settings.step = run.step();
  settings.integrator.method = run.method().method;
  settings.integrator.scheme = run.method().scheme;
  settings.effects = {Gravity{}};
  if (run.material() < measured_fabrics().size()) {
    const Fabric& fabric = measured_fabrics()[run.material()];
    settings.cloth = make_cloth(start, rest, 1, 1, {});
    share_mass_by_area(fabric.density, settings.cloth);
    stiffen_by_direction(fabric.modulus, settings.cloth);
    settings.effects.add(Bending{.rigidity = fabric.rigidity});
  } else {
    settings.cloth = make_cloth(start, rest, 0.2, stiffnesses[run.material() - measured_fabrics().size()], {});
  }
  settings.cloth.velocities = velocities(run, settings.cloth, random);
  add_obstacle(run.obstacle(), settings.effects);
  settings = in_substeps(settings);
  // Without any contact, the energy oscillates by a part of (hω)² of velocity Verlet and of hω of semi-implicit Euler,
  // more in an initially strained cloth such as the folded one.
  const bool verlet = run.method().method == Method::verlet, folded = run.obstacle() == Obstacle::itself;
  const double ratio = folded ? (verlet ? 4 : 6) : (verlet ? calm_ratio : 2);
  if (run.method().is_explicit()) settings.step /= ratio;
  return settings;
}

/// Returns the cloth's available energy: kinetic, elastic, and that of its fall onto the ground [J].
double to_give(const Trial& run, const SimulationSettings& settings) {
  const Energies energies = Simulation(settings).energies();
  const bool deep = run.obstacle() != Obstacle::ground && run.obstacle() != Obstacle::itself;
  const double lowest = (deep ? -depth : 0) + distance;
  const double fall = mean_of(settings.cloth, settings.cloth.positions).z() - lowest;
  return energies.kinetic + energies.elastic + settings.cloth.masses.sum() * g * fall;
}

/// Runs with cloth that crumples on itself, whose steps are slow.
constexpr std::array left_out{4, 19, 24, 29, 39};
/// Later runs left out: in 83 liu13 does not finish its first step, and the cloth would fall beside the pole.
constexpr std::array later{83};

std::vector<Trial> all_runs() {
  std::vector<Trial> all;
  for (int i = 0; i < 42; ++i) {
    if (std::ranges::find(left_out, i) == left_out.end()) all.push_back({i});
  }
  for (const int i : later) all.push_back({i});
  for (int i = 0; i < 42; ++i) all.push_back({.number = i, .impulses = true});
  return all;
}

void PrintTo(const Trial& run, std::ostream* out) { *out << run.title(); }

class ObstaclesAtRest : public testing::TestWithParam<Trial> {};
INSTANTIATE_TEST_SUITE_P(Of, ObstaclesAtRest, testing::ValuesIn(all_runs()),
                         [](const auto& trial) { return trial.param.title(); });

/// The large set's runs that are asked for.
std::vector<Trial> nightly_runs() {
  const char* const asked = std::getenv("DRAPE_ENERGY_RUNS");
  std::vector<Trial> all;
  for (int i = 0; i < (asked == nullptr ? 20 : std::atoi(asked)); ++i) all.push_back({.number = i, .nightly = true});
  return all;
}
INSTANTIATE_TEST_SUITE_P(Nightly, ObstaclesAtRest, testing::ValuesIn(nightly_runs()),
                         [](const auto& trial) { return trial.param.title(); });

/// The run of the large set whose unfinished steps gained 1.3 % of the energy from contacts that began too near.
INSTANTIATE_TEST_SUITE_P(Unfinished, ObstaclesAtRest, testing::Values(Trial{.number = 7, .nightly = true}),
                         [](const auto& trial) { return trial.param.title(); });

TEST(EnergyRuns, OfTheNightCoverAllPairs) {
  using Levels = std::array<std::size_t, 4>;
  std::array<std::array<std::set<std::pair<std::size_t, std::size_t>>, 4>, 4> pairs;
  for (int i = 0; i < 350; ++i) {
    const Trial run{.number = i, .nightly = true};
    const auto step = std::ranges::find(steps, run.step()) - steps.begin();
    const auto method = std::ranges::find(all_contact_methods, std::string_view(run.method().name),
                                          [](const NamedMethod& m) { return std::string_view(m.name); }) -
                        all_contact_methods.begin();
    const Levels levels{static_cast<std::size_t>(run.obstacle()), run.material(), static_cast<std::size_t>(step),
                        static_cast<std::size_t>(method)};
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) pairs[a][b].insert({levels[a], levels[b]});
    }
  }
  constexpr Levels counts{5, 14, 5, 8};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_EQ(pairs[a][b].size(), counts[a] * counts[b]) << a << ", " << b;
  }
}

TEST_P(ObstaclesAtRest, GiveNoEnergyAndLetNothingPass) {
  const Trial& run = GetParam();
  const SimulationSettings settings = make(run);
  const double all = to_give(run, settings);
  const auto steps = std::lround((run.step() > 0.005 ? 60 : 100) * run.step() / settings.step);
  const char* const seconds = run.nightly ? std::getenv("DRAPE_ENERGY_SECONDS") : nullptr;
  const AuditedRun audited =
      audit_run(settings, steps, seconds == nullptr ? std::numeric_limits<double>::infinity() : std::atof(seconds));
  RecordProperty("steps", std::to_string(audited.steps));
  RecordProperty("of_steps", std::to_string(steps));
  RecordProperty("rise_percent", std::to_string(100 * audited.rise.rise / all));
  RecordProperty("passages", audited.with_passages + audited.with_crossings + (audited.deepest > 0 ? 1 : 0));
  EXPECT_LE(audited.rise.rise, stable * all) << run.title() << ": " << 100 * audited.rise.rise / all << " % from step "
                                             << audited.rise.from << " to " << audited.rise.to;
  EXPECT_EQ(audited.with_passages, 0) << run.title() << "\n" << lines(audited.first);
  EXPECT_EQ(audited.with_crossings, 0) << run.title() << "\n" << lines(audited.first);
  EXPECT_EQ(audited.deepest, 0) << run.title();
}

}  // namespace
}  // namespace drape::test

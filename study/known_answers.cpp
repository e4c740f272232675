#include "study/known_answers.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "motion/import/npz.hpp"
#include "study/runs_file.hpp"
#include "study/validation.hpp"
#include "study/validation_measures.hpp"

namespace drape {
namespace {

constexpr int elastica_steps = 4000;

/// θ, dθ/dσ, drop and reach, with σ = 1 − s measured from the free end.
using ElasticaState = std::array<double, 4>;

ElasticaState slope_of(const ElasticaState& y, double sigma, double gamma) {
  return {y[1], -gamma * sigma * std::cos(y[0]), std::sin(y[0]), std::cos(y[0])};
}

ElasticaState moved(const ElasticaState& y, const ElasticaState& slope, double way) {
  ElasticaState result = y;
  for (std::size_t k = 0; k < y.size(); ++k) result[k] += way * slope[k];
  return result;
}

/// Returns the state at the clamp for the angle `tip` at the free end.
ElasticaState shoot(double tip, double gamma) {
  constexpr double h = 1.0 / elastica_steps;
  ElasticaState y{tip, 0, 0, 0};
  for (int step = 0; step < elastica_steps; ++step) {
    const double sigma = step * h;
    const ElasticaState k1 = slope_of(y, sigma, gamma), k2 = slope_of(moved(y, k1, h / 2), sigma + h / 2, gamma),
                        k3 = slope_of(moved(y, k2, h / 2), sigma + h / 2, gamma),
                        k4 = slope_of(moved(y, k3, h), sigma + h, gamma);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
  }
  return y;
}

/// Returns the angle at the free end of the hanging equilibrium: the largest angle with a horizontal clamp.
double tip_angle(double gamma) {
  constexpr int scanned = 200;
  double high = std::numbers::pi / 2, above = shoot(high, gamma)[0], low = high, below = above;
  for (int i = 1; i <= scanned && below > 0; ++i) {
    high = low;
    above = below;
    low = std::numbers::pi / 2 * (1 - static_cast<double>(i) / scanned);
    below = shoot(low, gamma)[0];
  }
  // The Illinois variant of regula falsi.
  for (int i = 0; i < 100 && high - low > 1e-16; ++i) {
    const double middle = (low * above - high * below) / (above - below), value = shoot(middle, gamma)[0];
    if (std::abs(value) < 1e-15) return middle;
    if (value > 0) {
      high = middle;
      above = value;
      below /= 2;
    } else {
      low = middle;
      below = value;
      above /= 2;
    }
  }
  return (low + high) / 2;
}

}  // namespace

double ElasticaTip::chord_angle() const { return std::atan2(drop, reach) * 180 / std::numbers::pi; }

ElasticaTip heavy_elastica(double gamma) {
  if (gamma <= 0) return {0, 1};
  const ElasticaState clamp = shoot(tip_angle(gamma), gamma);
  return {clamp[2], clamp[3]};
}

namespace {

using std::numbers::pi;

/// Returns the fall of a flat sheet from rest, in units of v∞²/g, at a time in units of v∞/g.
double fallen(double time) { return std::log(std::cosh(time)); }

/// Returns the acceleration on a slope of tangent x with friction 0.3, relative to g.
double sliding(double tangent) {
  constexpr double friction = 0.3;
  return std::max(0.0, (tangent - friction) / std::hypot(1, tangent));
}

/// Returns the way of a sheet that a steadily moving spring pulls over dry ground, relative to the way of the spring's
/// end in a cycle.
/// @param cycles since the spring first exceeded friction
double stick_slip_way(double cycles) { return cycles < 0 ? 0 : cycles - std::sin(2 * pi * cycles) / (2 * pi); }

/// Returns the modulus relative to E at an angle [degrees], from weights of springs along 0° and 90°, 45°, and 135°.
double modulus_at(double angle, double sides, double rising, double falling) {
  const auto share = [angle](double spring) { return std::pow(std::cos((angle - spring) * pi / 180), 4); };
  return sides * (share(0) + share(90)) + rising * share(45) + falling * share(135);
}

/// Returns the modulus relative to E of an isotropic sheet with Poisson's ratio 1/3. The four loads are strain in one
/// direction, in the other, equal strains in both, and opposite strains.
double isotropic_modulus(double load) {
  constexpr std::array values{9.0 / 8, 9.0 / 8, 3.0, 1.5};
  return values.at(static_cast<std::size_t>(std::lround(load) - 1));
}

/// Returns the radius of a mylar balloon relative to that of its flat discs, 4 √(2π)/Γ(1/4)².
double balloon_radius() { return 4 * std::sqrt(2 * pi) / std::pow(std::tgamma(0.25), 2); }

/// Returns the height of a mylar balloon relative to its diameter: that is ∫ t²/√(1 − t⁴) dt from 0 to 1.
double balloon_height() { return pi / 4 * balloon_radius(); }

const std::map<std::string, KnownCurve>& all_known_curves() {
  static const std::map<std::string, KnownCurve> curves{
      {"heavy-cantilever/drop", {[](double gamma) { return heavy_elastica(gamma).drop; }}},
      {"heavy-cantilever/reach", {[](double gamma) { return heavy_elastica(gamma).reach; }}},
      {"bending-length/angle", {[](double gamma) { return heavy_elastica(gamma).chord_angle(); }}},
      {"catenary/sag", {catenary_sag}},
      {"pendulum/period", {pendulum_period}},
      {"hanging-chain/frequency", {[](double n) { return bessel_zero(static_cast<int>(std::lround(n))) / 2; }, false}},
      {"membrane/frequency", {[](double waves) { return waves; }}},
      {"terminal-velocity/fallen", {fallen}},
      {"incline/acceleration", {sliding}},
      {"capstan/slipped", {[](double load) { return load > 1 ? 1.0 : 0.0; }}},
      {"turntable/slipped", {[](double load) { return load > 1 ? 1.0 : 0.0; }}},
      {"stick-slip/way", {stick_slip_way}},
      {"stick-slip/rest", {stick_slip_rest}},
      {"restitution/rebound", {[](double e) { return e * e; }}},
      {"pattern-stiffness/diagonal", {[](double angle) { return modulus_at(angle, 1, 0, 1); }}},
      {"pattern-stiffness/alternating", {[](double angle) { return modulus_at(angle, 1, 0.5, 0.5); }}},
      {"pattern-stiffness/x", {[](double angle) { return modulus_at(angle, 0.5, 1, 1); }}},
      {"pattern-stiffness/grid", {isotropic_modulus, false}},
      {"lateral-buckling/buckled", {[](double gamma) { return gamma > 12.85 * std::numbers::sqrt2 ? 1.0 : 0.0; }}},
      {"clamped-plate/frequency", {[](double) { return 35.985; }, false}},
      {"rolled-sheet/energy", {[](double) { return 1.0; }}},
      {"mylar-balloon/radius", {[](double) { return balloon_radius(); }}},
      {"mylar-balloon/height", {[](double) { return balloon_height(); }}},
      {"free-flight/ratio", {[](double) { return 1.0; }, false}},
  };
  return curves;
}

}  // namespace

KnownCurve known_curve(const std::string& name, const std::string& curve) {
  const auto found = all_known_curves().find(name + "/" + curve);
  return found == all_known_curves().end() ? KnownCurve{} : found->second;
}

double bessel_zero(int k) {
  const double b = (k - 0.25) * pi;
  double x = b + 1 / (8 * b);  // McMahon's expansion
  for (int i = 0; i < 20; ++i) x += std::cyl_bessel_j(0, x) / std::cyl_bessel_j(1, x);
  return x;
}

double capstan_limit(double friction, double light, double radius) {
  // T/(ρgR) = C e^{µθ} + a cos θ + b sin θ; the b term vanishes at both ends.
  const double a = -2 * friction / (1 + friction * friction);
  return ((light / radius - a) * std::exp(friction * pi) - a) * radius;
}

double catenary_sag(double span) {
  // a sinh(x/a) = 1 with x half the span: u = x/a solves sinh(u)/u = 1/x.
  const double half = span / 2;
  double low = 1e-9, high = 50;
  for (int i = 0; i < 200; ++i) {
    const double u = (low + high) / 2;
    (half * std::sinh(u) > u ? high : low) = u;
  }
  const double a = half / low;
  return a * (std::cosh(low) - 1);
}

double stick_slip_rest(double start) {
  return std::abs(start) <= 1 ? start : -stick_slip_rest(start - std::copysign(2, start));
}

double pendulum_period(double amplitude) {
  double a = 1, b = std::cos(amplitude * pi / 360);
  for (int i = 0; i < 60 && std::abs(a - b) > 1e-16; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 1 / a;
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_answer_bytes = std::size_t{1} << 24;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const std::size_t begin = cell.find_first_not_of(" \t\r\""), end = cell.find_last_not_of(" \t\r\"");
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

const KnownAnswer& answer_called(const ValidationProblem& problem, const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const KnownAnswer& answer : problem.answers) {
    if (answer.name == name) return answer;
    names.push_back(answer.name);
  }
  throw UsageError(fmt::format("{}: problem '{}' has no quantity '{}'{}", place, problem.name, name,
                               did_you_mean(name, names, "the quantities are")));
}

std::vector<GivenAnswer> answers_of_csv(const ValidationCase& of, const fs::path& file) {
  std::istringstream text(read_text(file, most_answer_bytes));
  std::vector<GivenAnswer> given;
  std::string line;
  std::size_t number = 0;
  while (std::getline(text, line)) {
    const std::string place = fmt::format("{}:{}", shown(file), ++number);
    const std::vector<std::string> cells = cells_of(line);
    if (cells.empty()) continue;
    if (cells.size() != 3) {
      throw UsageError(fmt::format("{}: expected problem,quantity,value, found {} cells", place, cells.size()));
    }
    if (number == 1) {
      if (cells != std::vector<std::string>{"problem", "quantity", "value"}) {
        throw UsageError(fmt::format("{}: expected the line problem,quantity,value", place));
      }
      continue;
    }
    GivenAnswer answer;
    try {
      answer.problem = &of.problem(cells[0]);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}: {}", place, error.what()));
    }
    answer.known = &answer_called(*answer.problem, cells[1], place);
    const char* const end = cells[2].data() + cells[2].size();
    const auto [read, error] = std::from_chars(cells[2].data(), end, answer.value);
    if (error != std::errc() || read != end) {
      throw UsageError(fmt::format("{}: expected a number, found '{}'", place, shown(cells[2])));
    }
    given.push_back(answer);
  }
  if (given.empty()) throw UsageError(fmt::format("{}: there is no answer in it", shown(file)));
  return given;
}

/// Returns the states in an array of positions or velocities.
std::vector<Vertices> states_in(NpyStream& array, Eigen::Index vertices) {
  const std::vector<std::size_t>& shape = array.shape();
  const auto count = static_cast<std::size_t>(vertices);
  const bool one = shape.size() == 2, several = shape.size() == 3;
  if ((!one && !several) || shape.back() != 3 || shape[shape.size() - 2] != count) {
    array.fail(fmt::format("expected [times ×] {} × 3 numbers", count));
  }
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  std::vector<Vertices> states;
  const std::vector<double> values = array.rest();
  for (std::size_t begin = 0; begin < values.size(); begin += 3 * count) {
    states.emplace_back(Eigen::Map<const Rows>(values.data() + begin, vertices, 3));
  }
  return states;
}

std::vector<GivenAnswer> answers_of_npz(const ValidationCase& of, const fs::path& file, const std::string& name) {
  if (name.empty() && of.problems.size() > 1) {
    std::vector<std::string> names;
    for (const ValidationProblem& one : of.problems) names.push_back(one.name);
    throw UsageError(
        fmt::format("{}: expected --problem with the motion's problem, one of {}", shown(file), quoted_list(names)));
  }
  const ValidationProblem& problem = name.empty() ? of.problems.front() : of.problem(name);
  const ZipReader zip(file);
  const auto positions = array_named(zip, {"positions"}), velocities = array_named(zip, {"velocities"}),
             times = array_named(zip, {"times"});
  if (!positions) throw UsageError(fmt::format("{}: expected an array 'positions'", shown(file)));
  StudyCase study_case;
  study_case.scene = of.scene;
  study_case.overrides = problem.overrides;
  ObservedMotion motion;
  motion.cloth = study_case.load().simulation.cloth;
  const Eigen::Index vertices = motion.cloth.positions.rows();
  motion.positions = states_in(*positions, vertices);
  if (velocities) motion.velocities = states_in(*velocities, vertices);
  motion.times = times ? times->rest() : std::vector<double>(motion.positions.size(), 0.0);
  std::map<std::string, double> values;
  try {
    values = measure_motion(of.measure, motion, problem.given);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", shown(file), error.what()));
  }
  std::vector<GivenAnswer> given;
  for (const KnownAnswer& known : problem.answers) given.push_back({&problem, &known, values.at(known.name)});
  return given;
}

}  // namespace

bool GivenAnswer::met() const { return std::isfinite(value) && in_tolerances(*known, value) <= 1; }

std::vector<GivenAnswer> read_answers(const ValidationCase& of, const fs::path& file, const std::string& problem) {
  if (file.extension() == ".npz") return answers_of_npz(of, file, problem);
  if (!problem.empty()) throw UsageError("--problem belongs to an NPZ file: a CSV file names its problems itself");
  return answers_of_csv(of, file);
}

}  // namespace drape

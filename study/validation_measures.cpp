#include "study/validation_measures.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "study/known_answers.hpp"
#include "study/motions.hpp"
#include "study/runs_file.hpp"

namespace drape {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using Quantities = std::map<std::string, double>;

/// A motion with the numbers of its problem.
struct MotionOfCase {
  const ObservedMotion& motion;
  const std::map<std::string, double>& given;

  [[nodiscard]] double number(const std::string& name) const {
    const auto found = given.find(name);
    if (found == given.end()) throw UsageError(fmt::format("the case gives no number '{}'", name));
    return found->second;
  }
  [[nodiscard]] const Vertices& last() const { return motion.positions.back(); }
  [[nodiscard]] const Vertices& rest() const { return motion.cloth.rest; }

  /// Returns the mean position in `x` of the rest shape's extreme vertices along an axis.
  [[nodiscard]] Vector3d side(const Vertices& x, int axis, double sign) const {
    const VectorXd along = sign * rest().col(axis);
    const double end = along.maxCoeff();
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      if (along[i] < end - 1e-9) continue;
      sum += x.row(i).transpose();
      ++count;
    }
    return sum / count;
  }
  [[nodiscard]] Vector3d mean_of_pins(const Vertices& x) const {
    if (motion.cloth.pins.empty()) throw UsageError("the case's scene has no pins");
    Vector3d sum = Vector3d::Zero();
    for (const int pin : motion.cloth.pins) sum += x.row(pin).transpose();
    return sum / static_cast<double>(motion.cloth.pins.size());
  }
  [[nodiscard]] Vector3d mass_centre(const Vertices& x) const {
    return (motion.cloth.masses.transpose() * x).transpose() / motion.cloth.masses.sum();
  }
};

/// Returns the times of a quantity's sign changes, by linear interpolation.
std::vector<double> sign_changes(const std::vector<double>& times, const std::vector<double>& values) {
  std::vector<double> moments;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double before = values[i - 1], after = values[i];
    if (before == 0 || (before < 0) == (after < 0)) continue;
    moments.push_back(times[i - 1] + (times[i] - times[i - 1]) * before / (before - after));
  }
  return moments;
}

/// Returns the angular frequency of an oscillation about zero, from its first to its last sign change [1/s].
double angular_frequency(const std::vector<double>& times, const std::vector<double>& values) {
  const std::vector<double> moments = sign_changes(times, values);
  if (moments.size() < 3) throw UsageError("the motion is too short: expected a whole oscillation");
  return pi * static_cast<double>(moments.size() - 1) / (moments.back() - moments.front());
}

/// Returns the amplitude of a mode shape in every state: Σ m φ u, with the displacement u along an axis.
std::vector<double> part_of_shape(const MotionOfCase& m, int axis, const VectorXd& shape) {
  const VectorXd weights = m.motion.cloth.masses.cwiseProduct(shape);
  std::vector<double> parts;
  const VectorXd start = m.motion.positions.front().col(axis);
  for (const Vertices& x : m.motion.positions) parts.push_back(weights.dot(x.col(axis) - start));
  return parts;
}

Quantities measure_sag(const MotionOfCase& m) {
  return {{"sag", m.mean_of_pins(m.last()).z() - m.last().col(2).minCoeff()}};
}

/// Returns the tip position of a strip clamped at the lower end of its rest shape's x, relative to its free length.
Quantities measure_clamped_strip(const MotionOfCase& m) {
  double clamp = -HUGE_VAL;
  for (const int pin : m.motion.cloth.pins) clamp = std::max(clamp, m.rest()(pin, 0));
  const double length = m.rest().col(0).maxCoeff() - clamp;
  const Vector3d tip = m.side(m.last(), 0, 1), held = m.mean_of_pins(m.last());
  const double drop = (held.z() - tip.z()) / length, reach = (tip.x() - clamp) / length;
  const double sideways = std::abs(tip.y() - held.y()) / length;
  return {{"drop", drop},
          {"reach", reach},
          {"angle", std::atan2(drop, reach) * 180 / pi},
          {"sideways", sideways},
          {"buckled", sideways > 0.02 ? 1.0 : 0.0}};
}

/// Returns twice the time between the first two passages through the lowest point, relative to 2π √(L/g).
Quantities measure_pendulum(const MotionOfCase& m) {
  const Vector3d pivot = m.mean_of_pins(m.motion.positions.front());
  std::vector<double> sideways;
  for (const Vertices& x : m.motion.positions) sideways.push_back(m.side(x, 1, -1).y() - pivot.y());
  const std::vector<double> moments = sign_changes(m.motion.times, sideways);
  if (moments.size() < 2) throw UsageError("the motion is too short: expected two passages through the lowest point");
  const double length = m.rest().col(1).maxCoeff() - m.rest().col(1).minCoeff();
  return {{"period", 2 * (moments[1] - moments[0]) / (2 * pi * std::sqrt(length / m.number("g")))}};
}

/// Returns frequencies of a hanging chain relative to √(g/L). Mode n has the shape J0(jₙ √(z/L)), z from the free end.
Quantities measure_hanging_chain(const MotionOfCase& m) {
  const VectorXd along = m.rest().col(0);
  const double length = along.maxCoeff() - along.minCoeff();
  const VectorXd height = (along.maxCoeff() - along.array()) / length;
  Quantities found;
  for (int mode = 1; mode <= 4; ++mode) {
    VectorXd shape(height.size());
    for (Eigen::Index i = 0; i < shape.size(); ++i) {
      shape[i] = std::cyl_bessel_j(0, bessel_zero(mode) * std::sqrt(std::max(0.0, height[i])));
    }
    const double omega = angular_frequency(m.motion.times, part_of_shape(m, 0, shape));
    found[fmt::format("mode-{}", mode)] = omega / std::sqrt(m.number("g") / length);
  }
  return found;
}

/// Returns frequencies of a stretched square relative to π c/a, c² = tension/(mass per area), for m and n half waves.
Quantities measure_membrane(const MotionOfCase& m) {
  const double width = m.motion.positions.front().col(0).maxCoeff() - m.motion.positions.front().col(0).minCoeff();
  const double rest_width = m.rest().col(0).maxCoeff() - m.rest().col(0).minCoeff();
  const double stretch = width / rest_width;
  // Springs of equal stiffness in all directions store 3/2 E e² per area of the rest shape.
  const double tension = 1.5 * m.number("E") * (stretch - 1) / stretch;
  const double speed = std::sqrt(tension / (m.number("density") / (stretch * stretch)));
  Quantities found;
  for (const auto& [rows, columns] : {std::array{1, 1}, std::array{3, 1}, std::array{3, 3}}) {
    const Vertices& r = m.rest();
    const VectorXd shape =
        (rows * pi / rest_width * r.col(0).array()).cos() * (columns * pi / rest_width * r.col(1).array()).cos();
    const double omega = angular_frequency(m.motion.times, part_of_shape(m, 2, shape));
    found[fmt::format("mode-{}-{}", rows, columns)] = omega * width / (pi * speed);
  }
  return found;
}

/// Returns the first frequency of a clamped unit square relative to √(D/ρ), assuming the shape cos² πx cos² πy.
Quantities measure_plate(const MotionOfCase& m) {
  const Vertices& r = m.rest();
  VectorXd shape(r.rows());
  for (Eigen::Index i = 0; i < r.rows(); ++i) {
    const bool inside = std::max(std::abs(r(i, 0)), std::abs(r(i, 1))) < 0.5;
    shape[i] = inside ? std::pow(std::cos(pi * r(i, 0)) * std::cos(pi * r(i, 1)), 2) : 0;
  }
  const double omega = angular_frequency(m.motion.times, part_of_shape(m, 2, shape));
  return {{"frequency", omega / std::sqrt(m.number("D") / m.number("density"))}};
}

/// Returns the fall of the centre of mass relative to v²/g after given times, v the terminal velocity.
Quantities measure_fall(const MotionOfCase& m) {
  const double g = m.number("g");
  const double square = 2 * m.number("density") * g / (m.number("air density") * m.number("drag"));
  const double unit = std::sqrt(square) / g;
  const double start = m.mass_centre(m.motion.positions.front()).z();
  Quantities found;
  for (const double time : {0.5, 1.0, 2.0, 4.0}) {
    const auto& times = m.motion.times;
    const auto after = std::ranges::lower_bound(times, time * unit - 1e-12);
    if (after == times.end()) throw UsageError(fmt::format("the motion is too short: expected {:.3g} s", time * unit));
    const auto place = static_cast<std::size_t>(after - times.begin());
    const auto height = [&](std::size_t at) { return m.mass_centre(m.motion.positions[at]).z(); };
    double fallen = start - height(place);
    if (place > 0) {
      const double part = (times[place] - time * unit) / (times[place] - times[place - 1]);
      fallen += part * (height(place) - height(place - 1));
    }
    found[fmt::format("fallen-{:g}", time)] = fallen * g / square;
  }
  return found;
}

/// Returns the acceleration along x relative to g, from the distances in the first and second half of the motion.
Quantities measure_sliding(const MotionOfCase& m) {
  const std::size_t last = m.motion.times.size() - 1, middle = last / 2;
  if (middle == 0) throw UsageError("the motion is too short: expected three states");
  const auto place = [&](std::size_t at) { return m.mass_centre(m.motion.positions[at]).x(); };
  const double half = m.motion.times[middle] - m.motion.times.front();
  const double way = place(2 * middle) - 2 * place(middle) + place(0);
  return {{"acceleration", way / (half * half) / m.number("g")}};
}

/// Returns 1 if the centre of mass ends more than 2 % further from the z axis than it began, otherwise 0.
Quantities measure_turntable(const MotionOfCase& m) {
  const auto distance = [&](const Vertices& x) { return m.mass_centre(x).head<2>().norm(); };
  const double share = distance(m.last()) / distance(m.motion.positions.front());
  return {{"slipped", share > 1.02 ? 1.0 : 0.0}};
}

/// Returns 1 if the end that hangs lowest at first falls by more than 5 cm, otherwise 0.
Quantities measure_capstan(const MotionOfCase& m) {
  Eigen::Index lowest = 0;
  const double start = m.motion.positions.front().col(2).minCoeff(&lowest);
  return {{"slipped", start - m.last()(lowest, 2) > 0.05 ? 1.0 : 0.0}};
}

/// Measures a sheet that a spring of frequency ω pulls over a ground. With a given speed of the spring's end: the way
/// of the sheet after some cycles of slip, relative to the way of the end in a cycle. With no speed: the last distance
/// from the end, relative to the largest at which friction holds.
Quantities measure_stick_slip(const MotionOfCase& m) {
  const double omega = m.number("omega"), held = m.number("friction") * m.number("g") / (omega * omega);
  const auto place = [&](std::size_t at) { return m.mass_centre(m.motion.positions[at]).x(); };
  if (!m.given.contains("speed")) return {{"rest", place(m.motion.positions.size() - 1) / held}};
  const double speed = m.number("speed"), cycle = 2 * pi / omega, loose = held / speed;
  const auto& times = m.motion.times;
  Quantities found;
  for (const double cycles : {-0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0}) {
    const double time = loose + cycles * cycle;
    const auto after = static_cast<std::size_t>(std::ranges::lower_bound(times, time) - times.begin());
    if (after == 0 || after == times.size()) {
      throw UsageError(fmt::format("the motion is too short: expected a state before and after {:.3g} s", time));
    }
    const double part = (time - times[after - 1]) / (times[after] - times[after - 1]);
    const double way = place(after - 1) + part * (place(after) - place(after - 1)) - place(0);
    found[fmt::format("way-{:g}", cycles)] = way / (speed * cycle);
  }
  return found;
}

/// Returns the height of the first rebound relative to the fall, both above the resting height.
Quantities measure_rebound(const MotionOfCase& m) {
  const double floor = m.number("floor");
  std::vector<double> heights;
  for (const Vertices& x : m.motion.positions) heights.push_back(m.mass_centre(x).z() - floor);
  std::size_t low = 1;
  while (low + 1 < heights.size() && heights[low + 1] < heights[low]) ++low;
  double top = heights[low];
  for (std::size_t i = low; i + 1 < heights.size() && heights[i + 1] >= heights[i]; ++i) top = heights[i + 1];
  return {{"rebound", top / heights.front()}};
}

/// Returns ½ Σ m v² and the springs' energy, from positions and velocities alone.
double energy_of(const Cloth& cloth, const Vertices& x, const Vertices& v) {
  double energy = 0.5 * cloth.masses.dot(v.rowwise().squaredNorm());
  for (const Spring& spring : cloth.springs) {
    const double longer = (x.row(spring.i) - x.row(spring.j)).norm() - spring.rest_length;
    energy += spring.stiffness / 2 * longer * longer;
  }
  return energy;
}

/// Measures a flight without forces, by three ratios: distance over velocity times duration; final over initial energy.
/// The third is 1 plus the change of angular momentum over that of the whole mass at the given speed.
Quantities measure_free_flight(const MotionOfCase& m) {
  if (m.motion.velocities.empty()) throw UsageError("expected velocities beside the positions");
  const Cloth& cloth = m.motion.cloth;
  const double seconds = m.motion.times.back() - m.motion.times.front();
  const Vector3d way = m.mass_centre(m.last()) - m.mass_centre(m.motion.positions.front());
  const Vector3d velocity = m.mass_centre(m.motion.velocities.front());
  const auto turning = [&](const Vertices& x, const Vertices& v) {
    Vector3d sum = Vector3d::Zero();
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      const Vector3d arm = x.row(i).transpose() - m.mass_centre(x);
      sum += cloth.masses[i] * arm.cross(Vector3d(v.row(i).transpose()));
    }
    return sum;
  };
  const Vector3d turned =
      turning(m.last(), m.motion.velocities.back()) - turning(m.motion.positions.front(), m.motion.velocities.front());
  const double before = energy_of(cloth, m.motion.positions.front(), m.motion.velocities.front());
  return {{"way", way.norm() / (velocity.norm() * seconds)},
          {"angular-momentum", 1 + turned.norm() / (cloth.masses.sum() * velocity.norm())},
          {"energy", energy_of(cloth, m.last(), m.motion.velocities.back()) / before}};
}

/// Returns twice the springs' energy per area of the rest shape, relative to E e².
Quantities measure_strain_energy(const MotionOfCase& m) {
  const Cloth& cloth = m.motion.cloth;
  const double energy = energy_of(cloth, m.last(), Vertices::Zero(m.last().rows(), 3));
  double area = 0;
  for (const auto& [a, b, c] : cloth.triangles) {
    const Vector3d p = (m.rest().row(b) - m.rest().row(a)).transpose(),
                   q = (m.rest().row(c) - m.rest().row(a)).transpose();
    area += p.cross(q).norm() / 2;
  }
  return {{"modulus", 2 * energy / (area * m.number("E") * std::pow(m.number("strain"), 2))}};
}

/// Returns the energy of the first state relative to ½ D A/R².
Quantities measure_rolled_sheet(const MotionOfCase& m) {
  if (m.motion.elastic.empty()) throw UsageError("expected the elastic energy of every state: give the answer as CSV");
  return {{"energy",
           m.motion.elastic.front() / (0.5 * m.number("D") * m.number("area") / std::pow(m.number("radius"), 2))}};
}

/// Returns the area that the triangles cover in a plan, on points half a millimetre apart [m²].
double shadow_area(const Vertices& x, const std::vector<Triangle>& triangles) {
  constexpr double cell = 5e-4;
  const Eigen::RowVector2d low = x.leftCols<2>().colwise().minCoeff();
  const Eigen::Array2i count =
      ((x.leftCols<2>().colwise().maxCoeff() - low) / cell).transpose().cast<int>().array() + 2;
  const auto rows = static_cast<std::size_t>(count.y());
  std::vector<char> covered(static_cast<std::size_t>(count.x()) * rows);
  for (const Triangle& triangle : triangles) {
    std::array<Eigen::Vector2d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = (x.row(triangle[k]).leftCols<2>() - low).transpose() / cell;
    }
    const Eigen::Vector2d from = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
    const Eigen::Vector2d to = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    for (int i = static_cast<int>(std::ceil(from.x())); i <= to.x(); ++i) {
      for (int j = static_cast<int>(std::ceil(from.y())); j <= to.y(); ++j) {
        const Eigen::Vector2d point(i, j);
        double least = 0, most = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const Eigen::Vector2d side = corner[(k + 1) % 3] - corner[k], way = point - corner[k];
          const double turn = side.x() * way.y() - side.y() * way.x();
          least = std::min(least, turn);
          most = std::max(most, turn);
        }
        if (least == 0 || most == 0) covered[static_cast<std::size_t>(i) * rows + static_cast<std::size_t>(j)] = 1;
      }
    }
  }
  return static_cast<double>(std::ranges::count(covered, 1)) * cell * cell;
}

/// Returns the drape coefficient of the last state: the share of the free ring that still casts a shadow.
Quantities measure_drape(const MotionOfCase& m) {
  const double held = pi * std::pow(m.number("held"), 2), whole = pi * std::pow(m.number("radius"), 2);
  return {{"coefficient", (shadow_area(m.last(), m.motion.cloth.triangles) - held) / (whole - held)}};
}

/// Measures two discs that are one at their rims, blown up: the radius of the rim relative to that of the flat discs,
/// and the distance of their middles relative to the rim's diameter.
Quantities measure_balloon(const MotionOfCase& m) {
  const VectorXd along = m.rest().leftCols<2>().rowwise().norm();
  const double flat = along.maxCoeff();
  Vector3d middle = Vector3d::Zero();
  std::vector<Eigen::Index> rim, poles;
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    if (along[i] > flat * (1 - 1e-9)) rim.push_back(i);
    if (along[i] < flat * 1e-9) poles.push_back(i);
  }
  if (poles.size() != 2) throw UsageError("expected two discs with a vertex in the middle of each");
  for (const Eigen::Index i : rim) middle += m.last().row(i).transpose() / static_cast<double>(rim.size());
  double radius = 0;
  for (const Eigen::Index i : rim) {
    radius += (m.last().row(i).transpose() - middle).norm() / static_cast<double>(rim.size());
  }
  const double height = (m.last().row(poles[0]) - m.last().row(poles[1])).norm();
  return {{"radius", radius / flat}, {"height", height / (2 * radius)}};
}

struct MeasureType {
  std::string name;
  std::function<Quantities(const MotionOfCase&)> measure;
};

const std::vector<MeasureType>& all_measures() {
  static const std::vector<MeasureType> measures{
      {"sag", measure_sag},
      {"clamped-strip", measure_clamped_strip},
      {"pendulum", measure_pendulum},
      {"hanging-chain", measure_hanging_chain},
      {"membrane", measure_membrane},
      {"plate", measure_plate},
      {"fall", measure_fall},
      {"sliding", measure_sliding},
      {"rebound", measure_rebound},
      {"capstan", measure_capstan},
      {"turntable", measure_turntable},
      {"stick-slip", measure_stick_slip},
      {"free-flight", measure_free_flight},
      {"strain-energy", measure_strain_energy},
      {"rolled-sheet", measure_rolled_sheet},
      {"drape", measure_drape},
      {"balloon", measure_balloon},
  };
  return measures;
}

}  // namespace

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const MeasureType& one : all_measures()) names.push_back(one.name);
  return names;
}

std::map<std::string, double> measure_motion(const std::string& measure, const ObservedMotion& motion,
                                             const std::map<std::string, double>& given) {
  const auto found = std::ranges::find(all_measures(), measure, &MeasureType::name);
  if (found == all_measures().end()) {
    throw UsageError(
        fmt::format("unknown measure '{}'{}", measure, did_you_mean(measure, measure_names(), "the measures are")));
  }
  if (motion.positions.empty() || motion.times.size() != motion.positions.size()) {
    throw UsageError("expected a time for every state of the motion");
  }
  return found->measure({motion, given});
}

namespace {

constexpr int validation_format = 1;
constexpr std::size_t most_validation_bytes = std::size_t{1} << 28;

// The fields of a run, described once for both directions: Fields is a RunsWriter (with const data) or a RunsRecord.
template <class Fields, class Run>
void describe_run(Fields& f, Run& run) {
  f("place", run.place);
  f("set", run.study_case.overrides);
  f("steps", run.study_case.steps);
  f("failure", run.failure);
  f("seconds", run.seconds);
  f("step", run.step);
  f("cell", run.cell);
  f("vertices", run.vertices);
  f("capped", run.capped);
  f("rest_speed", run.rest_speed);
  f("quantity", run.names);
  f("value", run.values);
}

RunsKey key_of(const ValidationRun& run) { return {run.name, run.factor, run.problem, {}, run.setting}; }

/// Reader of the study in a file: its cases and runs.
class ValidationReader {
 public:
  explicit ValidationReader(const std::filesystem::path& file)
      : records_(parse_runs(read_text(file, most_validation_bytes), shown(file))) {
    if (records_.empty()) throw UsageError(fmt::format("{}: there is nothing in it", shown(file)));
    RunsRecord& heading = records_.front();
    int format = 0;
    heading("format", format);
    if (heading.key.kind != "study" || format != validation_format) {
      heading.fail(heading.line(), "expected the runs of a study of validation");
    }
    heading("command", study_.command);
    std::optional<std::string> typed;
    heading("typed_command", typed);
    study_.typed_command = typed.value_or("");
    heading("seconds", study_.seconds);
    std::optional<std::string> shard;
    heading("shard", shard);
    if (shard) study_.shard = parse_shard(*shard);
    std::optional<std::size_t> planned;
    heading("planned", planned);
    study_.planned = planned.value_or(0);
    std::vector<std::string> names, values, cases;
    heading("measured_on", names);
    heading("measured_on_value", values);
    heading("case", cases);
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
      study_.provenance.emplace_back(names[i], values[i]);
    }
    study_.cases = validation_cases(cases);
    heading.done();
    for (std::size_t i = 1; i < records_.size(); ++i) read_run(records_[i]);
  }

  ValidationStudy finish() { return std::move(study_); }

 private:
  void read_run(RunsRecord& record) {
    ValidationRun run;
    run.name = record.key.scene;
    run.factor = record.key.kind;
    run.problem = record.key.method;
    run.setting = record.key.setting;
    describe_run(record, run);
    record.done();
    const auto of = std::ranges::find(study_.cases, run.name, &ValidationCase::name);
    if (of == study_.cases.end()) record.fail(record.line(), fmt::format("there is no case '{}'", run.name));
    static_cast<void>(of->problem(run.problem));
    if (run.names.size() != run.values.size()) record.fail(record.line(), "expected a value for every quantity");
    run.study_case.scene = of->scene;
    run.study_case.label = run.setting;
    run.measured = true;
    study_.runs.push_back(std::move(run));
  }

  std::vector<RunsRecord> records_;
  ValidationStudy study_;
};

}  // namespace

std::string validation_runs(const ValidationStudy& study) {
  RunsWriter f;
  f.begin({{}, "study", {}, {}, {}});
  f("format", validation_format);
  f("command", study.command);
  if (!study.typed_command.empty()) f("typed_command", study.typed_command);
  f("seconds", study.seconds);
  if (!study.shard.whole()) f("shard", study.shard.text());
  f("planned", study.planned);
  std::vector<std::string> names, values, cases;
  for (const auto& [name, value] : study.provenance) {
    names.push_back(name);
    values.push_back(value);
  }
  for (const ValidationCase& one : study.cases) cases.push_back(one.name);
  f("measured_on", names);
  f("measured_on_value", values);
  f("case", cases);
  for (const ValidationRun& run : study.runs) {
    if (!run.measured) continue;
    f.begin(key_of(run));
    describe_run(f, run);
  }
  return f.finish();
}

std::string validation_motions(const ValidationStudy& study) {
  std::vector<ShownMotion> motions;
  for (const ValidationRun& run : study.runs) {
    if (run.played.frames > 0)
      motions.push_back({run.name, {run.problem, run.study_case.film_command("motion.html"), run.played}});
  }
  return motions_csv(motions);
}

ValidationStudy validation_study(const std::filesystem::path& file) {
  ValidationStudy study = ValidationReader(file).finish();
  for (ShownMotion& shown : read_motions(file.parent_path() / motions_name)) {
    const auto of = std::ranges::find_if(study.runs, [&](const ValidationRun& run) {
      return run.factor == scene_factor && run.name == shown.part && run.problem == shown.motion.label;
    });
    if (of != study.runs.end()) of->played = std::move(shown.motion.played);
  }
  return study;
}

namespace {

/// Returns the program that measured a study: version, revision and compiler.
std::string program_of(const ValidationStudy& study) {
  std::string program;
  for (const auto& [name, value] : study.provenance) {
    if (name == "drape" || name == "Compiler") program += (program.empty() ? "drape " : ", ") + value;
  }
  return program;
}

/// @throws UsageError if the part in a file was measured by another program than the study
void require_program(const std::filesystem::path& file, const ValidationStudy& part, const ValidationStudy& study) {
  if (program_of(part) == program_of(study)) return;
  throw UsageError(fmt::format("{} was made by {}, but the study by {}: one study is made by one program", shown(file),
                               shown(program_of(part)), shown(program_of(study))));
}

}  // namespace

MergedValidation merge_validation(const std::vector<std::filesystem::path>& files) {
  MergedValidation merged;
  FoundShards found("study");
  for (const std::filesystem::path& file : files) {
    ValidationStudy part = validation_study(file);
    std::vector<ValidationRun> runs = std::exchange(part.runs, {});
    const double seconds = std::exchange(part.seconds, 0);
    const std::size_t planned = std::exchange(part.planned, 0);
    const Shard shard = part.shard;
    if (found.empty())
      merged.study = std::move(part);
    else if (part.command != merged.study.command)
      found.fail_as_other(file);
    else
      require_program(file, part, merged.study);
    if (!found.add(shard, file)) continue;
    merged.study.seconds += seconds;
    merged.study.planned += planned;
    std::ranges::move(runs, std::back_inserter(merged.study.runs));
  }
  std::ranges::stable_sort(merged.study.runs, {}, &ValidationRun::place);
  for (ValidationRun& run : merged.study.runs) run.place.reset();
  merged.study.shard = {};
  merged.study.typed_command.clear();  // each shard has its own
  merged.missing = found.missing();
  return merged;
}

void read_validation_runs(const std::filesystem::path& file, ValidationStudy& study) {
  const ValidationStudy begun = validation_study(file);
  if (begun.command != study.command) {
    throw UsageError(fmt::format("{} is of another command: {}", shown(file), begun.command));
  }
  require_program(file, begun, study);
  study.seconds += begun.seconds;
  if (!begun.typed_command.empty()) study.typed_command = begun.typed_command;
  for (const ValidationRun& run : begun.runs) {
    const auto same = std::ranges::find_if(study.runs, [&](const ValidationRun& planned) {
      return key_of(planned) == key_of(run) && planned.study_case.overrides == run.study_case.overrides;
    });
    if (same != study.runs.end()) *same = run;
  }
}

}  // namespace drape

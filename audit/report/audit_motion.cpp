#include "audit/report/audit_motion.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "audit/motion_audit.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/renderer.hpp"
#include "drape/render/view.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "output/html_writer.hpp"
#include "output/png_encoder.hpp"
#include "reports/components.hpp"
#include "reports/page.hpp"
#include "run/run_scene.hpp"
#include "sim/start_overlap.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

using audit::Check;
using audit::CheckFindings;

constexpr std::array all_checks{Check::crossings, Check::ways, Check::inside, Check::stretch, Check::stuck};

std::string limit_of(Check check, const audit::AuditLimits& limits) {
  switch (check) {
    case Check::inside:
      return readable_length(limits.depth);
    case Check::stretch:
      return std::isinf(limits.stretch) ? "none" : fmt::format("{:.4g}", limits.stretch);
    case Check::crossings:
    case Check::ways:
    case Check::stuck:
      break;
  }
  return "–";
}

/// Returns the worst value of a check in a state: "2 pairs", "1.2", "3 mm".
std::string most_of(Check check, const CheckFindings& found) {
  const std::size_t count = found.states > 0 ? found.worst.count : 0;
  switch (check) {
    case Check::inside:
      return readable_length(found.largest);
    case Check::stretch:
      return fmt::format("{:.4g}", found.largest);
    case Check::crossings:
    case Check::ways:
      return fmt::format("{} pair{}", count, count == 1 ? "" : "s");
    case Check::stuck:
      break;
  }
  return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

}  // namespace

std::string check_name(Check check) {
  switch (check) {
    case Check::crossings:
      return "triangles that cross";
    case Check::ways:
      return "crossings between states";
    case Check::inside:
      return "depth in solids";
    case Check::stretch:
      return "stretch of edges";
    case Check::stuck:
      return "vertices stuck in mid-air";
  }
  return {};
}

namespace {

/// Describes the worst state of a check: "at 0.4 s (step 40): 2 pairs; cloth edge 1 2 goes through …".
std::string describe_worst(Check check, const CheckFindings& found) {
  return fmt::format("at {:.4g} s (step {}): {}; {}", found.worst.time, found.worst.step,
                     check == Check::stretch  ? fmt::format("{} edges", found.worst.count)
                     : check == Check::inside ? fmt::format("{} vertices", found.worst.count)
                                              : most_of(check, found),
                     found.worst.text);
}

/// Returns the checks that found something.
std::vector<Check> found_checks(const AuditReport& report) {
  std::vector<Check> found;
  std::ranges::copy_if(all_checks, std::back_inserter(found),
                       [&](Check check) { return report.findings.findings(check).states > 0; });
  return found;
}

std::string describe_rise(const EnergyAudit& energy) {
  return fmt::format("{:.3g} J from {:.4g} s to {:.4g} s, without a source", energy.rise, energy.from, energy.to);
}

/// Returns the table of the checks, with notes on what they cannot judge.
ResultTable table_of_checks(const AuditReport& report) {
  ResultTable table{
      .name = "audit",
      .title = fmt::format("Audit of {}: {} states, {:.4g} s", report.file, report.findings.states(), report.duration),
      .columns = {"check", "limit", "states found in", "first", "most"},
      .rows = {},
      .notes = {}};
  for (const Check check : all_checks) {
    const CheckFindings& found = report.findings.findings(check);
    table.rows.push_back({check_name(check), limit_of(check, report.limits), fmt::format("{}", found.states),
                          found.states > 0 ? fmt::format("{:.4g} s", found.first_time) : "–", most_of(check, found)});
  }
  const EnergyAudit& energy = report.energy;
  const bool judged = energy.not_judged.empty();
  table.rows.push_back({"rise of energy", judged ? fmt::format("{:g} %", 100 * EnergyAudit::most) : "–",
                        judged ? (energy.found() ? "found" : "0") : "not judged",
                        energy.found() ? fmt::format("{:.4g} s", energy.from) : "–",
                        judged ? fmt::format("{:.2g} %", 100 * energy.of_available) : "–"});
  if (!judged) table.notes.push_back(fmt::format("rise of energy: not judged, because {}", energy.not_judged));
  const std::size_t touches = report.findings.findings(Check::ways).touches;
  if (touches > 0) {
    table.notes.push_back(
        fmt::format("crossings between states: {} pairs only touch, which counts as no crossing", touches));
  }
  if (report.gaps) {
    table.notes.emplace_back(
        "crossings between states: the states are more than a step or substep apart, so the straight ways between them "
        "are not "
        "those of the steps");
  }
  return table;
}

}  // namespace

ResultTable audit_table(const AuditReport& report) {
  ResultTable table = table_of_checks(report);
  std::vector<std::string> worst;
  for (const Check check : found_checks(report)) {
    worst.push_back(fmt::format("{}, {}", check_name(check), describe_worst(check, report.findings.findings(check))));
  }
  if (report.energy.found()) worst.push_back("rise of energy: " + describe_rise(report.energy));
  table.notes.insert(table.notes.begin(), worst.begin(), worst.end());
  return table;
}

std::string audit_summary(const AuditReport& report) {
  if (report.clean()) return fmt::format("{}: nothing found in {} states", report.file, report.findings.states());
  std::string text;
  for (const Check check : found_checks(report)) {
    text += (text.empty() ? "" : ", ") + check_name(check);
  }
  if (report.energy.found()) text += std::string(text.empty() ? "" : ", ") + "rise of energy";
  return fmt::format("{}: found {}", report.file, text);
}

namespace {

using audit::Check;
using audit::WorstState;
using html::Markup;

constexpr Rgb marked_color{0.86, 0.08, 0.08}, plain_color{0.86, 0.83, 0.74};

View whole_view(const Scene& scene, const WorstState& state, double aspect) {
  if (!needs_motion(scene.camera)) return fixed_view(scene.camera, scene.simulation.cloth.positions);
  Framing framing(scene.camera, aspect);
  framing.add(state.x);
  for (const Collider& collider : state.colliders) framing.add(collider);
  return framing.view();
}

/// Returns the triangles with a corner among some vertices.
std::vector<Triangle> triangles_at(const std::vector<Triangle>& triangles, const std::vector<int>& vertices) {
  std::vector<Triangle> found;
  const auto marked = [&](int v) { return std::ranges::binary_search(vertices, v); };
  std::ranges::copy_if(triangles, std::back_inserter(found),
                       [&](const Triangle& t) { return std::ranges::any_of(t, marked); });
  return found;
}

/// Returns a close view of a finding, from the front side of the cloth's triangles there.
/// @param vertices at least one, of the cloth
View close_view(const Scene& scene, const WorstState& state, const View& whole, double aspect) {
  constexpr double part = 0.12;  // relative to the cloth's size: more distant vertices are another place
  const double size = (state.x.colwise().maxCoeff() - state.x.colwise().minCoeff()).norm();
  std::vector<int> place;
  std::ranges::copy_if(state.vertices, std::back_inserter(place), [&](int v) {
    return (state.x.row(v) - state.x.row(state.vertices.front())).norm() <= part * size;
  });
  const std::vector<Triangle> around = triangles_at(scene.simulation.cloth.triangles, place);
  Vertices near(static_cast<Eigen::Index>(3 * around.size()), 3);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t t = 0; t < around.size(); ++t) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      near.row(static_cast<Eigen::Index>(3 * t + c)) = state.x.row(around[t][c]);
      corners[c] = state.x.row(around[t][c]).transpose();
    }
    normal += (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  }
  if (near.rows() == 0) return whole;
  const Eigen::Vector3d seen = (whole.position - whole.target).normalized();
  if (normal.norm() < 1e-12) normal = seen;
  if (normal.dot(seen) < 0) normal = -normal;
  const Eigen::Vector3d towards = (normal.normalized() + seen).normalized();
  constexpr double degrees = 180 / std::numbers::pi;
  Camera camera;
  camera.azimuth = degrees * std::atan2(towards.y(), towards.x());
  camera.elevation = degrees * std::asin(std::clamp(towards.z(), -1.0, 1.0));
  camera.margin = 0.2;
  Framing framing(camera, aspect);
  framing.add(near);
  return framing.view();
}

/// Returns a state as an interactive view.
html::PlayedMotion turned(const Scene& scene, const Frame& frame, const View& first) {
  Look look = scene.look;
  look.mesh_lines = true;
  FilmInfo film;
  film.scene = scene.name;
  film.cloth = &scene.simulation.cloth;
  film.look = &look;
  MotionPacker packer(film);
  try {
    packer.add(frame);
  } catch (const OutputError&) {
    return {};
  }
  return packer.finish(first, scene.camera.up);
}

Markup pictures(const AuditReport& report, const std::vector<DrawnFinding>& drawn) {
  Markup content;
  for (const DrawnFinding& finding : drawn) {
    const std::string name = check_name(finding.check);
    const std::string text = describe_worst(finding.check, report.findings.findings(finding.check));
    const std::string id = fmt::format("check-{}", static_cast<int>(finding.check));
    Markup found = html::figure(html::row({html::picture("image/png", finding.whole, "The whole motion " + text),
                                           html::picture("image/png", finding.close, "The place " + text)}),
                                text);
    if (finding.turned.frames > 0) {
      found +=
          html::details("Turn this state", html::motion_player(id + "-turned", finding.turned, "The state " + text));
    }
    content += html::section(3, id, name, found);
  }
  return html::section(2, "worst", "The worst states", content);
}

}  // namespace

std::vector<DrawnFinding> draw_findings(const Scene& scene, const AuditReport& report, GlBackend backend) {
  std::vector<DrawnFinding> drawn;
  const Cloth& cloth = scene.simulation.cloth;
  const Eigen::Vector2i size = scene.video.size;
  const double aspect = static_cast<double>(size.x()) / size.y();
  Look look = scene.look;
  look.texture.clear();
  look.mesh_lines = true;
  for (const Check check : found_checks(report)) {
    const WorstState& state = report.findings.findings(check).worst;
    std::vector<Rgb> colors(static_cast<std::size_t>(cloth.vertex_count()), plain_color);
    for (const int v : state.vertices) colors[static_cast<std::size_t>(v)] = marked_color;
    const View whole = whole_view(scene, state, aspect);
    Renderer renderer(data_folder(), size, whole, look, cloth.vertex_count(), cloth.triangles, scene.uvs, backend);
    const Frame frame{.time = state.time, .positions = state.x, .colliders = state.colliders};
    DrawnFinding pictures{.check = check,
                          .whole = encode_png(renderer.draw(frame, colors)),
                          .close = {},
                          .turned = turned(scene, frame, whole)};
    renderer.look_from(close_view(scene, state, whole, aspect));
    pictures.close = encode_png(renderer.draw(frame, colors));
    drawn.push_back(std::move(pictures));
  }
  return drawn;
}

std::string audit_page(const AuditReport& report, const std::vector<DrawnFinding>& drawn, const std::string& command) {
  std::vector<html::Finding> findings;
  if (report.clean()) findings.push_back({html::Tone::good, "Nothing was found"});
  for (const Check check : found_checks(report)) {
    const audit::CheckFindings& found = report.findings.findings(check);
    findings.push_back({html::Tone::bad, fmt::format("{} in {} of {} states", check_name(check), found.states,
                                                     report.findings.states())});
  }
  if (report.energy.found())
    findings.push_back({html::Tone::bad, "The energy rises by " + describe_rise(report.energy)});
  if (!report.divergence.empty()) findings.push_back({html::Tone::bad, report.divergence});
  html::Page page;
  page.title = "drape audit: " + report.file;
  page.kind = "drape audit";
  page.heading = audit_summary(report);
  page.introduction = html::findings(findings) + html::command("Run this audit again", command);
  page.content = html::section(2, "checks", "Checks", to_html(table_of_checks(report)));
  if (!drawn.empty()) page.content += pictures(report, drawn);
  for (const auto& [name, value] : html::provenance()) page.foot.emplace_back(name, value);
  return html::render(page);
}

namespace {

/// Energies of the steps, for their largest rise.
class EnergyBook {
 public:
  explicit EnergyBook(double step) : step_(step) {}

  void add(const Energies& now) {
    if (totals_.empty()) first_ = now.total();
    totals_.push_back(now.total());
    available_ = std::max(available_, first_ - now.gravity);
  }

  [[nodiscard]] EnergyAudit judge() const {
    const audit::EnergyRise rise = audit::largest_rise(totals_);
    return {.not_judged = {},
            .rise = rise.rise,
            .of_available = available_ > 0 ? rise.rise / available_ : 0,
            .from = rise.from * step_,
            .to = rise.to * step_};
  }

 private:
  double step_;  // h [s]
  std::vector<double> totals_;
  double first_ = 0, available_ = 0;
};

/// Returns the reason why the energy of a scene may rise; empty if it can only decrease.
std::string cause_of_rises(const Scene& scene, const System& system) {
  if (is_explicit(scene.simulation.integrator.method)) return "the energy of an explicit method oscillates";
  if (!system.only_loses_energy()) return "something that moves, blows or attracts may do work on the cloth";
  if (begins_too_near(scene.simulation)) {
    return "the cloth begins nearer than its contact distance, and separation does work on it";
  }
  return {};
}

audit::AuditedCloth audited_cloth(const Scene& scene, const System& system, const AuditOptions& options,
                                  bool imported) {
  const Cloth& cloth = scene.simulation.cloth;
  const Eigen::Vector3d gravity = imported ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ()) : system.gravity;
  const bool known = !imported || options.held.has_value();  // pins of imported motions are unknown
  return {.rest = cloth.rest,
          .triangles = cloth.triangles,
          .held = {.known = known, .vertices = options.held.value_or(cloth.pins)},
          .down = gravity.isZero(0) ? gravity : Eigen::Vector3d(gravity.normalized()),
          .sewn = audit::sewn_vertices(cloth.seams)};
}

constexpr double usual_stretch = 1.1;  // limit for the edges of an imported motion

audit::AuditLimits limits_of(const Scene& scene, const AuditOptions& options, bool imported) {
  audit::AuditLimits limits{.depth = options.depth};
  if (imported) limits.stretch = usual_stretch;
  std::size_t limited = 0;  // cloths
  double largest = 0;
  for (const Effect& effect : scene.simulation.effects) {
    const auto* limit = effect.as<StrainLimit>();
    if (limit == nullptr) continue;
    limited += limit->cloth.empty() ? std::max<std::size_t>(1, scene.simulation.cloth.pieces.size()) : 1;
    largest = std::max(largest, limit->max_stretch * (1 + limit->tolerance));
  }
  if (limited > 0 && limited >= scene.simulation.cloth.pieces.size()) limits.stretch = largest;
  limits.stretch = options.stretch.value_or(limits.stretch);
  return limits;
}

class SimulatedAudit final : public StepObserver {
 public:
  SimulatedAudit(AuditReport& report, EnergyBook& energies, Progress& progress)
      : report_(report), energies_(energies), progress_(progress) {}

  void begin(const Simulation& simulation) override { add(simulation); }
  void after_step(const Simulation& simulation, const StepReport& step, double) override {
    add(simulation);
    report_.gaps = report_.gaps || step.substeps > 1;
    ++progress_.done;
  }

 private:
  void add(const Simulation& simulation) {
    const State& state = simulation.state();
    const std::vector<Collider> colliders = simulation.colliders(simulation.time());
    report_.findings.add({state.step, simulation.time(), state.x, colliders});
    energies_.add(simulation.energies());
  }

  AuditReport& report_;
  EnergyBook& energies_;
  Progress& progress_;
};

void audit_simulation(const Scene& scene, std::int64_t steps, EnergyBook& energies, AuditReport& report,
                      const std::stop_token& stop, Progress& progress) {
  progress.begin("auditing", "steps", steps);
  SimulatedAudit observer(report, energies, progress);
  const std::array<StepObserver*, 1> observers{&observer};
  try {
    Simulation simulation(scene.simulation, Timing::none, make_stop(stop));
    run_steps(simulation, steps, observers, stop);
    report.duration = simulation.time();
  } catch (const DivergedError& diverged) {
    report.divergence = diverged.what();
  } catch (const Interrupted&) {
  }
}

void audit_recording(MotionReader& motion, const System& system, std::int64_t steps, EnergyBook& energies,
                     AuditReport& report, const std::stop_token& stop, Progress& progress) {
  progress.begin("auditing", "states", static_cast<std::int64_t>(motion.states()));
  std::int64_t before = 0;
  for (std::size_t i = 0; i < motion.states() && !stop.stop_requested(); ++i) {
    const State& state = motion.state(i);
    if (state.step > steps) break;
    report.gaps = report.gaps || state.step > before + 1 || motion.row(state.step).substeps > 1;
    before = state.step;
    const double time = static_cast<double>(state.step) * system.whole_step;
    const std::vector<Collider> colliders = system.colliders_at(time);
    report.findings.add({state.step, time, state.x, colliders});
    report.duration = time;
    ++progress.done;
  }
  for (std::int64_t step = 0; step <= before; ++step) energies.add(motion.row(step).energies);
}

}  // namespace

AuditReport audit_motion(const LoadedScene& scene, const std::shared_ptr<MotionReader>& recorded,
                         const AuditOptions& options, const std::stop_token& stop, Progress& progress) {
  const System system = make_system(scene.simulation);
  const std::string file = shown(scene.source.file);
  try {
    const bool imported = recorded && recorded->header().imported;
    AuditReport report{
        .file = file,
        .limits = limits_of(scene, options, imported),
        .findings = {audited_cloth(scene, system, options, imported), limits_of(scene, options, imported)},
        .energy = {}};
    EnergyBook energies(scene.simulation.step);
    if (recorded) {
      const std::int64_t steps = options.steps.value_or(recorded->last_step());
      audit_recording(*recorded, system, steps, energies, report, stop, progress);
    } else {
      audit_simulation(scene, options.steps.value_or(scene.step_count()), energies, report, stop, progress);
    }
    report.energy = energies.judge();
    report.energy.not_judged =
        imported ? "masses and springs of an imported motion are not known" : cause_of_rises(scene, system);
    report.interrupted = stop.stop_requested();
    return report;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{}: cannot be audited: {}", file, error.what()));
  }
}

}  // namespace drape

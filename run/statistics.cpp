#include "run/statistics.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "drape/scene/scene.hpp"
#include "sim/start_overlap.hpp"

namespace drape {

void EnergyRise::begin(const Simulation& simulation) {
  watches_ = simulation.only_loses_energy();
  from_start_ = simulation.has_push();
  every_ = is_explicit(simulation.settings().integrator.method) ? check_interval : 1;
  if (watches_ && simulation.state().step == 0) note(simulation.energies());
}

void EnergyRise::after_step(const Simulation& simulation, const StepReport&, double) {
  if (!watches_ || simulation.state().step % every_ != 0) return;
  note(simulation.energies());
  if (asked_ || !rise()->notable()) return;
  asked_ = true;  // a search for contacts, which may take as long as a step
  watches_ = !begins_too_near(simulation.settings());
}

void EnergyRise::replay(const StepRow& row, double, double) {
  if (row.step == 0) first_ = row.energies;
  if (row.step % every_ == 0) note(row.energies);
}

void EnergyRise::note(const Energies& now) {
  if (!first_) first_ = now;
  available_ = std::max(available_, first_->total() - now.gravity);
  least_ = from_start_ ? first_->total() : std::min(least_, now.total());
  rise_ = std::max(rise_, now.total() - least_);
}

std::optional<EnergyRise::Rise> EnergyRise::rise() const {
  if (!watches_) return std::nullopt;
  return Rise{.energy = rise_, .of_available = available_ > 0 ? rise_ / available_ : 0};
}

namespace {

constexpr std::int64_t check_interval = 128;  // steps between two estimates
constexpr double coarse_share = 0.01;         // share of the cloth's size
constexpr double still = 1e-3;                // speed below which a cloth is at rest [cloth sizes/s]
constexpr double moment = 0.01;               // or the speed that residual forces cause within this time [s]

}  // namespace

void ErrorMonitor::begin(const Simulation& simulation) {
  accuracy_ = simulation.accuracy();
  asked_ = simulation.settings().accuracy;
  size_ = size_of(simulation.cloth());
}

void ErrorMonitor::after_step(const Simulation& simulation, const StepReport& report, double /*seconds*/) {
  if (report.estimate) return note(simulation.state().step, *report.estimate);
  if (!accuracy_) return;
  const bool known = accuracy_->rule == StoppingRule::error && report.converged;
  if (known || simulation.state().step % check_interval == 0) look(simulation);
}

void ErrorMonitor::replay(const StepRow& row, double /*time*/, double /*seconds*/) {
  if (row.error) note(row.step, *row.error);
}

void ErrorMonitor::look(const Simulation& simulation) { note(simulation.state().step, simulation.error()); }

void ErrorMonitor::note(std::int64_t step, double error) {
  sum_ += error;
  largest_ = std::max(largest_, error);
  last_ = step;
  last_error_ = error;
  ++looked_at_;
}

void ErrorMonitor::finish(const Simulation& simulation) {
  const State& state = simulation.state();
  if (!accuracy_ || state.step == 0) return;
  if (last_ != state.step) look(simulation);
  const double force = simulation.residual_force();
  const double standing = std::max(still * size_, moment * force / simulation.cloth().masses.sum());
  if (!(state.v.rowwise().norm().maxCoeff() <= standing)) return;
  const double weight = simulation.weight();
  residual_force_ = {.force = force, .of_weight = weight > 0 ? std::optional(force / weight) : std::nullopt};
}

std::optional<ErrorMonitor::Errors> ErrorMonitor::errors() const {
  if (looked_at_ == 0) return std::nullopt;
  return Errors{.mean = sum_ / static_cast<double>(looked_at_), .largest = largest_};
}

bool ErrorMonitor::coarse() const {
  const auto found = errors();
  return found && found->mean > coarse_share * size_;
}

void Statistics::begin(const Simulation& simulation) {
  exactness_.begin(simulation);
  energy_rise_.begin(simulation);
  method_ = method_name(simulation.settings().integrator.method);
  const IntegratorSettings& integrator = simulation.settings().integrator;
  scheme_ = is_explicit(integrator.method) ? method_ : scheme_name(integrator.scheme);
  vertices_ = simulation.cloth().vertex_count();
  springs_ = static_cast<std::int64_t>(simulation.springs().size());
  h_ = simulation.settings().step;
  for (const Effect& effect : simulation.settings().effects) effects_.emplace_back(effect.name());
}

void Statistics::after_step(const Simulation& simulation, const StepReport& report, double seconds) {
  exactness_.after_step(simulation, report, seconds);
  energy_rise_.after_step(simulation, report, seconds);
  effect_seconds_ = simulation.effect_seconds();
  redone_ += report.redone ? 1 : 0;
  note(report.iterations, report.substeps, report.converged, report.converged ? 0 : simulation.residual(), seconds);
}

void Statistics::replay(const StepRow& row, double time, double seconds) {
  energy_rise_.replay(row, time, seconds);
  if (row.step == 0) return;
  exactness_.replay(row, time, seconds);
  redone_ += row.redone ? 1 : 0;
  note(row.iterations, row.substeps, row.converged, row.residual, seconds);
  ++replayed_;
}

void Statistics::note(int iterations, std::int64_t substeps, bool converged, double residual, double seconds) {
  microseconds_.push_back(static_cast<float>(1e6 * seconds));
  iterations_ += iterations;
  substeps_ += substeps;
  max_substeps_ = std::max(max_substeps_, substeps);
  max_iterations_ = std::max(max_iterations_, iterations);
  if (converged) return;
  ++not_converged_;
  worst_residual_ = std::max(worst_residual_, residual);
}

std::optional<std::string> Statistics::instability() const {
  constexpr double most_redone = 0.05;  // fraction of the steps
  const double share = static_cast<double>(redone_) / static_cast<double>(std::max<std::int64_t>(1, steps()));
  if (share <= most_redone) return std::nullopt;
  return fmt::format(
      "sdirk2 gained energy in {} of {} steps, which backward Euler took instead; more than {:g} % mean that sdirk2 is "
      "unstable here: use a smaller tolerance and more max_iterations, a shorter [time] step, or scheme = "
      "\"backward-euler\"",
      redone_, steps(), 100 * most_redone);
}

double Statistics::mean_iterations() const {
  return microseconds_.empty() ? 0 : static_cast<double>(iterations_) / static_cast<double>(steps());
}

double Statistics::mean_substeps() const {
  return microseconds_.empty() ? 0 : static_cast<double>(substeps_) / static_cast<double>(steps());
}

double Statistics::mean_microseconds() const {
  return microseconds_.empty() ? 0 : 1e6 * total_seconds() / static_cast<double>(steps());
}

double Statistics::median_microseconds() const {
  if (microseconds_.empty()) return 0;
  if (std::isnan(mean_microseconds())) return mean_microseconds();  // step times are unknown
  std::vector<float> sorted = microseconds_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (sorted.size() % 2 == 1) return *middle;
  return 0.5 * (static_cast<double>(*middle) + static_cast<double>(*std::max_element(sorted.begin(), middle)));
}

double Statistics::total_seconds() const {
  return 1e-6 * std::accumulate(microseconds_.begin(), microseconds_.end(), 0.0);
}

double Statistics::own_seconds() const {
  return 1e-6 *
         std::accumulate(microseconds_.begin() + static_cast<std::ptrdiff_t>(replayed_), microseconds_.end(), 0.0);
}

std::vector<Statistics::EffectShare> Statistics::effects() const {
  std::vector<EffectShare> shares;
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    shares.push_back({effects_[i], {}});
    if (!effect_seconds_.empty() && own_seconds() > 0) shares.back().share = effect_seconds_[i] / own_seconds();
  }
  return shares;
}

namespace {

/// Returns null if no accuracy was given and nothing is minimised.
nlohmann::ordered_json accuracy_json(const Statistics& statistics) {
  const ErrorMonitor& exactness = statistics.exactness();
  nlohmann::ordered_json json;
  if (const auto& asked = exactness.asked()) {
    json = {{"asked", *asked},
            {"substeps", {{"mean", statistics.mean_substeps()}, {"max", statistics.max_substeps()}}},
            {"steps_not_accurate", statistics.not_converged()}};
  } else if (const auto& accuracy = exactness.accuracy()) {
    json = {{"stop", stopping_rule_name(accuracy->rule)}, {"tolerance", nullptr}};
    if (!accuracy->is_default) json["tolerance"] = accuracy->tolerance;
  } else {
    return nullptr;
  }
  if (const auto errors = exactness.errors()) {
    json["estimated_error"] = {{"mean", errors->mean}, {"largest", errors->largest}};
  }
  if (const auto& residual_force = exactness.residual_force()) {
    json["unbalanced_at_rest"] = {{"force", residual_force->force}};
    if (residual_force->of_weight) json["unbalanced_at_rest"]["of_weight"] = *residual_force->of_weight;
  }
  return json;
}

/// Returns null if the cloth gets energy from outside or can touch nothing.
nlohmann::ordered_json rise_json(const Statistics& statistics) {
  const auto rise = statistics.energy_rise();
  if (!rise) return nullptr;
  return {{"energy", rise->energy}, {"of_available", rise->of_available}};
}

}  // namespace

std::string Statistics::to_json(const std::string& outcome) const {
  // Effects of one name share one entry: the sum of their shares.
  auto names = nlohmann::ordered_json::array();
  auto shares = nlohmann::ordered_json::object();
  for (const EffectShare& effect : effects()) {
    if (std::find(names.begin(), names.end(), effect.name) == names.end()) names.push_back(effect.name);
    if (effect.share) shares[effect.name] = shares.value(effect.name, 0.0) + *effect.share;
  }
  const nlohmann::ordered_json json = {{"method", method_},
                                       {"scheme", scheme_},
                                       {"vertices", vertices_},
                                       {"springs", springs_},
                                       {"step", h_},
                                       {"steps", steps()},
                                       {"iterations",
                                        {{"mean", mean_iterations()},
                                         {"max", max_iterations_},
                                         {"steps_not_converged", not_converged_},
                                         {"steps_redone", redone_},
                                         {"worst_residual", worst_residual_}}},
                                       {"accuracy", accuracy_json(*this)},
                                       {"energy_rise", rise_json(*this)},
                                       {"step_us", {{"mean", mean_microseconds()}, {"median", median_microseconds()}}},
                                       {"effects", names},
                                       {"effect_shares", shares},
                                       {"outcome", outcome}};
  return json.dump(2) + "\n";
}

}  // namespace drape

#include "study/accuracy_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "study/local_error.hpp"

namespace drape {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double rounded_part = 1e-6;  // rounding tolerance, as a share of a step

/// Returns the scene's step that ends at a time; nothing for a time within a step.
std::optional<std::int64_t> moment_at(double time, double h) {
  const double steps = time / h;
  if (std::abs(steps - std::round(steps)) > rounded_part) return std::nullopt;
  return std::llround(steps);
}

}  // namespace

std::function<void(const Simulation&, const StepReport&)> MotionWatch::watch(MotionPoint& point,
                                                                             const StudyCase& what) {
  point.errors.assign(times_.size(), {unknown, unknown});
  Watched& watched = watched_.emplace_back();
  watched.point = &point;
  const Cloth& cloth = scene_.simulation.cloth;
  watched.before = {.x = cloth.positions, .v = cloth.velocities, .step = 0};
  return [this, &point, &watched, judged = what.steps](const Simulation& simulation, const StepReport& report) {
    const State& state = simulation.state();
    if (report.estimate && state.step <= judged) {
      point.substeps.push_back(static_cast<double>(report.substeps));
      point.estimates.push_back(*report.estimate);
      point.converged.push_back(report.converged ? 1 : 0);
      watched.steps.push_back({std::move(watched.before), state.x});
      watched.before = state;
    }
    const auto moment = moment_at(simulation.time(), scene_.simulation.step);
    const auto place = moment ? reference_->place(*moment) : std::nullopt;
    if (!place) return;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (*moment == std::llround(times_[i] / scene_.simulation.step)) {
        point.errors[i] = distance(state.x, reference_->x[*place]);
      }
    }
    if (films_ == nullptr) return;
    if (const auto error = films_->error(*moment, state.x)) point.film_flip.push_back(*error);
    if (point.film_flip.size() != films_->count()) return;
    point.flip =
        std::accumulate(point.film_flip.begin(), point.film_flip.end(), 0.0) / static_cast<double>(films_->count());
  };
}

bool MotionWatch::find_local_errors(std::vector<MotionPoint>& points, std::vector<std::string>& notes,
                                    const std::stop_token& stop, Progress& progress) const {
  if (points.empty()) return true;
  progress.begin("taking single steps again", "cases", static_cast<std::int64_t>(points.size()));
  std::optional<LocalErrors> exact;
  try {
    exact.emplace(scene_.simulation);
  } catch (const UsageError& error) {
    notes.push_back(fmt::format("The true errors of steps are not known: {}", error.what()));
    return true;
  }
  for (MotionPoint& point : points) {
    const auto watched = std::ranges::find(watched_, &point, &Watched::point);
    for (const Step& step : watched->steps) {
      if (stop.stop_requested()) return false;
      const auto found = exact->of_step(step.before, step.after);
      point.local_errors.push_back(found ? found->error : unknown);
      point.local_unknown.push_back(found ? found->unknown : unknown);
    }
    ++progress.done;
  }
  return true;
}

}  // namespace drape

#include "study/film_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "check/flip.hpp"
#include "run/known_film.hpp"

namespace drape {
namespace {

constexpr double frames_per_second = 10;
constexpr int judged_width = 160;  // [pixels]

Eigen::Vector2i picture_size(const Scene& scene) {
  return {judged_width, std::max(1, judged_width * scene.video.size.y() / scene.video.size.x())};
}

double mean(const ErrorMap& map) {
  return std::accumulate(map.values.begin(), map.values.end(), 0.0) / static_cast<double>(map.values.size());
}

/// Allows any step length, since only positions are used.
SimulationSettings places_only(SimulationSettings settings) {
  settings.integrator.allow_unstable = true;
  return settings;
}

}  // namespace

std::vector<std::int64_t> film_steps(const Scene& scene, std::int64_t last) {
  const auto every = std::max<std::int64_t>(1, std::llround(1 / (frames_per_second * scene.simulation.step)));
  std::vector<std::int64_t> steps;
  for (std::int64_t step = every; step <= last; step += every) steps.push_back(step);
  if (steps.empty()) steps.push_back(last);
  return steps;
}

FilmJudge::FilmJudge(const Scene& scene, const std::vector<std::int64_t>& steps, const StepReference& reference,
                     GlBackend backend)
    : step_(scene.simulation.step),
      simulation_(places_only(scene.simulation)),
      renderer_(data_folder(), picture_size(scene), View{}, scene.look, scene.simulation.cloth.vertex_count(),
                scene.simulation.cloth.triangles, scene.uvs, backend),
      steps_(steps) {
  const auto frame = [&](std::size_t i) {
    const double time = static_cast<double>(steps_[i]) * step_;
    return Frame{.index = static_cast<int>(i),
                 .time = time,
                 .positions = reference.x[reference.place(steps_[i]).value()],
                 .colliders = simulation_.colliders(time)};
  };
  const auto pass = [&](const std::function<void(const Frame&)>& visit) {
    for (std::size_t i = 0; i < steps_.size(); ++i) visit(frame(i));
  };
  const auto frames = static_cast<int>(steps_.size());
  const CameraPath path = camera_path(scene.camera, known_film(scene, picture_size(scene), frames, pass));
  for (int i = 0; i < frames; ++i) views_.push_back(path.at(i));
  for (std::size_t i = 0; i < steps_.size(); ++i) pictures_.push_back(draw(i, frame(i).positions));
  for (const std::int64_t step : steps_) {
    unknown_ += error(step, reference.plain[reference.place(step).value()]).value_or(0) / frames;
  }
}

Image FilmJudge::draw(std::size_t frame, const Vertices& x) {
  const double time = static_cast<double>(steps_[frame]) * step_;
  renderer_.look_from(views_[frame]);
  return renderer_.draw(
      {.index = static_cast<int>(frame), .time = time, .positions = x, .colliders = simulation_.colliders(time)});
}

std::optional<double> FilmJudge::error(std::int64_t step, const Vertices& x) {
  const auto found = std::ranges::lower_bound(steps_, step);
  if (found == steps_.end() || *found != step) return std::nullopt;
  const auto frame = static_cast<std::size_t>(found - steps_.begin());
  return mean(flip_error(pictures_[frame], draw(frame, x)));
}

}  // namespace drape

#include "study/study_motion.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "output/motion_packer.hpp"
#include "run/run_steps.hpp"

namespace drape {
namespace {

constexpr std::size_t most_frames = 100, most_positions = 50'000;
constexpr double most_frames_per_second = 50;  // with shorter steps, the motion plays slower than real time

/// Returns the largest number of frames for a page, an even number.
std::size_t frames_of_page(const Scene& scene) {
  const auto vertices = static_cast<std::size_t>(std::max(1, scene.simulation.cloth.vertex_count()));
  return std::clamp<std::size_t>(most_positions / vertices, 2, most_frames) & ~std::size_t{1};
}

/// Keeps every second frame.
void thin(std::vector<Frame>& frames) {
  for (std::size_t i = 0; 2 * i < frames.size(); ++i) {
    if (i > 0) frames[i] = std::move(frames[2 * i]);
  }
  frames.resize((frames.size() + 1) / 2);
}

}  // namespace

html::PlayedMotion pack_for_page(const Scene& scene, const std::vector<Frame>& frames) {
  std::size_t every = 1;
  while ((frames.size() + every - 1) / every > frames_of_page(scene)) every *= 2;
  FilmInfo film;
  film.scene = scene.name;
  film.cloth = &scene.simulation.cloth;
  film.look = &scene.look;
  film.camera = &scene.camera;
  if (frames.size() > every) film.seconds_per_frame = frames[every].time - frames[0].time;
  film.fps = std::min(1 / film.seconds_per_frame, most_frames_per_second);
  MotionPacker packer(film);
  try {
    for (std::size_t i = 0; i < frames.size(); i += every) packer.add(frames[i]);
  } catch (const OutputError&) {
    return {};
  }
  return packer.finish();
}

StudyMotionRecorder::StudyMotionRecorder(const Scene& scene) : scene_(scene), most_(frames_of_page(scene)) {}

void StudyMotionRecorder::add(const Simulation& simulation) {
  if (simulation.state().step % every_ != 0) return;
  if (frames_.size() == most_) {
    thin(frames_);
    every_ *= 2;
    if (simulation.state().step % every_ != 0) return;
  }
  frames_.push_back({.index = static_cast<int>(frames_.size()),
                     .time = simulation.time(),
                     .positions = simulation.state().x,
                     .colliders = simulation.colliders(simulation.time())});
}

html::PlayedMotion StudyMotionRecorder::finish() const {
  return frames_.empty() ? html::PlayedMotion{} : pack_for_page(scene_, frames_);
}

std::optional<StudyMotion> record_study_motion(const StudyCase& what, const std::string& label,
                                               const std::stop_token& stop) {
  const Scene scene = what.load();
  StudyMotionRecorder recorder(scene);
  Simulation simulation(scene.simulation);
  recorder.add(simulation);
  try {
    run_steps(simulation, what.steps, stop, [&](const StepReport&) { recorder.add(simulation); });
  } catch (const DivergedError&) {
  }
  if (stop.stop_requested()) return std::nullopt;
  return StudyMotion{label, what.film_command("motion.html"), recorder.finish()};
}

}  // namespace drape

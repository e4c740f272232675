#include "compare/synchronised_motions.hpp"

#include <algorithm>

#include "run/frame_player.hpp"
#include "run/known_film.hpp"

namespace drape {
namespace {

/// Combines the vertices and colliders of all motions at a moment.
Frame together(const SynchronisedMotions::Moment& moment) {
  Frame all{};
  Eigen::Index rows = 0;
  for (const Frame* frame : moment) rows += frame->positions.rows();
  all.positions.resize(rows, 3);
  rows = 0;
  for (const Frame* frame : moment) {
    all.positions.middleRows(rows, frame->positions.rows()) = frame->positions;
    rows += frame->positions.rows();
    all.colliders.insert(all.colliders.end(), frame->colliders.begin(), frame->colliders.end());
  }
  return all;
}

}  // namespace

FilmExtent compared_extent(const std::vector<Scene>& scenes, const CompareOptions& options, std::size_t i) {
  const Scene& scene = scenes[i];
  const std::int64_t steps =
      options.recorded.empty() || !options.recorded[i] ? scene.step_count() : options.recorded[i]->last_step();
  return FilmExtent(scenes.front().video, scene.simulation.step, options.steps.value_or(steps), std::nullopt);
}

FrameRange all_frames(const std::vector<Scene>& scenes, const CompareOptions& options) {
  FrameRange all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    all.last = std::max(all.last, compared_extent(scenes, options, i).frames.last);
  }
  return all;
}

SynchronisedMotions::SynchronisedMotions(const std::vector<Scene>& scenes, const CompareOptions& options, bool often)
    : scenes_(scenes), first_count_(compared_extent(scenes, options, 0).frames.count()) {
  const std::optional<std::size_t> memory =
      often ? std::optional(FrameTape::usual_memory / scenes.size()) : std::nullopt;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    sources_.emplace_back(scenes[i], options.recorded.empty() ? nullptr : options.recorded[i],
                          compared_extent(scenes, options, i), memory);
  }
}

void SynchronisedMotions::play(int last, const std::stop_token& stop,
                               const std::function<void(int, const Moment&)>& work) {
  std::deque<FramePlayer> players;  // a deque, since players cannot be moved
  for (FrameSource& source : sources_) players.emplace_back(source);
  Moment moment(players.size());
  for (int k = 0; k <= last && !stop.stop_requested(); ++k) {
    for (std::size_t i = 0; i < players.size(); ++i) moment[i] = &players[i].next();
    work(k, moment);
  }
  // A motion counts as known after its last frame: ask for one more.
  for (std::size_t i = 0; i < players.size() && !stop.stop_requested(); ++i) players[i].next();
}

std::optional<CameraPath> SynchronisedMotions::camera_path(int count, const std::stop_token& stop) {
  const Scene& first = scenes_.front();
  struct Stopped {};
  const auto go_on = [&] {
    if (stop.stop_requested()) throw Stopped();
  };
  try {
    Camera camera = first.camera;
    if (!camera.position) {
      camera = well_placed(camera, known_film(first, first.video.size, first_count_, [&](const auto& visit) {
                             sources_.front().pass(visit, stop);
                             go_on();
                           }));
    }
    return drape::camera_path(camera, known_film(first, first.video.size, count, [&](const auto& visit) {
                                play(count - 1, stop, [&](int, const Moment& moment) { visit(together(moment)); });
                                go_on();
                              }));
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace drape

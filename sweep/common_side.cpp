#include "sweep/common_side.hpp"

#include <new>

#include "core/hash.hpp"
#include "run/frame_source.hpp"
#include "run/known_film.hpp"
#include "run/outputs.hpp"

namespace drape {
namespace {

Camera usual_side() { return {.azimuth = Camera::usual_azimuth, .elevation = Camera::usual_elevation}; }

}  // namespace

bool chooses_side(const SweepRequest& request, const Camera& camera) {
  return !request.films.empty() && !camera.position && !(camera.azimuth && camera.elevation);
}

std::string key_seen_from(const std::string& key, const std::string& side) {
  if (side.empty() || side == key) return key;
  return checksum_of(key + ", seen as " + side);
}

Camera side_of_films(const SweepPlan& plan, const std::stop_token& stop) {
  struct Stopped {};
  const PlannedRun& run = plan.runs.at(plan.side.value());
  try {
    const Scene scene = load_scene(plan.request.scenes[run.scene], overrides_of(plan, run));
    const FilmExtent extent = film_extent(scene, run_options(plan.request, {}));
    FrameSource motion(scene, nullptr, extent, std::nullopt);  // a single pass, by well_placed()
    return well_placed(scene.camera, known_film(scene, scene.video.size, extent.frames.count(), [&](const auto& visit) {
                         motion.pass(visit, stop);
                         if (stop.stop_requested()) throw Stopped();
                       }));
  } catch (const Stopped&) {
    return usual_side();  // no more drawing follows
  } catch (const Error&) {
    return usual_side();  // that run's own row has the reason
  } catch (const std::bad_alloc&) {
    return usual_side();
  }
}

void look_from(const Camera& side, Camera& camera) {
  if (!camera.azimuth) camera.azimuth = side.azimuth;
  if (!camera.elevation) camera.elevation = side.elevation;
}

}  // namespace drape

#include "bench/drawing.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "bench/subject.hpp"
#include "core/read_file.hpp"
#include "render/renderer.hpp"
#include "run/frame_sampler.hpp"
#include "run/run_steps.hpp"
#include "scene/scene.hpp"

namespace drape {
namespace {

constexpr int count = 20;  // drawn frames, evenly spread over the film

struct DrawnFilm {
  Scene scene;
  std::vector<Frame> frames;
  View view;
};

DrawnFilm make_film(const std::string& file) {
  DrawnFilm film{load_scene(data_folder() / file, {}), {}, {}};
  const Scene& scene = film.scene;
  const SimulationSettings& settings = scene.simulation;
  const std::int64_t steps = std::llround(scene.duration / settings.step);
  const int last = static_cast<int>(scene.video.last_frame(scene.duration));
  const FilmExtent extent(scene.video, settings.step, steps, FrameRange{0, last});
  Framing framing(scene.camera, static_cast<double>(scene.video.size.x()) / scene.video.size.y());
  int seen = 0;
  FrameSampler sampler(extent, [&](Frame frame) {
    framing.add(frame.positions);
    for (const Collider& collider : frame.colliders) framing.add(collider);
    framing.end_frame();
    if (seen++ * count / last == static_cast<int>(film.frames.size())) film.frames.push_back(std::move(frame));
  });
  const std::array<StepObserver*, 1> observers{&sampler};
  Simulation simulation(settings);
  run_steps(simulation, extent.steps, observers, {});
  film.view = framing.view();
  film.frames.resize(count, film.frames.back());
  return film;
}

Subject make_drawing(const std::shared_ptr<DrawnFilm>& film, bool lit) {
  if (film->frames.empty()) *film = make_film(film->scene.file);
  Look look = film->scene.look;
  if (!lit) {
    look.shadows = look.ambient_occlusion = false;
    look.translucency = 0;
  }
  const SimulationSettings& settings = film->scene.simulation;
  // Never deleted: benchmarks are destroyed when the process ends, after Mesa has cleaned up.
  auto* renderer = new Renderer(data_folder(), film->scene.video.size, film->view, look, settings.cloth.vertex_count(),
                                settings.cloth.triangles, film->scene.uvs);
  renderer->set_weave(settings.cloth.rest, film->scene.uvs);
  return {.restore = [] {},
          .run =
              [film, renderer] {
                for (const Frame& frame : film->frames) renderer->draw(frame);
                return count;
              }};
}

}  // namespace

std::vector<std::string> register_drawing() {
  std::vector<std::string> names;
  for (const char* scene : {"homework/1", "homework/4", "homework/5", "showcase/ground", "showcase/moving_pins",
                            "showcase/moving_sphere", "showcase/self_collision", "showcase/wind"}) {
    const auto film = std::make_shared<DrawnFilm>();
    film->scene.file = fmt::format("scenes/{}.toml", scene);
    names.push_back(fmt::format("draw/{}", scene));
    register_subject(names.back(), "with", count, [film] { return make_drawing(film, true); });
    register_subject(names.back(), "without", count, [film] { return make_drawing(film, false); });
  }
  return names;
}

}  // namespace drape

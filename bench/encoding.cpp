#include "bench/encoding.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "bench/ffmpeg_gif.hpp"
#include "bench/subject.hpp"
#include "core/read_file.hpp"
#include "output/gif_encoder.hpp"
#include "render/renderer.hpp"
#include "run/frame_sampler.hpp"
#include "run/run_steps.hpp"
#include "scene/scene.hpp"

namespace drape {
namespace {

/// The first hundred frames of the homework's fourth film, drawn once for both encoders.
const std::vector<Image>& film() {
  static const std::vector<Image> images = [] {
    const Scene scene = load_scene(data_folder() / "scenes/homework/4.toml", {});
    const SimulationSettings& settings = scene.simulation;
    const std::int64_t steps = std::llround(scene.duration / settings.step);
    const FilmExtent extent(scene.video, settings.step, steps, FrameRange{0, 99});
    std::vector<Frame> frames;
    FrameSampler sampler(extent, [&](Frame frame) { frames.push_back(std::move(frame)); });
    const std::array<StepObserver*, 1> observers{&sampler};
    Simulation simulation(settings);
    run_steps(simulation, extent.steps, observers, {});

    const Eigen::Vector2i size = scene.video.size;
    Framing framing(scene.camera, static_cast<double>(size.x()) / size.y());
    for (const Frame& frame : frames) framing.add(frame.positions);
    Renderer renderer(data_folder(), size, framing.view(), scene.look, settings.cloth.vertex_count(),
                      settings.cloth.triangles, scene.uvs);
    std::vector<Image> drawn;
    for (const Frame& frame : frames) drawn.push_back(renderer.draw(frame));
    return drawn;
  }();
  return images;
}

constexpr int fps = 25, count = 100;

Subject make_drape() {
  return {.restore = [] {},
          .run =
              [] {
                const auto file =
                    std::filesystem::temp_directory_path() / fmt::format("drape-bench-{}.gif", ::getpid());
                GifEncoder encoder(file, fps, {});
                for (const Image& image : film()) encoder.add(image);
                const bool written = encoder.finish(Ending::complete).size() == 1;
                std::filesystem::remove(file);
                return written ? count : 0;
              }};
}

Subject make_ffmpeg() {
  return {.restore = [] {}, .run = [] { return encode_gif_by_ffmpeg(film(), fps) > 0 ? count : 0; }};
}

}  // namespace

std::vector<std::string> register_encoding() {
  const std::string name = "gif_frame/scene_4";
  register_subject(name, "drape", count, make_drape);
  register_subject(name, "ffmpeg", count, make_ffmpeg);
  return {name};
}

}  // namespace drape

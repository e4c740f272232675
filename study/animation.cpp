#include "study/animation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/render/image.hpp"
#include "drape/render/overlay/pen.hpp"
#include "drape/render/renderer.hpp"
#include "drape/sim/mesh.hpp"
#include "render/flip.hpp"
#include "render/overlay/color_scale.hpp"
#include "render/overlay/diagrams.hpp"
#include "run/frame_source.hpp"
#include "run/outputs.hpp"
#include "run/run_scene.hpp"
#include "study/motions.hpp"

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

namespace {

constexpr double most_frames_per_second = 10;                        // enough to show differences
constexpr int picture_width = 340, gap = 6, band = 42, margin = 10;  // [pixels]
constexpr int letters = 13;                                          // font size [pixels]
constexpr double smallest = 1e-6, largest = 1;                       // range of the colour bar [m]
constexpr int stills_in_a_row = 2;                                   // more would be too small on paper
constexpr std::uint8_t paper = 255;
// Mesh lines show folded triangles, on dark and on bright colours.
const Rgb mesh_ink{0.05, 0.05, 0.06};

double along_bar(double distance) {
  return distance <= smallest ? 0 : std::log10(distance / smallest) / std::log10(largest / smallest);
}

/// Returns the frames of a whole motion, or up to the stop.
std::vector<Frame> frames_of(const SimulationSettings& settings, const Video& video, double duration,
                             const std::stop_token& stop) {
  std::vector<Frame> frames;
  const FilmExtent film(video, settings.step, std::llround(duration / settings.step), std::nullopt);
  FrameSampler sampler(film, [&](Frame frame) { frames.push_back(std::move(frame)); });
  const std::array<StepObserver*, 1> observers{&sampler};
  Simulation simulation(settings);
  run_steps(simulation, film.steps, observers, stop);
  return frames;
}

/// Draws the colour bar below the panels.
Image distance_bar(Pen& pen, int width) {
  const std::vector<Tick> marks{{along_bar(1e-6), "1 µm"}, {along_bar(1e-5), "10 µm"}, {along_bar(1e-4), "0.1 mm"},
                                {along_bar(1e-3), "1 mm"}, {along_bar(1e-2), "1 cm"},  {along_bar(0.1), "0.1 m"},
                                {along_bar(1), "1 m"}};
  return color_bar(pen, width, letters, "distance from the reference", marks);
}

/// Painter of panels of one cloth.
class PanelPainter {
 public:
  PanelPainter(const Scene& scene, const View& view, const Eigen::Vector2i& size, GlBackend backend, Pen& pen)
      : pen_(pen),
        pairs_(scene.simulation.cloth.triangles),
        renderer_(data_folder(), size, view, look_of(scene.look), scene.simulation.cloth.vertex_count(),
                  scene.simulation.cloth.triangles, {}, backend) {}

  Image draw(const std::string& label, const Frame& frame, const Vertices& reference) {
    const Eigen::VectorXd distances = (frame.positions - reference).rowwise().norm();
    std::vector<Rgb> colors;
    for (const double d : distances) colors.push_back(viridis(along_bar(d)));
    const Image cloth = renderer_.draw(frame, colors);
    Image head(cloth.width, band);
    std::fill(head.pixels.begin(), head.pixels.end(), paper);
    pen_.write(head, margin, 16, label, letters, band_ink);
    const int flipped = pairs_.count(frame.positions);
    pen_.write(head, margin, 34,
               fmt::format("error {}, {} flipped {}", readable_length(distances.maxCoeff()), flipped,
                           flipped == 1 ? "pair" : "pairs"),
               letters, band_ink);
    append_below(head, cloth);
    return head;
  }

 private:
  static Look look_of(Look look) {
    look.texture.clear();
    look.mesh_lines = true;
    look.line_color = mesh_ink;
    return look;
  }

  Pen& pen_;
  FlippedPairs pairs_;
  Renderer renderer_;
};

/// Returns the motion whose last frame is furthest from a frame.
std::size_t furthest(const std::vector<std::vector<Frame>>& motions, const Frame& end) {
  std::size_t worst = 0;
  double most = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double distance = (motions[i].back().positions - end.positions).rowwise().norm().maxCoeff();
    if (distance > most) {
      most = distance;
      worst = i;
    }
  }
  return worst;
}

/// Returns one fixed view that covers all motions.
View view_of(const Scene& scene, const Eigen::Vector2i& size, const std::vector<std::vector<Frame>>& motions) {
  Camera still = scene.camera;
  still.follow = false;
  still.orbit = 0;
  std::size_t count = 0;
  for (const std::vector<Frame>& motion : motions) count += motion.size();
  const auto pass = [&motions](const std::function<void(const Frame&)>& visit) {
    for (const std::vector<Frame>& motion : motions) std::for_each(motion.begin(), motion.end(), visit);
  };
  return camera_path(still, known_film(scene, size, static_cast<int>(count), pass)).at(0);
}

}  // namespace

std::optional<Animation> animate_errors(const Scene& scene, const SimulationSettings& reference,
                                        const std::vector<AnimationPanel>& panels, const std::filesystem::path& file,
                                        GlBackend backend, const std::stop_token& stop, Progress& progress) {
  Pen pen;
  progress.begin("simulating for the animation", "motions", static_cast<std::int64_t>(panels.size()) + 1);
  Video video = scene.video;
  video.fps = std::min(video.fps, most_frames_per_second);
  const std::vector<Frame> exact = frames_of(reference, video, scene.duration, stop);
  ++progress.done;
  std::vector<std::vector<Frame>> motions;
  for (const AnimationPanel& panel : panels) {
    motions.push_back(frames_of(panel.study_case.load().simulation, video, scene.duration, stop));
    ++progress.done;
  }
  if (stop.stop_requested()) return std::nullopt;

  const Eigen::Vector2i size(picture_width, picture_width * scene.video.size.y() / scene.video.size.x());
  const View view = view_of(scene, size, motions);
  PanelPainter painter(scene, view, size, backend, pen);
  progress.begin("drawing the animation", "frames", static_cast<std::int64_t>(exact.size()));
  Image bar;  // the same below every frame
  const auto draw = [&](std::size_t f) {
    if (stop.stop_requested()) throw Interrupted();
    std::vector<Image> pictures;
    std::vector<const Image*> list;
    for (std::size_t p = 0; p < panels.size(); ++p) {
      pictures.push_back(painter.draw(panels[p].label, motions[p][f], exact[f].positions));
    }
    for (const Image& picture : pictures) list.push_back(&picture);
    Image whole = montage(list, panels.size() == 3 ? 3 : 2, gap, paper);
    if (bar.width == 0) bar = distance_bar(pen, whole.width);
    append_below(whole, bar);
    ++progress.done;
    return whole;
  };
  PosterFrame poster(scene.simulation.cloth.triangles);
  for (const Frame& frame : exact) poster.see(frame.positions);
  PageFilm film;
  try {
    film = write_page_film(file, video.fps,
                           {.count = exact.size(),
                            .first = static_cast<std::size_t>(poster.index()),
                            .picture = draw,
                            .columns = stills_in_a_row,
                            .gap = gap,
                            .gray = paper});
  } catch (const Interrupted&) {
    return std::nullopt;
  }
  write_file_atomically(std::filesystem::path(file).replace_extension(".png"), film.stills);
  const std::size_t worst = furthest(motions, exact.back());
  return Animation{std::move(film), pack_for_page(scene, exact, view), pack_for_page(scene, motions[worst], view),
                   worst};
}

}  // namespace drape

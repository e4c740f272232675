#include "run/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"
#include "overlay/caption.hpp"
#include "overlay/color_bar.hpp"
#include "scene/caption.hpp"

namespace drape {
namespace {

/// Colours distinguishable with any kind of colour vision (M. Okabe and K. Ito 2008).
const Rgb total_color{0, 0, 0}, kinetic_color{0.835, 0.369, 0}, gravity_color{0, 0.447, 0.698},
    elastic_color{0, 0.620, 0.451};

/// Returns the text size of the bands, a little smaller than a caption's [pixels].
int band_text_size(const Scene& scene) { return std::max(11, text_size(scene.video.size.y()) * 5 / 6); }

/// Calls work() and prefixes its error messages with the caption's place in the scene.
auto attributed(const Scene& scene, const auto& work) {
  const auto placed = [&](const Error& error) {
    return fmt::format("{}: {}", scene.caption_place.empty() ? shown(scene.file) : scene.caption_place, error.what());
  };
  try {
    return work();
  } catch (const UsageError& error) {
    throw UsageError(placed(error));
  } catch (const OutputError& error) {
    throw OutputError(placed(error));
  }
}

std::string caption_text(const Scene& scene, const Frame& frame) {
  const auto value = [&](const std::string& name) { return moment_value(name, frame, scene.simulation.step); };
  return scene.caption.filled.fill(value);
}

/// Checks that the fonts have all letters of the caption, and that it fits into the picture at both ends of the film.
/// @throws UsageError, OutputError
void require_caption(Pen& pen, const Scene& scene) {
  if (scene.caption.filled.empty()) return;
  Frame first, last;
  last.time = static_cast<double>(scene.step_count()) * scene.simulation.step;
  last.index = static_cast<int>(std::min(last.time * scene.video.fps, 1e9));
  for (const Frame& frame : {first, last}) {
    const std::string text = caption_text(scene, frame);
    pen.fonts().require(text);
    require_room(pen, scene.caption, text, scene.video.size.x(), scene.video.size.y());
  }
}

/// Appends the rows of `band` below a picture.
void append(Image& picture, const Image& band) {
  picture.height += band.height;
  picture.pixels.insert(picture.pixels.end(), band.pixels.begin(), band.pixels.end());
}

}  // namespace

Annotations::Annotations(const Scene& scene) : scene_(scene), pen_(attributed(scene, [] { return Pen(); })) {
  const Look& look = scene.look;
  if (look.color_by) coloring_.emplace(*look.color_by, look.color_limit, scene.simulation.cloth);
  if (scene.overlay.energies) {
    energies_ = {{"total", total_color, {}},
                 {"kinetic", kinetic_color, {}},
                 {"gravity", gravity_color, {}},
                 {"elastic", elastic_color, {}}};
  }
  attributed(scene, [&] { require_caption(pen_, scene); });
}

bool Annotations::wanted(const Scene& scene) {
  return !scene.caption.filled.empty() || scene.overlay.energies || scene.look.color_by;
}

Eigen::Vector2i Annotations::film_size(const Scene& scene) {
  const int size = band_text_size(scene);
  Eigen::Vector2i film = scene.video.size;
  if (scene.look.color_by) film.y() += color_bar_height(size);
  if (scene.overlay.energies) film.y() += CurveBand::height(size);
  return film;
}

Look Annotations::look(const Scene& scene) {
  Look look = scene.look;
  if (look.color_by) look.texture.clear();
  return look;
}

FrameContents Annotations::contents() const {
  if (scene_.overlay.energies || needs_motion_facts(scene_.caption.filled)) return FrameContents::motion;
  return coloring_ && coloring_->measure().needs_velocities() ? FrameContents::motion : FrameContents::places;
}

bool Annotations::needs_motion() const {
  return scene_.overlay.energies || (coloring_ && coloring_->scale().needs_motion());
}

void Annotations::survey(const Frame& frame) {
  if (coloring_) coloring_->survey(frame);
  if (!scene_.overlay.energies || !frame.energies) return;
  const Energies& now = *frame.energies;
  times_.push_back(frame.time);
  const std::array values{now.total(), now.kinetic, now.gravity, now.elastic};
  for (std::size_t i = 0; i < values.size(); ++i) energies_[i].values.push_back(values[i]);
}

std::vector<Rgb> Annotations::colors(const Frame& frame) const {
  return coloring_ ? coloring_->colors(frame) : std::vector<Rgb>{};
}

Image Annotations::annotate(Image drawn, const Frame& frame) {
  const Look& look = scene_.look;
  const CaptionSettings& caption = scene_.caption;
  if (!caption.filled.empty()) {
    const bool at_top = caption.place < CaptionPlace::bottom_left;
    draw_caption(drawn, pen_, caption, caption_text(scene_, frame),
                 at_top ? look.upper_background() : look.lower_background());
  }
  const int size = band_text_size(scene_);
  if (coloring_) {
    if (!bar_) bar_ = color_bar(pen_, drawn.width, size, coloring_->measure().title(), coloring_->marks());
    append(drawn, *bar_);
  }
  if (scene_.overlay.energies) {
    if (!curves_) curves_.emplace(drawn.width, size, "J", times_, energies_);
    append(drawn, curves_->draw(pen_, frame.time));
  }
  return drawn;
}

}  // namespace drape

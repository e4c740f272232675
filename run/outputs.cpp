#include "run/outputs.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>

#include "core/machine.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/overlay/caption.hpp"
#include "output/png_encoder.hpp"
#include "output/registry.hpp"
#include "render/overlay/diagrams.hpp"
#include "run/run_scene.hpp"
#include "scene/scene_values.hpp"

namespace drape {
namespace {

/// Colours distinguishable with any kind of colour vision (M. Okabe and K. Ito 2008).
const Rgb total_color{0, 0, 0}, kinetic_color{0.835, 0.369, 0}, gravity_color{0, 0.447, 0.698},
    elastic_color{0, 0.620, 0.451};

/// Returns the text size of the bands, a little smaller than a caption's [pixels].
int band_text_size(const Scene& scene) { return std::max(11, text_size(scene.video.size.y()) * 5 / 6); }

/// Calls work() and prefixes its error messages with the caption's place in the scene.
auto attributed(const SceneSource& source, const auto& work) {
  const auto placed = [&](const Error& error) {
    return fmt::format("{}: {}", source.caption_place.empty() ? shown(source.file) : source.caption_place,
                       error.what());
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

}  // namespace

Annotations::Annotations(const LoadedScene& scene)
    : scene_(scene), pen_(attributed(scene.source, [] { return Pen(); })) {
  const Look& look = scene.look;
  if (look.color_by) coloring_.emplace(*look.color_by, look.color_limit, scene.simulation.cloth);
  if (scene.overlay.energies) {
    energies_ = {{"total", total_color, {}},
                 {"kinetic", kinetic_color, {}},
                 {"gravity", gravity_color, {}},
                 {"elastic", elastic_color, {}}};
  }
  attributed(scene.source, [&] { require_caption(pen_, scene); });
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
    append_below(drawn, *bar_);
  }
  if (scene_.overlay.energies) {
    if (!curves_) curves_.emplace(drawn.width, size, "J", times_, energies_);
    append_below(drawn, curves_->draw(pen_, frame.time));
  }
  return drawn;
}

namespace {

/// Passes the part of a frame that a sink takes.
void add_to(Encoder& encoder, const FilmFrame& frame) { frame.image ? encoder.add(*frame.image) : encoder.skip(); }
void add_to(MotionWriter& writer, const FilmFrame& frame) { writer.add(frame.frame); }

/// Returns true if films of this format loop, so that they can begin at any frame.
bool loops(const OutputFormat& format) {
  constexpr std::array<std::string_view, 3> extensions{".gif", ".webp", ".apng"};
  return std::ranges::find(extensions, format.extension) != extensions.end();
}

}  // namespace

FilmExtent film_extent(const Scene& scene, const RunOptions& options) {
  return FilmExtent(scene.video, scene.simulation.step, options.steps.value_or(scene.step_count()), options.frames,
                    options.every);
}

FilmExtent whole_extent(const Scene& scene, RunOptions options) {
  options.frames.reset();
  return film_extent(scene, options);
}

FilmInfo film_info(const Scene& scene, const RunOptions& options, Progress* progress) {
  const FilmExtent extent = film_extent(scene, options);
  FilmInfo film;
  film.scene = scene.name;
  film.fps = scene.video.fps;
  film.seconds_per_frame = extent.seconds_per_frame;
  film.first_frame = extent.frames.first;
  film.expected_frames = extent.frames.count();
  const Eigen::Vector2i size = Annotations::film_size(scene);
  film.width = size.x();
  film.height = size.y();
  film.bands = size.y() - scene.video.size.y();
  film.cloth = &scene.simulation.cloth;
  film.uvs = &scene.uvs;
  film.look = &scene.look;
  film.camera = &scene.camera;
  film.largest_file = options.largest_file;
  film.sheet = options.sheet;
  film.temporary_textures = options.recorded != nullptr;
  if (progress != nullptr) {
    film.progress = [progress](int done, int total) {
      if (done <= 1) progress->begin("encoding", "frames", total);
      progress->done = done;
    };
  }
  return film;
}

bool needs_drawing(const RunOptions& options) {
  return std::any_of(options.outputs.begin(), options.outputs.end(), [](const std::string& path) {
    const OutputFormat* format = find_format(path);
    return format != nullptr && format->drawn();
  });
}

void require_outputs(const Scene& scene, const RunOptions& options) {
  const Outputs outputs(options.outputs, film_info(scene, options), options.poster, options.start_at_poster);
  const Records records(options.records);
  if (options.motion) require_motion_file(*options.motion, motion_space(scene, options), options.from != nullptr);
}

void require_texture(const LoadedScene& scene, int largest) {
  const auto require = [&](const std::filesystem::path& texture, const std::string& place) {
    if (texture.empty()) return;
    try {
      require_texture_image(texture, largest);
    } catch (const UsageError& error) {
      throw UsageError(place + ": " + error.what());
    }
  };
  require(scene.look.texture, scene.source.texture_location);
  for (const ClothLook& cloth : scene.look.cloths) {
    if (!cloth.place.empty()) require(cloth.texture, cloth.place);
  }
}

Outputs::Outputs(const std::vector<std::string>& paths, const FilmInfo& film, bool poster, bool start_at_poster) {
  for (const std::string& path : paths) format_of(path);  // rejects an unknown one before a sink makes a folder
  for (const std::string& path : paths) outputs_.push_back({path, make_sink(path, film)});
  pictures_.assign(static_cast<std::size_t>(std::max(0, film.expected_frames)), false);
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    pictures_[i] = std::any_of(outputs_.begin(), outputs_.end(), [&](const Output& output) {
      const auto* encoder = std::get_if<std::unique_ptr<Encoder>>(&*output.sink);
      return encoder != nullptr && (*encoder)->needs(static_cast<int>(i));
    });
  }
  if (poster || start_at_poster) poster_.emplace(film);
  if (start_at_poster) hold_loops(film);
  if (!poster) return;
  poster_files_ = poster_files(paths, film);
  for (const std::string& file : poster_files_) require_writable(file);
}

void Outputs::hold_loops(const FilmInfo& film) {
  for (Output& output : outputs_) {
    const OutputFormat* format = find_format(output.path);
    output.held = format != nullptr && loops(*format);
  }
  if (std::ranges::none_of(outputs_, &Output::held)) return;
  require_memory(fmt::format("a film of {} frames that begins with its poster", film.expected_frames),
                 3.0 * film.width * film.height * film.expected_frames, "make its pictures smaller or fewer");
}

void Outputs::release(Encoder& encoder) const {
  for (std::size_t k = 0; k < held_.size(); ++k) encoder.add(held_[(poster_place_ + k) % held_.size()]);
}

bool Outputs::none() const {
  return std::none_of(outputs_.begin(), outputs_.end(), [](const Output& output) { return output.sink.has_value(); });
}

template <class AnyOf>
bool Outputs::any_is() const {
  return std::any_of(outputs_.begin(), outputs_.end(), [](const Output& output) {
    return output.sink && std::holds_alternative<std::unique_ptr<AnyOf>>(*output.sink);
  });
}

bool Outputs::needs_picture(int index) const {
  return index < 0 || index >= static_cast<int>(pictures_.size()) || pictures_[static_cast<std::size_t>(index)];
}

bool Outputs::drawn() const { return any_is<Encoder>(); }

FrameContents Outputs::contents() const {
  return any_is<MotionWriter>() ? FrameContents::motion : FrameContents::places;
}

/// Applies work() to an output's sink; gives the output up if it fails.
template <class Work>
void Outputs::attempt(Output& output, Work work) {
  if (!output.sink) return;
  try {
    std::visit([&](auto& sink) { work(*sink); }, *output.sink);
  } catch (const std::exception& error) {
    const bool complete = dynamic_cast<const Error*>(&error) != nullptr;  // the message names the file already
    problems_.push_back(complete ? error.what() : fmt::format("cannot write {}: {}", output.path, error.what()));
    output.sink.reset();
  }
}

void Outputs::add(const FilmFrame& frame) {
  for (Output& output : outputs_) {
    if (!output.held) attempt(output, [&](auto& sink) { add_to(sink, frame); });
  }
  if (!poster_ || !frame.image) return;
  poster_->see(frame.frame, *frame.image);
  if (std::ranges::none_of(outputs_, &Output::held)) return;
  if (poster_->frame() == frame.frame.index) poster_place_ = held_.size();
  held_.push_back(*frame.image);
}

std::vector<OutputFile> Outputs::write_poster(const std::string& name, Ending ending) {
  try {
    PartialFile file(name);
    file.write(encode_png(*poster_->image()));
    const std::uintmax_t size = file.commit(ending);
    return {{file.name(ending), size, fmt::format("frame {}", poster_->frame())}};
  } catch (const Error& error) {
    problems_.emplace_back(error.what());
    return {};
  }
}

std::vector<std::vector<OutputFile>> Outputs::finish(Ending ending) {
  std::vector<std::vector<OutputFile>> written;
  for (Output& output : outputs_) {
    attempt(output, [&](auto& sink) {
      if constexpr (std::is_base_of_v<Encoder, std::remove_reference_t<decltype(sink)>>) {
        if (output.held) release(sink);
      }
      std::vector<OutputFile> files = sink.finish(ending);
      if (!files.empty()) written.push_back(std::move(files));
    });
  }
  for (const std::string& file : poster_files_) {
    if (!poster_->image()) break;
    std::vector<OutputFile> files = write_poster(file, ending);
    if (!files.empty()) written.push_back(std::move(files));
  }
  return written;
}

void Poster::see(const Frame& frame, const Image& image) {
  if (!frames_.see(frame.positions)) return;
  image_ = image;
  frame_ = frame.index;
}

std::vector<std::string> poster_files(const std::vector<std::string>& outputs, const FilmInfo& film) {
  std::vector<std::string> files;
  for (const std::string& output : outputs) {
    const OutputFormat* format = find_format(output);
    if (format == nullptr || !format->drawn() || format->file_per_frame()) continue;
    const std::filesystem::path file = output_files(output, film).front();
    files.push_back((file.parent_path() / file.stem()).string() + ".poster.png");
  }
  return files;
}

}  // namespace drape

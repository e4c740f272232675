#include "run/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "output/png_encoder.hpp"
#include "output/registry.hpp"
#include "run/annotations.hpp"
#include "run/motion_space.hpp"

namespace drape {
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

void require_texture(const Scene& scene, int largest) {
  if (scene.look.texture.empty()) return;
  try {
    require_texture_image(scene.look.texture, largest);
  } catch (const UsageError& error) {
    throw UsageError(scene.texture_location + ": " + error.what());
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

}  // namespace drape

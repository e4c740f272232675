#include "run/films.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace drape {

FilmExtent film_extent(const Scene& scene, const RunOptions& options) {
  return FilmExtent(scene.video, scene.simulation.step, options.steps.value_or(scene.step_count()), options.frames);
}

std::vector<OutputSpec> output_specs(const Scene& scene, const RunOptions& options) {
  const FrameRange frames = film_extent(scene, options).frames;
  std::vector<OutputSpec> specs;
  for (const std::string& output : options.outputs) {
    OutputSpec spec;
    spec.path = output;
    spec.scene = scene.name;
    spec.fps = scene.video.fps;
    spec.first_frame = frames.first;
    spec.expected_frames = frames.count();
    spec.width = scene.video.size.x();
    spec.height = scene.video.size.y();
    specs.push_back(std::move(spec));
  }
  return specs;
}

void require_outputs(const Scene& scene, const RunOptions& options) {
  const Films films(output_specs(scene, options));
  const Records records(options.records);
}

void require_texture(const Scene& scene, int largest) {
  if (scene.look.texture.empty()) return;
  try {
    require_texture_image(scene.look.texture, largest);
  } catch (const UsageError& error) {
    throw UsageError(scene.texture_place + ": " + error.what());
  }
}

Films::Films(const std::vector<OutputSpec>& specs) {
  for (const OutputSpec& spec : specs) films_.push_back({spec.path, make_encoder(spec)});
}

bool Films::none() const {
  return std::all_of(films_.begin(), films_.end(), [](const Film& film) { return film.encoder == nullptr; });
}

void Films::add(const Image& image) {
  for (Film& film : films_) {
    try {
      if (film.encoder) film.encoder->add(image);
    } catch (const std::exception& error) {
      give_up(film, error);
    }
  }
}

std::vector<std::vector<OutputFile>> Films::finish(Ending ending) {
  std::vector<std::vector<OutputFile>> outputs;
  for (Film& film : films_) {
    try {
      if (!film.encoder) continue;
      std::vector<OutputFile> files = film.encoder->finish(ending);
      if (!files.empty()) outputs.push_back(std::move(files));
    } catch (const std::exception& error) {
      give_up(film, error);
    }
  }
  return outputs;
}

void Films::give_up(Film& film, const std::exception& error) {
  const bool complete = dynamic_cast<const Error*>(&error) != nullptr;  // a message that names the file
  problems_.push_back(complete ? error.what() : fmt::format("cannot write {}: {}", film.path, error.what()));
  film.encoder.reset();
}

}  // namespace drape

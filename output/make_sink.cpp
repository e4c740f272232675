#include "output/make_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "output/beside.hpp"
#include "output/contact_sheet.hpp"
#include "output/frame_files.hpp"
#include "output/path_template.hpp"
#include "output/registry.hpp"
#include "output/size_limited_encoder.hpp"

namespace drape {
namespace {

/// Makes a film's sink for one file.
struct AtFile {
  const std::filesystem::path& file;
  const FilmInfo& film;

  template <class Item>
  AnySink operator()(const FilmMaker<Item>& make) const {
    if constexpr (std::is_same_v<Item, Image>) {
      if (film.largest_file) return std::make_unique<SizeLimitedEncoder>(make, file, film);
    }
    return make(file, film);
  }
  template <class Item>
  AnySink operator()(const FrameMaker<Item>& make) const {
    return std::make_unique<LastFrameFile<Item>>(file, film.expected_frames - 1, make(film));
  }
  AnySink operator()(const OfSteps&) const { throw std::logic_error("a run writes its steps itself"); }
};

[[noreturn]] void fail_for_frame(const std::string& path, const OutputFormat& format) {
  std::vector<std::string> others;
  for (const OutputFormat& other : output_formats()) {
    if (other.file_per_frame()) others.push_back(other.extension);
  }
  throw UsageError(fmt::format("the output {} has a {{frame}}, but a {} holds all frames; one file per frame make {}",
                               path, format.extension, quoted_list(others)));
}

/// Makes a film's sink for one file per frame.
struct AtFiles {
  const std::string& text;  // text of the path
  const PathTemplate& path;
  const OutputFormat& format;
  const FilmInfo& film;

  template <class Item>
  AnySink operator()(const FilmMaker<Item>&) const {
    fail_for_frame(text, format);
  }
  AnySink operator()(const OfSteps&) const { fail_for_frame(text, format); }
  template <class Item>
  AnySink operator()(const FrameMaker<Item>& make) const {
    const auto name = [path = path, scene = film.scene, width = frame_digits(film)](int frame) {
      return path.path(scene, frame, width);
    };
    return std::make_unique<FrameFiles<Item>>(name, film.first_frame, make(film));
  }
};

}  // namespace

std::vector<std::string> output_files(const std::string& path, const FilmInfo& film) {
  const PathTemplate path_template(path);
  const int frames = std::max(1, film.expected_frames);
  std::vector<std::string> files;
  for (int i = 0; i < (path_template.has_frame() ? frames : 1); ++i) {
    files.push_back(path_template.path(film.scene, film.first_frame + i, frame_digits(film)));
  }
  const OutputFormat* format = find_format(path);
  if (format == nullptr || path_template.has_frame()) return files;
  const std::filesystem::path file = files.front();
  for (const char* beside : format->beside) {
    for (int i = 0; i < (PathTemplate(beside).has_frame() ? frames : 1); ++i) {
      files.push_back(file_beside(file, beside, film, film.first_frame + i));
    }
  }
  return files;
}

AnySink make_sink(const std::string& path, const FilmInfo& film) {
  const PathTemplate path_template(path);
  const OutputFormat& format = format_of(path);
  if (!path_template.has_frame()) {
    const std::filesystem::path file = path_template.path(film.scene, 0, 1);
    if (film.sheet && format.drawn() && format.file_per_frame()) return std::make_unique<ContactSheet>(file, film);
    return make_sink(format, file, film);
  }
  return std::visit(AtFiles{path, path_template, format, film}, format.make);
}

AnySink make_sink(const OutputFormat& format, const std::filesystem::path& file, const FilmInfo& film) {
  return std::visit(AtFile{file, film}, format.make);
}

}  // namespace drape

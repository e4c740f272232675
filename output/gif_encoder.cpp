#include "output/gif_encoder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "codecs/codecs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "output/gif/film_writer.hpp"
#include "output/gif/palette.hpp"
#include "output/video_check.hpp"

namespace drape {
namespace {

double checked_rate(const std::filesystem::path& file, double fps) {
  if (fps > 50) {
    throw UsageError(fmt::format(
        "cannot write {} at {} frames per second: a GIF can play at most 50, because it counts in hundredths of a "
        "second and browsers slow down frames shorter than two; choose fps = 50 or less, or write .mp4 or .webm",
        shown(file), fps));
  }
  if (!(fps >= 0.01)) {
    throw UsageError(
        fmt::format("cannot write {} at {} frames per second: a GIF can play at least 0.01", shown(file), fps));
  }
  return fps;
}

}  // namespace

GifEncoder::GifEncoder(const std::filesystem::path& file, double fps, std::function<void(int, int)> progress)
    : fps_(checked_rate(file, fps)), file_(file), progress_(std::move(progress)), spool_(file_) {
  codecs();  // finish() reads the file back: missing codecs are reported now
}

std::int64_t GifEncoder::start(int frame) const { return std::llround(frame * 100.0 / fps_); }

void GifEncoder::add(const Image& image) {
  spool_.append(image);
  colors_.add(image);
}

std::vector<OutputFile> GifEncoder::finish(Ending ending) {
  if (spool_.count() == 0) return {};
  encode();
  require_frames(file_, spool_.count());
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

void GifEncoder::encode() {
  const gif::Palette palette = gif::make_palette(colors_);
  const int count = spool_.count();
  std::optional<gif::FilmWriter> writer;
  spool_.rewind();
  for (int k = 0; k < count; ++k) {
    const Image& image = spool_.next();
    if (!writer) writer.emplace(file_, image.width, image.height, palette);
    writer->add(image, start(k + 1) - start(k));
    if (progress_) progress_(k + 1, count);
  }
  writer->finish();
}

OutputFormat gif_format() {
  return {.extension = ".gif",
          .help = "looping animation, at most 50 frames per second",
          .made_by = {},
          .packages = "libopencv-dev",  // reads the file back
          .make = FilmMaker<Image>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<GifEncoder>(file, film.fps, film.progress);
          })};
}

}  // namespace drape

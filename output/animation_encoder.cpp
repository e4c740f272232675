#include "output/animation_encoder.hpp"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

double rate_of_animation(const std::filesystem::path& file, double fps) {
  if (fps >= 0.01 && fps <= 90) return fps;
  throw UsageError(
      fmt::format("cannot write {} at {} frames per second: an animated picture takes 0.01 to 90, because browsers "
                  "slow down frames of ten milliseconds or less; choose another fps, or write .mp4 or .webm",
                  shown(file), fps));
}

OutputFormat animation_format(const std::string& form, const std::string& made_by, const std::string& help) {
  return {.extension = "." + form,
          .help = help,
          .made_by = made_by,
          .packages = "libopencv-dev",  // depends on these libraries
          .make = FilmMaker<Image>([form](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<AnimationEncoder>(file, form, film.fps, film.width, film.height);
          })};
}

}  // namespace

AnimationEncoder::AnimationEncoder(const std::filesystem::path& file, std::string form, double fps, int width,
                                   int height)
    : form_(std::move(form)), fps_(rate_of_animation(file, fps)), file_(file) {
  attempt([&] { codecs().begin_animation(file_.temporary().string(), form_, fps_, {width, height}); });
}

/// Runs a library call and turns its failure into an OutputError.
template <class Work>
void AnimationEncoder::attempt(Work work) {
  try {
    work();
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    file_.require_space();
    throw OutputError(fmt::format("cannot write {}: {}", shown(file_.file()), error.what()));
  }
}

void AnimationEncoder::add(const Image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  if (!pen_) {
    width_ = image.width;
    height_ = image.height;
    attempt([&] { pen_ = codecs().begin_animation(file_.temporary().string(), form_, fps_, rgb.size()); });
  }
  if (image.width != width_ || image.height != height_) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  attempt([&] { pen_(&rgb); });
}

std::vector<OutputFile> AnimationEncoder::finish(Ending ending) {
  if (!pen_) return {};
  attempt([&] { pen_(nullptr); });
  pen_ = {};
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

OutputFormat webp_format() {
  return animation_format("webp", "libwebp", "looping animation in full colour, two thirds of the size of a GIF");
}

OutputFormat apng_format() {
  return animation_format("apng", "FFmpeg", "looping animation with exactly the drawn pixels");
}

}  // namespace drape

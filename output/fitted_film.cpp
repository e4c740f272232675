#include "output/fitted_film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "output/scaled_image.hpp"

namespace drape {
namespace {

constexpr int narrowest = 16;  // of which somebody sees something [pixels]

/// Where a file of `bytes` would lie between two that are known, if its size went as a power of its width.
double interpolated_width(double small, double small_bytes, double wide, double wide_bytes, double bytes) {
  const double power = std::log(wide_bytes / small_bytes) / std::log(wide / small);
  return power > 0 ? small * std::pow(bytes / small_bytes, 1 / power) : (small + wide) / 2;
}

}  // namespace

FittedFilm::FittedFilm(FilmMaker<Image> make, const std::filesystem::path& file, const FilmInfo& film)
    : make_(std::move(make)), film_(film), largest_(film.largest_file.value()), file_(file), spool_(file_) {
  film_.largest_file.reset();
  make_(file, film_);  // what is wrong with it is known now
}

void FittedFilm::add(const Image& image) {
  width_ = image.width;
  height_ = image.height;
  spool_.append(image);
}

int FittedFilm::height_of(int width) const {
  return std::max(1, static_cast<int>(std::lround(static_cast<double>(height_) * width / width_)));
}

FittedFilm::Trial FittedFilm::encode(int width) {
  const std::filesystem::path trial =
      file_.temporary().parent_path() / (".trial-" + file_.temporary().filename().string().substr(1));
  film_.width = width;
  film_.height = height_of(width);
  const std::unique_ptr<Encoder> encoder = make_(trial, film_);
  spool_.rewind();
  for (int k = 0; k < spool_.count(); ++k) encoder->add(scaled_image(spool_.next(), film_.width, film_.height));
  const std::uint64_t bytes = encoder->finish().at(0).size;
  if (bytes <= largest_) {
    file_.adopt(trial);
  } else {
    std::filesystem::remove(trial);
  }
  return {width, bytes};
}

int FittedFilm::find_largest() {
  Trial wide = encode(width_);
  if (wide.bytes <= largest_) return width_;
  const auto limit = static_cast<double>(largest_);
  Trial fits{0, 0};
  while (fits.width == 0) {
    if (wide.width <= narrowest) {
      throw OutputError(
          fmt::format("cannot write {} with at most {} bytes: at {}x{} pixels it still has {}; take fewer "
                      "frames, with --frames or a lower [video] fps",
                      file_.file().string(), largest_, wide.width, height_of(wide.width), wide.bytes));
    }
    const double guess = 0.97 * wide.width * std::sqrt(limit / static_cast<double>(wide.bytes));
    const Trial trial = encode(std::clamp(static_cast<int>(guess), narrowest, wide.width - 1));
    (trial.bytes <= largest_ ? fits : wide) = trial;
  }
  // Each trial takes at least an eighth off what is left, so that there are few of them whatever the sizes.
  while (wide.width - fits.width > std::max(1, fits.width / 100)) {
    const int least = std::max(1, (wide.width - fits.width) / 8);
    const double guess = interpolated_width(fits.width, static_cast<double>(fits.bytes), wide.width,
                                            static_cast<double>(wide.bytes), 0.99 * limit);
    const Trial trial = encode(std::clamp(static_cast<int>(guess), fits.width + least, wide.width - least));
    (trial.bytes <= largest_ ? fits : wide) = trial;
  }
  return fits.width;
}

std::vector<OutputFile> FittedFilm::finish(Ending ending) {
  if (spool_.count() == 0) return {};
  const int width = find_largest();
  const std::uintmax_t size = file_.commit(ending);
  const std::string note =
      width == width_ ? "" : fmt::format("{}x{} pixels instead of {}x{}", width, height_of(width), width_, height_);
  return {{file_.name(ending), size, note}};
}

}  // namespace drape

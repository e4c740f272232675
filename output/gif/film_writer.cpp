#include "output/gif/film_writer.hpp"

#include <algorithm>

namespace drape::gif {

FilmWriter::FilmWriter(PartialFile& file, int width, int height, const Palette& palette)
    : dither_(palette, width, height),
      compactor_(palette, width, height),
      container_(file, width, height, palette),
      bytes_per_frame_(0.14 * width * height) {}

int FilmWriter::tolerance() const {
  // Proportional to the debt, so that it settles at the allowed size. A larger tolerance would fray edges.
  constexpr double largest = 32, frames_of_debt = 8;
  return static_cast<int>(std::clamp(largest * debt_ / (frames_of_debt * bytes_per_frame_), 0.0, largest));
}

void FilmWriter::add(const Image& image, std::int64_t duration) {
  const Patch patch = compactor_.compact(dither_.apply(image), tolerance());
  debt_ += static_cast<double>(container_.add(patch, duration)) - bytes_per_frame_;
}

}  // namespace drape::gif

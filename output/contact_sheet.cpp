#include "output/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/atomic_file.hpp"
#include "output/png_encoder.hpp"
#include "overlay/color_bar.hpp"
#include "render/montage.hpp"

namespace drape {
namespace {

constexpr int gap = 6;  // [pixels]
constexpr std::uint8_t paper = 255;

/// Cuts rows off the bottom of a picture and returns them.
Image cut_below(Image& picture, int rows) {
  Image below(picture.width, rows);
  const auto bytes = static_cast<std::ptrdiff_t>(below.pixels.size());
  std::copy(picture.pixels.end() - bytes, picture.pixels.end(), below.pixels.begin());
  picture.pixels.resize(picture.pixels.size() - below.pixels.size());
  picture.height -= rows;
  return below;
}

/// Appends a narrower picture below another, centred.
void put_below(Image& sheet, const Image& below) {
  const int left = (sheet.width - below.width) / 2, top = sheet.height;
  sheet.pixels.resize(sheet.pixels.size() + std::size_t{3} * sheet.width * below.height, paper);
  sheet.height += below.height;
  for (int y = 0; y < below.height; ++y) std::copy_n(below.at(0, y), 3 * below.width, sheet.at(left, top + y));
}

}  // namespace

bool is_spread(int index, int count, int shown) {
  if (count <= shown) return true;
  if (shown < 2) return index == 0;
  const auto place = [&](std::int64_t k) { return static_cast<int>(k * (count - 1) / (shown - 1)); };
  const int near = static_cast<int>(std::int64_t{index} * (shown - 1) / (count - 1));
  return place(near) == index || (near + 1 < shown && place(near + 1) == index);
}

ContactSheet::ContactSheet(std::filesystem::path file, const FilmInfo& film)
    : file_(std::move(file)),
      grid_(film.sheet.value()),
      first_frame_(film.first_frame),
      expected_frames_(std::max(1, film.expected_frames)),
      seconds_per_frame_(film.seconds_per_frame),
      bands_(film.bands) {
  require_writable(file_);
}

Image ContactSheet::labelled(Image picture, double time) {
  const int size = std::clamp(picture.height / 24, 12, 96), margin = size / 2;
  Image label(picture.width, Pen::line_height(size) + margin);
  std::fill(label.pixels.begin(), label.pixels.end(), paper);
  pen_.write(label, margin, size + margin / 2, fmt::format("t = {:.2f} s", time), size, band_ink);
  picture.height += label.height;
  picture.pixels.insert(picture.pixels.end(), label.pixels.begin(), label.pixels.end());
  return picture;
}

bool ContactSheet::needs(int index) const { return is_spread(index, expected_frames_, grid_.columns * grid_.rows); }

void ContactSheet::add(const Image& image) {
  const int index = added_++;
  if (!needs(index)) return;
  if (!pictures_.empty() && pictures_.front().width != image.width) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  Image picture = image;
  legend_ = cut_below(picture, bands_);
  pictures_.push_back(grid_.labelled ? labelled(std::move(picture), (first_frame_ + index) * seconds_per_frame_)
                                     : std::move(picture));
}

std::vector<OutputFile> ContactSheet::finish(Ending ending) {
  if (pictures_.empty()) return {};
  std::vector<const Image*> list;
  for (const Image& picture : pictures_) list.push_back(&picture);
  PartialFile file(file_);
  Image sheet = montage(list, grid_.columns, gap, paper);
  if (legend_.height > 0) put_below(sheet, legend_);
  file.write(encode_png(sheet));
  const std::uintmax_t size = file.commit(ending);
  return {{file.name(ending), size}};
}

}  // namespace drape

#include "overlay/caption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"

namespace drape {
namespace {

constexpr double panel_part = 0.8;  // opacity of a panel

enum class Across { left, middle, right };

struct Corner {
  Across across;
  bool bottom;
};

Corner corner_of(CaptionPlace place) {
  constexpr std::array across{Across::left, Across::middle, Across::right};
  const auto index = static_cast<std::size_t>(place);
  return {across[index % across.size()], index >= across.size()};
}

int margin_of(int size) { return size / 2 + 2; }

bool fits(Pen& pen, const std::string& text, int size, int width, int height) {
  const int across = width - 2 * margin_of(size), down = height - 2 * margin_of(size);
  if (across <= 0 || down < Pen::line_height(size)) return false;
  const std::vector<std::string> lines = pen.wrap(text, size, across);
  return static_cast<int>(lines.size()) * Pen::line_height(size) <= down &&
         std::ranges::all_of(lines, [&](const std::string& line) { return pen.width(line, size) <= across; });
}

}  // namespace

int text_size(int picture_height) { return std::clamp((picture_height + 11) / 22, 12, 96); }

int largest_caption_size(Pen& pen, const std::string& text, int most, int width, int height) {
  most = std::min(most, height);
  if (most >= least_text_size && fits(pen, text, most, width, height)) return most;
  int fit = 0;
  for (int low = least_text_size, high = most - 1; low <= high;) {
    const int size = (low + high) / 2;
    if (fits(pen, text, size, width, height)) {
      fit = size;
      low = size + 1;
    } else {
      high = size - 1;
    }
  }
  return fit;
}

void require_room(Pen& pen, const CaptionSettings& caption, const std::string& text, int width, int height) {
  const int wanted = caption.size.value_or(text_size(height));
  const int largest = largest_caption_size(pen, text, wanted, width, height);
  if (largest == 0) {
    throw UsageError(
        fmt::format("the caption is too long for a picture of {}x{} pixels, even with letters of {} pixels", width,
                    height, least_text_size));
  }
  if (caption.size && largest < *caption.size) {
    throw UsageError(
        fmt::format("a caption of size = {} does not fit into a picture of {}x{} pixels: the largest that fits "
                    "is size = {}",
                    *caption.size, width, height, largest));
  }
}

void draw_caption(Image& picture, Pen& pen, const CaptionSettings& caption, const std::string& text,
                  const Rgb& background) {
  const int fitting =
      largest_caption_size(pen, text, caption.size.value_or(text_size(picture.height)), picture.width, picture.height);
  const int size = std::max(fitting, least_text_size), margin = margin_of(size);
  const Rgb color = caption.color.value_or(contrasting(background));
  const std::vector<std::string> lines = pen.wrap(text, size, picture.width - 2 * margin);
  const int height = static_cast<int>(lines.size()) * Pen::line_height(size);
  const Corner corner = corner_of(caption.place);
  const int top = corner.bottom ? picture.height - margin - height : margin;
  const auto left_of = [&](int width) {
    if (corner.across == Across::left) return margin;
    return corner.across == Across::right ? picture.width - margin - width : (picture.width - width) / 2;
  };
  if (caption.backing == Backing::panel) {
    int widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, pen.width(line, size));
    const int room = size / 3;
    Pen::fill(picture, {left_of(widest) - room, top - room, widest + 2 * room, height + 2 * room}, contrasting(color),
              panel_part);
  }
  int base = top + size - size / 16;
  for (const std::string& line : lines) {
    pen.write(picture, left_of(pen.width(line, size)), base, line, size, color, caption.backing);
    base += Pen::line_height(size);
  }
}

}  // namespace drape

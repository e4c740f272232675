#include "overlay/caption.hpp"

#include <algorithm>
#include <array>

namespace drape {
namespace {

constexpr double panel_part = 0.8;  // of what is behind a panel that it covers

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

}  // namespace

int text_size(int picture_height) { return std::clamp((picture_height + 11) / 22, 12, 96); }

void draw_caption(Image& picture, Pen& pen, const CaptionSettings& caption, const std::string& text,
                  const Rgb& background) {
  const int size = caption.size.value_or(text_size(picture.height)), margin = size / 2 + 2;
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

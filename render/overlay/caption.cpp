#include "drape/render/overlay/caption.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "drape/core/error.hpp"

namespace drape {
namespace {

constexpr std::string_view digits = "0123456789";

/// Returns true for a format of {fmt} without names and numbers of arguments, and with widths of at most two digits.
bool well_formed(std::string_view format) {
  const auto take = [&](std::string_view any) {
    if (format.empty() || any.find(format.front()) == std::string_view::npos) return false;
    format.remove_prefix(1);
    return true;
  };
  const auto number = [&] { return !take(digits) || !take(digits) || !take(digits); };  // at most two digits
  if (format.size() > 1 && std::string_view("<>^").find(format[1]) != std::string_view::npos) format.remove_prefix(1);
  take("<>^");
  take("+- ");
  take("#");
  take("0");
  if (!number()) return false;
  if (take(".") && (format.empty() || digits.find(format.front()) == std::string_view::npos || !number())) return false;
  take("aAbBcdeEfFgGosxX");
  return format.empty();
}

std::string format_number(double number, const std::string& format) {
  return fmt::format(fmt::runtime("{:" + (format.empty() ? std::string(".6g") : format) + "}"), number);
}

struct FormatField {
  const std::string& format;

  std::string operator()(std::int64_t number) const {
    // Whole numbers accept formats with decimals.
    if (!format.empty() && std::string_view("eEfFgG").find(format.back()) != std::string_view::npos) {
      return format_number(static_cast<double>(number), format);
    }
    return fmt::format(fmt::runtime("{:" + format + "}"), number);
  }
  std::string operator()(double number) const { return format_number(number, format); }
  std::string operator()(const std::string& word) const { return fmt::format(fmt::runtime("{:" + format + "}"), word); }
  std::string operator()(const std::vector<double>& numbers) const {
    std::string text = "[";
    for (const double number : numbers) text += (text.size() > 1 ? ", " : "") + format_number(number, format);
    return text + "]";
  }
};

}  // namespace

std::string format_field(const FieldValue& value, const std::string& format) {
  try {
    if (well_formed(format)) return std::visit(FormatField{format}, value);
  } catch (const fmt::format_error&) {
    // reported below
  }
  throw std::invalid_argument(
      fmt::format("unknown format '{}'; {}", format,
                  std::holds_alternative<std::string>(value)
                      ? "text takes only a width, as in ':>12'"
                      : "a number takes one like ':.2f', ':.1e', ':.3g', ':6.1f' or, if it is whole, ':04'"));
}

TextTemplate::TextTemplate(std::string_view text) {
  std::string plain;
  const auto end_plain = [&] {
    if (!plain.empty()) pieces_.push_back({plain, false, {}});
    plain.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '{' && text[i] != '}') {
      plain += text[i];
    } else if (i + 1 < text.size() && text[i + 1] == text[i]) {
      plain += text[i++];
    } else if (text[i] == '}') {
      throw std::invalid_argument("there is a '}' without its '{'; write '}}' for a brace");
    } else {
      const std::size_t end = text.find_first_of("{}", i + 1);
      if (end == std::string_view::npos || text[end] == '{') {
        throw std::invalid_argument(fmt::format("'{}' has no '}}'; write '{{{{' for a brace",
                                                text.substr(i, std::min<std::size_t>(text.size() - i, 24))));
      }
      const std::string_view field = text.substr(i + 1, end - i - 1);
      const std::size_t colon = std::min(field.find(':'), field.size());
      end_plain();
      pieces_.push_back(
          {std::string(field.substr(0, colon)), true, std::string(field.substr(std::min(colon + 1, field.size())))});
      i = end;
    }
  }
  end_plain();
}

std::string TextTemplate::fill(const std::function<FieldValue(const std::string&)>& value) const {
  std::string text;
  for (const Piece& piece : pieces_)
    text += piece.is_field ? format_field(value(piece.text), piece.format) : piece.text;
  return text;
}

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

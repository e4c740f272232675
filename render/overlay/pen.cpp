#include "drape/render/overlay/pen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drape/render/image.hpp"

namespace drape {
namespace {

/// Returns the linear light of each sRGB byte.
const std::array<float, 256>& light_of_bytes() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i) {
      light[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255));
    }
    return light;
  }();
  return table;
}

/// Returns the index of a pixel in rows of the given width.
std::size_t place(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// Blends a colour over a pixel.
/// @param part covered fraction of the pixel
void blend(Image& image, int x, int y, const Eigen::Vector3f& light, float part) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || part <= 0) return;
  std::uint8_t* const pixel = image.at(x, y);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const double mixed = std::lerp(light_of_bytes()[pixel[c]], light[c], std::min(part, 1.0F));
    pixel[c] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(std::clamp(mixed, 0.0, 1.0))));
  }
}

/// Squared distance transform: replaces each f(q) by the least (p − q)² + f(p), the lower envelope of parabolas (P.
/// Felzenszwalb and D. Huttenlocher 2012, Distance Transforms of Sampled Functions, algorithm 1).
class SquaredDistances {
 public:
  explicit SquaredDistances(int longest)
      : values_(static_cast<std::size_t>(longest)), centres_(values_.size()), begins_(values_.size() + 1) {}

  /// @param stride distance between the `count` numbers
  void along(double* f, std::size_t count, std::size_t stride) {
    for (std::size_t q = 0; q < count; ++q) values_[q] = f[q * stride];
    std::size_t last = 0;
    centres_[0] = 0;
    begins_[0] = -std::numeric_limits<double>::infinity();
    for (std::size_t q = 1; q < count; ++q) {
      double begin = meet(q, centres_[last]);
      while (begin <= begins_[last]) begin = meet(q, centres_[--last]);
      centres_[++last] = q;
      begins_[last] = begin;
    }
    begins_[last + 1] = std::numeric_limits<double>::infinity();
    for (std::size_t q = 0, k = 0; q < count; ++q) {
      while (begins_[k + 1] < static_cast<double>(q)) ++k;
      const double away = static_cast<double>(q) - static_cast<double>(centres_[k]);
      f[q * stride] = away * away + values_[centres_[k]];
    }
  }

  static constexpr double far = 1e12;  // exceeds every squared distance in a picture

 private:
  /// Returns the position where the parabola around q > p falls below the one around p.
  [[nodiscard]] double meet(std::size_t q, std::size_t p) const {
    const auto at_q = static_cast<double>(q), at_p = static_cast<double>(p);
    return (values_[q] - values_[p] + at_q * at_q - at_p * at_p) / (2 * (at_q - at_p));
  }

  std::vector<double> values_;
  std::vector<std::size_t> centres_;  // of the envelope's parabolas
  std::vector<double> begins_;        // start of each parabola's part
};

/// Returns each pixel's distance from the letters; a partly covered pixel is as far away as its uncovered fraction.
std::vector<double> distances_from(const std::vector<float>& coverage, int width, int height) {
  std::vector<double> distances(coverage.size());
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const double left = 1 - coverage[i];
    distances[i] = coverage[i] > 0 ? left * left : SquaredDistances::far;
  }
  SquaredDistances squared(std::max(width, height));
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  for (std::size_t x = 0; x < columns; ++x) squared.along(distances.data() + x, rows, columns);
  for (std::size_t y = 0; y < rows; ++y) squared.along(distances.data() + y * columns, columns, 1);
  for (double& distance : distances) distance = std::sqrt(distance);
  return distances;
}

double luminance(const Rgb& color) {
  return 0.2126 * srgb_to_linear(color.r) + 0.7152 * srgb_to_linear(color.g) + 0.0722 * srgb_to_linear(color.b);
}

}  // namespace

Rgb contrasting(const Rgb& color) {
  constexpr double flare = 0.05;
  const double on_white = (1 + flare) / (luminance(color) + flare), on_black = (luminance(color) + flare) / flare;
  return on_white >= on_black ? Rgb{1, 1, 1} : Rgb{0, 0, 0};
}

int Pen::width(const std::string& line, int size) {
  double at = 0;
  for (const char32_t c : characters(line)) at += fonts_.glyph(c, size).advance;
  return static_cast<int>(std::ceil(at));
}

std::vector<std::string> Pen::wrap(const std::string& text, int size, int width) {
  std::vector<std::string> lines(1);
  const auto fits = [&](const std::string& line) { return this->width(line, size) <= width; };
  const auto add_letters = [&](const std::string& word) {
    for (std::size_t i = 0; i < word.size();) {
      std::size_t end = i + 1;
      while (end < word.size() && (static_cast<unsigned char>(word[end]) & 0xC0U) == 0x80U) ++end;
      const std::string letter = word.substr(i, end - i);
      if (!lines.back().empty() && !fits(lines.back() + letter)) lines.emplace_back();
      lines.back() += letter;
      i = end;
    }
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (fits(longer)) {
      lines.back() = longer;
    } else {
      if (!lines.back().empty()) lines.emplace_back();
      add_letters(word);
    }
    if (end < text.size() && text[end] == '\n') lines.emplace_back();
    begin = end + 1;
  }
  return lines;
}

Pen::Mask Pen::mask(const std::string& line, int size, int rim) {
  const std::u32string letters = characters(line);
  Mask mask;
  mask.box = {-rim - size, -rim - 2 * size, width(line, size) + 2 * (rim + size), 3 * size + 2 * rim};
  mask.coverage.assign(static_cast<std::size_t>(mask.box.width) * static_cast<std::size_t>(mask.box.height), 0);
  double at = 0;
  for (const char32_t letter : letters) {
    const Glyph& glyph = fonts_.glyph(letter, size);
    const int left = static_cast<int>(std::lround(at)) + glyph.left - mask.box.left, top = -glyph.top - mask.box.top;
    for (int y = 0; y < glyph.height; ++y) {
      for (int x = 0; x < glyph.width; ++x) {
        const int column = left + x, row = top + y;
        if (column < 0 || row < 0 || column >= mask.box.width || row >= mask.box.height) continue;
        float& to = mask.coverage[place(column, row, mask.box.width)];
        to = std::max(to, static_cast<float>(glyph.coverage[place(x, y, glyph.width)]) / 255);
      }
    }
    at += glyph.advance;
  }
  return mask;
}

// Coverage falls with the distance from the letters: full beside them, zero at the radius.
Pen::Mask Pen::widened(const Mask& letters, int radius) {
  Mask wide{letters.box, std::vector<float>(letters.coverage.size(), 0)};
  const double reach = radius + 1;
  const std::vector<double> distances = distances_from(letters.coverage, letters.box.width, letters.box.height);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    wide.coverage[i] = static_cast<float>(std::clamp(1.6 * (1 - distances[i] / reach), 0.0, 1.0));
  }
  return wide;
}

void Pen::stamp(Image& image, const Mask& mask, int left, int base, const Rgb& color, float strength) {
  const Eigen::Vector3f light = linear_color(color);
  for (int y = 0; y < mask.box.height; ++y) {
    for (int x = 0; x < mask.box.width; ++x) {
      const float part = mask.coverage[place(x, y, mask.box.width)];
      blend(image, left + mask.box.left + x, base + mask.box.top + y, light, strength * part);
    }
  }
}

void Pen::write(Image& image, int left, int base, const std::string& line, int size, const Rgb& color,
                Backing backing) {
  const int rim = backing == Backing::halo ? std::max(2, size / 7) : 0;
  const Mask letters = mask(line, size, rim);
  if (rim > 0) stamp(image, widened(letters, rim), left, base, contrasting(color), 0.85F);
  stamp(image, letters, left, base, color, 1);
}

void Pen::line(Image& image, double x0, double y0, double x1, double y1, double width, const Rgb& color) {
  const Eigen::Vector3f light = linear_color(color);
  const double reach = width / 2 + 1, dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
  const auto low = [&](double a, double b) { return static_cast<int>(std::floor(std::min(a, b) - reach)); };
  const auto high = [&](double a, double b) { return static_cast<int>(std::ceil(std::max(a, b) + reach)); };
  for (int y = low(y0, y1); y <= high(y0, y1); ++y) {
    for (int x = low(x0, x1); x <= high(x0, x1); ++x) {
      const double px = x + 0.5 - x0, py = y + 0.5 - y0;
      const double along = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0;
      const double away = std::hypot(px - along * dx, py - along * dy);
      blend(image, x, y, light, static_cast<float>(std::clamp(width / 2 + 0.5 - away, 0.0, 1.0)));
    }
  }
}

void Pen::fill(Image& image, const PictureBox& box, const Rgb& color, double part) {
  const Eigen::Vector3f light = linear_color(color);
  for (int y = box.top; y < box.bottom(); ++y) {
    for (int x = box.left; x < box.right(); ++x) blend(image, x, y, light, static_cast<float>(part));
  }
}

}  // namespace drape

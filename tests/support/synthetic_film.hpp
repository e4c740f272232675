#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "drape/render/image.hpp"

namespace drape::test {

using Color = std::array<std::uint8_t, 3>;

inline Image plain_image(int width, int height, Color color) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = color[i % 3];
  return image;
}

/// Makes a frame as hard to encode as a rendered one: a waving cloth, checked, woven and shaded, and a moving glossy
/// red ball, on a plain background. The top row and the leftmost column show only background.
inline Image synthetic_frame(int k, int width, int height, Color background = {255, 255, 255}) {
  Image image = plain_image(width, height, background);
  const auto put = [&](int x, int y, double r, double g, double b) {
    const std::array<double, 3> rgb{r, g, b};
    for (int c = 0; c < 3; ++c)
      image.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(std::clamp(rgb[c], 0.0, 255.0)));
  };
  for (int y = 1; y < height; ++y) {
    for (int x = 1; x < width; ++x) {
      const double u = (x - 0.25 * width - 20 * std::sin(0.1 * k + 0.02 * y)) / (0.5 * width);
      const double v = (y - 0.12 * height - 15 * std::sin(0.13 * k + 0.03 * x)) / (0.45 * height);
      if (u > 0 && u < 1 && v > 0 && v < 1) {
        const double light = 0.7 + 0.3 * std::sin(9 * u + 4 * v + 0.15 * k) * std::cos(5 * v - 0.1 * k);
        const double weave = 1 - 0.12 * ((static_cast<int>(u * 160) + 2 * static_cast<int>(v * 120)) % 4 == 0);
        const int red = (std::fmod(12 * u, 1) < 0.45) + (std::fmod(12 * v, 1) < 0.45);
        constexpr double colors[3][3] = {{238, 232, 205}, {215, 130, 125}, {185, 40, 50}};
        const double s = light * weave;
        put(x, y, s * colors[red][0], s * colors[red][1], s * colors[red][2]);
      }
      const double nx = (x - 0.5 * width - 30 * std::sin(0.05 * k)) / (0.2 * height);
      const double ny = (y - 0.74 * height) / (0.2 * height);
      const double depth = 1 - nx * nx - ny * ny;
      if (depth <= 0) continue;
      const double light = std::max(0.0, -0.4 * nx - 0.6 * ny + 0.69 * std::sqrt(depth));
      const double gloss = 200 * std::pow(light, 40), shade = 0.25 + 0.75 * light;
      put(x, y, 191 * shade + gloss, 10 * shade + gloss, 10 * shade + gloss);
    }
  }
  return image;
}

}  // namespace drape::test

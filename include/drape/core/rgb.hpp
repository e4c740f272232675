#pragma once

namespace drape {

/// A colour as people write it: sRGB-encoded, each channel in [0, 1].
struct Rgb {
  double r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

}  // namespace drape

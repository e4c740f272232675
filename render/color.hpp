#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/rgb.hpp"

namespace drape {

/// Converts an sRGB-encoded value in [0, 1] to linear light in [0, 1] (IEC 61966-2-1).
inline double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Inverts srgb_to_linear().
inline double linear_to_srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

inline Eigen::Vector3f linear_color(const Rgb& color) {
  return Eigen::Vector3d(srgb_to_linear(color.r), srgb_to_linear(color.g), srgb_to_linear(color.b)).cast<float>();
}

}  // namespace drape

#pragma once

#include <vector>

#include "drape/render/image.hpp"

namespace drape {

/// A value per pixel, rows from top to bottom.
struct ErrorMap {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// Returns the pixels per degree of the observer assumed by the authors of FLIP, 67.02. The display is 0.7 m wide with
/// 3840 columns, seen from 0.7 m.
double default_pixels_per_degree();

/// Computes the visible difference of two alternating pictures, 0 (none) to 1 per pixel. Border pixels are repeated
/// outside. Source: LDR-FLIP of Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A
/// Difference Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques
/// 3(2), 2020.
/// @throws std::invalid_argument if the pictures have different sizes
ErrorMap flip_error(const Image& reference, const Image& test, double pixels_per_degree = default_pixels_per_degree());

/// Returns the map in the colours of "magma", from black (0) to pale yellow (1).
Image magma(const ErrorMap& map);

}  // namespace drape

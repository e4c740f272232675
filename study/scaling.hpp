#pragma once

#include <array>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "run/progress.hpp"
#include "study/measure.hpp"

namespace drape {

struct ScalingOptions {
  int largest = 80;  ///< cells along a side of the largest grid
  RunCount runs = {};
};

/// Where the time of a step goes, as shares of it that sum to 1.
struct TimeShares {
  double local = 0;     ///< the springs' energies and forces
  double assembly = 0;  ///< the blocks of Newton's matrix
  double product = 0;   ///< products with Newton's matrix, of the conjugate gradients
  double global = 0;    ///< the triangles of the constant factor: the global step, and Newton's preconditioner
  double vectors = 0;   ///< sums and scalar products of vectors
  double contact = 0;   ///< effects: the sphere
  double rest = 0;      ///< all else; with linear_solver = "cholesky", Newton's matrix, its factor and its solution
};

/// A method on a grid.
struct ScalingPoint {
  std::string method;  ///< "implicit, cholesky"
  int cells = 0;       ///< along a side
  double vertices = 0;
  StudyCase what;
  double step = 0;        ///< h [s]
  double iterations = 0;  ///< mean of a step; 0 for a method that has none
  MedianInterval time;    ///< of a step [µs]
  MedianInterval setup;   ///< before the first step, with the factor of the constant matrix [µs]
  double factor = 0;      ///< of that, the constant matrix alone: assembled, analysed, factored [µs]
  double memory = 0;      ///< of the simulation, after steps [bytes]
  TimeShares shares;
};

struct ScalingStudy {
  std::vector<ScalingPoint> points;  ///< by method, then by grid
  std::vector<std::string> notes;    ///< what did not fit
  ScalingOptions options;
  double seconds = 0;
};

/// Measures every method on grids of 10×10, 20×20, 40×40 … cells: the homework's cloth with the sphere, k = 180 N/m,
/// from the same state in which it touches the sphere.
/// @returns nothing if it was stopped
std::optional<ScalingStudy> study_scaling(const ScalingOptions& options, const std::stop_token& stop,
                                          Progress& progress);

}  // namespace drape

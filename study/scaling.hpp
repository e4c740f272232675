#pragma once

#include <array>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "run/progress.hpp"
#include "study/measure.hpp"
#include "study/report.hpp"

namespace drape {

struct ScalingOptions {
  std::set<int> grids = {10, 20, 40, 80};  ///< cells along a side
  RunCount runs = {};
};

/// Shares of a step's time, with sum 1.
struct TimeShares {
  double local = 0;     ///< the springs' energies and forces
  double assembly = 0;  ///< blocks of Newton's matrix
  double product = 0;   ///< products with Newton's matrix in conjugate gradients
  double global = 0;    ///< triangular solves with the constant factor: the global step, and Newton's preconditioner
  double vectors = 0;   ///< sums and scalar products of vectors
  double contact = 0;   ///< effects: the sphere
  double rest = 0;      ///< all else; for linear_solver = "cholesky" also Newton's matrix, factor and solution
};

/// The measurements of a method on a grid.
struct ScalingPoint {
  std::string method;  ///< "implicit, cholesky"
  int cells = 0;       ///< cells along a side
  double vertices = 0;
  StudyCase study_case;
  double step = 0;        ///< step length h [s]
  double iterations = 0;  ///< mean per step; 0 for a method without iterations
  MedianInterval time;    ///< time per step [µs]
  MedianInterval setup;   ///< time before the first step, with the factorisation of the constant matrix [µs]
  double factor = 0;      ///< assembly, analysis and factorisation of the constant matrix alone [µs]
  double memory = 0;      ///< memory of the simulation after some steps [bytes]
  TimeShares shares;
};

struct ScalingStudy {
  std::vector<ScalingPoint> points;  ///< sorted by method, then by grid
  std::vector<std::string> notes;    ///< grids that did not fit
  ScalingOptions options;
  double seconds = 0;
};

/// Measures every method on square grids: the homework's cloth with the sphere, k = 180 N/m.
/// All methods start from the same state, in contact with the sphere.
/// @returns nothing if stopped
std::optional<ScalingStudy> study_scaling(const ScalingOptions& options, const std::stop_token& stop,
                                          Progress& progress);

/// Returns the report of a study for all output formats.
StudyReport scaling_report(const ScalingStudy& study);

}  // namespace drape

#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A motion of a case's cloth, of drape's or another simulator's making.
struct ObservedMotion {
  Cloth cloth;                       ///< as the case's scene begins
  std::vector<double> times;         ///< ascending [s]
  std::vector<Vertices> positions;   ///< at these times, n×3 [m]
  std::vector<Vertices> velocities;  ///< likewise [m/s]; empty: unknown
  std::vector<double> elastic;       ///< energy of springs and bending, likewise [J]; empty: unknown
};

/// The names of all measures.
std::vector<std::string> measure_names();

/// Measures a motion.
/// @param measure one of measure_names()
/// @param given   numbers that the measure needs, by name
/// @returns quantities by name
/// @throws UsageError if the motion is too short, or something that the measure needs is not there
std::map<std::string, double> measure_motion(const std::string& measure, const ObservedMotion& motion,
                                             const std::map<std::string, double>& given);

}  // namespace drape

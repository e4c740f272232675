#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A motion of a case's cloth, by drape or another simulator.
struct ObservedMotion {
  Cloth cloth;                       ///< cloth at the start of the case's scene
  std::vector<double> times;         ///< times of the states, ascending [s]
  std::vector<Vertices> positions;   ///< vertex positions at these times, n×3 [m]
  std::vector<Vertices> velocities;  ///< vertex velocities at these times, n×3 [m/s]; empty: unknown
  std::vector<double> elastic;       ///< energy of springs and bending at these times [J]; empty: unknown
};

/// Returns the names of all measures.
std::vector<std::string> measure_names();

/// Measures a motion.
/// @param measure one of measure_names()
/// @param given   numbers for the measure, by name
/// @returns quantities by name
/// @throws UsageError if the motion is too short, or lacks data that the measure needs
std::map<std::string, double> measure_motion(const std::string& measure, const ObservedMotion& motion,
                                             const std::map<std::string, double>& given);

}  // namespace drape

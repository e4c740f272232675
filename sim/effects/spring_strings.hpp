#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A spring's position in a string: a chain of springs, each continued at its end by the straightest neighbour.
struct StringLink {
  std::size_t spring;  ///< number in the cloth
  int from, to;        ///< ends, in the direction of the string
  bool joined;         ///< true if it continues the previous link
};

/// Groups springs into strings, each spring once. A string passes through free vertices in the direction straightest at
/// rest, and ends where no spring is within 37° of it. On a grid the strings are the lines and diagonals.
/// @param springs numbers of the springs to group
std::vector<StringLink> lay_out_strings(const Cloth& cloth, const std::vector<std::size_t>& springs);

/// A pulling spring in a string, with the change of its tension.
struct Tension {
  Eigen::Vector3d along;  ///< unit direction of the pull
  double weight;          ///< sum of 1/m of both ends [1/kg]
  double coupling;        ///< lengthening of this spring by the tension of the previous one, and vice versa [1/kg]
  double excess;          ///< length beyond the limit at the current tension [m]
  double pull;            ///< current tension, not negative; springs at 0 stay there [kg·m]
  double more = 0;        ///< result: change of the tension, at least −pull [kg·m]

  // For the elimination.
  bool slack = false;
  double next = 0;
};

/// Finds the changes of a string's tensions such that no spring is too long, and none that could pull less is too
/// short. Solves a tridiagonal system without the springs that would have to push.
void balance(std::span<Tension> string);

}  // namespace drape

#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A spring's place in a string: one after another, at each vertex the next is the one that goes on straightest.
struct StringLink {
  std::size_t spring;  ///< its number in the cloth
  int from, to;        ///< its ends, in the direction of the string
  bool joined;         ///< whether it goes on from the link before it
};

/// Lays the springs out in strings, each spring once. Strings go through vertices that are no pins, by what is straight
/// at rest, and end where nothing goes on within 37° of straight. On a grid they are its lines and diagonals.
/// @param springs the numbers of those that are laid out
std::vector<StringLink> lay_out_strings(const Cloth& cloth, const std::vector<std::size_t>& springs);

/// A spring that pulls, in a string of them, and by how much more it should.
struct Tension {
  Eigen::Vector3d along;  ///< of length 1, the direction that it pulls in
  double weight;          ///< 1/m of both of its ends [1/kg]
  double coupling;        ///< by how much the one before it lengthens it, and the other way round [1/kg]
  double excess;          ///< by how much it is too long as it pulls now [m]
  double pull;            ///< that, not negative; it remains 0 [kg·m]
  double more = 0;        ///< the result, at least −pull [kg·m]

  // Of the elimination.
  bool slack = false;
  double next = 0;
};

/// Finds what all of a string have to pull more so that none is too long, and none that could pull less is too short:
/// a tridiagonal system, without those that would have to push.
void balance(std::span<Tension> string);

}  // namespace drape

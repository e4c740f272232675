#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drape/sim/settings.hpp"

namespace drape {

/// Part of a cloth that is inside an obstacle, across one, or across itself.
struct Overlap {
  std::vector<int> vertices;  ///< unpinned vertices inside a solid, ascending
  /// Triangles with such a vertex, crossed by an edge, or next to an edge that crosses a triangle, ascending. Triangles
  /// with pins are left out for obstacles.
  std::vector<int> triangles;
  double depth = 0;     ///< of the deepest vertex, below the drawn surface [m]
  bool contact = true;  ///< false: with a sphere that pushes, in which cloth may be
};

/// Returns true if an effect lets the cloth begin inside or across it: its key allow_overlap.
bool allows_overlap(const Effect& effect);

/// Finds the overlap of the cloth with one of the effects. Features nearer than a thickness do not overlap.
/// @param effect its number in the settings
/// @param x      positions of the cloth, n×3 [m]
/// @param time   [s]
/// @returns nothing without an overlap, or if nothing can touch the effect
std::optional<Overlap> find_overlap(const SimulationSettings& settings, std::size_t effect, const Vertices& x,
                                    double time);

/// An overlap at the start, with the number of its effect.
struct StartOverlap {
  std::size_t effect;
  Overlap overlap;
};
/// Finds the overlaps with effects that allow it, and with spheres that push.
std::vector<StartOverlap> start_overlaps(const SimulationSettings& settings);

/// Returns a description: "12 vertices inside the body, up to 0.03 m deep, and 20 triangles (numbers 3, 4, 7 …), the
/// first at [0, 0.1, 0.2]".
std::string describe(const StartOverlap& overlap, const SimulationSettings& settings);

/// Returns the notice for one of start_overlaps(): "the cloth begins with …: they are separated step by step".
std::string overlap_advice(const StartOverlap& overlap, const SimulationSettings& settings);

/// Returns true if the cloth begins across an obstacle or itself, or nearer than its contact distance. Separation then
/// does work on it.
bool begins_too_near(const SimulationSettings& settings);

}  // namespace drape

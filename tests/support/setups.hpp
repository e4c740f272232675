#pragma once

#include <string>
#include <vector>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/settings.hpp"
#include "tests/support/methods.hpp"

namespace drape::test {

/// Makes settings without effects, which tests extend. A step ends at a change below 1e-3 m.
SimulationSettings setup(Cloth cloth, Solver solver, double step);

/// Makes a cloth of a mesh that is its own rest shape.
Cloth cloth_of(const Mesh& mesh, double mass, double stiffness, std::vector<int> pins);

/// Makes the homework's cloth: 20×20 cells, 1 kg, pinned at vertices 0 and 20, under gravity; h in s, k in N/m.
SimulationSettings homework(Solver solver, double step, double stiffness);

/// Makes the homework's sphere, of radius 0.4 m around (0, 0, −0.5), pushing within 0.44 m.
Sphere homework_sphere();
inline const Eigen::RowVector3d homework_sphere_center(0, 0, -0.5);

/// Makes the homework's damping 0.2, as in its scene files.
Damping homework_damping();

/// Returns the problems that Effect::check finds in these settings, each "key: sentence".
std::vector<std::string> problems(const Effect& effect, const SimulationSettings& settings);

/// Steps of the homework's whole timeline of 250/30 s in its two step lengths.
inline constexpr int homework_steps = 417;         ///< h = 0.02 s
inline constexpr int homework_small_steps = 8334;  ///< h = 0.001 s

/// Returns 0, 1, … count−1: pins for every vertex.
std::vector<int> every(int count);

/// Returns n×3 numbers in [−1, 1), determined by the seed.
Vertices random_vertices(Eigen::Index count, int seed);

/// Returns true if two states have the same bits.
bool same_bits(const Vertices& a, const Vertices& b);

}  // namespace drape::test

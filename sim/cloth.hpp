#pragma once

// Example:
//   const drape::Mesh rest = drape::make_grid(10, 10);
//   drape::Mesh start = rest;
//   start.positions.col(2).array() += 1;  // a metre above where it was cut
//   drape::Cloth cloth = drape::make_cloth(start, rest, 0.5, 100, {});
//   drape::share_mass_by_area(0.3, cloth);  // 0.3 kg/m²

#include <Eigen/Core>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// A spring between two vertices: E = stiffness/2 · (‖x_i − x_j‖ − rest_length)².
struct Spring {
  int i = 0, j = 0;        ///< i < j
  double rest_length = 0;  ///< [m]
  double stiffness = 0;    ///< [N/m]
};

/// A cloth as it is before the first step. Nothing in here changes while it is simulated.
struct Cloth {
  Vertices positions;   ///< n×3 [m]
  Vertices velocities;  ///< n×3 [m/s]
  Vertices rest;        ///< n×3, the shape without strain [m]
  std::vector<Triangle> triangles;
  std::vector<Spring> springs;
  Eigen::VectorXd masses;  ///< n, all positive [kg]
  std::vector<int> pins;   ///< vertices that do not move, ascending, each once

  [[nodiscard]] int vertex_count() const { return static_cast<int>(positions.rows()); }
};

/// The diagonal of the box around the cloth as it starts, or the rest length of its longest spring if larger [m].
double size_of(const Cloth& cloth);

/// The homework's cloth: one spring per edge of `rest`, with the edge's length and the same stiffness everywhere, and
/// the total mass shared equally among all vertices.
/// @param start    the mesh whose positions the cloth starts from, at rest
/// @param rest     the same triangles in the shape whose edge lengths are the rest lengths
/// @param mass     of the whole cloth, positive [kg]
/// @param stiffness of every spring, positive [N/m]
/// @param pins     vertices that do not move, in any order
/// @throws std::invalid_argument if start and rest do not match, or a triangle's corner or a pin is not a vertex
Cloth make_cloth(const Mesh& start, const Mesh& rest, double mass, double stiffness, std::vector<int> pins);

/// Gives every vertex the mass of a third of each rest triangle at it, so that the mesh does not matter: fine and
/// coarse parts of a sheet have the same mass per area.
/// @param density of the cloth, positive [kg/m²]
/// @throws std::invalid_argument if a vertex has no triangle with an area
void share_mass_by_area(double density, Cloth& cloth);

/// Gives every spring the stiffness E·A/l², l its rest length and A the area of the rest triangles at it (Van Gelder
/// 1998, "Approximate simulation of elastic membranes by triangulated spring meshes"), so that a force stretches a
/// sheet by the same amount however fine its mesh is. What E means depends on the mesh. Per area the springs at angles
/// θ hold ½E·3⟨ε(θ)²⟩ where edges have all directions alike: that is the uniaxial stiffness E with a Poisson's ratio of
/// 1/3. On a grid with one diagonal it is E along the edges while shear is free to follow, with no contraction, and 1.2
/// E where shear is held (docs/scene-format.md).
/// @param modulus E, force per width and strain, positive [N/m]
/// @throws std::invalid_argument if a spring has no triangle with an area
void stiffen_by_area(double modulus, Cloth& cloth);

}  // namespace drape

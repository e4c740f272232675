#pragma once

// Example:
//   const drape::Mesh rest = drape::make_grid(10, 10);
//   drape::Mesh start = rest;
//   start.positions.col(2).array() += 1;  // a metre above where it was cut
//   drape::Cloth cloth = drape::make_cloth(start, rest, 0.5, 100, {});
//   drape::share_mass_by_area(0.3, cloth);  // 0.3 kg/m²
//   drape::Cloth both;  // two cloths in one simulation
//   drape::append("table cloth", cloth, both);
//   drape::append("napkin", cloth, both);

// Example:
//   for (const drape::Fabric& fabric : drape::fabrics()) std::printf("%g N/m", fabric.modulus.warp);

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drape/core/warp_weft.hpp"
#include "drape/sim/mesh.hpp"

namespace drape {

/// A spring between two vertices: E = stiffness/2 · (‖x_i − x_j‖ − rest_length)².
struct Spring {
  int i = 0, j = 0;        ///< i < j
  double rest_length = 0;  ///< [m]
  double stiffness = 0;    ///< [N/m]
};

/// One of several cloths of a simulation: its name, and its ranges of vertices and triangles.
struct ClothPiece {
  std::string name;
  int first_vertex = 0, vertex_count = 0;
  int first_triangle = 0, triangle_count = 0;

  [[nodiscard]] bool has(int vertex) const { return vertex >= first_vertex && vertex < first_vertex + vertex_count; }
};

/// A vertex that a seam ties to a point of an edge of the other side.
struct SeamTie {
  int vertex = 0;
  std::array<int, 2> edge = {};  ///< ends of that edge; twice the same vertex: tied to that vertex
  double share = 0;              ///< position of the point on the edge, 0 at its first end to 1
  double length = 0;             ///< distance of vertex and point at the start [m]
};

/// A seam that pulls its ties together: at the time t each is at most length·(1 − t/time) long, and from `time` on it
/// is closed.
struct Seam {
  double time = 0;  ///< [s]
  std::vector<SeamTie> ties = {};
  std::array<std::vector<int>, 2> sides = {};  ///< vertices of both sides, in order along the seam
};

/// The initial state of a cloth, constant during a simulation. It may consist of several cloths.
struct Cloth {
  Vertices positions;   ///< n×3 [m]
  Vertices velocities;  ///< n×3 [m/s]
  Vertices rest;        ///< n×3, unstrained shape [m]
  std::vector<Triangle> triangles;
  std::vector<Spring> springs;
  Eigen::VectorXd masses;               ///< n, all positive [kg]
  std::vector<int> pins;                ///< fixed vertices, ascending, without duplicates
  std::vector<ClothPiece> pieces = {};  ///< the cloths that it consists of, in order; empty: one without a name
  std::vector<Seam> seams = {};

  [[nodiscard]] int vertex_count() const { return static_cast<int>(positions.rows()); }
};

/// Appends a cloth to others: its vertices and triangles follow theirs. It becomes a piece with this name.
void append(const std::string& name, const Cloth& one, Cloth& all);

/// Returns the piece with a name, or null.
const ClothPiece* find_piece(const Cloth& cloth, std::string_view name);

/// Returns the number of each vertex's piece; empty for less than two pieces.
std::vector<int> pieces_of_vertices(const Cloth& cloth);

/// Returns a copy of the cloth with only the triangles and springs of one piece. It keeps all vertices.
Cloth only_piece(const Cloth& cloth, const ClothPiece& piece);

/// Returns the diagonal of the cloth's initial bounding box, or the largest rest length if longer [m].
double size_of(const Cloth& cloth);

/// Returns the homework's cloth: one spring per edge of `rest`, with the edge's length as rest length. All springs have
/// the same stiffness, and all vertices the same mass.
/// @param start    mesh with the initial positions; the cloth starts at rest
/// @param rest     the same triangles in the unstrained shape
/// @param mass     of the whole cloth, positive [kg]
/// @param stiffness of every spring, positive [N/m]
/// @param pins     fixed vertices, in any order
/// @throws std::invalid_argument if start and rest do not match, or a triangle's corner or a pin is not a vertex
Cloth make_cloth(const Mesh& start, const Mesh& rest, double mass, double stiffness, std::vector<int> pins);

/// Gives every vertex a third of the mass of each rest triangle at it. So fine and coarse parts of a sheet have the
/// same mass per area.
/// @param density of the cloth, positive [kg/m²]
/// @throws std::invalid_argument if a vertex has no triangle with an area
void share_mass_by_area(double density, Cloth& cloth);

/// Gives every spring the stiffness E·A/l², with rest length l and area A of the rest triangles at it (Van Gelder 1998,
/// "Approximate simulation of elastic membranes by triangulated spring meshes"). So a force stretches a sheet by the
/// same amount on fine and coarse meshes. The meaning of E depends on the mesh. Springs at angles θ store ½E·3⟨ε(θ)²⟩
/// per area if edges have all directions equally. That is the uniaxial stiffness E with a Poisson's ratio of 1/3. On a
/// grid with one diagonal it is E along the edges, without contraction, if shear is free, and 1.2 E if shear is held
/// (docs/reference/scene-format.md).
/// @param modulus E, force per width and strain, positive [N/m]
/// @throws std::invalid_argument if a spring has no triangle with an area
void stiffen_by_area(double modulus, Cloth& cloth);

/// Returns the angle from the first side of a triangle of the rest shape to the warp, counterclockwise as seen from the
/// triangle's front [rad]. The warp lies in the triangle's plane above or below the direction (cos, sin, 0). Nothing if
/// the triangle has no area or is perpendicular to that.
/// @param angle of the direction, see WarpWeft [rad]
std::optional<double> warp_angle(const Cloth& cloth, const Triangle& triangle, double angle);

/// Gives every spring the stiffness F(θ)·A/l², with rest length l, area A of the rest triangles at it, and angle θ from
/// the warp. F is chosen such that a sheet has the modulus E₁ along the warp and E₂ along the weft.
///
/// Springs with Σ k l² n⊗n⊗n⊗n = C per area store ½ ε:C:ε under a uniform strain. C has all symmetries, so the
/// stiffness in shear C₁₂₁₂ is C₁₁₂₂. The C of this cloth is C₁₁₁₁ = 9/8 E₁, C₂₂₂₂ = 9/8 E₂, C₁₁₂₂ = 3/8 √(E₁E₂): the
/// orthotropic sheet of Huber 1923 with the Poisson's ratios √(E₁/E₂)/3 and √(E₂/E₁)/3. Pulled at an angle θ from the
/// warp it has 1/√E(θ) = cos²θ/√E₁ + sin²θ/√E₂. For E₁ = E₂ that is the isotropic sheet of stiffen_evenly().
///
/// F(θ) = a₀ + a₁ cos 2θ + b₁ sin 2θ + a₂ cos 4θ + b₂ sin 4θ has as many coefficients as C has numbers. If springs have
/// all directions equally, F(θ) = 3/8 (E₁ + E₂) + ¼ √(E₁E₂) + ¾ (E₁ − E₂) cos 2θ + ¾ (√E₁ − √E₂)² cos 4θ, which is
/// positive if neither modulus is nine times the other. Springs in few directions, as in a grid with one diagonal, have
/// no such C.
/// @param modulus E₁, E₂, force per width and strain, positive [N/m]
/// @throws std::invalid_argument with a sentence, if the mesh's edges cannot have this C, or a spring would push
void stiffen_as_woven(const WarpWeft& modulus, Cloth& cloth);

/// Gives every spring the stiffness E(θ)·A/l² with the E(θ) of stiffen_as_woven(), or √(E₁E₂) if the warp has no
/// direction there. It fits every mesh, as stiffen_by_area() does. A grid with one diagonal has E₁ and E₂ along its
/// sides while shear is free; between the directions of its edges a mesh with few of them deviates.
/// @throws std::invalid_argument if a spring has no triangle with an area
void stiffen_by_direction(const WarpWeft& modulus, Cloth& cloth);

/// A fabric, as represented by a cloth with one density, and a modulus and a rigidity along its warp and its weft.
///
/// Most are measured by Wang, O'Brien and Ramamoorthi 2011, "Data-Driven Elastic Models for Cloth: Modeling and
/// Measurement", whose tables of ten fabrics come with ARCSim. They change with strain; these values hold for small
/// strains. Their energy is ½·2c₁₁·ε₁² + ½·2c₂₂·ε₂² + …, with axis 1 along the weft and axis 2 along the warp. So the
/// moduli are E₁ = 2c₂₂ and E₂ = 2c₁₁, from the row for no strain. A row of bending is for folds at 0°, 45° or 90° from
/// axis 1. The rigidities at the least curvature measured are D₁ = B₀, whose folds are across the warp, and D₂ = B₉₀.
///
/// The everyday fabrics are estimates without a measured sample, and isotropic. Canvas, cotton, silk and wool stretch
/// by 1, 2, 3 and 4 % at 98 N/m. Paper follows from its thickness and Young's modulus. docs/reference/scene-format.md
/// lists the sources.
struct Fabric {
  std::string_view name;    ///< name in scenes
  std::string_view sample;  ///< name in the paper
  double density;           ///< [kg/m²]
  WarpWeft modulus;         ///< E₁ and E₂, force per width and strain [N/m]
  WarpWeft rigidity;        ///< D₁ and D₂, bending rigidity when rolled along the warp and along the weft [N·m]
  bool measured = true;     ///< false: an estimate
};

/// Returns all fabrics, sorted by name.
std::span<const Fabric> fabrics();

}  // namespace drape

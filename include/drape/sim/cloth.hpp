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
  std::array<int, 2> edge = {};  ///< end vertices of the edge; two equal ones tie to that vertex
  double share = 0;              ///< position of the point on the edge, 0 at its first end to 1
  double length = 0;             ///< distance of vertex and point at the start [m]
};

/// A seam that shortens its ties to zero. At time t a tie is at most length·(1 − t/time) long. The seam is closed from
/// `time` on.
struct Seam {
  double time = 0;  ///< [s]
  std::vector<SeamTie> ties = {};
  std::array<std::vector<int>, 2> sides = {};  ///< vertices of both sides, in order along the seam
};

/// Initial state of all cloth in a simulation. It has one or more pieces.
struct Cloth {
  Vertices positions;   ///< n×3 [m]
  Vertices velocities;  ///< n×3 [m/s]
  Vertices rest;        ///< n×3, unstrained shape [m]
  std::vector<Triangle> triangles;
  std::vector<Spring> springs;
  Eigen::VectorXd masses;               ///< n, all positive [kg]
  std::vector<int> pins;                ///< fixed vertices, ascending, without duplicates
  std::vector<ClothPiece> pieces = {};  ///< pieces in order; empty: a single unnamed piece
  std::vector<Seam> seams = {};

  [[nodiscard]] int vertex_count() const { return static_cast<int>(positions.rows()); }
};

/// Appends `one` to `all` as a piece with a name. Its vertices and triangles follow the existing ones.
void append(const std::string& name, const Cloth& one, Cloth& all);

/// Returns the piece with a name, or null.
const ClothPiece* find_piece(const Cloth& cloth, std::string_view name);

/// Returns the piece index of each vertex; empty for fewer than two pieces.
std::vector<int> pieces_of_vertices(const Cloth& cloth);

/// Returns a copy of the cloth with only the triangles and springs of one piece. It keeps all vertices.
Cloth only_piece(const Cloth& cloth, const ClothPiece& piece);

/// Returns the diagonal of the cloth's initial bounding box, or the largest rest length if longer [m].
double size_of(const Cloth& cloth);

/// Makes the homework's mass-spring cloth with one spring per edge of `rest`. The edge's length is the rest length. All
/// springs have the same stiffness, and all vertices the same mass.
/// @param start    mesh with the initial positions; the cloth starts at rest
/// @param rest     the same triangles in the unstrained shape
/// @param mass     of the whole cloth, positive [kg]
/// @param stiffness of every spring, positive [N/m]
/// @param pins     fixed vertices, in any order
/// @throws std::invalid_argument if start and rest do not match, or a triangle's corner or a pin is not a vertex
Cloth make_cloth(const Mesh& start, const Mesh& rest, double mass, double stiffness, std::vector<int> pins);

/// Distributes mass by area: each vertex gets a third of the mass of each adjacent rest triangle. So fine and coarse
/// parts of a sheet have the same mass per area. A vertex of no triangle gets the mean mass of the others.
/// @param density of the cloth, positive [kg/m²]
/// @throws std::invalid_argument if a vertex has triangles, and none with an area
void share_mass_by_area(double density, Cloth& cloth);

/// Gives every spring the stiffness E·A/l², with rest length l and area A of the rest triangles at it (Van Gelder 1998,
/// "Approximate simulation of elastic membranes by triangulated spring meshes"). So a force stretches a sheet by the
/// same amount on fine and coarse meshes. The effective modulus depends on the mesh. With uniformly distributed edge
/// directions θ, springs store ½E·3⟨ε(θ)²⟩ per area: the modulus is E, with Poisson's ratio 1/3. On a grid with one
/// diagonal, the modulus along the edges is E without contraction if shear is free. It is 1.2 E if shear is prevented
/// (docs/reference/scene-format.md).
/// @param modulus E, force per width and strain, positive [N/m]
/// @throws std::invalid_argument if a spring has no triangle with an area
void stiffen_by_area(double modulus, Cloth& cloth);

/// Returns the warp's angle in a rest triangle, counterclockwise from its first side, seen from the front [rad]. The
/// warp lies in the triangle's plane above or below the direction (cos, sin, 0). Returns nothing if the triangle has no
/// area or is perpendicular to that direction.
/// @param angle of the direction, see WarpWeft [rad]
std::optional<double> warp_angle(const Cloth& cloth, const Triangle& triangle, double angle);

/// Gives every spring the stiffness F(θ)·A/l², with rest length l, area A of the rest triangles at it, and angle θ from
/// the warp. F is chosen such that a sheet has the modulus E₁ along the warp and E₂ along the weft.
///
/// Springs with unit directions n and Σ k l² n⊗n⊗n⊗n = C per area store ½ ε:C:ε under a uniform strain. C is fully
/// symmetric, so the stiffness in shear C₁₂₁₂ is C₁₁₂₂. The C of this cloth is C₁₁₁₁ = 9/8 E₁, C₂₂₂₂ = 9/8 E₂, C₁₁₂₂ =
/// 3/8 √(E₁E₂). It is the orthotropic sheet of Huber 1923 with the Poisson's ratios √(E₁/E₂)/3 and √(E₂/E₁)/3. Its
/// modulus E(θ) at angle θ from the warp follows 1/√E(θ) = cos²θ/√E₁ + sin²θ/√E₂. For E₁ = E₂ it is the isotropic sheet
/// of stiffen_evenly().
///
/// F(θ) = a₀ + a₁ cos 2θ + b₁ sin 2θ + a₂ cos 4θ + b₂ sin 4θ has five coefficients, as many as C has independent
/// components. For uniformly distributed spring directions, F(θ) = 3/8 (E₁ + E₂) + ¼ √(E₁E₂) + ¾ (E₁ − E₂) cos 2θ + ¾
/// (√E₁ − √E₂)² cos 4θ. It is positive if the larger modulus is less than nine times the smaller. Meshes with few edge
/// directions, such as a grid with one diagonal, cannot have this C.
/// @param modulus E₁, E₂, force per width and strain, positive [N/m]
/// @throws std::invalid_argument if the warp has no direction at an edge, the mesh's edges cannot represent C, or a
/// spring would have negative stiffness
void stiffen_as_woven(const WarpWeft& modulus, Cloth& cloth);

/// Gives every spring the stiffness E(θ)·A/l² with the E(θ) of stiffen_as_woven(), or √(E₁E₂) where warp_angle()
/// returns nothing. It works on every mesh, like stiffen_by_area(). A grid with one diagonal has E₁ and E₂ along its
/// sides while shear is free. A mesh with few edge directions deviates from E(θ) between them.
/// @throws std::invalid_argument if a spring has no triangle with an area
void stiffen_by_direction(const WarpWeft& modulus, Cloth& cloth);

/// Material of a fabric: its density, and its modulus and bending rigidity along warp and weft.
///
/// Most are measured by Wang, O'Brien and Ramamoorthi 2011, "Data-Driven Elastic Models for Cloth: Modeling and
/// Measurement", whose tables of ten fabrics come with ARCSim. The values here hold for small strains. The paper's
/// energy is ½·2c₁₁·ε₁² + ½·2c₂₂·ε₂² + …, with axis 1 along the weft and axis 2 along the warp. So the moduli are E₁ =
/// 2c₂₂ and E₂ = 2c₁₁, from the row for no strain. Each row of the bending table is for folds at 0°, 45° or 90° from
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

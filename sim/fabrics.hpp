#pragma once

// Example:
//   for (const drape::Fabric& fabric : drape::fabrics()) std::printf("%g kg/m2", fabric.density);

#include <span>
#include <string_view>

namespace drape {

/// A fabric, as represented by a cloth with one density, modulus and rigidity in all directions.
///
/// Most are measured by Wang, O'Brien and Ramamoorthi 2011, "Data-Driven Elastic Models for Cloth: Modeling and
/// Measurement", whose tables of ten fabrics come with ARCSim. Those are anisotropic and change with strain; these
/// values hold for small strains. The modulus is the geometric mean of weft and warp, E = 2√(c₁₁·c₂₂) (their energy is
/// ½·2c·ε²). The rigidity is the mean over directions at the least curvature measured, D = (B₀ + 2·B₄₅ + B₉₀)/4.
///
/// The everyday fabrics are estimates without a measured sample. Canvas, cotton, silk and wool stretch by 1, 2, 3 and 4
/// % at 98 N/m. Paper follows from its thickness and Young's modulus. docs/scene-format.md lists the sources.
struct Fabric {
  std::string_view name;    ///< name in scenes
  std::string_view sample;  ///< name in the paper
  double density;           ///< [kg/m²]
  double modulus;           ///< E, force per width and strain [N/m]
  double rigidity;          ///< D, bending rigidity [N·m]
  bool measured = true;     ///< false: an estimate
};

/// Returns all fabrics, sorted by name.
std::span<const Fabric> fabrics();

}  // namespace drape

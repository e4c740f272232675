#pragma once

// Example:
//   for (const drape::Fabric& fabric : drape::fabrics()) std::printf("%g kg/m2", fabric.density);

#include <span>
#include <string_view>

namespace drape {

/// A fabric, as far as a cloth of one density, modulus and rigidity in all directions can represent it.
///
/// Most are measured by Wang, O'Brien and Ramamoorthi 2011, "Data-Driven Elastic Models for Cloth: Modeling and
/// Measurement", whose tables of ten fabrics come with ARCSim. Those are anisotropic and change with strain; this is
/// what they say of small strains: the modulus is the geometric mean of the weft's and the warp's, E = 2√(c₁₁·c₂₂)
/// (their energy is ½·2c·ε²), the rigidity the mean of the directions at the least curvature measured, D = (B₀ + 2·B₄₅
/// + B₉₀)/4.
///
/// The everyday ones are estimates: no sample was measured. Canvas, cotton, silk and wool stretch by 1, 2, 3 and 4 % at
/// 98 N/m. Paper follows from its thickness and Young's modulus. docs/scene-format.md has the sources of each.
struct Fabric {
  std::string_view name;    ///< as scenes write it
  std::string_view sample;  ///< what the paper calls it
  double density;           ///< [kg/m²]
  double modulus;           ///< E, force per width and strain [N/m]
  double rigidity;          ///< D, against bending [N·m]
  bool measured = true;     ///< otherwise an estimate
};

/// All of them, by name.
std::span<const Fabric> fabrics();

}  // namespace drape

#pragma once

// Example:
//   for (const drape::Fabric& fabric : drape::fabrics()) std::printf("%g kg/m2", fabric.density);

#include <span>
#include <string_view>

namespace drape {

/// A fabric, as far as a cloth of one density, modulus and rigidity in all directions can represent it.
///
/// Measured by Wang, O'Brien and Ramamoorthi 2011, "Data-Driven Elastic Models for Cloth: Modeling and Measurement",
/// whose tables of ten fabrics come with ARCSim. Those are anisotropic and change with strain; this is what they say of
/// small strains: the modulus is the geometric mean of the weft's and the warp's, E = 2√(c₁₁·c₂₂) (their energy is
/// ½·2c·ε²), the rigidity the mean of the directions at the least curvature measured, D = (B₀ + 2·B₄₅ + B₉₀)/4.
struct Fabric {
  std::string_view name;    ///< as scenes write it
  std::string_view sample;  ///< what the paper calls it
  double density;           ///< [kg/m²]
  double modulus;           ///< E, force per width and strain [N/m]
  double rigidity;          ///< D, against bending [N·m]
};

/// All of them, by name.
std::span<const Fabric> fabrics();

}  // namespace drape

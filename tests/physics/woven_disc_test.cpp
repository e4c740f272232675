// Cusick's drape meter with a fabric whose warp is stiffer than its weft: the outline of the hanging disc has the
// symmetry of the weave.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"

namespace drape::test {
namespace {

using Harmonic = std::complex<double>;

/// Returns the harmonics of the rim's distance from the axis, r = Σ Re(c̄ₖ e^{ikθ}), over the angle θ in the flat disc
/// [m].
/// @param rigidity of bending, as in a scene
/// @param warp     [degrees]
std::vector<Harmonic> hung_outline(const std::string& rigidity, double warp) {
  const std::filesystem::path folder = std::filesystem::path(DRAPE_SOURCE_DIR) / "scenes/validation/drape-meter";
  const Scene scene = load_scene(folder / "drape-meter.toml",
                                 {"cloth.mesh=\"disc-14.obj\"", "cloth.modulus=100", "time.step=0.02",
                                  "effects.bending.rigidity=" + rigidity, "cloth.warp=" + std::to_string(warp)});
  Simulation simulation(scene.simulation);
  for (int step = 0; step < 100; ++step) simulation.step();
  const Vertices& x = simulation.state().x;
  const Vertices& flat = simulation.cloth().rest;
  const double border = flat.rowwise().norm().maxCoeff() * (1 - 1e-6);
  std::vector<Harmonic> harmonics(5);
  int count = 0;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    if (flat.row(i).norm() < border) continue;
    ++count;
    const double angle = std::atan2(flat(i, 1), flat(i, 0));
    for (std::size_t k = 0; k < harmonics.size(); ++k) {
      harmonics[k] += x.row(i).head<2>().norm() * std::polar(1.0, static_cast<double>(k) * angle);
    }
  }
  for (std::size_t k = 0; k < harmonics.size(); ++k) harmonics[k] *= (k == 0 ? 1.0 : 2.0) / count;
  return harmonics;
}

// The geometric mean of both rigidities is that of the isotropic disc.
TEST(WovenDisc, IsLongAlongItsWarpWhereAnIsotropicOneIsRound) {
  const double round = std::abs(hung_outline("2.5e-5", 0)[2]);
  for (const double warp : {0.0, 30.0, 90.0}) {
    const std::vector<Harmonic> outline = hung_outline("[1e-4,6.25e-6]", warp);
    EXPECT_LT(outline[0].real(), 0.145) << "it hangs";
    EXPECT_GT(std::abs(outline[2]), 0.1 * outline[0].real()) << warp;
    EXPECT_LT(round, 0.1 * std::abs(outline[2])) << warp;
    // The longest radius lies along the stiffer direction.
    const double turned = std::arg(outline[2] * std::polar(1.0, -2 * warp * std::numbers::pi / 180));
    EXPECT_NEAR(turned * 90 / std::numbers::pi, 0, 3) << warp;
    // Warp and weft do not tell their two ends apart: turned by half, the outline is the same.
    for (const std::size_t odd : {1U, 3U}) {
      EXPECT_LT(std::abs(outline[odd]), 0.15 * std::abs(outline[2])) << warp << " " << odd;
    }
  }
}

}  // namespace
}  // namespace drape::test

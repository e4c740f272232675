// Cusick's drape meter with a fabric whose warp is stiffer than its weft: the outline of the hanging disc has the
// symmetry of the weave.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {
namespace {

using Harmonic = std::complex<double>;

const std::filesystem::path meter = std::filesystem::path(DRAPE_SOURCE_DIR) / "scenes/validation/drape-meter";

/// Returns the harmonics of the rim's distance from the axis, r = Σ Re(c̄ₖ e^{ikθ}), over the angle θ in the flat disc
/// [m].
/// @param lifted angle at which the disc is lifted at the start by up to 5 mm, at both ends [degrees]
std::vector<Harmonic> hung_outline(SimulationSettings settings, std::optional<double> lifted = {}) {
  Cloth& cloth = settings.cloth;
  const double border = cloth.rest.rowwise().norm().maxCoeff() * (1 - 1e-6), support = 0.09;
  for (Eigen::Index i = 0; lifted && i < cloth.rest.rows(); ++i) {
    const double beyond = std::max(0.0, cloth.rest.row(i).norm() - support) / (border - support);
    const double angle = std::atan2(cloth.rest(i, 1), cloth.rest(i, 0)) - *lifted * std::numbers::pi / 180;
    cloth.positions(i, 2) += 0.005 * beyond * std::cos(2 * angle);
  }
  Simulation simulation(settings);
  for (int step = 0; step < 100; ++step) simulation.step();
  const Vertices& x = simulation.state().x;
  const Vertices& flat = cloth.rest;
  std::vector<Harmonic> harmonics(13);
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

/// @param rigidity of bending, as in a scene
/// @param warp     [degrees]
SimulationSettings disc(const std::string& rigidity, double warp) {
  return load_scene(meter / "drape-meter.toml",
                    {"cloth.mesh=\"disc-14.obj\"", "cloth.modulus=100", "time.step=0.02",
                     "effects.bending.rigidity=" + rigidity, "cloth.warp=" + std::to_string(warp)})
      .simulation;
}

/// @param warp [degrees]
SimulationSettings disc_of(const std::string& fabric, double warp) {
  const SceneFolder folder;
  return folder
      .load("[cloth]\nmesh = \"" + (meter / "disc-14.obj").string() + "\"\nmaterial = \"" + fabric +
            "\"\nwarp = " + std::to_string(warp) +
            "\npins = [{ ball = { center = [0, 0, 0], radius = 0.0901 } }]\n[time]\nstep = 0.02\n"
            "[integrator]\nmethod = \"quasi-newton\"\n[effects]\ngravity = {}\ndamping = { factor = 0.02 }\n")
      .simulation;
}

/// Returns the direction of the longest radius, between −90° and 90° from an angle [degrees].
double long_axis(const std::vector<Harmonic>& outline, double from) {
  return std::arg(outline[2] * std::polar(1.0, -2 * from * std::numbers::pi / 180)) * 90 / std::numbers::pi;
}

/// Returns the power of the odd harmonics relative to that of the even ones: 0 if the outline stays when turned by
/// half.
double odd_share(const std::vector<Harmonic>& outline) {
  double odd = 0, even = 0;
  for (std::size_t k = 1; k < outline.size(); ++k) (k % 2 == 1 ? odd : even) += std::norm(outline[k]);
  return odd / even;
}

// The geometric mean of both rigidities is that of the isotropic disc.
TEST(WovenDisc, IsLongAlongItsWarpWhereAnIsotropicOneIsRound) {
  const double round = std::abs(hung_outline(disc("2.5e-5", 0))[2]);
  for (const double warp : {0.0, 30.0, 90.0}) {
    const std::vector<Harmonic> outline = hung_outline(disc("[1e-4,6.25e-6]", warp));
    EXPECT_LT(outline[0].real(), 0.145) << "it hangs";
    EXPECT_GT(std::abs(outline[2]), 0.1 * outline[0].real()) << warp;
    EXPECT_LT(round, 0.1 * std::abs(outline[2])) << warp;
    // The longest radius lies along the stiffer direction.
    EXPECT_NEAR(long_axis(outline, warp), 0, 3) << warp;
    // Warp and weft do not tell their two ends apart: turned by half, the outline is the same.
    for (const std::size_t odd : {1U, 3U}) {
      EXPECT_LT(std::abs(outline[odd]), 0.15 * std::abs(outline[2])) << warp << " " << odd;
    }
  }
}

// The outline is longest along the direction that is stiffer in bending, the warp of sweat and the weft of denim. Six
// folds, as of sweat, have both axes of the weave; denim may have five or seven, which have one.
TEST(WovenDisc, OfANamedFabricIsLongAlongItsStifferDirectionHoweverItStarts) {
  for (const double lifted : {0.0, 90.0}) {
    for (const double warp : {0.0, 30.0}) {
      const std::vector<Harmonic> outline = hung_outline(disc_of("sweat", warp), lifted);
      EXPECT_NEAR(long_axis(outline, warp), 0, 3) << warp << " " << lifted;
      EXPECT_LT(odd_share(outline), 0.01) << warp << " " << lifted;
    }
    EXPECT_NEAR(long_axis(hung_outline(disc_of("denim", 30), lifted), 120), 0, 15) << lifted;
  }
}

TEST(WovenDisc, OfOneRigidityHasNoAxisOfItsOwn) {
  const SimulationSettings round = disc("2.5e-5", 0);
  const double one = long_axis(hung_outline(round, 0), 0);
  EXPECT_GT(std::abs(long_axis(hung_outline(round, 90), one)), 30);
}

}  // namespace
}  // namespace drape::test

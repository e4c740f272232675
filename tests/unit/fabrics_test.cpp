// Fabrics: their values follow from the published measurements, and a scene's cloth has them along its warp and weft.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "drape/scene/scene.hpp"
#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/bending.hpp"
#include "tests/support/cloths.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {
namespace {

/// A fabric's published row of stretching for no strain, and its rigidities at the least curvature.
struct Measured {
  std::string_view name;
  double c11, c22;  // [N/m]
  double b0, b90;   // of folds along axis 1 and axis 2 [1e-6 N·m]
  double density;   // [kg/m²]
};

constexpr std::array measured{
    Measured{"denim", 205.352005, 1013.88629, 64.196457, 96.951576, 0.324},
    Measured{"dots", 2002.08618, 2027.48559, 51.714, 31.283, 0.128},
    Measured{"interlock", 16.593832, 34.477123, 23.191698, 14.267624, 0.187},
    Measured{"jet-set", 43.067627, 171.424835, 14.294, 20.346, 0.113},
    Measured{"ponte-roma", 31.146198, 44.028667, 36.348, 37.158, 0.284},
    Measured{"rib-knit", 42.871021, 65.166023, 46.238, 32.244, 0.276},
    Measured{"ribbon", 151.503906, 244.830673, 117.07, 59.774, 0.228},
    Measured{"sweat", 12.486332, 3.272434, 59.47, 45.625, 0.224},
    Measured{"swim", 47.971176, 104.615456, 60.238, 51.019, 0.204},
    Measured{"target", 2016.55456, 2034.97644, 125.41, 125.41, 0.22},
};

// The energy is ½·2c₁₁·ε₁² + ½·2c₂₂·ε₂², and axis 2 is the warp. Folds along axis 1 bend the warp.
TEST(Fabrics, FollowFromThePublishedMeasurements) {
  for (const Measured& m : measured) {
    const Fabric& f = fabric(m.name);
    EXPECT_NEAR(f.modulus.warp, 2 * m.c22, 3e-3 * f.modulus.warp) << m.name;
    EXPECT_NEAR(f.modulus.weft, 2 * m.c11, 3e-3 * f.modulus.weft) << m.name;
    EXPECT_NEAR(f.rigidity.warp, 1e-6 * m.b0, 3e-3 * f.rigidity.warp) << m.name;
    EXPECT_NEAR(f.rigidity.weft, 1e-6 * m.b90, 3e-3 * f.rigidity.weft) << m.name;
    EXPECT_EQ(f.density, m.density) << m.name;
  }
  EXPECT_EQ(std::ranges::count(fabrics(), true, &Fabric::measured), std::ssize(measured));
}

std::string sheet(std::string_view material, const std::string& more, const std::string& pattern) {
  return "[cloth]\nmesh = { grid = [4, 4], pattern = \"" + pattern + "\" }\nmaterial = \"" + std::string(material) +
         "\"\n" + more;
}

/// Returns the cloth of `sheet` with exactly these moduli.
Cloth woven(const Scene& scene, WarpWeft modulus, double degrees) {
  Cloth cloth = scene.simulation.cloth;
  modulus.angle = degrees * std::numbers::pi / 180;
  stiffen_as_woven(modulus, cloth);
  return cloth;
}

void expect_stiffnesses(const Cloth& cloth, const Cloth& wanted) {
  ASSERT_EQ(cloth.springs.size(), wanted.springs.size());
  for (std::size_t i = 0; i < cloth.springs.size(); ++i) {
    EXPECT_EQ(cloth.springs[i].stiffness, wanted.springs[i].stiffness) << i;
  }
}

TEST(Fabrics, HaveBothModuliOnMeshesThatCan) {
  const SceneFolder folder;
  for (const Fabric& f : fabrics()) {
    if (!f.measured) continue;
    for (const std::string pattern : {"alternating", "x"}) {
      for (const double warp : {0.0, 45.0, 90.0}) {
        const LoadedScene scene = folder.load(sheet(f.name, "warp = " + std::to_string(warp) + "\n", pattern));
        EXPECT_TRUE(scene.source.warnings.empty()) << f.name << scene.source.warnings.front();
        expect_stiffnesses(scene.simulation.cloth, woven(scene, f.modulus, warp));
      }
    }
  }
}

TEST(Fabrics, BendByBothRigiditiesAlongTheWarp) {
  const SceneFolder folder;
  const auto rigidity = [](const Scene& scene, std::size_t effect = 0) {
    return *scene.simulation.effects[effect].as<Bending>()->rigidity;
  };
  const WarpWeft ribbon = fabric("ribbon").rigidity;
  const double angle = 30 * std::numbers::pi / 180;
  EXPECT_EQ(rigidity(folder.load(sheet("ribbon", "warp = 30\n", "diagonal"))),
            WarpWeft(ribbon.warp, ribbon.weft, angle));
  EXPECT_EQ(rigidity(folder.load(sheet("ribbon", "warp = 30\n[effects.bending]\nrigidity = 1e-5\n", "diagonal"))),
            WarpWeft(1e-5, 1e-5, angle));
  // Each of several cloths has its own warp.
  const std::string two =
      "[[cloth]]\nname = \"a\"\nmesh = { grid = [4, 4] }\nmaterial = \"ribbon\"\n"
      "[[cloth]]\nname = \"b\"\nmesh = { grid = [4, 4] }\nmaterial = \"denim\"\nwarp = 30\n";
  const Scene scene = folder.load(two);
  const WarpWeft denim = fabric("denim").rigidity;
  EXPECT_EQ(rigidity(scene, 0), ribbon);
  EXPECT_EQ(rigidity(scene, 1), WarpWeft(denim.warp, denim.weft, angle));
}

TEST(Fabrics, AreReplacedByTheScenesOwnValues) {
  const SceneFolder folder;
  const Scene scene = folder.load(sheet("denim", "modulus = [300, 200]\ndensity = 0.5\n", "x"));
  expect_stiffnesses(scene.simulation.cloth, woven(scene, {300, 200}, 0));
  EXPECT_NEAR(scene.simulation.cloth.masses.sum(), 0.5 * 4, 1e-12);
  EXPECT_EQ(folder.load(sheet("denim", "stiffness = 7\n", "x")).simulation.cloth.springs[0].stiffness, 7);
}

// A mesh with few directions gets the modulus of each edge's direction, and a warning that names the remedy.
TEST(Fabrics, WarnOfMeshesThatCannotHaveBothModuli) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(sheet("denim", "", "diagonal"));
  ASSERT_EQ(scene.source.warnings.size(), 1U);
  const std::string text = folder.without_folder(scene.source.warnings[0]);
  EXPECT_TRUE(text.starts_with("scene.toml:2:8: mesh: denim: the mesh's edges run in too few directions")) << text;
  EXPECT_NE(text.find("a grid needs pattern \"alternating\" or \"x\""), std::string::npos) << text;
  EXPECT_NE(text.find("each spring gets the modulus of its own direction"), std::string::npos) << text;
  Cloth wanted = scene.simulation.cloth;
  stiffen_by_direction(fabric("denim").modulus, wanted);
  expect_stiffnesses(scene.simulation.cloth, wanted);
  for (const char* const mesh : {"{ grid = [6, 6], pattern = \"equilateral\" }", "{ tube = { around = 24 } }",
                                 "{ disc = { rings = 6 } }", "{ strip = { across = 3 } }"}) {
    EXPECT_LE(folder.load("[cloth]\nmesh = " + std::string(mesh) + "\nmaterial = \"denim\"\n").source.warnings.size(),
              1U)
        << mesh;
  }
  // The scene's own moduli must be exact.
  EXPECT_NE(folder.problems(sheet("denim", "modulus = [300, 200]\n", "diagonal")).find("too few directions"),
            std::string::npos);
  EXPECT_TRUE(folder.load(sheet("cotton", "", "diagonal")).source.warnings.empty());
}

}  // namespace
}  // namespace drape::test

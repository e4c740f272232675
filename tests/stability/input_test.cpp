// Non-finite numbers never enter a simulation, wherever they are written.

#include <gtest/gtest.h>

#include <cmath>

#include "drape/core/warp_weft.hpp"
#include "scene/tables.hpp"
#include "sim/stability.hpp"
#include "tests/support/scene_folder.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Returns a key's value with such a number in it; empty if it has no numbers.
std::string with_number(const Key& key, const std::string& number) {
  std::string vector = "[0, " + number + ", 0]";
  if (key.pointer<double>() != nullptr || key.pointer<std::optional<double>>() != nullptr ||
      key.pointer<std::optional<WarpWeft>>() != nullptr) {
    return number;
  }
  if (key.pointer<Eigen::Vector3d>() != nullptr || key.pointer<std::optional<Eigen::Vector3d>>() != nullptr) {
    return vector;
  }
  if (key.as<FormulaList>() != nullptr) return vector;
  if (const auto* list = key.as<KeyframeList>()) {
    return "[{ time = 0, " + list->names.front() + " = " + vector + " }]";
  }
  return {};
}

void expect_refused(const test::SceneFolder& folder, const std::string& table, const Key& key) {
  for (const char* number : {"nan", "inf", "-inf", "1e999"}) {
    const std::string value = with_number(key, number);
    if (value.empty()) continue;
    const std::string problem = folder.problems(test::least_scene, {table + "." + key.name + "=" + value});
    EXPECT_NE(problem.find("--set " + table + "." + key.name), std::string::npos)
        << table << "." << key.name << ": " << problem;
  }
}

TEST(Input, ThatIsNotFiniteIsAnErrorAtEveryKey) {
  const test::SceneFolder folder;
  for_each_table([&](const TableType& table) {
    for (const Key& key : table.keys.all()) expect_refused(folder, table.name, key);
  });
}

TEST(Input, ThatIsNotFiniteIsAnErrorInAMesh) {
  const test::SceneFolder folder;
  for (const char* number : {"nan", "inf", "-inf", "1e999"}) {
    folder.write("a.obj", std::string("v 0 0 0\nv 1 ") + number + " 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("a.usda",
                 std::string("#usda 1.0\ndef Mesh \"m\" {\n  int[] faceVertexCounts = [3]\n  int[] faceVertexIndices = "
                             "[0, 1, 2]\n  point3f[] points = [(0, 0, 0), (1, ") +
                     number + ", 0), (0, 1, 0)]\n}\n");
    for (const char* mesh : {"a.obj", "a.usda"}) {
      const std::string problem = folder.problems(test::least_scene, {std::string("cloth.mesh='") + mesh + "'"});
      EXPECT_NE(problem.find(mesh), std::string::npos) << number << ": " << problem;
    }
  }
}

/// Returns the largest safe step of a hanging cloth [s].
double safe_step_of(double mass, double stiffness) {
  const Cloth cloth = cloth_of(make_grid(10, 10), mass, stiffness, {0});
  return safe_step(System(cloth, 0.01));
}

// It is proportional to √(m/k), even if k/m exceeds the range of a double.
TEST(Input, OfAnySizeHasASafeStep) {
  const double usual = safe_step_of(1, 1);
  ASSERT_GT(usual, 0);
  for (const double exponent : {-300, -200, -100, 100, 200, 300}) {
    const double root = std::pow(10, exponent / 2);
    EXPECT_NEAR(safe_step_of(1, std::pow(10, exponent)) * root, usual, 1e-3 * usual) << "stiffness 1e" << exponent;
    EXPECT_NEAR(safe_step_of(std::pow(10, exponent), 1) / root, usual, 1e-3 * usual) << "mass 1e" << exponent;
  }
  EXPECT_NEAR(safe_step_of(1e-300, 1e300) * 1e300, usual, 1e-3 * usual);
}

// Regression: each of these once took extremely long.
TEST(Input, ThatCannotBeComputedWithIsRefused) {
  const test::SceneFolder folder;
  folder.write("far.obj", "v 0 0 0\nv 1e308 0 0\nv 0 1e308 0\nf 1 2 3\n");
  const std::string alone = "effects.self_collision.thickness=0.01", anyway = "integrator.allow_unstable=true";
  EXPECT_EQ(folder.problems(test::least_scene, {"cloth.transform.scale=1e-300", alone, anyway}),
            "--set effects.self_collision.thickness=0.01: thickness: expected less than the size of the whole cloth at "
            "its start, 2e-300 m, found 0.01");
  EXPECT_EQ(
      folder.problems(test::least_scene, {"cloth.mesh=far.obj", alone, anyway}),
      "--set cloth.mesh=far.obj: mesh: a vertex is at 1e+308 m; distances beyond 1e+90 m overflow double precision");
}

}  // namespace
}  // namespace drape::test

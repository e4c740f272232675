#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "sim/system.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using test::least_scene;
using test::SceneFolder;

const std::string one_sphere = least_scene + "[effects.sphere]\ncenter = [0, 0, 1]\nradius = 1\n";
const std::string item = "[[effects.sphere]]\ncenter = [0, 0, 1]\nradius = 1\n";

/// Returns the spheres' radii as installed in a system.
std::vector<double> radii(const Scene& scene) {
  System system{scene.simulation.cloth, scene.simulation.step};
  for (const Effect& effect : scene.simulation.effects) effect.install(system);
  std::vector<double> result;
  for (const auto& collider : system.colliders) result.push_back(std::get<SphereShape>(collider->at(0)).radius);
  return result;
}

TEST(SceneOverrides, ReplaceAndAddValues) {
  const SceneFolder folder;
  const Scene scene =
      folder.load(least_scene, {"time.step=0.5", "cloth.mass = 3", "video.size=[64,32]", "camera.position=[1, 2, 3.5]",
                                "look.mesh_lines=true", "cloth.mesh={grid=[3,3]}"});
  EXPECT_EQ(scene.simulation.step, 0.5);
  EXPECT_DOUBLE_EQ(scene.simulation.cloth.masses.sum(), 3);
  EXPECT_EQ(scene.video.size, Eigen::Vector2i(64, 32));
  EXPECT_EQ(scene.camera.position, Eigen::Vector3d(1, 2, 3.5));
  EXPECT_TRUE(scene.look.mesh_lines);
  EXPECT_EQ(scene.simulation.cloth.vertex_count(), 16);
}

TEST(SceneOverrides, ABareWordIsAString) {
  const SceneFolder folder;
  const Scene scene = folder.load(least_scene, {"integrator.method=implicit", "look.color=#ff0000",
                                                "look.background=navy", "integrator.stop=\"gradient\""});
  EXPECT_EQ(scene.simulation.integrator.method, Method::implicit);
  EXPECT_EQ(scene.simulation.integrator.stop, StoppingRule::gradient);
  EXPECT_EQ(scene.look.color, (Rgb{1, 0, 0}));

  folder.write("meshes/one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(folder.load(least_scene, {"cloth.mesh=meshes/one.obj"}).simulation.cloth.vertex_count(), 3);
}

TEST(SceneOverrides, AreAppliedInOrder) {
  const SceneFolder folder;
  EXPECT_EQ(folder.load(least_scene, {"time.step=1", "time.step=2"}).simulation.step, 2);
  EXPECT_EQ(
      folder.load(least_scene, {"cloth.mesh={grid=[4,4]}", "cloth.mesh.grid.1=2"}).simulation.cloth.vertex_count(), 15);
}

TEST(SceneOverrides, AddTablesOnTheWay) {
  const SceneFolder folder;
  const Scene scene = folder.load(least_scene, {"effects.damping.factor=0.7", "cloth.transform.scale=2"});
  ASSERT_EQ(scene.simulation.effects.size(), 1U);
  EXPECT_EQ(scene.simulation.effects[0].name(), "damping");
  EXPECT_EQ(folder.load(least_scene, {"effects.gravity={}"}).simulation.effects.size(), 1U);
}

TEST(SceneOverrides, ReachOneOfSeveralTables) {
  const SceneFolder folder;
  EXPECT_EQ(radii(folder.load(one_sphere, {"effects.sphere.radius=2"})), (std::vector<double>{2}));
  EXPECT_EQ(radii(folder.load(one_sphere, {"effects.sphere.0.radius=2"})), (std::vector<double>{2}));
  EXPECT_EQ(radii(folder.load(least_scene + item, {"effects.sphere.radius=2"})), (std::vector<double>{2}));
  EXPECT_EQ(radii(folder.load(least_scene + item, {"effects.sphere.0.radius=2"})), (std::vector<double>{2}));
  EXPECT_EQ(radii(folder.load(least_scene + item + item, {"effects.sphere.1.radius=2"})), (std::vector<double>{1, 2}));
  EXPECT_EQ(radii(folder.load(least_scene + item + item, {"effects.sphere=[]"})), (std::vector<double>{}));
}

TEST(SceneOverrides, MustSayWhichOfSeveralTables) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(least_scene + item + item, {"effects.sphere.radius=2"}),
            "--set effects.sphere.radius=2: effects.sphere is an array of 2: say which, as in effects.sphere.0");
  EXPECT_EQ(folder.problems(least_scene + item + item, {"effects.sphere.2.radius=2"}),
            "--set effects.sphere.2.radius=2: effects.sphere has the items 0 to 1");
  EXPECT_EQ(folder.problems(one_sphere, {"effects.sphere.1.radius=2"}),
            "--set effects.sphere.1.radius=2: unknown key '1' in [effects.sphere]; the keys are 'center', 'radius', "
            "'scale', 'thickness', 'friction', 'restitution', 'stiffness', 'velocity', 'orbit_period', "
            "'orbit_center', 'orbit_axis', 'keyframes', 'interpolation', 'track', 'allow_overlap'");
}

TEST(SceneOverrides, AreCheckedLikeTheFile) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(least_scene, {"cloth.stifness=3"}),
            "--set cloth.stifness=3: unknown key 'stifness' in [cloth]; did you mean 'stiffness'?");
  EXPECT_EQ(folder.problems(least_scene, {"clth.stiffness=3"}),
            "--set clth.stiffness=3: unknown table 'clth'; did you mean 'cloth'?");
  EXPECT_EQ(folder.problems(least_scene, {"effects.dampng.factor=0.7"}),
            "--set effects.dampng.factor=0.7: unknown effect 'dampng'; did you mean 'damping'?");
  EXPECT_EQ(folder.problems(least_scene, {"effects.wind={}"}),
            "--set effects.wind={}: missing key 'acceleration' in [effects.wind]");
  EXPECT_EQ(folder.problems(least_scene, {"cloth.mass=inf"}), "--set cloth.mass=inf: mass must be finite, found inf");
  EXPECT_EQ(folder.problems(least_scene, {"time.step=0.1.2"}),
            "--set time.step=0.1.2: step: expected a number, found a string");
  EXPECT_EQ(folder.problems(least_scene, {"step=2"}), "--set step=2: 'step' belongs in [time]");
}

TEST(SceneOverrides, ReachItemsOfAnArrayThatIsLeftToItsDefault) {
  const SceneFolder folder;
  const Scene plain = folder.load(least_scene);
  const Scene scene = folder.load(least_scene, {"video.size.0=96", "cloth.transform.rotate.2=90"});
  EXPECT_EQ(scene.video.size, Eigen::Vector2i(96, plain.video.size.y()));
  EXPECT_TRUE(scene.simulation.cloth.positions.row(0).isApprox(
      Eigen::RowVector3d(-plain.simulation.cloth.positions(0, 1), plain.simulation.cloth.positions(0, 0), 0)));
  EXPECT_EQ(folder.problems(least_scene, {"effects.gravity.acceleration.2=-1"}), "(no error)");
  EXPECT_EQ(folder.problems(least_scene, {"effects.gravity.0.acceleration.2=-1"}), "(no error)");
  EXPECT_EQ(folder.problems(least_scene, {"video.size.2=96"}),
            "--set video.size.2=96: video.size has the items 0 to 1");
  EXPECT_EQ(folder.problems(least_scene, {"camera.position.0=1"}),
            "--set camera.position.0=1: camera.position has no items until it is given: set all of it, "
            "camera.position=…");
  EXPECT_EQ(folder.problems(least_scene, {"effects.field.acceleration.0=x"}),
            "--set effects.field.acceleration.0=x: effects.field.acceleration has no items until it is given: set all "
            "of it, effects.field.acceleration=…\n"
            "--set effects.field.acceleration.0=x: missing key 'acceleration' in [effects.field]");
}

TEST(SceneOverrides, CanRepairAFile) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems("[cloth]\nmesh = { grid = [2, 2] }\nstiffness = -1\n", {"cloth.stiffness=1"}),
            "(no error)");
  EXPECT_EQ(folder.problems("", {"cloth.mesh={grid=[2,2]}", "cloth.stiffness=1"}), "(no error)");
}

TEST(SceneOverrides, PutTablesAndValuesWhereTheyBelong) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(least_scene, {"time=3"}), "--set time=3: expected a table [time], found a whole number");
  EXPECT_EQ(folder.problems(least_scene, {"time.step.x=3"}), "--set time.step.x=3: time.step is a number, not a table");
  EXPECT_EQ(folder.problems(least_scene, {"time.step={x=3}"}),
            "--set time.step={x=3}: step: expected a number, found a table");
  EXPECT_EQ(folder.problems(least_scene, {"cloth.mesh.grid.2=3"}),
            "--set cloth.mesh.grid.2=3: cloth.mesh.grid has the items 0 to 1");
  EXPECT_EQ(folder.problems(least_scene, {"cloth.mesh.grid.x=3"}),
            "--set cloth.mesh.grid.x=3: cloth.mesh.grid is an array of 2: say which, as in cloth.mesh.grid.0");
}

TEST(SceneOverrides, AreAnAssignment) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(least_scene, {"foo"}), "--set foo: expected key.path=value, found no '='");
  EXPECT_EQ(folder.problems(least_scene, {""}), "--set : expected key.path=value, found no '='");
  EXPECT_EQ(folder.problems(least_scene, {"time.step="}), "--set time.step=: expected a value after the '='");
  for (const std::string path :
       {"", ".", "time.", ".step", "time..step", "time step", "time.\"step\"", "[time].step"}) {
    EXPECT_EQ(folder.problems(least_scene, {path + "=1"}),
              "--set " + path + "=1: expected names with dots between them before the '='");
  }
}

TEST(SceneOverrides, HaveOneTomlValueOrOneWord) {
  const SceneFolder folder;
  for (const std::string value : {"[1, 2", "1 2", "two words", "\"open", "{a = }", "1\n2", "1\n[cloth]", "a=b", "1e400",
                                  "-1e400", "007", "9223372036854775808"}) {
    const std::string problem = folder.problems(least_scene, {"cloth.mass=" + value});
    const std::string expected = "--set cloth.mass=" + value + ": expected a TOML value or a bare word after the '=': ";
    EXPECT_EQ(problem.substr(0, expected.size()), expected);
  }
}

}  // namespace
}  // namespace drape

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "run/run_scene.hpp"
#include "tests/motion/recorded.hpp"
#include "tests/support/files.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Every state and row of a scene's motion, directly from its simulation.
struct Straight final : StepObserver {
  std::vector<State> states;
  std::vector<Energies> energies;
  std::vector<int> iterations;

  explicit Straight(const Scene& scene) {
    Simulation simulation(scene.simulation);
    run_steps(simulation, scene.step_count(), std::array<StepObserver*, 1>{this}, {});
  }
  void begin(const Simulation& simulation) override { add(simulation, 0); }
  void after_step(const Simulation& simulation, const StepReport& report, double) override {
    add(simulation, report.iterations);
  }
  void add(const Simulation& simulation, int count) {
    states.push_back(simulation.state());
    energies.push_back(simulation.energies());
    iterations.push_back(count);
  }
};

TEST(MotionFile, HoldsEveryStepToTheBit) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  const RunResult result = record(scene, folder.path("m.drape"));
  ASSERT_TRUE(result.motion && result.motion->complete);
  EXPECT_EQ(result.motion->complete->size, std::filesystem::file_size(folder.path("m.drape")));
  EXPECT_EQ(folder.file_count(), 2u) << "the scene and the motion";

  const Straight straight(scene);
  MotionReader motion(folder.path("m.drape"));
  ASSERT_EQ(motion.states(), 51u);
  ASSERT_EQ(motion.rows(), 51);
  for (std::size_t i = 0; i < 51; ++i) {
    EXPECT_TRUE(same_bits(motion.state(i).x, straight.states[i].x)) << i;
    EXPECT_TRUE(same_bits(motion.state(i).v, straight.states[i].v)) << i;
    const StepRow& row = motion.row(static_cast<std::int64_t>(i));
    EXPECT_EQ(row.energies.elastic, straight.energies[i].elastic);
    EXPECT_EQ(row.energies.kinetic, straight.energies[i].kinetic);
    EXPECT_EQ(row.energies.gravity, straight.energies[i].gravity);
    EXPECT_EQ(row.iterations, straight.iterations[i]);
    ASSERT_EQ(row.colliders.size(), 1u);
    const Eigen::Vector3d center = std::get<SphereShape>(row.colliders[0]).center;
    EXPECT_EQ(center, (Eigen::Vector3d(0.1, 0.2, 0) * (static_cast<double>(i) * 0.02) + Eigen::Vector3d(0, 0, -0.5)));
  }
}

/// Two cloths above each other; bending acts on one of them.
const std::string two_cloths = R"(
[[cloth]]
name = "sheet"
mesh = { grid = [4, 3] }
stiffness = 50
pins = ["corner:x-y-", "corner:x+y-"]
[[cloth]]
name = "napkin"
mesh = { grid = [2, 2], size = [0.4, 0.4] }
transform = { translate = [0, 0, 1] }
stiffness = 20
[time]
step = 0.02
duration = 0.6
[effects.gravity]
[[effects.bending]]
cloth = "sheet"
rigidity = 1e-3
)";

/// Records the energies of each cloth in a simulation.
struct PieceEnergies final : StepObserver {
  std::vector<std::vector<Energies>> rows;
  void begin(const Simulation& simulation) override { rows.push_back(simulation.piece_energies()); }
  void after_step(const Simulation& simulation, const StepReport&, double) override {
    rows.push_back(simulation.piece_energies());
  }
};

TEST(MotionFile, HoldsTheEnergiesOfEachCloth) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(two_cloths);
  record(scene, folder.path("m.drape"));
  PieceEnergies expected;
  Simulation simulation(scene.simulation);
  run_steps(simulation, scene.step_count(), std::array<StepObserver*, 1>{&expected}, {});
  MotionReader motion(folder.path("m.drape"));
  EXPECT_EQ(motion.header().cloths, (std::vector<std::string>{"sheet", "napkin"}));
  ASSERT_EQ(motion.rows(), static_cast<std::int64_t>(expected.rows.size()));
  for (std::size_t i = 0; i < expected.rows.size(); ++i) {
    const StepRow& row = motion.row(static_cast<std::int64_t>(i));
    ASSERT_EQ(row.cloths.size(), 2U);
    double kinetic = 0, elastic = 0;
    const double rounding = 1e-12 * std::abs(row.energies.total());
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(row.cloths[k].kinetic, expected.rows[i][k].kinetic) << i;
      EXPECT_EQ(row.cloths[k].gravity, expected.rows[i][k].gravity) << i;
      EXPECT_EQ(row.cloths[k].elastic, expected.rows[i][k].elastic) << i;
      kinetic += row.cloths[k].kinetic;
      elastic += row.cloths[k].elastic;
    }
    EXPECT_NEAR(kinetic, row.energies.kinetic, rounding);
    EXPECT_NEAR(elastic, row.energies.elastic, rounding);
  }
}

/// The records of a complete or resumed motion are those of the run, with the columns of every cloth.
TEST(MotionFile, GivesTheRecordsOfEachCloth) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(two_cloths);
  RunOptions options;
  options.records.energies = folder.path("run.csv");
  options.motion.emplace();
  options.motion->recorded.every = 7;  // most steps have a row only
  record(scene, folder.path("m.drape"), options);
  const std::string expected = content(folder.path("run.csv"));
  EXPECT_NE(expected.find(",sheet.elastic,napkin.kinetic,"), std::string::npos) << expected.substr(0, 200);
  EXPECT_EQ(expected.find(",,"), std::string::npos);

  MotionReader motion(folder.path("m.drape"));
  RecordPaths paths;
  paths.energies = folder.path("read.csv");
  write_records(motion, MotionScene(motion).scene(), paths);
  EXPECT_EQ(content(folder.path("read.csv")), expected);

  record(scene, folder.path("parts.drape"), {}, 11);
  RunOptions rest;
  rest.records.energies = folder.path("parts.csv");
  resume(folder.path("parts.drape"), rest);
  EXPECT_EQ(content(folder.path("parts.csv")), expected);
}

/// A file of a version before several cloths had rows of their own has neither names nor columns.
TEST(MotionFile, IsReadWithoutTheEnergiesOfEachCloth) {
  StepRow row;
  row.energies = {.kinetic = 1, .gravity = 2, .elastic = 3};
  MotionHeader header;
  const std::string old = pack_rows({row});
  EXPECT_TRUE(unpack_rows(old, header).front().cloths.empty());
  row.cloths = {{.kinetic = 4, .gravity = 5, .elastic = 6}, {.kinetic = 7, .gravity = 8, .elastic = 9}};
  header.cloths = {"a", "b"};
  const StepRow back = unpack_rows(pack_rows({row}), header).front();
  ASSERT_EQ(back.cloths.size(), 2U);
  EXPECT_EQ(back.cloths[0].gravity, 5);
  EXPECT_EQ(back.cloths[1].elastic, 9);
  EXPECT_THROW(unpack_rows(old, header), std::invalid_argument);
}

TEST(MotionFile, CanBeReadInAnyOrder) {
  const SceneFolder folder;
  record(folder.load(recorded_scene), folder.path("m.drape"));
  MotionReader inwards(folder.path("m.drape")), forwards(folder.path("m.drape"));
  std::vector<Vertices> places;
  for (std::size_t i = 0; i < forwards.states(); ++i) places.push_back(forwards.state(i).x);
  for (std::size_t i = places.size(); i-- > 0;) EXPECT_TRUE(same_bits(inwards.state(i).x, places[i])) << i;
  for (const std::size_t i : {40, 2, 33, 31, 32, 0}) EXPECT_TRUE(same_bits(inwards.state(i).x, places[i])) << i;
}

TEST(MotionFile, HoldsEveryNthStepAndTheLast) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  RunOptions options;
  options.motion = MotionOptions{.recorded = {.every = 20}};
  record(scene, folder.path("m.drape"), options);
  const Straight straight(scene);
  MotionReader motion(folder.path("m.drape"));
  ASSERT_EQ(motion.states(), 4u);
  EXPECT_EQ(motion.rows(), 51) << "energies and iterations of every step";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(motion.step(i), (std::array{0, 20, 40, 50})[i]);
    EXPECT_TRUE(same_bits(motion.state(i).x, straight.states[static_cast<std::size_t>(motion.step(i))].x));
  }
}

/// 20 frames and 50 steps per second: frame k is at step 2.5 k, so of five steps it needs those at 0, 2 and 3.
TEST(MotionFile, HoldsWhatFramesNeed) {
  const SceneFolder folder;
  RunOptions options;
  options.motion = MotionOptions{.recorded = {.every = std::nullopt}};
  record(folder.load(recorded_scene), folder.path("m.drape"), options);
  const MotionReader motion(folder.path("m.drape"));
  ASSERT_EQ(motion.states(), 31u);
  for (std::size_t i = 0; i < 31; ++i) EXPECT_EQ(motion.step(i) % 5, (std::array{0, 2, 3})[i % 3]);
}

TEST(MotionFile, IsTheSameBytesEveryTime) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  record(scene, folder.path("a.drape"));
  record(scene, folder.path("b.drape"));
  EXPECT_TRUE(content(folder.path("a.drape")) == content(folder.path("b.drape")));
}

TEST(MotionFile, KeepsTheFilesOfItsScene) {
  const SceneFolder folder;
  folder.write("meshes/sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  const LoadedScene scene = folder.load(
      "[cloth]\nmesh = \"meshes/sheet.obj\"\nstiffness = 10\npins = [0]\n[time]\nstep = 0.01\nduration = 0.1\n"
      "[effects.gravity]\n[look]\ntexture = \"plaid.png\"\n[check]\nframes = [1]\n",
      {"cloth.mass=2"});
  record(scene, folder.path("m.drape"));
  std::filesystem::remove_all(folder.path("meshes"));
  const MotionReader motion(folder.path("m.drape"));
  const MotionScene own(motion);
  EXPECT_EQ(own.scene().simulation.cloth.masses.sum(), 2);
  EXPECT_TRUE(same_bits(own.scene().simulation.cloth.positions, scene.simulation.cloth.positions));
  EXPECT_EQ(own.scene().uvs, scene.uvs);
  EXPECT_EQ(content(own.scene().look.texture), content(scene.look.texture));
  EXPECT_NE(content(own.scene().look.texture), "");
}

/// Reads the whole motion file.
void read_all(const std::string& file) {
  MotionReader motion(file);
  for (std::size_t i = 0; i < motion.states(); ++i) motion.state(i);
  for (std::int64_t i = 0; i < motion.rows(); ++i) motion.row(i);
  const MotionScene scene(motion);
}

class DamagedMotion : public testing::Test {
 protected:
  DamagedMotion() {
    folder_.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    record(folder_.load("[cloth]\nmesh = \"t.obj\"\nstiffness = 10\n[time]\nstep = 0.01\nduration = 0.05\n"
                        "[effects.gravity]\n"),
           folder_.path("good.drape"));
    good_ = content(folder_.path("good.drape"));
  }
  [[nodiscard]] std::string error_of(const std::string& bytes) const {
    std::ofstream(folder_.path("bad.drape"), std::ios::binary) << bytes;
    return folder_.without_folder(usage_error([&] { read_all(folder_.path("bad.drape")); }));
  }
  SceneFolder folder_;
  std::string good_;
};

TEST_F(DamagedMotion, IsRefusedWhereverItIsCutShort) {
  EXPECT_EQ(error_of(good_), "(no error)");
  for (std::size_t size = 0; size < good_.size(); ++size) {
    const std::string message = error_of(good_.substr(0, size));
    ASSERT_TRUE(message.starts_with("bad.drape: ")) << size << ": " << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(DamagedMotion, IsRefusedWhicheverByteIsAnother) {
  for (std::size_t i = 0; i < good_.size(); ++i) {
    std::string bytes = good_;
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
    const std::string message = error_of(bytes);
    ASSERT_TRUE(message.starts_with("bad.drape: ")) << "byte " << i << ": " << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(DamagedMotion, SaysWhatItIs) {
  EXPECT_EQ(error_of("drape recorded motion 2\n"),
            "bad.drape: this motion has version 2, but this drape reads version 1");
  EXPECT_EQ(error_of("solid cube\n"), "bad.drape: this is not a drape motion");
  EXPECT_EQ(error_of(good_.substr(0, good_.size() - 1)), "bad.drape: the file is cut short: it has no end");
  EXPECT_EQ(usage_error([] { read_all("/nowhere/m.drape"); }), "/nowhere/m.drape: no such file");
  EXPECT_EQ(folder_.without_folder(usage_error([&] { read_all(folder_.path().string()); })).substr(0, 4), "/tmp");
}

TEST_F(DamagedMotion, OfAnotherSceneIsRefused) {
  const SceneFolder folder;
  const std::string named = std::string(recorded_scene) + "[integrator]\nmethod = \"quasi-newton\"\n";
  const LoadedScene scene = folder.load(named);
  const auto error = [&](const std::vector<std::string>& overrides) {
    return usage_error([&] { require_same_physics("m.drape", scene, folder.load(named, overrides), "look.toml"); });
  };
  EXPECT_EQ(error({}), "(no error)");
  EXPECT_EQ(error({"look.color=red", "video.fps=3", "camera.azimuth=10", "time.duration=3"}), "(no error)");
  EXPECT_EQ(error({"cloth.mass=1"}), "(no error)") << "the default";
  EXPECT_EQ(error({"effects.sphere.radius=0.25", "integrator.tolerance=1e-5", "cloth.mass=2"}),
            "m.drape is a different motion from what look.toml gives: simulate again, or leave these values unchanged\n"
            "cloth.mass: 1, and 2 in look.toml\n"
            "integrator.tolerance: nothing, and 1e-05 in look.toml\n"
            "effects.sphere.radius: 0.3, and 0.25 in look.toml");
  EXPECT_NE(error({"cloth.mesh={grid=[5,5]}"}).find("cloth.mesh: 30 vertices"), std::string::npos);
  EXPECT_NE(error({"effects.wind.acceleration=[1,0,0]"}).find("effects.wind: nothing, and there in look.toml"),
            std::string::npos);
}

}  // namespace
}  // namespace drape::test

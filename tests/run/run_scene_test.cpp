#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run/outputs.hpp"
#include "run/run_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

constexpr const char* swinging = R"(
[cloth]
mesh = { grid = [4, 4] }
stiffness = 50
pins = ["corner:x-y-"]
[time]
step = 0.02
duration = 0.4
[integrator]
method = "liu13"
tolerance = 1e-3
[effects.gravity]
)";

std::vector<std::string> lines(const fs::path& file) {
  std::istringstream text(test::content(file));
  std::vector<std::string> result;
  for (std::string line; std::getline(text, line);) result.push_back(line);
  return result;
}

RunResult run(const LoadedScene& scene, const RunOptions& options) {
  Progress progress;
  return run_scene(scene, options, {}, progress);
}

class StopAfterAStep final : public StepObserver {
 public:
  explicit StopAfterAStep(std::stop_source stop) : stop_(std::move(stop)) {}
  void after_step(const Simulation&, const StepReport&, double) override { stop_.request_stop(); }

 private:
  std::stop_source stop_;
};

TEST(RunScene, WritesEveryRecordThatIsAskedFor) {
  const test::SceneFolder folder;
  RunOptions options;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  options.records = {path("stats.json"), path("energies.csv"), path("positions.csv"), path("trace.csv")};
  const RunResult result = run(folder.load(swinging), options);

  EXPECT_EQ(result.outcome, Outcome::completed);
  EXPECT_EQ(result.records.size(), 4u);
  const auto energies = lines(path("energies.csv"));
  EXPECT_EQ(energies.front(), "step,time,total,kinetic,gravity,elastic");
  EXPECT_EQ(energies.size(), 1u + 21u);  // the start and twenty steps
  const auto trace = lines(path("trace.csv"));
  EXPECT_EQ(trace.front(), "step,time,iterations,residual,step_us");
  EXPECT_EQ(trace.size(), 1u + 20u);
  const auto positions = lines(path("positions.csv"));
  EXPECT_EQ(positions.front(), "vertex,x,y,z");
  EXPECT_EQ(positions.size(), 1u + 25u);
  EXPECT_EQ(positions[1], "0,-1,-1,0");  // the pin

  const auto stats = nlohmann::json::parse(test::content(path("stats.json")));
  EXPECT_EQ(stats["method"], "liu13");
  EXPECT_EQ(stats["scheme"], "backward-euler");
  EXPECT_EQ(stats["vertices"], 25);
  EXPECT_EQ(stats["springs"], 56);
  EXPECT_EQ(stats["steps"], 20);
  EXPECT_GE(stats["iterations"]["mean"], 2);  // the stopping rule starts at the second
  EXPECT_GE(stats["iterations"]["max"], stats["iterations"]["mean"]);
  EXPECT_GT(stats["step_us"]["mean"], 0);
  EXPECT_GT(stats["step_us"]["median"], 0);
  ASSERT_EQ(stats["effects"].size(), 1U);
  EXPECT_EQ(stats["effects"][0], "gravity");
  EXPECT_EQ(stats["outcome"], "completed");
}

TEST(RunScene, RecordsHoldSubstepsAndEstimatesWhereAnAccuracyIsAskedFor) {
  const test::SceneFolder folder;
  RunOptions options;
  options.records.stats = (folder.path() / "stats.json").string();
  options.records.trace = (folder.path() / "trace.csv").string();
  std::string asked = swinging;
  asked.replace(asked.find("tolerance = 1e-3"), 16, "");
  asked.replace(asked.find("duration"), 0, "accuracy = 1e-4\n");
  run(folder.load(asked), options);
  const auto trace = lines(options.records.trace);
  EXPECT_EQ(trace.front(), "step,time,iterations,residual,step_us,substeps,estimate");
  double most = 0, largest = 0;
  for (std::size_t i = 1; i < trace.size(); ++i) {
    int substeps = 0;
    double estimate = 0;
    ASSERT_EQ(std::sscanf(trace[i].c_str(), "%*d,%*f,%*d,%*f,%*f,%d,%lf", &substeps, &estimate), 2) << trace[i];
    EXPECT_LE(estimate, 1e-4);
    most = std::max<double>(most, substeps);
    largest = std::max(largest, estimate);
  }
  const auto accuracy = nlohmann::json::parse(test::content(options.records.stats))["accuracy"];
  EXPECT_EQ(accuracy["asked"], 1e-4);
  EXPECT_EQ(accuracy["substeps"]["max"], most);
  EXPECT_LE(accuracy["substeps"]["mean"], most);
  EXPECT_EQ(accuracy["steps_not_accurate"], 0);
  EXPECT_NEAR(accuracy["estimated_error"]["largest"], largest, 1e-5 * largest);
}

TEST(RunScene, PositionsReadBackHaveTheSameBits) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(swinging);
  RunOptions options;
  options.records.positions = (folder.path() / "positions.csv").string();
  run(scene, options);
  Simulation simulation(scene.simulation);
  for (int step = 0; step < 20; ++step) simulation.step();
  const auto rows = lines(options.records.positions);
  for (int vertex = 0; vertex < 25; ++vertex) {
    int number = 0;
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(rows[static_cast<std::size_t>(vertex) + 1].c_str(), "%d,%lf,%lf,%lf", &number, &x, &y, &z),
              4);
    EXPECT_EQ(number, vertex);
    EXPECT_EQ(Eigen::RowVector3d(x, y, z), simulation.state().x.row(vertex));
  }
}

TEST(RunScene, EnergiesAreThoseOfTheirStep) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(swinging);
  RunOptions options;
  options.records.energies = (folder.path() / "energies.csv").string();
  run(scene, options);
  const auto rows = lines(options.records.energies);
  ASSERT_EQ(rows.size(), 22U);
  const Cloth& cloth = scene.simulation.cloth;
  Simulation simulation(scene.simulation);
  for (int step = 0; step <= 20; ++step) {
    if (step > 0) simulation.step();
    const State& state = simulation.state();
    const double kinetic = cloth.masses.dot(state.v.rowwise().squaredNorm()) / 2;
    const double gravity = 9.8 * cloth.masses.dot(state.x.col(2));
    const double elastic = test::plain_energy(cloth.springs, state.x);
    double number = 0, time = 0, total = 0, written_kinetic = 0, written_gravity = 0, written_elastic = 0;
    ASSERT_EQ(std::sscanf(rows[static_cast<std::size_t>(step) + 1].c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &number, &time,
                          &total, &written_kinetic, &written_gravity, &written_elastic),
              6);
    EXPECT_EQ(number, step);
    EXPECT_NEAR(time, 0.02 * step, 1e-11);
    EXPECT_NEAR(written_kinetic, kinetic, 1e-11 * kinetic) << "step " << step;
    EXPECT_NEAR(written_gravity, gravity, 1e-11 * std::abs(gravity)) << "step " << step;
    EXPECT_NEAR(written_elastic, elastic, 1e-11 * elastic + 1e-15) << "step " << step;
    EXPECT_NEAR(total, kinetic + gravity + elastic, 1e-10 * kinetic) << "step " << step;
  }
}

TEST(RunScene, AZeroHasNoSignInTheEnergies) {
  const test::SceneFolder folder;
  // Without gravity, −m·(x·g) is −0.
  const LoadedScene scene =
      folder.load("[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 50\n[time]\nstep = 0.02\nduration = 0.1\n");
  RunOptions options;
  options.records.energies = (folder.path() / "energies.csv").string();
  run(scene, options);
  for (const std::string& row : lines(options.records.energies)) {
    EXPECT_EQ((row + ",").find(",-0,"), std::string::npos) << row;
  }
}

TEST(RunScene, ADivergedRunKeepsTheRecordsOfItsFiniteSteps) {
  const test::SceneFolder folder;
  const std::string stiff = R"(
[cloth]
mesh = { grid = [4, 4] }
stiffness = 1e6
velocity = [0, 0, 0]
transform = { scale = 1.5 }
rest = { grid = [4, 4] }
[time]
step = 0.1
duration = 1000
[integrator]
method = "semi-implicit"
allow_unstable = true
)";
  RunOptions options;
  options.records = {.stats = (folder.path() / "stats.json").string(),
                     .energies = (folder.path() / "energies.csv").string(),
                     .positions = {},
                     .trace = {}};
  const RunResult result = run(folder.load(stiff), options);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_NE(result.divergence.find("step"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(test::content(folder.path() / "stats.partial.json"))["outcome"], "diverged");
  const auto rows = lines(folder.path() / "energies.partial.csv");
  EXPECT_EQ(rows.size(), 2u + static_cast<std::size_t>(result.statistics.steps()));
}

TEST(RunScene, StopsWhenItIsToldToAndKeepsTheRecords) {
  const test::SceneFolder folder;
  RunOptions options;
  options.records.stats = (folder.path() / "stats.json").string();
  options.steps = 1'000'000;
  std::stop_source stop;
  StopAfterAStep watch(stop);
  options.observer = &watch;
  Progress progress;
  const RunResult result = run_scene(folder.load(swinging), options, stop.get_token(), progress);
  EXPECT_EQ(result.outcome, Outcome::interrupted);
  EXPECT_EQ(nlohmann::json::parse(test::content(folder.path() / "stats.partial.json"))["outcome"], "interrupted");
  EXPECT_EQ(result.statistics.steps(), 1);
}

// A run that draws only some frames gives the same pictures as one that draws all.
TEST(RunScene, WhatIsNotShownNeedNotBeDrawn) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(
      std::string(swinging) + "[video]\nsize = [48, 32]\n[camera]\nposition = [0, -4, 1]\ntarget = [0, 0, 0]\n");
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  RunOptions all, some;
  all.sheet = some.sheet = SheetGrid{.columns = 2, .rows = 2};
  all.outputs = {path("every{frame}.png"), path("sheet.png")};
  some.outputs = {path("some.png")};
  run(scene, all);
  run(scene, some);
  EXPECT_EQ(test::content(path("some.png")), test::content(path("sheet.png")));
  some.sheet.reset();
  run(scene, some);
  EXPECT_EQ(test::content(path("some.png")), test::content(path("every10.png")));

  // The last picture of a film that ends early shows its last state.
  std::stop_source stop;
  StopAfterAStep observer(stop);
  some.observer = &observer;
  Progress progress;
  EXPECT_EQ(run_scene(scene, some, stop.get_token(), progress).outcome, Outcome::interrupted);
  const std::string early = test::content(path("some.partial.png"));
  EXPECT_TRUE(early == test::content(path("every00.png")) || early == test::content(path("every01.png")));
}

TEST(Outputs, KnowWhichPicturesTheyNeed) {
  const test::SceneFolder folder;
  const auto needed = [&](const std::vector<std::string>& names, std::optional<SheetGrid> sheet) {
    FilmInfo film;
    film.expected_frames = 7;
    film.sheet = sheet;
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back((folder.path() / name).string());
    const Outputs outputs(paths, film);
    std::string text;
    for (int i = 0; i < 7; ++i) text += outputs.needs_picture(i) ? 'x' : '.';
    return text;
  };
  EXPECT_EQ(needed({"last.png"}, {}), "......x");
  EXPECT_EQ(needed({"sheet.png"}, SheetGrid{.columns = 3, .rows = 1}), "x..x..x");
  EXPECT_EQ(needed({"last.png", "film.gif"}, {}), "xxxxxxx");
  EXPECT_EQ(needed({"each{frame}.png"}, {}), "xxxxxxx");
  EXPECT_EQ(needed({"last.obj"}, {}), ".......");
}

TEST(RunScene, AnUnwritableRecordIsKnownBeforeAnythingIsSimulated) {
  const test::SceneFolder folder;
  folder.write("file", "");
  RunOptions options;
  options.records.stats = (folder.path() / "file" / "stats.json").string();
  options.steps = 1'000'000;  // would take minutes
  EXPECT_THROW(run(folder.load(swinging), options), OutputError);
}

TEST(RunScene, CountsTheStepsThatDidNotConvergeAndTheirWorstResidual) {
  const LoadedScene scene = load_scene(DRAPE_SOURCE_DIR "/scenes/hard/stiffest.toml");
  RunOptions options;
  options.steps = 5;
  const RunResult result = run(scene, options);
  // liu13 takes at most a hundred iterations, and a hundred thousand would not suffice here.
  EXPECT_GE(result.statistics.not_converged(), 4);
  EXPECT_GT(result.statistics.worst_residual(), scene.simulation.integrator.tolerance);
  const std::string json = result.statistics.to_json("completed");
  EXPECT_NE(json.find("\"steps_not_converged\""), std::string::npos);
  EXPECT_NE(json.find("\"worst_residual\""), std::string::npos);
  EXPECT_EQ(result.outcome, Outcome::completed);
}

}  // namespace
}  // namespace drape

// An interrupted and resumed run gives the same bits as an uninterrupted one, with every method and effect.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "drape/scene/scene.hpp"
#include "run/records.hpp"
#include "tests/motion/recorded.hpp"
#include "tests/support/files.hpp"
#include "tests/support/methods.hpp"

namespace drape::test {
namespace {

constexpr int steps = 40;

/// Returns a table for each effect, and all of them together.
std::vector<std::string> effects_of_scenes() {
  std::vector<std::string> tables{
      "[effects.gravity]\n",
      "[effects.wind]\nacceleration = [1, 0, 0]\n",
      "[effects.air]\nvelocity = [1, 2, 0]\ngust = 1\n",
      "[effects.bending]\nrigidity = 1e-4\ncross_stiffness = 1\n",
      "[effects.moving_pins]\npins = [0, 6]\nkeyframes = [{ time = 0.05, offset = [0, 0, 0.2] }]\nrelease = 0.1\n",
      "[effects.sphere]\nradius = 0.3\nfriction = 0.3\n" +
          std::string("keyframes = [{ time = 0, center = [0, 0, -0.3] }, { time = 0.2, center = [0, 0.1, -0.1] }]\n"),
      "[effects.ground]\nheight = -0.05\nrestitution = 0.5\n",
      "[effects.strain_limit]\nmax_stretch = 1.05\n",
      "[effects.self_collision]\nthickness = 0.02\n",
      "[effects.damping]\nfactor = 0.5\n",
  };
  std::string all;
  for (const std::string& table : tables) all += table;
  tables.push_back(all);
  return tables;
}

/// @param accuracy line of [time], or empty; with one, the scheme follows from it
std::string scene_of(const NamedMethod& method, const std::string& effects, const std::string& accuracy = "") {
  static constexpr std::array solvers{"automatic", "cholesky", "conjugate-gradients"};
  std::string text =
      "[cloth]\nmesh = { grid = [6, 6] }\nstiffness = 50\npins = [0, 6]\nvelocity = [0, 0, -1]\n[time]\nstep = 0.005\n"
      "duration = 0.2\n" +
      accuracy + "[integrator]\nmethod = \"" + std::string(method_names[static_cast<std::size_t>(method.method)]) +
      "\"\n" + "linear_solver = \"" + solvers[static_cast<std::size_t>(method.linear_solver)] + "\"\n";
  if (!method.is_explicit() && accuracy.empty()) text += "scheme = \"" + scheme_name(method.scheme) + "\"\n";
  return text + effects;
}

class Resumed : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(Of, Resumed, testing::ValuesIn(all_methods), method_name);

TEST_P(Resumed, RunsComeToTheSameBits) {
  const SceneFolder folder;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> some_step(1, steps - 2);
  std::vector<std::string> scenes;
  for (const std::string& effects : effects_of_scenes()) scenes.push_back(scene_of(GetParam(), effects));
  scenes.push_back(scene_of(GetParam(), "[effects.gravity]\n", "accuracy = 1e-5\n"));
  for (const std::string& text : scenes) {
    const LoadedScene scene = folder.load(text);
    record(scene, folder.path("whole.drape"));
    const int first = some_step(random), second = std::min(first + some_step(random), steps - 1);
    const RunResult begun = record(scene, folder.path("parts.drape"), {}, first);
    EXPECT_EQ(begun.outcome, Outcome::interrupted);
    EXPECT_FALSE(std::filesystem::exists(folder.path("parts.drape")));
    if (second > first) resume(folder.path("parts.drape"), {}, second);
    const RunResult ended = resume(folder.path("parts.drape"));
    EXPECT_EQ(ended.outcome, Outcome::completed);
    EXPECT_TRUE(content(folder.path("parts.drape")) == content(folder.path("whole.drape")))
        << text << "interrupted after " << first << " and " << second;
    EXPECT_EQ(folder.file_count(), 3u);
    std::filesystem::remove(folder.path("parts.drape"));
  }
}

/// Records differ only in measured times.
TEST_P(Resumed, RunsHaveRecordsOfTheWholeMotion) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(scene_of(GetParam(), effects_of_scenes().back()));
  const auto with_records = [&](const std::string& name) {
    RunOptions options;
    options.records = {.stats = {},
                       .energies = folder.path(name + "-e.csv"),
                       .positions = folder.path(name + "-p.csv"),
                       .trace = folder.path(name + "-t.csv")};
    return options;
  };
  const auto trace = [&](const std::string& name) {
    std::string text = content(folder.path(name + "-t.csv")), kept;
    for (std::size_t line = 0, end = 0; (end = text.find('\n', line)) != std::string::npos; line = end + 1) {
      kept += text.substr(line, text.rfind(',', end) - line) + "\n";
    }
    return kept;
  };
  const RunResult whole = record(scene, folder.path("whole.drape"), with_records("whole"));
  record(scene, folder.path("parts.drape"), {}, 17);
  const RunResult parts = resume(folder.path("parts.drape"), with_records("parts"));
  EXPECT_EQ(content(folder.path("parts-e.csv")), content(folder.path("whole-e.csv")));
  EXPECT_EQ(content(folder.path("parts-p.csv")), content(folder.path("whole-p.csv")));
  EXPECT_EQ(trace("parts"), trace("whole"));
  EXPECT_EQ(parts.statistics.steps(), steps);
  EXPECT_EQ(parts.statistics.mean_iterations(), whole.statistics.mean_iterations());
  EXPECT_EQ(parts.statistics.worst_residual(), whole.statistics.worst_residual());
  const auto errors = parts.statistics.exactness().errors(), expected = whole.statistics.exactness().errors();
  ASSERT_EQ(errors.has_value(), expected.has_value());
  if (errors) {
    EXPECT_EQ(errors->mean, expected->mean);
    EXPECT_EQ(errors->largest, expected->largest);
  }
  const auto rise = parts.statistics.energy_rise(), whole_rise = whole.statistics.energy_rise();
  ASSERT_EQ(rise.has_value(), whole_rise.has_value());
  if (rise) {
    EXPECT_EQ(rise->of_available, whole_rise->of_available);
  }
}

/// A cloth that falls on a ground. Its steps stop at a change, so that few of them have an error estimate.
const std::string falling_scene =
    "[cloth]\nmesh = { grid = [6, 6] }\nstiffness = 50\n[time]\nstep = 0.01\nduration = 0.5\n[integrator]\n"
    "method = \"liu13\"\ntolerance = 1e-3\n[effects.gravity]\n[effects.ground]\nheight = -0.5\n";

/// A fall loses energy on impact: the start of the whole motion has more than any later state.
TEST(ResumedRun, TellsTheEnergyRiseOfTheWholeMotion) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(falling_scene);
  const auto whole = record(scene, folder.path("whole.drape")).statistics.energy_rise();
  record(scene, folder.path("parts.drape"), {}, 45);
  const auto parts = resume(folder.path("parts.drape")).statistics.energy_rise();
  ASSERT_TRUE(whole && parts);
  EXPECT_FALSE(whole->notable());
  EXPECT_EQ(parts->energy, whole->energy);
  EXPECT_EQ(parts->of_available, whole->of_available);
}

TEST(CompleteMotion, HasTheStatisticsOfItsRun) {
  const SceneFolder folder;
  for (const std::string& text : {falling_scene, scene_of(all_methods[4], effects_of_scenes().front())}) {
    const LoadedScene scene = folder.load(text);
    RunOptions options;
    options.records.stats = folder.path("run.json");
    record(scene, folder.path("m.drape"), options);
    MotionReader motion(folder.path("m.drape"));
    write_records(motion, scene, {.stats = folder.path("motion.json"), .energies = {}, .positions = {}, .trace = {}});
    auto run = nlohmann::json::parse(content(folder.path("run.json"))),
         read = nlohmann::json::parse(content(folder.path("motion.json")));
    for (auto* of : {&run, &read}) of->erase("step_us"), of->erase("effect_shares");
    EXPECT_TRUE(run["accuracy"].contains("estimated_error"));
    const auto error = [](const auto& json) {
      return json["accuracy"]["estimated_error"]["mean"].template get<double>();
    };
    EXPECT_NEAR(error(read), error(run), 1e-3 * error(run)) << text;
    for (auto* of : {&run, &read}) (*of)["accuracy"].erase("estimated_error");
    EXPECT_EQ(read, run) << text;
  }
}

/// The energy guard resumes with its history: it reports the same step.
TEST(ResumedRun, DivergesInTheSameStep) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(
      "[cloth]\nmesh = { grid = [6, 6] }\nstiffness = 500\npins = [0, 6]\n[time]\nstep = 0.02\nduration = "
      "4\n[integrator]\n"
      "method = \"semi-implicit\"\nallow_unstable = true\n[effects.gravity]\n[effects.air]\n");
  const RunResult whole = record(scene, folder.path("whole.drape"));
  ASSERT_EQ(whole.outcome, Outcome::diverged);
  EXPECT_FALSE(std::filesystem::exists(folder.path("whole.drape")));
  const std::int64_t last = whole.statistics.steps();
  ASSERT_GT(last, 2);
  for (const std::int64_t stop : {std::int64_t{1}, last / 2, last}) {
    std::filesystem::remove(folder.path("parts.drape.partial"));
    record(scene, folder.path("parts.drape"), {}, stop);
    const RunResult parts = resume(folder.path("parts.drape"));
    EXPECT_EQ(parts.outcome, Outcome::diverged);
    EXPECT_EQ(parts.divergence, whole.divergence) << stop;
  }
}

/// A resumed run redoes the steps that the whole one did, and counts all of them. Solves this loose gain energy, more
/// often than a run may.
TEST(ResumedRun, RedoesTheSameSteps) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(
      "[cloth]\nmesh = { grid = [4, 4] }\nstiffness = 1e8\npins = [0, 4]\n[time]\nstep = 0.005\nduration = 0.5\n"
      "[integrator]\nmethod = \"quasi-newton\"\nscheme = \"sdirk2\"\nstop = \"change\"\ntolerance = 1e-3\n"
      "[effects.gravity]\n");
  const RunResult whole = record(scene, folder.path("whole.drape"));
  EXPECT_GT(whole.statistics.redone(), 5);
  EXPECT_LT(whole.statistics.redone(), 100);
  EXPECT_EQ(whole.outcome, Outcome::diverged);
  EXPECT_NE(whole.divergence.find("sdirk2 gained energy in "), std::string::npos) << whole.divergence;
  record(scene, folder.path("parts.drape"), {}, 60);
  const RunResult parts = resume(folder.path("parts.drape"));
  EXPECT_EQ(parts.statistics.redone(), whole.statistics.redone());
  EXPECT_EQ(parts.divergence, whole.divergence);
  EXPECT_TRUE(content(folder.path("parts.drape")) == content(folder.path("whole.drape")));
}

/// Leftovers of a killed process: a motion longer than its checkpoint.
class KilledAt final : public StepObserver {
 public:
  KilledAt(const SceneFolder& folder, std::int64_t step) : folder_(folder), step_(step) {}
  void after_step(const Simulation& simulation, const StepReport&, double) override {
    if (simulation.state().step != step_) return;
    for (const std::string ending : {".partial", ".checkpoint"}) {
      std::filesystem::copy_file(folder_.path("whole.drape" + ending), folder_.path("killed.drape" + ending));
    }
  }

 private:
  const SceneFolder& folder_;
  std::int64_t step_;
};

TEST(ResumedRun, BeginsAgainWhereItWasKilledBeforeTheSecondCheckpoint) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(scene_of(all_methods[4], effects_of_scenes().back()));
  KilledAt kill(folder, 35);
  RunOptions options;
  options.motion = MotionOptions{.path = folder.path("whole.drape")};
  options.records.energies = folder.path("whole.csv");
  options.observer = &kill;
  Progress progress;
  run_scene(scene, options, {}, progress);
  EXPECT_EQ(read_resumption(folder.path("killed.drape")).checkpoint.state.step, 0);
  RunOptions rest;
  rest.records.energies = folder.path("killed.csv");
  resume(folder.path("killed.drape"), rest);
  EXPECT_TRUE(content(folder.path("killed.drape")) == content(folder.path("whole.drape")));
  EXPECT_EQ(content(folder.path("killed.csv")), content(folder.path("whole.csv")));
}

TEST(ResumedRun, NeedsSomethingToGoOnFrom) {
  const SceneFolder folder;
  const auto error = [&] { return folder.without_folder(usage_error([&] { resume(folder.path("m.drape")); })); };
  EXPECT_EQ(error(), "m.drape: nothing to resume: no m.drape.partial");
  folder.write("m.drape.partial", "drape recorded motion 1\n");
  EXPECT_EQ(error(), "m.drape.partial: cannot be resumed, because there is no m.drape.checkpoint: simulate again");
  folder.write("m.drape.checkpoint", "drape checkpoint 7\n");
  EXPECT_EQ(error(), "m.drape.checkpoint: this checkpoint has version 7, but this drape reads version 1");
}

TEST(ResumedRun, IsNotOverwrittenByANewOne) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  record(scene, folder.path("m.drape"), {}, 10);
  const std::string kept = content(folder.path("m.drape.partial"));
  EXPECT_NE(usage_error([&] {
              record(scene, folder.path("m.drape"));
            }).find("m.drape.partial exists, from a run in progress or ended early: drape simulate --resume"),
            std::string::npos);
  EXPECT_EQ(content(folder.path("m.drape.partial")), kept);
  // Without a checkpoint to resume from, nothing is lost.
  std::filesystem::remove(folder.path("m.drape.checkpoint"));
  EXPECT_EQ(record(scene, folder.path("m.drape")).outcome, Outcome::completed);
}

/// The complete file replaces a link's target, on whose file system the growing file is renamed.
TEST(ResumedRun, GrowsBesideTheTargetOfALink) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  std::filesystem::create_directory(folder.path("disk"));
  std::filesystem::create_symlink("disk/n.drape", folder.path("m.drape"));
  record(scene, folder.path("m.drape"), {}, 10);
  EXPECT_TRUE(std::filesystem::exists(folder.path("disk/n.drape.partial")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("disk/n.drape.checkpoint")));
  EXPECT_EQ(resume(folder.path("m.drape")).outcome, Outcome::completed);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("m.drape")));
  record(scene, folder.path("whole.drape"));
  EXPECT_TRUE(content(folder.path("disk/n.drape")) == content(folder.path("whole.drape")));
}

TEST(ResumedRun, LeavesNothingWhereNoStepWasDone) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  RunOptions options;
  options.motion = MotionOptions{.path = folder.path("m.drape")};
  std::stop_source stop;
  stop.request_stop();
  Progress progress;
  const RunResult result = run_scene(scene, options, stop.get_token(), progress);
  EXPECT_EQ(result.outcome, Outcome::interrupted);
  EXPECT_EQ(folder.file_count(), 1u) << "the scene";
}

/// A checkpoint with any changed byte is refused, or the byte is unused.
TEST(ResumedRun, RefusesDamagedCheckpoints) {
  const SceneFolder folder;
  folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const LoadedScene scene = folder.load(
      "[cloth]\nmesh = \"t.obj\"\nstiffness = 10\n[time]\nstep = 0.01\nduration = 0.05\n[effects.gravity]\n");
  record(scene, folder.path("m.drape"), {}, 3);
  const std::string good = content(folder.path("m.drape.checkpoint"));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bytes = good;
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
    folder.write("m.drape.checkpoint", bytes);
    ASSERT_NE(usage_error([&] { read_resumption(folder.path("m.drape")); }), "(no error)") << "byte " << i;
    folder.write("m.drape.checkpoint", good.substr(0, i));
    ASSERT_NE(usage_error([&] { read_resumption(folder.path("m.drape")); }), "(no error)") << "cut at " << i;
  }
}

}  // namespace
}  // namespace drape::test

// Random scenes: each ends in "ok", "diverged" with its message, or "scene error" with its line, and no step of
// backward Euler gains energy. DRAPE_RANDOM_SCENES sets their number; DRAPE_RANDOM_SEED runs and prints a single one.

#include <gtest/gtest.h>
#include <sys/time.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <sstream>

#include "core/files.hpp"
#include "drape/sim/simulation.hpp"
#include "run/run_scene.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/random/random_scene.hpp"
#include "tests/support/scene_folder.hpp"
#include "tests/support/step_ledger.hpp"

namespace drape::test {
namespace {

constexpr int shards = 4;  // lets several processors share the work

// CPU time for one scene [s]: self-collision of a cloth that blows up is the slowest, and far slower under a sanitizer.
#ifdef DRAPE_SANITIZED
constexpr int patience = 1800;
#else
constexpr int patience = 120;
#endif

/// Ends the program by SIGPROF once it has used this many seconds of CPU time; 0: never.
void end_after(int seconds) {
  const itimerval limit{.it_interval = {}, .it_value = {.tv_sec = seconds, .tv_usec = 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

int environment(const char* name, int otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : std::atoi(value);
}

/// Checks that every line names a place in the file, except errors of other files.
void expect_places(const std::string& message) {
  static const std::regex place(R"(.*scene\.toml:\d+:\d+: .+)");
  std::istringstream lines(message);
  bool elsewhere = false;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(elsewhere || std::regex_match(line, place)) << line;
    elsewhere = line.ends_with("cannot be read:");
  }
}

/// Checks the energy balance of a motion of backward Euler that only forces and energies move.
void expect_no_energy_out_of_nothing(const Scene& scene) {
  const SimulationSettings& settings = scene.simulation;
  if (is_explicit(settings.integrator.method) || settings.integrator.scheme == TimeScheme::sdirk2) return;
  const System system = make_system(settings);
  if (!system.contacts.empty() || !system.filters.empty() || !system.pin_motions.empty() ||
      !system.pin_releases.empty())
    return;
  if (!system.fields.empty() || !system.dashpots.empty()) return;  // forces of velocities are in no ledger
  if (condition_bound(system) > largest_condition) return;         // runs nevertheless, but rounding dominates
  const StepLedger ledger(settings);
  Simulation simulation(settings);
  for (std::int64_t step = 0; step < scene.step_count(); ++step) {
    const State before = simulation.state();
    const bool converged = simulation.step().converged;
    const StepBalance b = ledger.balance(before, simulation.state());
    ASSERT_LE(b.gain(), (converged ? b.tolerated : 0) + b.gain_rounding())
        << "step " << step << (converged ? "" : ", which did not converge");
  }
}

std::string outcome(const test::SceneFolder& folder, const std::string& text) {
  RunOptions options;
  options.records.energies = (folder.path() / "energies.csv").string();
  const std::filesystem::path part = partial_name(options.records.energies);
  std::filesystem::remove(options.records.energies);
  std::filesystem::remove(part);
  Progress progress;
  std::string how = "ok";
  try {
    const LoadedScene scene = folder.load(text);
    const RunResult result = run_scene(scene, options, {}, progress);
    if (result.outcome == Outcome::diverged) {
      how = "diverged";
      EXPECT_TRUE(result.divergence.starts_with("the simulation diverged at step ")) << result.divergence;
      EXPECT_EQ(result.divergence.find('\n'), std::string::npos) << result.divergence;
    } else {
      expect_no_energy_out_of_nothing(scene);
    }
    // The partial results of an early end are marked as such.
    EXPECT_TRUE(
        std::filesystem::exists(result.outcome == Outcome::diverged ? part.string() : options.records.energies));
  } catch (const UsageError& error) {
    how = "scene error";
    expect_places(error.what());
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string name = entry.path().filename();
    EXPECT_TRUE(name == "scene.toml" || (how != "scene error" && (name == "energies.csv" || name == part.filename())))
        << name;
  }
  return how;
}

class RandomScenes : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Shard, RandomScenes, ::testing::Range(0, shards));

TEST_P(RandomScenes, EndWell) {
  const test::SceneFolder folder;
  const int only = environment("DRAPE_RANDOM_SEED", -1);
  const int count = only >= 0 ? only + 1 : environment("DRAPE_RANDOM_SCENES", 120);
  std::map<std::string, int> outcomes;
  int scenes = 0;
  for (int seed = GetParam(); seed < count; seed += shards) {
    if (only >= 0 && seed != only) continue;
    const std::string text = random_scene(static_cast<std::uint64_t>(seed));
    SCOPED_TRACE("DRAPE_RANDOM_SEED=" + std::to_string(seed));
    std::printf("seed %d: ", seed);
    std::fflush(stdout);  // the last one printed is that of a crash
    if (only >= 0) std::printf("\n%s", text.c_str());
    end_after(patience);
    const std::string how = outcome(folder, text);
    end_after(0);
    std::printf("%s\n", how.c_str());
    ++outcomes[how];
    ++scenes;
  }
  if (only < 0) {
    EXPECT_GE(2 * outcomes["ok"], scenes)
        << outcomes["diverged"] << " diverged, " << outcomes["scene error"] << " scene errors";
  }
}

}  // namespace
}  // namespace drape::test

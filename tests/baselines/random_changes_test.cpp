// Random changes of a scene's values, effects and times. Each that moves any vertex by more than the tolerance at any
// step must be detected by the windows of the golden motion, wherever it acts in the film.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "check/compare_motion.hpp"
#include "check/golden.hpp"
#include "core/keys.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/effects/effect.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "tests/support/random.hpp"
#include "tests/support/visit_target.hpp"

namespace drape::random_changes {
namespace {

namespace fs = std::filesystem;

/// A random change of a scene, with its description.
class Change {
 public:
  Change(Scene& scene, std::uint64_t seed) : scene_(scene), random_(seed * 104'729 + 5) {
    for (int i = 0; i < 10; ++i) random_.number();  // generators of nearby seeds begin alike
  }

  std::string make() {
    const double kind = random_.number();
    if (kind < 0.25) return change_cloth();
    if (kind < 0.6) return change_effect();
    if (kind < 0.8 && !scene_.simulation.cloth.pins.empty()) return release_pin();
    return pass_by();
  }

 private:
  /// Returns a factor near 1, off by between a thousandth and a half.
  double factor() { return 1 + std::pow(10, random_.between(-3, -0.3)) * (random_.number() < 0.5 ? -1 : 1); }
  double moment() { return random_.between(0.02, 0.98) * scene_.duration; }
  int below(std::size_t count) { return random_.below(static_cast<int>(count)); }

  std::string change_cloth() {
    Cloth& cloth = scene_.simulation.cloth;
    const double by = factor();
    const auto vertex = static_cast<Eigen::Index>(below(static_cast<std::size_t>(cloth.vertex_count())));
    switch (random_.below(4)) {
      case 0:
        for (Spring& spring : cloth.springs) spring.stiffness *= by;
        return "springs " + std::to_string(by) + " times as stiff";
      case 1:
        cloth.masses *= by;
        return "a cloth " + std::to_string(by) + " times as heavy";
      case 2:
        cloth.springs[static_cast<std::size_t>(below(cloth.springs.size()))].rest_length *= by;
        return "a spring " + std::to_string(by) + " times as long";
      default:
        cloth.masses[vertex] *= by;
        return "vertex " + std::to_string(vertex) + " " + std::to_string(by) + " times as heavy";
    }
  }

  std::string change_effect() {
    const Effects before = scene_.simulation.effects;
    const auto index = static_cast<std::size_t>(below(before.size()));
    Effect effect = before[index];
    Keys keys;
    effect.describe(keys);
    for (int attempt = 0; attempt < 20; ++attempt) {
      const Key& key = keys.all()[static_cast<std::size_t>(below(keys.all().size()))];
      if (!test::visit_target<bool>(key, [&](const auto& target) { return change(target); })) continue;
      Effects after;
      for (std::size_t i = 0; i < before.size(); ++i) after.add(i == index ? effect : before[i]);
      scene_.simulation.effects = after;
      return std::string(effect.name()) + "." + key.name + " changed";
    }
    return "nothing";
  }

  template <class Target>
  bool change(const Target& target) {
    if constexpr (std::is_same_v<Target, double*>) {
      const double before = *target;
      *target *= factor();
      return *target != before;
    } else if constexpr (std::is_same_v<Target, std::optional<double>*>) {
      if (!*target || **target == 0) return false;
      **target *= factor();
      return true;
    } else if constexpr (std::is_same_v<Target, std::optional<WarpWeft>*>) {
      if (!*target) return false;
      const double by = factor();
      **target = WarpWeft((*target)->warp * by, (*target)->weft * by, (*target)->angle);
      return true;
    } else if constexpr (std::is_same_v<Target, Eigen::Vector3d*>) {
      if (target->isZero(0)) return false;
      *target *= factor();
      return true;
    } else if constexpr (std::is_same_v<Target, KeyframeList>) {
      if (target.keyframes->empty()) return false;
      Keyframe& keyframe = (*target.keyframes)[static_cast<std::size_t>(below(target.keyframes->size()))];
      keyframe.value[random_.below(3)] += random_.between(-0.1, 0.1);
      return true;
    }
    return false;
  }

  std::string release_pin() {
    const std::vector<int>& pins = scene_.simulation.cloth.pins;
    const int pin = pins[static_cast<std::size_t>(below(pins.size()))];
    const double when = moment();
    scene_.simulation.effects.add(MovingPins{.pins = {pin}, .release = when});
    return "pin " + std::to_string(pin) + " released at " + std::to_string(when) + " s";
  }

  /// Adds a ball that is near the cloth for a tenth of a second.
  std::string pass_by() {
    const double when = moment();
    const Eigen::Vector3d away(50, 50, 50),
        near(random_.between(-1, 1), random_.between(-1, 1), random_.between(-1, 1));
    scene_.simulation.effects.add(
        Sphere{.radius = 0.2, .keyframes = {{0, away}, {when, away}, {when + 0.05, near}, {when + 0.1, away}}});
    return "a ball that passes by at " + std::to_string(when) + " s";
  }

  Scene& scene_;
  test::Random random_;
};

/// Returns true if two motions are ever further apart than the tolerance.
bool moves(const SimulationSettings& before, const SimulationSettings& after, std::int64_t steps, double tolerance) {
  Simulation a(before), b(after);
  const auto apart = [&] {
    return !((a.state().x - b.state().x).rowwise().squaredNorm().maxCoeff() <= tolerance * tolerance);
  };
  if (apart()) return true;
  while (a.state().step < steps) {
    a.step();
    b.step();
    if (apart()) return true;
  }
  return false;
}

/// Effect of a change, and whether it was detected.
struct Outcome {
  bool moved = false, seen = false;
  std::string what;
};

Outcome try_change(const fs::path& file, std::uint64_t seed) {
  const Scene before = load_scene(file);
  Scene after = load_scene(file);
  const double tolerance = before.check.motion_tolerance;
  Outcome outcome;
  outcome.what = file.stem().string() + ", " + std::to_string(seed) + ": " + Change(after, seed).make();
  try {
    outcome.moved = moves(before.simulation, after.simulation, before.step_count(), tolerance);
    if (!outcome.moved) return outcome;
    const Golden golden = read_golden(golden_folder(file));
    const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
    for (const WindowResult& window : compare_windows(after.simulation, golden, tolerance, threads, {}, [] {})) {
      outcome.seen = outcome.seen || window.verdict == MotionVerdict::changed;
    }
  } catch (const Error&) {
    outcome.moved = outcome.seen = true;  // refused or diverged: counts as detected
  }
  return outcome;
}

/// @param scenes names below scenes/
void expect_all_seen(const std::vector<std::string>& scenes, std::uint64_t first, std::uint64_t count) {
  std::uint64_t moved = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const fs::path file = fs::path(DRAPE_SOURCE_DIR) / "scenes" / (scenes[seed % scenes.size()] + ".toml");
    const Outcome outcome = try_change(file, seed);
    moved += outcome.moved ? 1 : 0;
    EXPECT_EQ(outcome.seen, outcome.moved) << outcome.what;
  }
  EXPECT_GE(2 * moved, count);  // otherwise the test is vacuous
}

const std::vector<std::string> quick{"homework/1",       "homework/2",           "homework/3",
                                     "homework/4",       "homework/5",           "showcase/bending",
                                     "showcase/damping", "showcase/gravity",     "showcase/moving_sphere",
                                     "showcase/wind",    "showcase/strain_limit"};

std::vector<std::string> all() {
  std::vector<std::string> scenes = quick;
  for (const char* name : {"air", "ground", "moving_pins", "self_collision"}) {
    scenes.push_back(std::string("showcase/") + name);
  }
  return scenes;
}

class RandomChanges : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Of, RandomChanges, ::testing::Range(0, 4));

TEST_P(RandomChanges, AreSeenIfTheyMoveAnything) {
  expect_all_seen(quick, 5 * static_cast<std::uint64_t>(GetParam()), 5);
}

class ManyRandomChanges : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Nightly, ManyRandomChanges, ::testing::Range(0, 10));

TEST_P(ManyRandomChanges, AreSeenIfTheyMoveAnything) {
  expect_all_seen(all(), 100 + 20 * static_cast<std::uint64_t>(GetParam()), 20);
}

}  // namespace
}  // namespace drape::random_changes

// Whole runs under the exact checker: it finds passages, and nothing else.

#include <gtest/gtest.h>

#include <string>

#include "drape/scene/scene.hpp"
#include "tests/support/audited_run.hpp"

namespace drape::test {
namespace {

LoadedScene pile() {
  return load_scene(DRAPE_SOURCE_DIR "/scenes/showcase/self_collision.toml", {"cloth.mesh={grid=[20,20]}"});
}

std::string lines(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& line : all) text += line + '\n';
  return text;
}

TEST(AuditedRun, OfAPileThatKeepsItsLayersApartFindsNothing) {
  const AuditedRun run = audit_run(pile().simulation, 150);
  EXPECT_EQ(run.steps, 150);
  EXPECT_EQ(run.with_passages + run.with_crossings, 0) << lines(run.first);
}

TEST(AuditedRun, OfAPileWithoutSelfCollisionFindsWhatPasses) {
  SimulationSettings settings = pile().simulation;
  Effects others;
  for (const Effect& effect : settings.effects) {
    if (effect.name() != "self_collision") others.add(effect);
  }
  ASSERT_LT(others.size(), settings.effects.size());
  settings.effects = others;
  const AuditedRun run = audit_run(settings, 150);
  EXPECT_GT(run.with_passages, 20);
  EXPECT_GT(run.with_crossings, 20);
  EXPECT_EQ(run.first.size(), 10U);
}

}  // namespace
}  // namespace drape::test

// Contact is accepted with every method, scheme and accuracy; keys of the removed push are named.

#include <gtest/gtest.h>

#include "tests/contact/contact_setup.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {
namespace {

/// Checks that every contact effect is accepted.
void expect_each_to_be_fine(const SimulationSettings& settings) {
  const Sphere ball{.center = Eigen::Vector3d(0, 0, -2), .radius = 0.4, .thickness = distance};
  for (const Effect& effect :
       {Effect(solved_ground()), Effect(solved_box({1, 1, 1}, -1)), Effect(solved_self()), Effect(ball)}) {
    EXPECT_TRUE(problems(effect, settings).empty()) << effect.name();
  }
}

TEST(SolvedContact, IsAcceptedWithEveryMethodSchemeAndAccuracy) {
  for (const NamedMethod& method : contact_methods) {
    SimulationSettings settings;
    settings.cloth = plain_sheet(level_square(1, 4, 0));
    settings.integrator.method = method.method;
    expect_each_to_be_fine(settings);
    settings.accuracy = 1e-3;
    expect_each_to_be_fine(settings);
    settings.accuracy.reset();
    settings.integrator.scheme = TimeScheme::sdirk2;
    expect_each_to_be_fine(settings);
  }
}

TEST(SolvedContact, SaysWhatToWriteInsteadOfTheKeysOfAPush) {
  const SceneFolder folder;
  const auto said = [&](const std::string& effect) { return folder.problems(least_scene + effect); };
  for (const char* name : {"ground", "body", "self_collision", "sphere"}) {
    const std::string table = std::string("[effects.") + name + "]\n";
    EXPECT_NE(said(table + "response = \"solved\"\n")
                  .find("'response' in [effects." + std::string(name) +
                        "] no longer exists: contact is solved for with the step, by every method: omit it"),
              std::string::npos)
        << said(table + "response = \"solved\"\n");
  }
  for (const char* name : {"ground", "body"}) {
    EXPECT_NE(said(std::string("[effects.") + name + "]\nstiffness = 9\n").find("contact is solved for and has none"),
              std::string::npos);
  }
  EXPECT_NE(said("[effects.self_collision]\nrepulsion = 9\niterations = 3\n").find("'repulsion' in"),
            std::string::npos);
}

TEST(SphereThatPushes, HasNeitherFrictionNorRestitutionNorThickness) {
  SimulationSettings settings;
  settings.cloth = plain_sheet(level_square(1, 4, 0));
  const Sphere push{.center = Eigen::Vector3d(0, 0, -2), .radius = 0.4, .stiffness = 100};
  EXPECT_TRUE(problems(push, settings).empty());
  Sphere rubs = push, bounces = push, thick = push;
  rubs.friction = 0.1;
  bounces.restitution = 0;
  thick.thickness = 0.01;
  for (const Sphere& contact : {rubs, bounces, thick}) EXPECT_EQ(problems(contact, settings).size(), 1U);
}

}  // namespace
}  // namespace drape::test

// What contact cannot be solved with is refused, by the same sentence for every effect.

#include <gtest/gtest.h>

#include <functional>

#include "sim/effects/contact.hpp"
#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

/// Every effect that can be solved for.
void expect_each_to_say(const SimulationSettings& settings, const std::vector<std::string>& said) {
  EXPECT_EQ(problems(solved_ground(), settings), said);
  EXPECT_EQ(problems(solved_box({1, 1, 1}, -1), settings), said);
  EXPECT_EQ(problems(solved_self(), settings), said);
  const Sphere ball{
      .center = Eigen::Vector3d(0, 0, -2), .radius = 0.4, .thickness = distance, .response = Response::solved};
  EXPECT_EQ(problems(ball, settings), said);
}

SimulationSettings by(StepMethod how) {
  SimulationSettings settings;
  settings.cloth = plain_sheet(level_square(1, 4, 0));
  settings.integrator.method = how.method;
  settings.integrator.scheme = how.scheme;
  return settings;
}

TEST(SolvedContact, IsAcceptedWithEveryMethod) {
  for (const NamedMethod& method : contact_methods) {
    EXPECT_FALSE(solved_problem(by(method.method)));
    expect_each_to_say(by(method.method), {});
  }
}

TEST(SolvedContact, IsRefusedWithStagesAndWithAnAccuracy) {
  for (const NamedMethod& method : solving_methods) {
    expect_each_to_say(by({method.method, TimeScheme::sdirk2}),
                       {"response: contact can be \"solved\" by scheme = \"backward-euler\" alone"});
    SimulationSettings accurate = by(method.method);
    accurate.accuracy = 1e-3;
    expect_each_to_say(accurate, {"response: contact that is \"solved\" has no estimate of its error yet: omit "
                                  "'accuracy' in [time]"});
  }
}

TEST(SolvedContact, OfAClothWithItselfHasNoImplicitPush) {
  const SelfCollision self{.response = Response::implicit_energy};
  EXPECT_EQ(problems(self, by(Method::quasi_newton)),
            std::vector<std::string>{"response: expected \"explicit\" or \"solved\""});
}

}  // namespace
}  // namespace drape::test

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/text.hpp"

namespace drape {
namespace {

TEST(EditDistance, CountsEditsOfLetters) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("stifness", "stiffness"), 1U);
  EXPECT_EQ(edit_distance("gravity", "garvity"), 1U) << "neighbours swapped";
  EXPECT_EQ(edit_distance("ca", "abc"), 3U) << "no letter is edited twice";
}

TEST(EditDistance, IsTheSameInBothDirections) {
  const std::vector<std::string> words = {"", "a", "step", "stop", "pets", "duration", "gravity", "aabbab", "bbaaba"};
  for (const std::string& a : words) {
    for (const std::string& b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << ' ' << b;
  }
}

TEST(NearestName, IsTheOneThatWasProbablyMeant) {
  const std::vector<std::string> names = {"mass", "mesh", "stiffness", "semi-implicit", "implicit"};
  EXPECT_EQ(nearest_name("mas", names), "mass");
  EXPECT_EQ(nearest_name("Stiffnes", names), "stiffness");
  EXPECT_EQ(nearest_name("SEMI_IMPLICIT", names), "semi-implicit");
  EXPECT_EQ(nearest_name("implict", names), "implicit");
  EXPECT_EQ(nearest_name("gravity", names), "");
  EXPECT_EQ(nearest_name(std::string(1000000, 'm'), names), "");
  EXPECT_EQ(nearest_name("mass", {}), "");
}

TEST(NearestName, IsSaidAfterTheUnknownOne) {
  const std::vector<std::string> names = {"mass", "mesh"};
  EXPECT_EQ(did_you_mean("mas", names, "the keys are"), "; did you mean 'mass'?");
  EXPECT_EQ(did_you_mean("color", names, "the keys are"), "; the keys are 'mass', 'mesh'");
  EXPECT_EQ(did_you_mean("color", {}, "the keys are"), "");
}

}  // namespace
}  // namespace drape

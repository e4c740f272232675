#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/collision/smooth_sheet.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sheets.hpp"

namespace drape {
namespace {

using test::at_rest;

/// Waves across a square and how they move, which other waves change.
struct Waves {
  static constexpr double h = 0.01;
  Cloth cloth;
  Vertices from = cloth.rest, moves = at_rest(cloth);

  void add(double bent, double fast, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int wave = 0; wave < 3; ++wave) {
      const Eigen::RowVector3d direction(uniform(random), uniform(random), uniform(random));
      const Eigen::RowVector3d drift(uniform(random), uniform(random), uniform(random));
      const double u = 3 * uniform(random), v = 3 * uniform(random), shift = uniform(random);
      for (int i = 0; i < cloth.vertex_count(); ++i) {
        const double phase = u * cloth.rest(i, 0) + v * cloth.rest(i, 1) + shift;
        from.row(i) += bent * std::sin(phase) * direction;
        moves.row(i) += fast * std::cos(phase) * direction + drift;
      }
    }
  }
};

Cloth any_shape(int number) {
  switch (number % 4) {
    case 0:
      return test::square();
    case 1:
      return test::hexagon(5);
    case 2:
      return test::holed();
    default:
      return test::notched();
  }
}

/// Counts what a sheet says, and looks whether it is right when it says yes.
struct Answers {
  int yes = 0, no = 0;

  void count(SmoothSheet& sheet, const Waves& waves, double distance) {
    if (!sheet.stays_apart(waves.from, Waves::h, waves.moves / Waves::h, distance)) {
      ++no;
      return;
    }
    ++yes;
    const test::Nearness near = test::nearness(waves.cloth, waves.from, waves.moves);
    EXPECT_GE(near.distance, distance * (1 - 1e-9)) << yes << " and " << no;
    EXPECT_GE(near.part, 0.2 - 1e-9) << yes << " and " << no;
  }
};

TEST(SmoothSheet, IsRightWheneverItSaysYes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Answers answers;
  for (int trial = 0; trial < test::tries(60); ++trial) {
    Waves waves{.cloth = any_shape(trial)};
    const double bent = 0.3 * std::abs(uniform(random)), fast = 0.1 * std::abs(uniform(random));
    const double distance = 0.06 * (1 + uniform(random)) + 1e-3;
    waves.add(bent, fast, random);
    SmoothSheet sheet(waves.cloth);
    answers.count(sheet, waves, distance);
  }
  EXPECT_GE(answers.yes, test::tries(60) / 4);
  EXPECT_GE(answers.no, test::tries(60) / 12);
}

// What it knows of a step it takes for granted in those after it, as long as the cloth has not changed by as much.
TEST(SmoothSheet, IsRightInEveryStepOfAMotion) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Answers answers;
  for (int trial = 0; trial < test::tries(12); ++trial) {
    Waves waves{.cloth = any_shape(trial)};
    waves.add(0.2 * std::abs(uniform(random)), 0.02, random);
    SmoothSheet sheet(waves.cloth);
    for (int step = 0; step < 12; ++step) {
      answers.count(sheet, waves, 0.04);
      waves.from += waves.moves;
      waves.add(0, 0.01, random);
    }
  }
  EXPECT_GE(answers.yes, 12 * test::tries(12) / 6);
  EXPECT_GE(answers.no, 12 * test::tries(12) / 12);
}

}  // namespace
}  // namespace drape

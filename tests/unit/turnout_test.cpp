#include "sim/parallel/turnout.hpp"

#include <gtest/gtest.h>

namespace drape::test {
namespace {

using namespace std::chrono_literals;

/// Divides loops one after another, and counts the time lost to waiting and the time on one thread.
struct Machine {
  Turnout turnout;
  Turnout::Time now = 1h, lost = 0ns, alone = 0ns;

  /// @param taken, waited  time of every divided loop, and its waiting time
  void run(Turnout::Time taken, Turnout::Time waited, Turnout::Time length) {
    for (const Turnout::Time end = now + length; now < end; now += taken) {
      if (turnout.poor(now)) {
        alone += taken;
      } else {
        lost += waited;
        turnout.note(taken, waited, now + taken);
      }
    }
  }
};

TEST(Turnout, GoesOnWhileThreadsCome) {
  Machine machine;
  machine.run(30us, 5us, 1s);
  EXPECT_EQ(machine.alone, 0ns);
}

TEST(Turnout, LosesLittleWhereTheyDoNot) {
  Machine machine;
  machine.run(4ms, 3ms, 10s);
  EXPECT_LT(machine.lost, 500ms);
  EXPECT_GT(machine.lost, 0ns);
}

TEST(Turnout, TriesAgain) {
  Machine machine;
  machine.run(4ms, 3ms, 10ms);
  EXPECT_TRUE(machine.turnout.poor(machine.now));
  machine.run(30us, 1us, 1s);
  EXPECT_FALSE(machine.turnout.poor(machine.now));
  EXPECT_LT(machine.alone, 200ms);
}

// A single late thread is no reason to fall back to one thread.
TEST(Turnout, TakesNoteOfMoreThanOneLoop) {
  Machine machine;
  machine.run(50us, 40us, 50us);
  machine.run(30us, 1us, 1s);
  EXPECT_EQ(machine.alone, 0ns);
}

}  // namespace
}  // namespace drape::test

#include "sim/parallel/threads.hpp"

#include <gtest/gtest.h>

namespace drape::test {
namespace {

using namespace std::chrono_literals;

/// Divides loops one after another, and counts the time lost to waiting and the time on one thread.
struct Machine {
  BusyBackoff backoff;
  BusyBackoff::Time now = 1h, lost = 0ns, alone = 0ns;

  /// @param taken, waited  time of every divided loop, and its waiting time
  void run(BusyBackoff::Time taken, BusyBackoff::Time waited, BusyBackoff::Time length) {
    for (const BusyBackoff::Time end = now + length; now < end; now += taken) {
      if (backoff.active(now)) {
        alone += taken;
      } else {
        lost += waited;
        backoff.note(taken, waited, now + taken);
      }
    }
  }
};

TEST(BusyBackoff, GoesOnWhileThreadsCome) {
  Machine machine;
  machine.run(30us, 5us, 1s);
  EXPECT_EQ(machine.alone, 0ns);
}

TEST(BusyBackoff, LosesLittleWhereTheyDoNot) {
  Machine machine;
  machine.run(4ms, 3ms, 10s);
  EXPECT_LT(machine.lost, 500ms);
  EXPECT_GT(machine.lost, 0ns);
}

TEST(BusyBackoff, TriesAgain) {
  Machine machine;
  machine.run(4ms, 3ms, 10ms);
  EXPECT_TRUE(machine.backoff.active(machine.now));
  machine.run(30us, 1us, 1s);
  EXPECT_FALSE(machine.backoff.active(machine.now));
  EXPECT_LT(machine.alone, 200ms);
}

// A single late thread is no reason to fall back to one thread.
TEST(BusyBackoff, TakesNoteOfMoreThanOneLoop) {
  Machine machine;
  machine.run(50us, 40us, 50us);
  machine.run(30us, 1us, 1s);
  EXPECT_EQ(machine.alone, 0ns);
}

}  // namespace
}  // namespace drape::test

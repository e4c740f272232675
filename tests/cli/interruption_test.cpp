// Signals arrive at once, without polling.

#include "cli/terminal.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>

#include "cli/summary.hpp"
#include "drape/sim/mesh.hpp"
#include "drape/sim/simulation.hpp"

namespace drape {
namespace {

/// Runs `work` in a child process and returns its exit code as a shell reports it. SIGALRM ends it after half a minute.
template <class Work>
int end_of_process(Work&& work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(30);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);  // a background job ignores some
    work();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Sleeps until a stop is requested.
void wait_for(const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any never;
  never.wait(lock, stop, [] { return false; });
}

TEST(Interruption, WakesWhoeverWaitsForTheStopAndNeverAsksForSignals) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(end_of_process([&] {
                const std::stop_token stop = interruption().get_token();
                raise(signal);
                wait_for(stop);
              }),
              0)
        << signal;
  }
}

/// nohup starts programs with SIGHUP ignored, and a shell's background jobs ignore SIGINT.
TEST(Interruption, LeavesIgnoredSignalsIgnored) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(end_of_process([&] {
                std::signal(signal, SIG_IGN);
                const std::stop_token stop = interruption().get_token();
                raise(signal);
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
                if (stop.stop_requested()) _exit(1);
              }),
              0)
        << signal;
  }
}

TEST(Interruption, EndsTheProcessAtTheSecondSignal) {
  EXPECT_EQ(end_of_process([] {
              const std::stop_token stop = interruption().get_token();
              raise(SIGINT);
              wait_for(stop);
              raise(SIGINT);
            }),
            128 + SIGINT);
}

int threads_of_this_process() {
  const std::filesystem::directory_iterator threads("/proc/self/task");
  return static_cast<int>(std::distance(begin(threads), end(threads)));
}

TEST(Interruption, NobodyListensAnyMoreWhereThePipeHasComeToAnEnd) {
  EXPECT_EQ(end_of_process([] {
              interruption();
              close_range(3, ~0U, 0);
              while (threads_of_this_process() > 1) std::this_thread::yield();
            }),
            0);
}

/// Returns how often a thread of this process has waited.
/// @param thread number of the thread, as from `gettid`
long waits(pid_t thread) {
  std::ifstream status("/proc/self/task/" + std::to_string(thread) + "/status");
  const std::string name = "voluntary_ctxt_switches:";
  std::string word;
  long count = -1;
  while (status >> word && word != name) {
  }
  status >> count;
  return count;
}

/// Takes a step, waits for a line of input that never comes, and is stopped. Returns how often this thread woke up
/// during a second in the middle of the wait, so that the step, its output and the end of the wait do not count.
long wakes_in_a_wait_for_the_next_step(const Simulation& simulation) {
  using std::chrono_literals::operator""ms;
  std::stop_source stop;
  StepByStep steps(stop);
  long wakes = 0;
  {
    const std::jthread person([&, thread = gettid()] {
      std::this_thread::sleep_for(500ms);
      const long before = waits(thread);
      std::this_thread::sleep_for(1000ms);
      wakes = waits(thread) - before;
      stop.request_stop();
    });
    steps.after_step(simulation, {}, 0);
  }
  return wakes;
}

TEST(Interruption, EndsTheWaitForTheNextStepWithoutBeingAskedFor) {
  EXPECT_EQ(
      end_of_process([] {
        std::array<int, 2> typed{};
        if (pipe(typed.data()) != 0 || dup2(typed[0], STDIN_FILENO) < 0) _exit(1);
        const Simulation simulation({.cloth = make_cloth(make_grid(2, 2), make_grid(2, 2), 1, 1, {}), .step = 0.01});
        if (wakes_in_a_wait_for_the_next_step(simulation) > 2) _exit(2);
      }),
      0);
}

}  // namespace
}  // namespace drape

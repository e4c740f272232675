// A signal is passed on as soon as it comes: nobody has to ask for it.

#include "cli/interruption.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <condition_variable>
#include <csignal>
#include <mutex>

namespace drape {
namespace {

/// Runs `work` in a process of its own, and returns how that ends, as a shell says it. After half a minute SIGALRM ends
/// it.
template <class Work>
int end_of_process(Work&& work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(30);
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

TEST(Interruption, EndsTheProcessAtTheSecondSignal) {
  EXPECT_EQ(end_of_process([] {
              const std::stop_token stop = interruption().get_token();
              raise(SIGINT);
              wait_for(stop);
              raise(SIGINT);
            }),
            128 + SIGINT);
}

}  // namespace
}  // namespace drape

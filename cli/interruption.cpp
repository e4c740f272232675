#include "cli/interruption.hpp"

#include <atomic>
#include <csignal>

namespace drape {
namespace {

std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only use lock-free atomics");

void handle(int) { signalled = true; }

void install() {
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
}

}  // namespace

std::stop_source& interruption() {
  static std::stop_source source = (install(), std::stop_source());
  return source;
}

bool interrupted() {
  if (signalled) interruption().request_stop();
  return interruption().stop_requested();
}

}  // namespace drape

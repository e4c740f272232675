#include "cli/interruption.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

namespace drape {
namespace {

std::array<int, 2> signals{-1, -1};  // pipe from the signal handler to listen()

void handle(int) {
  const int before = errno;
  const char byte = 0;
  [[maybe_unused]] const ssize_t written = write(signals[1], &byte, 1);  // a full pipe has already woken the reader
  errno = before;
}

/// Waits for the first signal and requests a stop. If the pipe fails, the first signal is lost; the second one ends the
/// process by default.
void listen(std::stop_source source) {
  char byte = 0;
  ssize_t count = 0;
  do {
    count = read(signals[0], &byte, 1);
  } while (count < 0 && errno == EINTR);
  if (count == 1) source.request_stop();
}

std::stop_source install() {
  std::stop_source source;
  if (pipe2(signals.data(), O_CLOEXEC | O_NONBLOCK) != 0 || fcntl(signals[0], F_SETFL, 0) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot listen for signals");
  }
  std::thread(listen, source).detach();  // runs until the process ends
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
  return source;
}

}  // namespace

std::stop_source& interruption() {
  static std::stop_source source = install();
  return source;
}

}  // namespace drape

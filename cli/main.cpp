#include <csignal>

#include "cli/command_line.hpp"
#include "core/console.hpp"
#include "core/installation.hpp"

int main(int argc, char** argv) {
  drape::open_standard_streams();
  drape::use_portable_data();
  // A reader that has gone away and a file that may not grow are errors of writing, with a message: dying of them would
  // leave hidden files behind.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(drape::run_command_line(argc, argv));
}

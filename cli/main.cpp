#include <csignal>

#include "cli/command_line.hpp"
#include "core/console.hpp"
#include "core/installation.hpp"

int main(int argc, char** argv) {
  drape::open_standard_streams();
  drape::use_portable_data();
  // Turn a vanished reader and the file size limit into write errors: death by signal would leave temporary files
  // behind.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(drape::run_command_line(argc, argv));
}

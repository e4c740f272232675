#include "cli/open_file.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <vector>

#include "core/installation.hpp"
#include "core/text.hpp"

namespace drape {

void open_file(const std::string& what) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  }
  std::string program = "xdg-open", argument = what;
  if (argument.starts_with('-')) argument.insert(0, "./");
  const std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  std::vector<std::string> variables = environment_for_others();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    spdlog::warn("cannot open {}: there is no xdg-open; on Debian: apt-get install xdg-utils", shown(what));
}

}  // namespace drape

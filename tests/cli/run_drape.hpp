#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

#include "tests/support/scene_folder.hpp"

namespace drape::test {

struct Finished {
  int code = -1;
  std::string text;  // standard output and error together
};

/// Runs a shell command in the folder.
inline Finished run_shell(const SceneFolder& folder, const std::string& command) {
  const std::string line = "cd '" + folder.path().string() + "' && " + command + " 2>&1";
  Finished finished;
  FILE* pipe = popen(line.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
    finished.text.append(buffer.data(), count);
  const int status = pclose(pipe);
  finished.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return finished;
}

inline Finished run(const SceneFolder& folder, const std::string& command) { return run_shell(folder, command); }

/// Runs the built drape in the folder.
/// @param environment assignments before it on the shell's command line
inline Finished drape(const SceneFolder& folder, const std::string& arguments, const std::string& environment = "") {
  return run_shell(folder, environment + " " + DRAPE_EXECUTABLE + " " + arguments);
}

/// A cloth that swings for 0.4 s; tests add tables.
const std::string swinging_scene =
    "[cloth]\n"
    "mesh = { grid = [6, 6] }\n"
    "stiffness = 50\n"
    "pins = [\"corner:x-y-\", \"corner:x+y-\"]\n"
    "[time]\n"
    "step = 0.02\n"
    "duration = 0.4\n"
    "[integrator]\n"
    "method = \"liu13\"\n"
    "tolerance = 1e-3\n"
    "[effects.gravity]\n";

}  // namespace drape::test

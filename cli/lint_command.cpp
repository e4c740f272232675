#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/advice.hpp"
#include "cli/command_line.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/text.hpp"
#include "run/outputs.hpp"
#include "scene/motion_scene.hpp"

namespace drape {
namespace {

/// Number of lines of each kind.
struct Count {
  int errors = 0, hints = 0;
};

std::string counted(int count, const char* what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

/// Prints errors and hints about a scene.
void lint(const std::string& file, const std::vector<std::string>& overrides, const Terminal& where, Count& count) {
  const auto hint = [&](const std::string& text) {
    ++count.hints;
    print_unescaped(stdout, wrapped(inked("hint", Ink::yellow, where) + ": " + text + "\n", where.width, 2));
  };
  try {
    if (const auto of_motion = load_scene_of_motion(file, overrides)) return require_texture(of_motion->look);
    const Scene scene = load_scene(file, overrides);
    require_texture(scene);
    for (const std::string& text : advice_on(scene, read_document(file))) hint(escape_controls(text));
    const std::string pace = advice_on_pace(scene);
    if (!pace.empty()) hint(fmt::format("{}: slow: {}", shown(scene.file), pace));
  } catch (const Error& error) {
    for (std::string_view rest = error.what(); !rest.empty();) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      ++count.errors;
      print_unescaped(stdout, wrapped(inked("error", Ink::red, where) + ": " +
                                          escape_controls(std::string(rest.substr(0, end))) + "\n",
                                      where.width, 2));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
}

}  // namespace

void add_lint_command(CLI::App& app, const CommonOptions& common, Command& command) {
  struct Arguments {
    std::vector<std::string> scenes, overrides;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* sub = app.add_subcommand("lint", "Check scenes without running them, and advise");
  sub->add_option("SCENE", arguments->scenes, "Scene files (TOML)")->required();
  sub->add_option("--set", arguments->overrides, "Override a value of all scenes: key.path=value; repeatable")
      ->allow_extra_args(false);
  sub->callback([arguments, &common, &command] {
    command = [arguments, &common] {
      const Terminal where = terminal(stdout, common.color);
      Count count;
      for (const std::string& scene : arguments->scenes) lint(scene, arguments->overrides, where, count);
      if (!common.quiet) {
        print_text(stdout, fmt::format("{}: {}, {}\n", counted(static_cast<int>(arguments->scenes.size()), "scene"),
                                       counted(count.errors, "error"), counted(count.hints, "hint")));
      }
      return count.errors > 0 ? ExitCode::usage : ExitCode::ok;
    };
  });
}

}  // namespace drape

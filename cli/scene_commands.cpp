#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/inputs.hpp"
#include "cli/manual/manual.hpp"
#include "cli/options.hpp"
#include "cli/scene_run.hpp"
#include "cli/summary.hpp"
#include "cli/terminal.hpp"
#include "cli/watch/session.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "render/gl/context.hpp"
#include "run/outputs.hpp"
#include "scene/motion_scene.hpp"
#include "scene/values/json_schema.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> scene_kinds{"flag", "tablecloth", "curtain", "hanging", "garment"};

/// Returns the text of a first scene; its first line refers editors to the schema.
std::string first_scene(const std::string& kind) {
  constexpr std::size_t most_bytes = 1 << 16;
  const fs::path scenes = data_folder() / "scenes";
  const std::string text = read_file(scenes / "new" / (kind + ".toml"), most_bytes);
  const fs::path schema = fs::absolute(scenes / "scene.schema.json").lexically_normal();
  return "#:schema " + schema.string() + text.substr(text.find('\n'));
}

ExitCode write_scene(const std::string& kind, std::string file, bool quiet) {
  if (std::ranges::find(scene_kinds, kind) == scene_kinds.end()) {
    throw UsageError(fmt::format("drape new: unknown '{}'{}", kind, did_you_mean(kind, scene_kinds, "there are")));
  }
  if (file.empty()) file = kind + ".toml";
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) file = (fs::path(file) / (kind + ".toml")).string();
  if (fs::exists(file, ignored)) throw UsageError(fmt::format("{} exists already: give another name", shown(file)));
  write_file_atomically(file, first_scene(kind));
  if (!quiet) {
    print_wrapped(stdout, fmt::format("{0} is written. Draw it: drape render {1}\nWatch it change as you edit it: "
                                      "drape watch {1}\n",
                                      shown(file), shell_file(file)));
  }
  return ExitCode::ok;
}

}  // namespace

void add_new_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto kind = std::make_shared<std::string>(), file = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("new", "Write a commented scene to begin with");
  sub->add_option("KIND", *kind, fmt::format("{}", fmt::join(scene_kinds, ", ")))
      ->required()
      ->type_name(fmt::format("{}", fmt::join(scene_kinds, "|")));
  sub->add_option("FILE", *file, "Scene file to write; default KIND.toml");
  complete_command(
      *sub, command, [kind, file, &common] { return write_scene(*kind, *file, common.quiet); },
      "new flag\n"
      "new tablecloth table.toml");
}

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
    const LoadedScene scene = load_scene(file, overrides);
    require_texture(scene);
    for (const std::string& text : advice_on(scene, read_document(file))) hint(escape_controls(text));
    const std::string pace = advice_on_pace(scene);
    if (!pace.empty()) hint(fmt::format("{}: slow: {}", shown(scene.source.file), pace));
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
  complete_command(
      *sub, command,
      [arguments, &common] {
        const Terminal where = terminal(stdout, common.color);
        Count count;
        for (const std::string& scene : arguments->scenes) lint(scene, arguments->overrides, where, count);
        if (!common.quiet) {
          print_text(stdout, fmt::format("{}: {}, {}\n", counted(static_cast<int>(arguments->scenes.size()), "scene"),
                                         counted(count.errors, "error"), counted(count.hints, "hint")));
        }
        return count.errors > 0 ? ExitCode::usage : ExitCode::ok;
      },
      "lint scene.toml\n"
      "lint scenes/*.toml");
}

void add_schema_command(CLI::App& app, Command& command) {
  auto file = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("schema", "Print a JSON schema of scene files, for editors");
  sub->add_option("-o,--output", *file, "Write it to this file instead");
  complete_command(
      *sub, command,
      [file] {
        if (file->empty()) {
          print_text(stdout, json_schema::scene());
        } else {
          write_file_atomically(*file, json_schema::scene());
        }
        return ExitCode::ok;
      },
      "schema\n"
      "schema -o scene.schema.json");
}

namespace {

ExitCode write_manual(const CLI::App& app, const std::filesystem::path& share) {
  const CommandText drape = describe_command(app);
  const std::vector<TableText> tables = reference_tables();
  const auto write = [&](const std::filesystem::path& file, const std::string& text) {
    write_file_atomically(share / file, text);
  };
  for (const ManPage& page : command_pages(drape)) write("man/man1/" + page.file, page.text);
  const ManPage scenes = scene_page(tables);
  write("man/man5/" + scenes.file, scenes.text);
  write("bash-completion/completions/drape", bash_completion);
  write("zsh/vendor-completions/_drape", zsh_completion);
  write("fish/vendor_completions.d/drape.fish", fish_completion);
  return ExitCode::ok;
}

}  // namespace

void add_manual_command(CLI::App& app, Command& command) {
  auto folder = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("manual", "Write the manual's pages and the shells' completions into a folder");
  sub->group("");  // hidden: used by installation
  sub->add_option("FOLDER", *folder, "Laid out as /usr/share")->required();
  complete_command(*sub, command, [folder, &app] { return write_manual(app, *folder); });
}

void add_complete_command(CLI::App& app, Command& command) {
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* sub = app.add_subcommand("complete", "Print the completions of a command line's last word");
  sub->group("");  // hidden: used by the shells' completions
  sub->add_option("WORD", *words, "The words after drape; the last one is incomplete, maybe empty");
  complete_command(*sub, command, [words, &app] {
    for (const Completion& one : completions(describe_command(app), reference_tables(), *words)) {
      // A tab or a new line in the name of a file would end the word.
      if (one.word.find_first_of("\t\n") != std::string::npos) continue;
      print_unescaped(stdout, one.help.empty() ? one.word + "\n" : fmt::format("{}\t{}\n", one.word, one.help));
    }
    return ExitCode::ok;
  });
}

namespace {

struct WatchArguments {
  std::string scene;
  std::vector<std::string> overrides, quality;
  int port = 0;
  bool hidden = false;
  GlBackend backend = GlBackend::automatic;
};

ExitCode watch(const WatchArguments& arguments, const CommonOptions& common) {
  const std::stop_token stop = interruption().get_token();
  if (!std::filesystem::is_regular_file(arguments.scene)) {
    throw UsageError(fmt::format("{}: there is no such file", shown(arguments.scene)));
  }
  inspect_backend(arguments.backend);
  std::vector<std::string> overrides =
      arguments.quality.empty() ? std::vector<std::string>{"look.quality=draft"} : arguments.quality;
  overrides.insert(overrides.end(), arguments.overrides.begin(), arguments.overrides.end());
  WatchSession session(arguments.scene, overrides, arguments.backend,
                       [](const LoadedScene& scene, const RunOptions& options) { return describe(scene, options); });
  const WatchServer server(session, arguments.port);
  print_text(stdout, fmt::format("{}\n", server.address()));
  if (!common.quiet)
    spdlog::info("shows {} in a browser, and draws it anew when it is saved; Ctrl-C ends this", shown(arguments.scene));
  if (!arguments.hidden) open_file(server.address());
  session.run(stop);
  return ExitCode::interrupted;
}

}  // namespace

void add_watch_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<WatchArguments>();
  CLI::App* sub = app.add_subcommand("watch", "Show a scene's film in a browser, drawn anew whenever it is saved");
  sub->add_option("SCENE", arguments->scene, "Scene file (TOML)")->required();
  sub->add_option("--set", arguments->overrides, "Override a value of the scene: key.path=value; repeatable")
      ->allow_extra_args(false);
  add_quality_option(*sub, arguments->quality);
  sub->add_option("--port", arguments->port, "Port on 127.0.0.1; default any that is free")
      ->check(whole_number_in({0, 65535}));
  sub->add_flag("--no-open", arguments->hidden, "Only print the address of the page");
  add_backend_option(*sub, arguments->backend);
  complete_command(
      *sub, command, [arguments, &common] { return watch(*arguments, common); },
      "watch scene.toml\n"
      "watch scene.toml --port 8000 --no-open");
}

}  // namespace drape

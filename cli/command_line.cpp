#include "cli/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/console.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/settings.hpp"
#include "scene/tables.hpp"

namespace drape {
namespace {

void set_up_logging(const CommonOptions& common) {
  log_to_terminal(common.color);
  spdlog::set_level(common.quiet ? spdlog::level::err : common.verbose ? spdlog::level::debug : spdlog::level::info);
}

/// Adds an option that takes one of several names and sets the enumerator of the same index.
template <class Enum>
void add_choice(CLI::App& app, const char* option, Enum& value, const std::vector<std::string>& names,
                const char* help) {
  app.add_option_function<std::string>(
         option,
         [option, &value, names](const std::string& given) {
           const auto found = std::find(names.begin(), names.end(), given);
           if (found == names.end()) {
             throw CLI::ValidationError(option,
                                        "unknown '" + given + "'" + did_you_mean(given, names, "the choices are"));
           }
           value = static_cast<Enum>(found - names.begin());
         },
         help)
      ->type_name(fmt::format("{}", fmt::join(names, "|")));
}

/// Formatter that shows an option's value and repetition. Required arguments appear in the usage line; exclusive
/// options are reported on misuse.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { label("Positionals", "Arguments"); }
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return {};
    const bool several = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    return (option->get_positional() ? "" : " " + option->get_type_name()) + (several ? " ..." : "");
  }
};

/// Names the value of --set and --vary KEY=VALUE in help and completion.
void name_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->check_lname("set") || option->check_lname("vary")) option->type_name("KEY=VALUE");
  }
  for (CLI::App* subcommand : app.get_subcommands([](CLI::App*) { return true; })) name_values(*subcommand);
}

constexpr const char* empty_value = "expected a value, found an empty text";

/// Rejects empty values of options, except those that check their values themselves.
void refuse_empty_values(CLI::App& app) {
  const auto problem = [](const std::string& value) {
    return value.empty() ? std::string(empty_value) : std::string();
  };
  for (CLI::Option* option : app.get_options()) {
    const bool own = option->check_lname("set") || option->check_lname("vary") || option->check_lname("output") ||
                     option->check_lname("threads");
    if (option->get_type_size() > 0 && !option->get_positional() && !own) option->check(CLI::Validator(problem, ""));
  }
  for (CLI::App* subcommand : app.get_subcommands([](CLI::App*) { return true; })) refuse_empty_values(*subcommand);
}

/// Rejects "--frames=", for example from an unset shell variable. CLI11 would take the next argument as the value.
/// @throws CLI::ValidationError
void refuse_nothing_after_equals(std::span<const char* const> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--") || argument.find('=') + 1 != argument.size()) continue;
    throw CLI::ValidationError(std::string(argument.substr(0, argument.size() - 1)), empty_value);
  }
}

/// Returns the command line quoted for a shell. The program is called drape, wherever it is.
std::string typed_command(std::span<const char* const> arguments) {
  std::string text = "drape";
  for (const char* argument : arguments.subspan(std::min<std::size_t>(1, arguments.size()))) {
    text += " " + shell_word(argument);
  }
  return text;
}

void print_help(const CLI::App& of, const std::string& name, const CommonOptions& common) {
  // of.help() would show the help of the chosen subcommand
  const std::string help = of.get_formatter()->make_help(&of, name, CLI::AppFormatMode::Normal);
  print_text(stdout, wrapped_help(help, terminal(stdout, common.color).width));
}

/// Returns the full name of a command: "drape study accuracy".
std::string full_name(const CLI::App& of) {
  return of.get_parent() == nullptr ? of.get_name() : full_name(*of.get_parent()) + " " + of.get_name();
}

void add_help_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto names = std::make_shared<std::vector<std::string>>();
  CLI::App* help = app.add_subcommand("help", "Show the help of drape or of a command");
  help->add_option("COMMAND", *names, "Names of a command, such as render or study accuracy");
  complete_command(
      *help, command,
      [&app, names, &common] {
        const CLI::App& of = find_command(app, *names);
        print_help(of, full_name(of), common);
        return ExitCode::ok;
      },
      "help render\n"
      "help study accuracy");
}

/// Prints the list of commands.
void print_commands(const CLI::App& app) {
  std::string text = app.get_description() + "\n\nUsage: drape COMMAND ...\n\n";
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_group().empty()) continue;
    text += fmt::format("  {:<10}{}\n", command->get_name(), command->get_description());
  }
  text += "\nBegin with: drape new flag. Options and examples: drape help COMMAND\n";
  constexpr std::size_t descriptions_at = 12;
  print_text(stdout, wrapped(text, terminal(stdout, ColorMode::never).width, descriptions_at - 2));
}

/// Returns the code, or the code of a write error if printed text was lost.
ExitCode code_or_write_error(ExitCode code) {
  const int error = lost_output();
  if (error == 0) return code;
  spdlog::error("cannot write to standard output: {}", std::generic_category().message(error));
  return std::max(code, ExitCode::output);
}

/// Returns the command whose --help is shown: the last one named.
const CLI::App& command_of_help(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? app : command_of_help(*chosen.front());
}

/// Calls `use` with the value of a non-empty environment variable.
template <class Use>
void with_variable(const char* name, const Use& use) {
  const char* value = std::getenv(name);
  if (value == nullptr || *value == '\0') return;
  try {
    use(value);
  } catch (const UsageError& error) {
    throw UsageError(std::string(name) + ": " + error.what());
  }
}

ExitCode report(const Error& error) {
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = std::string_view(error.what()).find('\n', begin);
    spdlog::error(std::string_view(error.what()).substr(begin, end == std::string::npos ? end : end - begin));
  }
  return exit_code(error.kind());
}

}  // namespace

void add_backend_option(CLI::App& subcommand, GlBackend& backend) {
  subcommand
      .add_option_function<std::string>(
          "--backend",
          [&backend](const std::string& given) {
            std::vector<std::string> names;
            for (const GlBackend known : {GlBackend::automatic, GlBackend::osmesa, GlBackend::egl}) {
              names.emplace_back(backend_name(known));
              if (given == names.back()) {
                backend = known;
                return;
              }
            }
            throw CLI::ValidationError(
                "--backend", "unknown backend '" + given + "'" + did_you_mean(given, names, "the backends are"));
          },
          "OpenGL library; default auto")
      ->type_name("auto|osmesa|egl");
}

void use_environment_isa() { with_variable("DRAPE_ISA", limit_instruction_set); }
void use_environment_data() {
  with_variable("DRAPE_DATA", [](const char* folder) { use_data_folder(folder); });
}

namespace {

void add_commands(CLI::App& app, CommonOptions& common, Command& command) {
  add_new_command(app, common, command);
  add_run_commands(app, common, command);
  add_watch_command(app, common, command);
  add_lint_command(app, common, command);
  add_compare_command(app, common, command);
  add_import_command(app, common, command);
  add_audit_command(app, common, command);
  add_sweep_command(app, common, command);
  add_merge_command(app, common, command);
  add_check_command(app, common, command);
  add_accept_command(app, common, command);
  add_bless_command(app, common, command);
  add_study_command(app, common, command);
  add_validate_command(app, common, command);
  add_schema_command(app, command);
  add_doctor_command(app, command);
  add_help_command(app, common, command);
  add_manual_command(app, command);
  add_complete_command(app, command);
  add_examples(app,
               "new flag\n"
               "render flag.toml\n"
               "render flag.toml --set look.color=navy -o navy.mp4\n"
               "help render");
}

/// Parses the command line and sets up logging. Returns an exit code if there is no command to run: after help, the
/// version or an error.
std::optional<ExitCode> parse(CLI::App& app, std::span<const char* const> arguments, const CommonOptions& common) {
  try {
    refuse_nothing_after_equals(arguments);
    app.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::CallForHelp&) {
    const CLI::App& of = command_of_help(app);
    set_up_logging(common);
    print_help(of, full_name(of), common);
    return code_or_write_error(ExitCode::ok);
  } catch (const CLI::CallForVersion& version) {
    set_up_logging(common);
    print_text(stdout, std::string(version.what()) + "\n");
    return code_or_write_error(ExitCode::ok);
  } catch (const CLI::ParseError& error) {
    set_up_logging(common);
    if (arguments.size() <= 1) {
      print_commands(app);
      return code_or_write_error(ExitCode::usage);
    }
    spdlog::error(explain(app, error, arguments.subspan(1)));
    return ExitCode::usage;
  }
  set_up_logging(common);
  return {};
}

/// Reads the command line, runs the chosen subcommand and returns the exit code; errors go to standard error.
ExitCode run_command_line(int argc, const char* const* argv) {
  const std::span arguments(argv, static_cast<std::size_t>(argc));
  CLI::App app("Simulates mass-spring cloth and renders it offscreen into GIF, PNG and MP4.", "drape");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", "drape " + build_info().version, "Print the version");
  app.require_subcommand(1);
  app.fallthrough();
  CommonOptions common;
  common.command = typed_command(arguments);
  auto* quiet = app.add_flag("--quiet", common.quiet, "Print errors only");
  app.add_flag("--verbose", common.verbose, "Print more details")->excludes(quiet);
  add_choice(app, "--color", common.color, {"auto", "always", "never"},
             "Colours in messages; default auto; NO_COLOR turns them off too");
  Command command;
  add_commands(app, common, command);
  name_values(app);
  refuse_empty_values(app);
  if (const auto ended = parse(app, arguments, common)) return *ended;
  const bool diagnosed = app.got_subcommand("doctor");  // doctor reports environment errors as findings
  return code_or_write_error(reported([&] {
    if (!diagnosed) {
      use_environment_isa();
      use_environment_data();
    }
    return command();
  }));
}

}  // namespace

ExitCode reported(const std::function<ExitCode()>& work) {
  try {
    return work();
  } catch (const Error& error) {
    return report(error);
  } catch (const std::bad_alloc&) {
    spdlog::error("not enough memory");
    return ExitCode::usage;
  } catch (const std::system_error& error) {
    spdlog::error("the system refused a resource: {}", error.code().message());
    return ExitCode::usage;
  }
}

void add_examples(CLI::App& command, std::string_view lines) {
  std::string text = "Examples:";
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    text.append("\n  drape ").append(lines.substr(begin, end - begin));
    begin = end + 1;
  }
  command.footer(text);
}

void complete_command(CLI::App& subcommand, Command& command, Command work, std::string_view examples) {
  subcommand.callback([&command, work = std::move(work)] { command = work; });
  if (!examples.empty()) add_examples(subcommand, examples);
}

namespace {

/// Returns the most specific subcommand that was chosen, or the app itself.
const CLI::App& chosen_command(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? app : chosen_command(*chosen.front());
}

/// Returns the options that may have been intended: those of the app and the chosen subcommand.
std::vector<std::string> known_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* of : {&app, &chosen_command(app)}) {
    for (const CLI::Option* option : of->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands(nullptr)) {
    if (!subcommand->get_group().empty()) names.push_back(subcommand->get_name());
  }
  return names;
}

/// A key of a scene with its table, "caption.size". `pair` means that it takes two whole numbers.
struct NamedKey {
  std::string path;
  bool pair;
};

std::vector<NamedKey> keys_named(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  std::vector<NamedKey> found;
  for_each_table([&](const TableType& table) {
    for (const Key& key : table.keys.all()) {
      if (key.name != name) continue;
      const bool pair =
          key.pointer<Eigen::Vector2i>() != nullptr || key.pointer<std::optional<Eigen::Vector2i>>() != nullptr;
      found.push_back({table.name + "." + key.name, pair});
    }
  });
  return found;
}

/// Converts "640x480" or "640,480" to a scene's array, "[640,480]"; returns other texts unchanged.
std::string as_pair(const std::string& text) {
  const std::size_t between = text.find_first_of("x,");
  const auto whole = [](std::string_view part) {
    return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (between == std::string::npos) return text;
  const std::string first = text.substr(0, between), second = text.substr(between + 1);
  return whole(first) && whole(second) ? fmt::format("[{},{}]", first, second) : text;
}

/// Returns "'--set video.fps=30'", quoted for a shell if necessary.
std::string set_option(const std::string& assignment) {
  const std::string word = shell_word(assignment);
  return word == assignment ? fmt::format("'--set {}'", word) : fmt::format("--set {}", word);
}

/// Returns the value given to an option: after its '=', or the next word.
std::string value_of(const std::string& option, std::span<const char* const> words) {
  if (const std::size_t equals = option.find('='); equals != std::string::npos) return option.substr(equals + 1);
  const auto found = std::find(words.begin(), words.end(), option);
  if (found == words.end() || found + 1 == words.end()) return "VALUE";
  const std::string_view next = *(found + 1);
  return next.starts_with("--") ? "VALUE" : std::string(next);
}

/// Returns a hint for an option that is a key of the scene; nothing otherwise, or if the command takes no keys.
std::optional<std::string> key_instead(const CLI::App& app, const std::string& word,
                                       std::span<const char* const> words) {
  if (!word.starts_with("--") || chosen_command(app).get_option_no_throw("--set") == nullptr) return std::nullopt;
  const std::string name = word.substr(0, word.find('='));
  const std::vector<NamedKey> keys = keys_named(name.substr(2));
  if (keys.empty()) return std::nullopt;
  const std::string given = value_of(word, words), pair = as_pair(given);
  const bool is_pair = pair.starts_with("[");
  const auto takes = [is_pair](const NamedKey& key) { return key.pair == is_pair; };
  const bool any = std::ranges::any_of(keys, takes);  // otherwise ignore the form of the value
  constexpr std::size_t most = 3;
  std::size_t told = 0;
  std::string meant;
  for (const NamedKey& key : keys) {
    if ((any && !takes(key)) || told == most) continue;
    const std::string value = key.pair && !is_pair ? "[640,480]" : key.pair ? pair : given;
    meant += (told++ == 0 ? "" : " or ") + set_option(key.path + "=" + value);
  }
  return fmt::format("'{}' is a key of the scene, not an option; did you mean {}?", name, meant);
}

}  // namespace

std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> words) {
  const std::vector<std::string> extras = app.remaining(true);
  if (extras.empty()) return fmt::format("{}; see drape help", error.what());
  const std::string& word = extras.front();
  if (word.starts_with("-")) {
    if (const auto key = key_instead(app, word, words)) return *key;
    return "unknown option '" + word + "'" + did_you_mean(word, known_options(app), "options");
  }
  const bool scene = word.ends_with(".toml"), motion = word.ends_with(".drape");
  if ((scene || motion) && app.get_subcommands().empty()) {
    return fmt::format("'{}' is a {}, not a command; did you mean 'drape render {}'?", word, scene ? "scene" : "motion",
                       shell_word(word));
  }
  const CLI::App& chosen = chosen_command(app);
  const CLI::App& parent = chosen.get_subcommands(nullptr).empty() ? app : chosen;
  return "unknown command '" + word + "'" + did_you_mean(word, subcommand_names(parent), "commands");
}

const CLI::App& find_command(const CLI::App& app, std::span<const std::string> names) {
  if (names.empty()) return app;
  for (const CLI::App* subcommand : app.get_subcommands(nullptr)) {
    if (subcommand->get_name() == names.front()) return find_command(*subcommand, names.subspan(1));
  }
  throw UsageError("unknown command '" + names.front() + "'" +
                   did_you_mean(names.front(), subcommand_names(app), "commands"));
}

}  // namespace drape

int main(int argc, char** argv) {
  try {
    drape::open_standard_streams();
    drape::use_portable_data();
    // Turn a vanished reader and the file size limit into write errors: death by signal would leave temporary files
    // behind.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    return static_cast<int>(drape::run_command_line(argc, argv));
  } catch (const std::exception& error) {  // outside of a command, which reports its own
    std::fprintf(stderr, "drape: %s\n", error.what());
    return static_cast<int>(drape::ExitCode::usage);
  }
}

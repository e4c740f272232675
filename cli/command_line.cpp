#include "cli/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <new>
#include <span>
#include <system_error>

#include "cli/environment.hpp"
#include "cli/examples.hpp"
#include "cli/suggestions.hpp"
#include "core/build_info.hpp"
#include "core/console.hpp"
#include "core/nearest.hpp"

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
  help->callback([&app, names, &common, &command] {
    command = [&app, names, &common] {
      const CLI::App& of = find_command(app, *names);
      print_help(of, full_name(of), common);
      return ExitCode::ok;
    };
  });
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

ExitCode run_command_line(int argc, const char* const* argv) {
  CLI::App app("Simulates mass-spring cloth and renders it offscreen into GIF, PNG and MP4.", "drape");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", "drape " + build_info().version, "Print the version");
  app.require_subcommand(1);
  app.fallthrough();
  CommonOptions common;
  auto* quiet = app.add_flag("--quiet", common.quiet, "Print errors only");
  app.add_flag("--verbose", common.verbose, "Print more details")->excludes(quiet);

  add_choice(app, "--color", common.color, {"auto", "always", "never"},
             "Colours in messages; default auto; NO_COLOR turns them off too");

  Command command;
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
  add_examples(app);
  name_values(app);
  refuse_empty_values(app);
  try {
    refuse_nothing_after_equals(std::span(argv, static_cast<std::size_t>(argc)));
    app.parse(argc, argv);
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
    if (argc <= 1) {
      print_commands(app);
      return code_or_write_error(ExitCode::usage);
    }
    spdlog::error(explain(app, error, std::span(argv, static_cast<std::size_t>(argc)).subspan(1)));
    return ExitCode::usage;
  }

  set_up_logging(common);
  const bool diagnosed = app.got_subcommand("doctor");  // doctor reports environment errors as findings
  return code_or_write_error(reported([&] {
    if (!diagnosed) use_environment();
    return command();
  }));
}

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

}  // namespace drape

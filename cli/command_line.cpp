#include "cli/command_line.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <new>
#include <system_error>

#include "cli/environment.hpp"
#include "core/build_info.hpp"
#include "core/console.hpp"
#include "core/nearest.hpp"

namespace drape {
namespace {

void set_up_logging(const CommonOptions& common) {
  auto logger = spdlog::stderr_color_st("drape");
  logger->set_pattern("drape: %v");
  logger->set_level(common.quiet ? spdlog::level::err : common.verbose ? spdlog::level::debug : spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

/// The words that could have been meant at the place where parsing stopped: the options of the chosen subcommand.
std::vector<std::string> known_options(const CLI::App& app) {
  std::vector<std::string> names;
  const auto add = [&](const CLI::App& of) {
    for (const CLI::Option* option : of.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  };
  add(app);
  for (const CLI::App* chosen : app.get_subcommands()) add(*chosen);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands(nullptr)) names.push_back(subcommand->get_name());
  return names;
}

std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining(true);
  if (extras.empty()) return fmt::format("{}; see drape --help", error.what());
  const std::string& word = extras.front();
  if (word.starts_with("-")) return "unknown option '" + word + "'" + did_you_mean(word, known_options(app), "options");
  return "unknown command '" + word + "'" + did_you_mean(word, subcommand_names(app), "commands");
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
          "OpenGL library: auto (default), osmesa or egl")
      ->type_name("NAME");
}

ExitCode run_command_line(int argc, const char* const* argv) {
  CLI::App app("Simulates mass-spring cloth and renders it offscreen into GIF, PNG and MP4.", "drape");
  app.set_version_flag("--version", "drape " + build_info().version);
  app.require_subcommand(1);
  app.fallthrough();
  CommonOptions common;
  auto* quiet = app.add_flag("--quiet", common.quiet, "Print errors only");
  app.add_flag("--verbose", common.verbose, "Print more details")->excludes(quiet);

  Command command;
  add_run_commands(app, common, command);
  add_compare_command(app, common, command);
  add_sweep_command(app, common, command);
  add_merge_command(app, common, command);
  add_check_command(app, common, command);
  add_accept_command(app, common, command);
  add_bless_command(app, common, command);
  add_study_command(app, common, command);
  add_doctor_command(app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);  // --help or --version: printed, and all is well
      return ExitCode::ok;
    }
    set_up_logging(common);
    spdlog::error(explain(app, error));
    return ExitCode::usage;
  }

  set_up_logging(common);
  const bool diagnosed = app.got_subcommand("doctor");  // what is wrong with the environment is a finding of its own
  const ExitCode code = reported([&] {
    if (!diagnosed) use_environment();
    return command();
  });
  if (const int error = lost_output()) {
    spdlog::error("cannot write to standard output: {}", std::generic_category().message(error));
    return std::max(code, ExitCode::output);
  }
  return code;
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

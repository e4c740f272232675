#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "cli/exit_code.hpp"
#include "cli/terminal.hpp"
#include "render/backend.hpp"

namespace drape {

/// What every subcommand shares.
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  ColorMode color = ColorMode::automatic;
};

/// The work of a subcommand, done once the whole command line is read.
using Command = std::function<ExitCode()>;

/// Adds the subcommands that run scenes, render and simulate. The one that is chosen sets `command`.
void add_run_commands(CLI::App& app, const CommonOptions& common, Command& command);

/// Add new, which writes a scene to begin with, and lint, which says what may not be meant in scenes.
void add_new_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_lint_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds watch, which shows a scene's film in a browser while the scene is edited.
void add_watch_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds compare, which draws motions side by side.
void add_compare_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Add check, accept and bless likewise.
void add_check_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_accept_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_bless_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds import, which makes motion files of other programs' motions.
void add_import_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds audit, which checks the states of motions exactly.
void add_audit_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds sweep, which runs scenes with many values, and merge, which puts together what several machines have done.
void add_sweep_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_merge_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds study, whose subcommands are the studies.
void add_study_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds validate, which judges answers to problems whose answers are known.
void add_validate_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds schema, which prints a JSON schema of scenes.
void add_schema_command(CLI::App& app, Command& command);

/// Adds doctor, which says what drape finds on this machine.
void add_doctor_command(CLI::App& app, Command& command);

/// Adds manual, which is not in the help: it writes the manual's pages and the shells' completions of `app`.
void add_manual_command(CLI::App& app, Command& command);

/// Adds --backend, which every subcommand that draws has.
void add_backend_option(CLI::App& subcommand, GlBackend& backend);

/// Does work and returns its exit code; an error that it throws goes to standard error, and its code is returned.
ExitCode reported(const std::function<ExitCode()>& work);

/// Reads the command line, runs the chosen subcommand and returns the exit code; errors go to standard error.
ExitCode run_command_line(int argc, const char* const* argv);

}  // namespace drape

#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "cli/exit_code.hpp"
#include "cli/terminal.hpp"
#include "drape/render/settings.hpp"

namespace drape {

/// Options shared by all subcommands.
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  ColorMode color = ColorMode::automatic;
  std::string command = {};  ///< command line as typed, quoted for a shell
};

/// The work of a subcommand, executed after parsing of the whole command line.
using Command = std::function<ExitCode()>;

/// Ends the help of a command with examples: one per line, without the word drape.
void add_examples(CLI::App& command, std::string_view lines);

/// Completes a new subcommand: parsing it sets `command` to `work`.
/// @param examples see add_examples(); none if empty
void complete_command(CLI::App& subcommand, Command& command, Command work, std::string_view examples = {});

/// Adds the run commands render and simulate. Parsing one of them sets `command`.
void add_run_commands(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds new, which writes a first scene, and lint, which warns about probable mistakes in scenes.
void add_new_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_lint_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds watch, which shows a scene's film in a browser and updates it during edits.
void add_watch_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds compare, which draws motions side by side.
void add_compare_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds check, which compares scenes with goldens; accept, which makes a check's candidates golden; and bless, which
/// records goldens.
void add_check_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_accept_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_bless_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds import, which converts motions of other programs to motion files.
void add_import_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds audit, which checks the states of motions exactly.
void add_audit_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds sweep, which runs scenes with many values, and merge, which combines results of several machines.
void add_sweep_command(CLI::App& app, const CommonOptions& common, Command& command);
void add_merge_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds study, whose subcommands measure accuracy, cost and stability.
void add_study_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds validate, which evaluates results for problems with known solutions.
void add_validate_command(CLI::App& app, const CommonOptions& common, Command& command);

/// Adds schema, which prints a JSON schema of scenes.
void add_schema_command(CLI::App& app, Command& command);

/// Adds doctor, which reports the environment of drape on this machine.
void add_doctor_command(CLI::App& app, Command& command);

/// Adds the hidden command manual, which writes manual pages and shell completions of `app`.
void add_manual_command(CLI::App& app, Command& command);

/// Adds the hidden command complete, which prints the completions of an incomplete command line of `app`.
void add_complete_command(CLI::App& app, Command& command);

/// Adds --backend, shared by all subcommands that draw.
void add_backend_option(CLI::App& subcommand, GlBackend& backend);

/// Runs `work` and returns its exit code. Exceptions are printed to standard error and mapped to an exit code.
ExitCode reported(const std::function<ExitCode()>& work);

/// Applies drape's environment variable DRAPE_ISA: the highest instruction set for the hot loops.
/// @throws UsageError for an unknown name
void use_environment_isa();

/// Applies drape's environment variable DRAPE_DATA: the data folder.
/// @throws UsageError if there is no such folder
void use_environment_data();

/// Explains a command line error and suggests a correction: another command or option, `drape render` for a scene in
/// place of a command, or `--set` for a key of the scene written as an option.
/// @param words the command line, from its second word on
std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> words);

/// Returns the subcommand at a path of names, as in `study accuracy`.
/// @throws UsageError if there is none, with the nearest name
const CLI::App& find_command(const CLI::App& app, std::span<const std::string> names);

}  // namespace drape

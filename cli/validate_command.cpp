#include <fmt/format.h>

#include <memory>

#include "cli/command_line.hpp"
#include "core/console.hpp"
#include "study/validation_answers.hpp"

namespace drape {
namespace {

struct ValidateArguments {
  std::string name, file, problem;
};

ExitCode run_validate(const ValidateArguments& arguments, const CommonOptions& common) {
  const ValidationCase of = validation_cases({arguments.name}).front();
  std::string text;
  std::size_t met = 0;
  const std::vector<GivenAnswer> answers = read_answers(of, arguments.file, arguments.problem);
  for (const GivenAnswer& one : answers) {
    text += fmt::format("{} {}: {:.6g}, known {:.6g}, off by {:.2g}, allowed {:.2g}: {}\n", one.problem->name,
                        one.known->name, one.value, one.known->value, std::abs(one.value - one.known->value),
                        one.known->tolerance, one.met() ? "met" : "not met");
    met += one.met() ? 1 : 0;
  }
  text += fmt::format("{} of {} answers are met\n", met, answers.size());
  if (!common.quiet) print_text(stdout, text);
  return met == answers.size() ? ExitCode::ok : ExitCode::differs;
}

}  // namespace

void add_validate_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* sub = app.add_subcommand("validate", "Judge an answer to a problem whose answer is known");
  sub->add_option("CASE", arguments->name, "A case of scenes/validation")->required();
  sub->add_option("ANSWER", arguments->file,
                  "CSV with the columns problem,quantity,value; or NPZ with positions and times of one motion")
      ->required();
  sub->add_option("--problem", arguments->problem, "Problem of the case that the motion in an NPZ file is of");
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return run_validate(*arguments, common); }; });
}

}  // namespace drape

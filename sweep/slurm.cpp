#include "sweep/slurm.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

/// Quotes a word for an #SBATCH line: within double quotes a backslash escapes the next character, also # (Slurm's
/// _get_argument).
/// @throws UsageError
std::string slurm_word(const std::string& word) {
  if (word.find_first_of("\r\n") != std::string::npos) {
    throw UsageError(fmt::format("a script of Slurm cannot name '{}', as it has a line feed in it", shown(word)));
  }
  if (shell_word(word) == word) return word;
  std::string quoted = "\"";
  for (const char c : word) {
    if (std::string_view("\\\"#").find(c) != std::string_view::npos) quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

/// Returns a folder for the name of a log, with % doubled because Slurm replaces it.
std::filesystem::path log_folder(const std::filesystem::path& folder) {
  std::string text;
  for (const char c : folder.string()) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

/// Returns the head of a script with its #SBATCH lines.
std::string head(const SlurmJobs& jobs, const std::string& name, const std::string& log) {
  std::string text = fmt::format(
      "#!/bin/sh\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --chdir={}\n"
      "#SBATCH --output={}\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --requeue\n",
      name, slurm_word(std::filesystem::current_path().string()), slurm_word((log_folder(jobs.folder) / log).string()));
  for (const std::string& option : jobs.options) text += "#SBATCH " + option + "\n";
  return text;
}

}  // namespace

std::filesystem::path write_slurm_jobs(const SlurmJobs& jobs) {
  const std::string program = shell_word(jobs.program), folder = shell_word(jobs.folder.string());
  write_file_atomically(
      jobs.folder / "sweep.sbatch",
      head(jobs, "drape-sweep", "slurm-%a.log") +
          fmt::format("#SBATCH --array=1-{0}\n"
                      "# Each task is a shard with many runs. One that is run again leaves out what is complete.\n"
                      "exec {1} {2} --shard \"$SLURM_ARRAY_TASK_ID/{0}\" --resume --quiet\n",
                      jobs.tasks, program, jobs.sweep));
  write_file_atomically(jobs.folder / "merge.sbatch", head(jobs, "drape-merge", "slurm-merge.log") +
                                                          fmt::format("exec {} merge {}\n", program, folder));
  std::filesystem::path submit = jobs.folder / "submit.sh";
  write_file_atomically(submit,
                        fmt::format("#!/bin/sh\n"
                                    "# Submits the array, and what merges it when all its tasks have ended, however.\n"
                                    "set -eu\n"
                                    "array=$(sbatch --parsable {})\n"
                                    "merge=$(sbatch --parsable --dependency=\"afterany:${{array%%;*}}\" {})\n"
                                    "echo \"tasks ${{array%%;*}}, merge ${{merge%%;*}}\"\n",
                                    shell_word((jobs.folder / "sweep.sbatch").string()),
                                    shell_word((jobs.folder / "merge.sbatch").string())));
  return submit;
}

}  // namespace drape

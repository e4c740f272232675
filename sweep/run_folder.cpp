#include "sweep/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "core/console.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"

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

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

constexpr const char *record_name = "run.json", *stats_name = "stats.json";
constexpr std::size_t most_record_bytes = std::size_t{1} << 24;

void flatten(const Json& json, const std::string& name, std::vector<std::pair<std::string, std::string>>& figures) {
  if (json.is_null()) return;
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) flatten(value, name.empty() ? key : name + "." + key, figures);
  } else if (json.is_array()) {
    std::string text;
    for (const Json& item : json)
      text += (text.empty() ? "" : " ") + (item.is_string() ? item.get<std::string>() : item.dump());
    figures.emplace_back(name, text);
  } else {
    figures.emplace_back(name, json.is_string() ? json.get<std::string>() : json.dump());
  }
}

/// Parses a record with limited nesting, since reading its figures takes a stack frame per level.
/// @returns nothing if it is damaged
std::optional<Json> parsed_record(const fs::path& file) {
  constexpr int deepest = 16;
  bool too_deep = false;
  const auto bounded = [&](int depth, Json::parse_event_t, const Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  try {
    Json json = Json::parse(read_file(file, most_record_bytes), bounded);
    return too_deep || !json.is_object() ? std::nullopt : std::optional(std::move(json));
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

/// @throws UsageError if the record's key or one of its files is no plain name within a folder
void require_names(const Json& record, const fs::path& file) {
  const auto require = [&](const Json& name, const std::string& key) {
    if (name.is_string()) name_in_folder(name.get_ref<const std::string&>(), file, key);
  };
  if (record.contains("key")) require(record["key"], "key");
  if (!record.contains("files") || !record["files"].is_array()) return;
  const Json& files = record["files"];
  for (std::size_t i = 0; i < files.size(); ++i) require(files[i], fmt::format("files[{}]", i));
}

[[noreturn]] void fail(const fs::path& place, const std::error_code& error) {
  throw OutputError(fmt::format("cannot write {}: {}", shown(place), error.message()));
}

/// @throws OutputError that names the folder of all runs, so that many failures share one message
void write_small_file(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int error = descriptor < 0 ? errno : write_all(descriptor, text);
  if (descriptor >= 0 && ::close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) fail(file.parent_path().parent_path(), {error, std::generic_category()});
}

}  // namespace

std::string RunRecord::figure(const std::string& name) const {
  const auto found = std::ranges::find(figures, name, &std::pair<std::string, std::string>::first);
  return found == figures.end() ? "" : found->second;
}

fs::path run_place(const fs::path& sweep, const std::string& key) { return sweep / "runs" / key; }

std::optional<RunRecord> read_run(const fs::path& sweep, const std::string& key) {
  const fs::path file = run_place(sweep, key) / record_name;
  std::error_code ignored;
  if (key.empty() || !fs::exists(file, ignored)) return std::nullopt;
  RunRecord damaged;
  damaged.damaged = true;
  damaged.reason = fmt::format("{} is damaged: --resume runs it again", shown(file));
  const std::optional<Json> parsed = parsed_record(file);
  if (!parsed) return damaged;
  const Json& json = *parsed;
  require_names(json, file);
  try {
    if (json.at("format") != 1 || json.at("key") != key) return damaged;
    const auto* const name = std::ranges::find(run_outcome_names, json.at("outcome").get<std::string>());
    if (name == run_outcome_names.end()) return damaged;
    RunRecord record{.outcome = static_cast<RunOutcome>(name - run_outcome_names.begin()),
                     .reason = json.at("reason"),
                     .damaged = false,
                     .timed = json.at("timed"),
                     .seconds = json.at("seconds"),
                     .files = json.at("files"),
                     .moments = json.at("moments"),
                     .figures = {}};
    flatten(json.at("figures"), "", record.figures);
    return record;
  } catch (const Json::exception&) {
    return damaged;
  }
}

RunFolder::RunFolder(const fs::path& sweep, const std::string& key)
    : key_(key), place_(run_place(sweep, key)), hidden_(place_.parent_path() / ("." + key)) {
  clear();
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  fs::remove_all(hidden_, ignored);
}

void RunFolder::clear() {
  std::error_code error;
  fs::remove_all(hidden_, error);
  fs::create_directories(hidden_, error);
  if (error) fail(hidden_.parent_path(), error);
}

void RunFolder::commit(const RunRecord& record, const std::string& stats) {
  Json figures = stats.empty() ? Json::object() : Json::parse(stats);
  figures.erase("outcome");
  const Json json{{"format", 1},
                  {"key", key_},
                  {"outcome", name_of(record.outcome)},
                  {"reason", record.reason},
                  {"timed", record.timed},
                  {"seconds", record.seconds},
                  {"files", record.files},
                  {"moments", record.moments},
                  {"figures", figures}};
  if (!stats.empty()) write_small_file(hidden_ / stats_name, stats);
  write_small_file(hidden_ / record_name, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  std::error_code error;
  fs::remove_all(place_, error);
  fs::rename(hidden_, place_, error);
  if (error) fail(place_, error);
}

void remove_unfinished(const fs::path& sweep) {
  std::error_code ignored;
  std::vector<fs::path> hidden;
  for (const auto& entry : fs::directory_iterator(sweep / "runs", ignored)) {
    if (entry.path().filename().string().starts_with('.')) hidden.push_back(entry.path());
  }
  for (const fs::path& folder : hidden) fs::remove_all(folder, ignored);
}

}  // namespace drape

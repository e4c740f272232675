#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>

#include "check/candidate.hpp"
#include "check/manifest.hpp"
#include "cli/options.hpp"
#include "cli/study_command.hpp"
#include "cli/summary.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "study/stability.hpp"
#include "study/validation_measures.hpp"
#include "sweep/page.hpp"
#include "sweep/results.hpp"
#include "sweep/run_folder.hpp"
#include "sweep/run_sweep.hpp"

namespace drape {
namespace {

struct SweepArguments {
  SweepRequest request;
  std::vector<std::string> varied;
  std::string folder = "out/sweep", shard;
  FigureStyle style = FigureStyle::screen;
  std::size_t jobs = 1, tasks = 0;
  int threads = 1;
  std::vector<std::string> slurm_options;
  bool resume = false, dry_run = false, report_only = false, submit = false;
};

std::string readable_time(double seconds) {
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (seconds < 600) return fmt::format("{:.0f} s", seconds);
  return seconds < 36000 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.0f} h", seconds / 3600);
}

/// Completes the request with the [sweep] tables of files.
SweepRequest complete_request(const SweepArguments& arguments) {
  SweepRequest request = arguments.request;
  std::vector<std::string> scenes;
  for (const std::string& text : arguments.varied) request.varied.push_back(parse_variation(text));
  for (const std::string& file : arguments.request.scenes) {
    for (std::string& scene : add_sweep_table(file, request)) scenes.push_back(std::move(scene));
  }
  request.scenes = std::move(scenes);
  return request;
}

ExitCode list_runs(const SweepPlan& plan, const SweepOptions& options) {
  double total = 0;
  std::string text;
  for (const std::size_t i : runs_of_shard(plan, options.shard)) {
    const PlannedRun& run = plan.runs[i];
    const std::optional<RunRecord> before = options.resume ? read_run(options.folder, run.key) : std::nullopt;
    const bool done = before && before->settled();
    if (!done) total += run.cost;
    text += fmt::format("{:4}  {}  {}\n", i + 1, label_of(plan, run),
                        !run.refusal.empty() ? "refused: " + run.refusal
                        : done               ? fmt::format("done: {}", name_of(before->outcome))
                                             : "about " + readable_time(run.cost));
  }
  const double seconds = total / static_cast<double>(options.jobs);
  print_text(stdout, text + fmt::format("roughly {} in all\n", readable_time(seconds)));
  return ExitCode::ok;
}

/// @throws UsageError if the folder has runs of another version of the program
void require_same_program(const SweepOptions& options, const SweepPlan& plan) {
  const std::optional<SweepFile> before = read_sweep_file(options.folder);
  if (!before || before->plan.program == plan.program) return;
  throw UsageError(
      fmt::format("{} was made by {}, but this is {}, whose runs may differ in their bits: continue with that program, "
                  "or choose another folder with -o",
                  shown(options.folder), shown(before->plan.program), plan.program));
}

ExitCode report_again(const SweepArguments& arguments, const CommonOptions& common) {
  require_links_inside(arguments.folder);
  std::optional<SweepFile> file = read_sweep_file(arguments.folder);
  if (!file) throw UsageError(fmt::format("{}: contains no sweep", arguments.folder));
  const auto file_names = [](const std::vector<std::string>& scenes) {
    std::vector<std::filesystem::path> files(scenes.begin(), scenes.end());
    for (std::filesystem::path& name : files) name = name.filename();
    return files;
  };
  const std::vector<std::string> given = complete_request(arguments).scenes;
  if (!given.empty() && file_names(given) != file_names(file->plan.request.scenes)) {
    throw UsageError(fmt::format("--report-only: {} contains another sweep: {}", shown(arguments.folder),
                                 shown(command_of(file->plan.request))));
  }
  return conclude_sweep(read_results(arguments.folder, std::move(*file)), arguments.folder, arguments.style, common);
}

/// Writes jobs for a cluster, and submits them if requested.
ExitCode write_jobs(const SweepArguments& arguments, const SweepPlan& plan, const CommonOptions& common) {
  std::string command = command_of(plan.request);
  command.erase(0, command.find(' ') + 1);  // remove the program's name
  const std::size_t tasks = std::min(arguments.tasks, plan.runs.size());
  const std::filesystem::path submit = write_slurm_jobs(
      {.sweep = fmt::format("{} -o {} --jobs {}{}", command, shell_word(arguments.folder), arguments.jobs,
                            arguments.threads > 1 ? fmt::format(" --threads {}", arguments.threads) : ""),
       .program = program_command().string(),
       .folder = arguments.folder,
       .tasks = tasks,
       .options = arguments.slurm_options});
  if (!common.quiet) {
    print_text(stdout, fmt::format("{} runs in {} tasks\n{}\n", plan.runs.size(), tasks, shown(submit)));
  }
  if (!arguments.submit) return ExitCode::ok;
  if (const int status = std::system(("sh " + shell_word(submit.string())).c_str()); status != 0) {
    throw OutputError(fmt::format("{}: Slurm did not take it", shown(submit)));
  }
  return ExitCode::ok;
}

ExitCode sweep(const SweepArguments& arguments, const CommonOptions& common) {
  interruption();
  if (arguments.report_only) return report_again(arguments, common);
  SweepOptions options{
      .folder = {}, .jobs = arguments.jobs, .threads = arguments.threads, .resume = arguments.resume, .shard = {}};
  if (!arguments.shard.empty()) options.shard = parse_shard(arguments.shard);
  options.folder = shard_place(arguments.folder, options.shard);
  const SweepPlan plan = make_plan(complete_request(arguments));
  if (arguments.resume) {
    require_links_inside(options.folder);
    require_same_program(options, plan);
    for (const PlannedRun& run : plan.runs) read_run(options.folder, run.key);  // throws if damaged
  }
  if (arguments.dry_run) return list_runs(plan, options);
  if (arguments.tasks > 0) return write_jobs(arguments, plan, common);

  const SweepLock lock(options.folder);
  write_sweep_file(options.folder, {plan, options.shard});
  std::map<std::size_t, RunRecord> unwritten;
  run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
    unwritten = run_sweep(plan, options, stop, progress);
  });
  SweepResults results = read_results(options.folder, {plan, options.shard}, unwritten);
  results.typed_command = common.command;
  return conclude_sweep(results, options.folder, arguments.style, common);
}

}  // namespace

ExitCode conclude_sweep(const SweepResults& results, const std::filesystem::path& folder, FigureStyle style,
                        const CommonOptions& common) {
  for (const std::string& trouble : results.troubles()) spdlog::error(trouble);
  if (const std::string problem = write_sweep_report(results, folder, style); !problem.empty()) spdlog::warn(problem);
  if (!common.quiet) {
    print_wrapped(stdout, fmt::format("{}\n{}\n", results.headline(), shown(folder / sweep_page_name)));
  }
  if (const std::size_t left = results.count(RunOutcome::not_run); left > 0) {
    spdlog::error("{} of {} runs were not run: --resume continues", left, results.rows.size());
  }
  return exit_code(results);
}

void add_sweep_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<SweepArguments>();
  SweepRequest& request = arguments->request;
  CLI::App* sub = app.add_subcommand("sweep", "Run scenes with many values, and write tables, diagrams and a page");
  const auto one_each = [](CLI::Option* option) { option->allow_extra_args(false); };
  sub->add_option("SCENE", request.scenes, "Scene files (TOML), or a file whose table [sweep] says all of this");
  one_each(sub->add_option("--vary", arguments->varied,
                           "Run with each of these values: key.path=value,value…, or a range FROM..TO/COUNT or "
                           "FROM..TO/COUNTlog; repeatable. The last key goes across, the one before it down"));
  sub->add_flag("--zip", request.zipped,
                "Pair the first values of all keys, then the second, and so on, instead of combining all");
  one_each(sub->add_option("--set", request.overrides, "Override a value of all scenes: key.path=value; repeatable"));
  sub->add_option("--steps", request.steps, "Simulate this many steps instead of the scenes' durations")
      ->check(whole_number_in({0, 1e9}));
  one_each(sub->add_option("--film", request.films, "Make a film of every run: gif, webp, mp4…; repeatable"));
  sub->add_flag("--motion", request.motion, "Keep every run's motion, as .drape");
  add_backend_option(*sub, request.backend);
  sub->add_option("-o,--output", arguments->folder, "Folder for the runs and the report; default out/sweep")
      ->check(on_one_line());
  add_style_option(*sub, arguments->style);
  sub->add_option("--jobs", arguments->jobs, "Runs at once; default 1, which is the only way to measure times well")
      ->check(whole_number_in({1, 1024}));
  sub->add_option("--threads", arguments->threads,
                  "Threads that share a step in each run where the cloth has 8192 vertices or more; default 1")
      ->check(whole_number_in({1, 256}));
  sub->add_option("--shard", arguments->shard, "Run only the K-th of N parts of about equal length: K/N");
  sub->add_flag("--resume", arguments->resume, "Skip runs that are complete in the folder");
  CLI::Option* slurm = sub->add_option("--slurm", arguments->tasks,
                                       "Run nothing; write jobs for Slurm: an array of N shards, and their merge");
  slurm->check(whole_number_in({1, 100'000}))->excludes("--shard");
  one_each(sub->add_option("--slurm-option", arguments->slurm_options,
                           "Option of sbatch for these jobs, such as --partition=short; repeatable")
               ->check(on_one_line())
               ->needs(slurm));
  sub->add_flag("--submit", arguments->submit, "Submit these jobs")->needs(slurm);
  sub->add_flag("--dry-run", arguments->dry_run, "Check everything and list the runs with estimated times");
  sub->add_flag("--report-only", arguments->report_only, "Run nothing; write the report again from the folder");
  complete_command(
      *sub, command, [arguments, &common] { return sweep(*arguments, common); },
      "sweep scene.toml --vary cloth.stiffness=10..80/8\n"
      "sweep scene.toml --vary integrator.method=liu13,implicit --film gif");
}

namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> folders;
  std::string output;
  FigureStyle style = FigureStyle::screen;
};

/// Copies files and folders recursively; follows links, skips special files.
void copy_files(const fs::path& from, const fs::path& to, std::error_code& error) {
  fs::create_directories(to, error);
  for (const auto& entry : fs::directory_iterator(from, error)) {
    const fs::path target = to / entry.path().filename();
    if (entry.is_directory(error) && !entry.is_symlink(error)) {
      copy_files(entry.path(), target, error);
    } else if (entry.is_regular_file(error)) {
      fs::copy_file(entry.path(), target, fs::copy_options::overwrite_existing, error);
    }
    if (error) return;
  }
}

/// Copies a shard's results of a scene, pictures and candidates, into the merged folder.
void take_over(const fs::path& part, const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::equivalent(part, folder, error)) return;
  fs::create_directories(folder, error);
  remove_candidate(folder, name);  // left from an older check
  if (!fs::exists(part / name, error)) return;
  copy_files(part / name, folder / name, error);
  if (error) throw OutputError(fmt::format("cannot write {}: {}", shown(folder / name), error.message()));
}

/// Returns true if a stop was requested. Merging can be repeated: merged results are complete.
bool interrupted() {
  if (!interruption().stop_requested()) return false;
  spdlog::error("interrupted: the same command completes it");
  return true;
}

/// @throws UsageError if it is damaged, or names a missing file
CheckShard read_shard(const fs::path& part) {
  constexpr std::size_t most_bytes = std::size_t{1} << 32;
  const fs::path file = part / check_mark;
  require_links_inside(part);
  CheckShard shard = unpack_shard(read_file(file, most_bytes), file);
  for (const SceneResult& scene : shard.report.scenes) {
    if (std::ranges::find(check_report_files, scene.name) == check_report_files.end()) continue;
    throw UsageError(fmt::format("{}: a scene is called as the report's {}", shown(file), scene.name));
  }
  return shard;
}

ExitCode merge_checks(const std::vector<fs::path>& parts, const StudyFiles& to, const CommonOptions& common) {
  const fs::path folder = to.folder;
  std::vector<CheckShard> shards;
  std::map<std::string, fs::path> found;  // the first part with a scene, by the scene's name
  for (const fs::path& part : parts) {
    shards.push_back(read_shard(part));
    for (const SceneResult& result : shards.back().report.scenes) found.emplace(result.name, part);
  }
  CheckReport whole = merge_shards(std::move(shards), parts);
  for (const auto& [name, part] : found) require_own_candidate(folder, name);
  for (const auto& [name, part] : found) {
    if (interrupted()) return ExitCode::interrupted;
    take_over(part, folder, name);
  }
  ResultPrinter verdicts;
  for (SceneResult& result : whole.scenes) {
    if (result.has_candidate()) {
      whole.accept_command = accept_command(folder);
      result.accept_command = accept_command(folder) + " " + shell_file(result.name);
    }
    tell(result, common, verdicts);
  }
  return conclude_check(whole, folder, to.style, common, verdicts);
}

ExitCode merge_sweep(const std::vector<fs::path>& parts, const StudyFiles& to, const CommonOptions& common) {
  SweepFile whole = merge_sweeps(parts, to.folder, interruption().get_token());
  if (interrupted()) return ExitCode::interrupted;
  return conclude_sweep(read_results(to.folder, std::move(whole)), to.folder, to.style, common);
}

/// A kind of shards: the file that marks them, and the function that merges them.
struct ShardKind {
  const char *mark, *name;
  ExitCode (*merge)(const std::vector<fs::path>& parts, const StudyFiles& to, const CommonOptions& common);
};

constexpr std::array shard_kinds{
    ShardKind{check_mark, "check", merge_checks},
    ShardKind{stability_runs_name, "study of stability", merge_stability_study},
    ShardKind{validation_shard_name, "study of validation", merge_validation_study},
    ShardKind{sweep_mark, "sweep", merge_sweep},
};

/// Returns the kind of the shards in a folder.
/// @throws UsageError if there are none
const ShardKind& kind_in(const fs::path& folder) {
  for (const ShardKind& kind : shard_kinds) {
    if (!parts_in(folder, kind.mark).empty()) return kind;
  }
  throw UsageError(fmt::format(
      "{}: there is no sweep, check or study of stability or validation in it, nor a shard of one", shown(folder)));
}

ExitCode merge(const MergeArguments& arguments, const CommonOptions& common) {
  interruption();  // from here on, a signal stops between two files
  for (const std::string& folder : arguments.folders) require_links_inside(folder);
  const ShardKind& kind = kind_in(arguments.folders.front());
  std::vector<fs::path> parts;
  for (const std::string& folder : arguments.folders) {
    const std::vector<fs::path> found = parts_in(folder, kind.mark);
    if (found.empty()) {
      throw UsageError(fmt::format("{}: there is neither a {} in it nor a shard of one", folder, kind.name));
    }
    parts.insert(parts.end(), found.begin(), found.end());
  }
  const std::string& folder = arguments.output.empty() ? arguments.folders.front() : arguments.output;
  return kind.merge(parts, {folder, arguments.style}, common);
}

}  // namespace

void add_merge_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* sub = app.add_subcommand("merge", "Merge the shards of a sweep, check or study");
  sub->add_option("DIR", arguments->folders, "Folders of shards, or a folder with shards in it")->required();
  sub->add_option("-o,--output", arguments->output, "Folder for the merged result; default the first DIR")
      ->check(on_one_line());
  add_style_option(*sub, arguments->style);
  complete_command(
      *sub, command, [arguments, &common] { return merge(*arguments, common); },
      "merge out/shard-1 out/shard-2 -o out/sweep");
}

}  // namespace drape

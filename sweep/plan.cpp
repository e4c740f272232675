#include "sweep/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/bytes.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/document.hpp"
#include "output/registry.hpp"
#include "render/gl/context.hpp"
#include "run/outputs.hpp"
#include "run/resources.hpp"
#include "run/shard.hpp"
#include "sweep/page.hpp"

namespace drape {
using Json = nlohmann::ordered_json;
namespace {

/// Problems of runs, each message once.
class RunProblems {
 public:
  explicit RunProblems(const SweepPlan& plan) : plan_(plan) {}

  void add(const PlannedRun& run, const Error& error) {
    kind_ = std::max(kind_, error.kind());
    std::istringstream lines(as_varied(error.what(), overrides_of(plan_.request.varied, run.values)));
    for (std::string line; std::getline(lines, line);) {
      auto [found, is_new] = by_message_.try_emplace(line, 0, label_of(plan_, run));
      if (is_new) order_.push_back(line);
      ++found->second.count;
    }
  }

  void throw_if_any(std::size_t runs) const {
    constexpr std::size_t most_told = 100;
    if (order_.empty()) return;
    std::vector<std::string> lines;
    for (const std::string& message : order_) {
      const Found& found = by_message_.at(message);
      lines.push_back(found.count == runs ? message
                      : found.count == 1  ? fmt::format("{} (in the run of {})", message, found.first)
                                          : fmt::format("{} (in {} of {} runs, of which the first has {})", message,
                                                        found.count, runs, found.first));
      if (lines.size() == most_told) break;
    }
    if (order_.size() > most_told) lines.push_back(fmt::format("and {} more", order_.size() - most_told));
    throw Error(kind_, fmt::format("{}", fmt::join(lines, "\n")));
  }

 private:
  struct Found {
    std::size_t count;
    std::string first;  // label of the first affected run
    Found(std::size_t c, std::string f) : count(c), first(std::move(f)) {}
  };
  const SweepPlan& plan_;
  std::map<std::string, Found> by_message_;
  std::vector<std::string> order_;
  ErrorKind kind_ = ErrorKind::usage;
};

/// Returns the stems of the files' names; for equal stems, the whole paths.
std::vector<std::string> names_of(const std::vector<std::string>& scenes) {
  std::multiset<std::string> stems;
  for (const std::string& scene : scenes) stems.insert(std::filesystem::path(scene).stem().string());
  std::vector<std::string> names;
  for (const std::string& scene : scenes) {
    const std::string stem = std::filesystem::path(scene).stem().string();
    names.push_back(stems.count(stem) > 1 ? scene : stem);
  }
  return names;
}

void require_sense(const SweepRequest& request) {
  if (request.scenes.empty()) throw UsageError("SCENE is required; see drape sweep --help");
  std::set<std::string> seen;
  for (const std::string& scene : request.scenes) {
    if (!seen.insert(scene).second) throw UsageError(fmt::format("{} is there twice", scene));
  }
  for (const Variation& variation : request.varied) {
    if (!seen.insert("--vary " + variation.key).second) {
      throw UsageError(fmt::format("--vary {} is there twice", variation.key));
    }
  }
  for (const std::string& film : request.films) {
    const std::string file = "film." + film;
    const OutputFormat& format = format_of(file);
    if (format.of_steps() || format.file_per_frame()) {
      throw UsageError(fmt::format("--film {}: a film is one file, such as gif, webp or mp4{}", film,
                                   format.of_steps() ? "; --motion keeps the motion" : ""));
    }
    if (!seen.insert(file).second) throw UsageError(fmt::format("--film {} is there twice", film));
  }
}

/// A temporary folder in which films are opened to check that they can be.
class TrialFolder {
 public:
  TrialFolder() : place_(std::filesystem::temp_directory_path() / fmt::format("drape-sweep-{}", ::getpid())) {}
  ~TrialFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(place_, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& place() const { return place_; }

 private:
  std::filesystem::path place_;
};

/// Checks the outputs of a run. @throws Error
void require_run(const LoadedScene& scene, const RunOptions& options, int largest_texture) {
  film_extent(scene, options);
  if (!needs_drawing(options)) return;
  const Outputs films(options.outputs, film_info(scene, options));
  require_texture(scene, largest_texture);
  if (Annotations::wanted(scene)) const Annotations fonts_are_there(scene);
}

}  // namespace

std::vector<std::string> overrides_of(const SweepPlan& plan, const PlannedRun& run) {
  std::vector<std::string> overrides = plan.request.overrides;
  for (std::string& override : overrides_of(plan.request.varied, run.values)) overrides.push_back(std::move(override));
  overrides.insert(overrides.end(), run.shared.begin(), run.shared.end());
  return overrides;
}

std::string run_command(const SweepPlan& plan, const PlannedRun& run) {
  const SweepRequest& request = plan.request;
  std::string text = request.films.empty() ? "drape simulate " : "drape render ";
  text += shell_file(request.scenes[run.scene]);
  for (const std::string& value : overrides_of(plan, run)) text += " --set " + shell_word(value);
  if (request.steps) text += fmt::format(" --steps {}", *request.steps);
  for (const std::string& film : request.films) text += " -o " + shell_word("film." + film);
  if (request.motion) text += " -o motion.drape";
  if (!request.films.empty() && request.backend != GlBackend::automatic)
    text += fmt::format(" --backend {}", backend_name(request.backend));
  return text;
}

std::string label_of(const SweepPlan& plan, const PlannedRun& run) {
  std::vector<std::string> parts;
  if (plan.names.size() > 1 || plan.request.varied.empty()) parts.push_back(plan.names[run.scene]);
  for (std::size_t i = 0; i < run.values.size(); ++i) {
    parts.push_back(fmt::format("{} = {}", plan.request.varied[i].key, run.values[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string program_text() {
  const BuildInfo& build = build_info();
  std::string text =
      fmt::format("drape {}, revision {}, {}, {}", build.version, build.revision, build.compiler, build.type);
  if (build.revision.ends_with("-dirty") || build.revision == "unknown") {
    text += ", file " + program_hash();
  }
  return text;
}

std::string run_key(const LoadedScene& scene, const SweepRequest& request, const std::string& program) {
  constexpr std::size_t most_bytes = std::size_t{1} << 31;
  Hash hash;
  hash.add(program + "\n" + scene.source.portable.text);
  // A caption may contain the scene's name.
  if (!request.films.empty()) hash.add(scene.name);
  for (const PortableScene::File& file : scene.source.portable.files) {
    if (std::filesystem::is_regular_file(file.place)) hash.add(read_file(file.place, most_bytes));
  }
  hash.add(fmt::format("\n{}, motion {}, steps {}, backend {}", fmt::join(request.films, " "), request.motion,
                       request.steps.value_or(-1), request.films.empty() ? "" : backend_name(request.backend)));
  return hash.text();
}

std::string run_key(const LoadedScene& scene, const SweepPlan& plan) {
  std::string key = run_key(scene, plan.request, plan.program);
  if (!plan.side || !chooses_side(plan.request, scene.camera)) return key;
  return key_seen_from(key, plan.runs[*plan.side].key);
}

SweepPlan make_plan(const SweepRequest& request) {
  require_sense(request);
  SweepPlan plan{
      .request = request, .program = program_text(), .names = names_of(request.scenes), .runs = {}, .side = {}};
  const std::vector<std::vector<std::string>> all = combinations(request.varied, request.zipped);
  const TrialFolder trial;
  const RunOptions options = run_options(request, trial.place());
  const int largest_texture = needs_drawing(options) ? inspect_backend(request.backend).max_texture_size : 0;
  RunProblems problems(plan);
  std::vector<std::optional<MethodChoice>> choices;
  const auto resolve = [&](std::size_t index) {
    PlannedRun& run = plan.runs[index];
    try {
      const LoadedScene scene = load_scene(request.scenes[run.scene], overrides_of(plan, run));
      require_run(scene, options, largest_texture);
      run.key = run_key(scene, plan);
      if (!plan.side && chooses_side(request, scene.camera)) plan.side = index;
      run.cost = estimated_cost(scene, options);
      choices[index] = scene.choice;
    } catch (const SceneConflict& error) {
      run.refusal = error.what();
    } catch (const Error& error) {
      problems.add(run, error);
    }
  };
  for (std::size_t i = 0; i < request.scenes.size(); ++i) {
    for (const std::vector<std::string>& values : all) {
      plan.runs.push_back({.scene = i, .values = values, .shared = {}, .key = {}, .refusal = {}});
      choices.emplace_back();
      resolve(plan.runs.size() - 1);
    }
  }
  problems.throw_if_any(plan.runs.size());
  const std::vector<std::vector<std::string>> shared = shared_method_overrides(choices);
  if (std::ranges::any_of(shared, [](const auto& overrides) { return !overrides.empty(); })) {
    plan.side.reset();  // keys depend on it
    for (std::size_t i = 0; i < plan.runs.size(); ++i) {
      plan.runs[i].shared = shared[i];
      resolve(i);
    }
    problems.throw_if_any(plan.runs.size());
  }
  if (std::ranges::none_of(plan.runs, &std::string::empty, &PlannedRun::refusal)) {
    for (const PlannedRun& run : plan.runs) problems.add(run, UsageError(run.refusal));
    problems.throw_if_any(plan.runs.size());
  }
  return plan;
}

std::vector<std::size_t> runs_of_shard(const SweepPlan& plan, const Shard& shard) {
  std::vector<double> costs;
  for (const PlannedRun& run : plan.runs) costs.push_back(run.cost);
  return runs_of_shard(costs, shard);
}

Json plan_json(const SweepPlan& plan) {
  const SweepRequest& request = plan.request;
  Json varied = Json::array(), runs = Json::array();
  for (const Variation& variation : request.varied) {
    varied.push_back({{"key", variation.key}, {"values", variation.values}});
  }
  for (const PlannedRun& run : plan.runs) {
    runs.push_back({{"scene", run.scene},
                    {"values", run.values},
                    {"shared", run.shared},
                    {"key", run.key},
                    {"refusal", run.refusal},
                    {"cost", run.cost}});
  }
  return {{"program", plan.program},
          {"scenes", request.scenes},
          {"names", plan.names},
          {"set", request.overrides},
          {"vary", varied},
          {"zip", request.zipped},
          {"films", request.films},
          {"motion", request.motion},
          {"steps", request.steps ? Json(*request.steps) : Json()},
          {"backend", static_cast<int>(request.backend)},
          {"side", plan.side ? Json(*plan.side) : Json()},
          {"runs", runs}};
}

SweepPlan plan_of(const Json& json) {
  SweepPlan plan;
  SweepRequest& request = plan.request;
  json.at("program").get_to(plan.program);
  json.at("scenes").get_to(request.scenes);
  json.at("names").get_to(plan.names);
  json.at("set").get_to(request.overrides);
  json.at("zip").get_to(request.zipped);
  json.at("films").get_to(request.films);
  json.at("motion").get_to(request.motion);
  if (!json.at("steps").is_null()) request.steps = json.at("steps").get<std::int64_t>();
  request.backend = static_cast<GlBackend>(json.at("backend").get<int>());
  for (const Json& item : json.at("vary")) {
    request.varied.push_back({item.at("key"), item.at("values").get<std::vector<std::string>>()});
  }
  for (const Json& item : json.at("runs")) {
    PlannedRun run{.scene = item.at("scene"),
                   .values = item.at("values"),
                   .shared = item.at("shared"),
                   .key = item.at("key"),
                   .refusal = item.at("refusal"),
                   .cost = item.at("cost")};
    if (run.scene >= plan.names.size() || run.values.size() != request.varied.size()) {
      throw std::out_of_range("a run has a scene or a value that the plan does not have");
    }
    plan.runs.push_back(std::move(run));
  }
  if (!json.at("side").is_null()) plan.side = json.at("side").get<std::size_t>();
  if (plan.side && *plan.side >= plan.runs.size())
    throw std::out_of_range("its films are seen as a run that is not there");
  return plan;
}

}  // namespace drape

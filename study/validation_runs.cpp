#include "study/validation_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "study/runs_file.hpp"

namespace drape {
namespace {

constexpr int validation_format = 1;
constexpr std::size_t most_validation_bytes = std::size_t{1} << 28;

// The fields of a run, described once for both directions: Fields is a RunsWriter (with const data) or a RunsRecord.
template <class Fields, class Run>
void describe_run(Fields& f, Run& run) {
  f("place", run.place);
  f("set", run.what.overrides);
  f("steps", run.what.steps);
  f("failure", run.failure);
  f("seconds", run.seconds);
  f("step", run.step);
  f("cell", run.cell);
  f("vertices", run.vertices);
  f("capped", run.capped);
  f("rest_speed", run.rest_speed);
  f("quantity", run.names);
  f("value", run.values);
}

RunsKey key_of(const ValidationRun& run) { return {run.name, run.factor, run.problem, {}, run.setting}; }

/// Reader of the study in a file: its cases and runs.
class ValidationReader {
 public:
  explicit ValidationReader(const std::filesystem::path& file)
      : records_(parse_runs(read_text(file, most_validation_bytes), shown(file))) {
    if (records_.empty()) throw UsageError(fmt::format("{}: there is nothing in it", shown(file)));
    RunsRecord& heading = records_.front();
    int format = 0;
    heading("format", format);
    if (heading.key.kind != "study" || format != validation_format) {
      heading.fail(heading.line(), "expected the runs of a study of validation");
    }
    heading("command", study_.command);
    heading("seconds", study_.seconds);
    std::optional<std::string> shard;
    heading("shard", shard);
    if (shard) study_.shard = parse_shard(*shard);
    std::vector<std::string> names, values, cases;
    heading("measured_on", names);
    heading("measured_on_value", values);
    heading("case", cases);
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
      study_.provenance.emplace_back(names[i], values[i]);
    }
    study_.cases = validation_cases(cases);
    heading.done();
    for (std::size_t i = 1; i < records_.size(); ++i) read_run(records_[i]);
  }

  ValidationStudy finish() { return std::move(study_); }

 private:
  void read_run(RunsRecord& record) {
    ValidationRun run;
    run.name = record.key.scene;
    run.factor = record.key.kind;
    run.problem = record.key.method;
    run.setting = record.key.setting;
    describe_run(record, run);
    record.done();
    const auto of = std::ranges::find(study_.cases, run.name, &ValidationCase::name);
    if (of == study_.cases.end()) record.fail(record.line(), fmt::format("there is no case '{}'", run.name));
    static_cast<void>(of->problem(run.problem));
    if (run.names.size() != run.values.size()) record.fail(record.line(), "expected a value for every quantity");
    run.what.scene = of->scene;
    run.what.label = run.setting;
    run.measured = true;
    study_.runs.push_back(std::move(run));
  }

  std::vector<RunsRecord> records_;
  ValidationStudy study_;
};

}  // namespace

std::string validation_runs(const ValidationStudy& study) {
  RunsWriter f;
  f.begin({{}, "study", {}, {}, {}});
  f("format", validation_format);
  f("command", study.command);
  f("seconds", study.seconds);
  if (!study.shard.whole()) f("shard", study.shard.text());
  std::vector<std::string> names, values, cases;
  for (const auto& [name, value] : study.provenance) {
    names.push_back(name);
    values.push_back(value);
  }
  for (const ValidationCase& one : study.cases) cases.push_back(one.name);
  f("measured_on", names);
  f("measured_on_value", values);
  f("case", cases);
  for (const ValidationRun& run : study.runs) {
    if (!run.measured) continue;
    f.begin(key_of(run));
    describe_run(f, run);
  }
  return f.finish();
}

ValidationStudy validation_study(const std::filesystem::path& file) { return ValidationReader(file).finish(); }

MergedValidation merge_validation(const std::vector<std::filesystem::path>& files) {
  MergedValidation merged;
  std::map<std::size_t, std::string> found;  // shard numbers and their files
  std::size_t count = 0;
  for (const std::filesystem::path& file : files) {
    ValidationStudy part = validation_study(file);
    const Shard shard = part.shard;
    if (found.empty()) {
      count = shard.count;
    } else if (shard.count != count || part.command != merged.study.command) {
      throw UsageError(fmt::format("{} and {} are not of one study", shown(file), shown(found.begin()->second)));
    }
    if (!found.try_emplace(shard.number, file.string()).second) continue;
    std::vector<ValidationRun> runs = std::move(merged.study.runs);
    runs.insert(runs.end(), part.runs.begin(), part.runs.end());
    const double seconds = merged.study.seconds + part.seconds;
    if (found.size() == 1) merged.study = std::move(part);
    merged.study.runs = std::move(runs);
    merged.study.seconds = seconds;
  }
  std::ranges::stable_sort(merged.study.runs, {}, &ValidationRun::place);
  for (ValidationRun& run : merged.study.runs) run.place.reset();
  merged.study.shard = {};
  for (std::size_t k = 1; k <= count; ++k) {
    if (!found.contains(k)) merged.missing.push_back({k, count});
  }
  return merged;
}

void read_validation_runs(const std::filesystem::path& file, ValidationStudy& study) {
  const ValidationStudy begun = validation_study(file);
  if (begun.command != study.command) {
    throw UsageError(fmt::format("{} is of another command: {}", shown(file), begun.command));
  }
  study.seconds += begun.seconds;
  for (const ValidationRun& run : begun.runs) {
    const auto same = std::ranges::find_if(study.runs, [&](const ValidationRun& planned) {
      return key_of(planned) == key_of(run) && planned.what.overrides == run.what.overrides;
    });
    if (same != study.runs.end()) *same = run;
  }
}

}  // namespace drape

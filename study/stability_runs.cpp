#include "study/stability_runs.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "core/build_info.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "scene/method_names.hpp"
#include "study/runs_file.hpp"
#include "study/stability_map.hpp"

namespace drape {
namespace {

/// The measurements of a shard in one map.
struct MapRuns {
  std::vector<std::int64_t> cells;  // indices in the map
  std::vector<int> outcomes, not_converged;
  std::vector<double> energy_errors;
};

// The fields, described once for both directions: Fields is a RunsWriter (with const data) or a RunsRecord.

template <class Fields, class Runs>
void describe_map(Fields& f, Runs& runs) {
  f("cell", runs.cells);
  f("outcome", runs.outcomes);
  f("energy_error", runs.energy_errors);
  f("steps_not_converged", runs.not_converged);
}

template <class Fields, class Border>
void describe_border(Fields& f, Border& border) {
  f("predicted", border.predicted);
  f("measured", border.measured);
}

template <class Fields, class Curve>
void describe_curve(Fields& f, Curve& curve) {
  f("time", curve.times);
  f("energy", curve.energies);
}

/// The heading of a file.
struct Heading {
  std::string program, shard;
  StabilityDetail detail;
  double seconds = 0;
};

template <class Fields, class Values>
void describe_heading(Fields& f, Values& heading) {
  f("program", heading.program);
  f("shard", heading.shard);
  f("per_decade", heading.detail.per_decade);
  f("steps", heading.detail.steps);
  f("seconds", heading.seconds);
}

std::string studying_program() {
  const BuildInfo& build = build_info();
  return fmt::format("drape {}, revision {}, {}, {}", build.version, build.revision, build.compiler, build.type);
}

RunsKey key_of(const StabilityMap& map) { return {map_name(map), "map", {}, {}, {}}; }
RunsKey key_of(const StabilityLimit& border, std::size_t place) {
  return {{}, "border", step_method_name(border.method), {}, std::to_string(place)};
}
RunsKey key_of(const EnergyCurve& curve, std::size_t place) {
  return {{}, "energy", step_method_name(curve.method), {}, std::to_string(place)};
}

MapRuns runs_of(const StabilityMap& map, const std::set<std::size_t>& parts, std::size_t first) {
  MapRuns runs;
  for (auto part = parts.lower_bound(first); part != parts.end() && *part < first + map.cells.size(); ++part) {
    const StabilityCell& cell = map.cells[*part - first];
    runs.cells.push_back(static_cast<std::int64_t>(*part - first));
    runs.outcomes.push_back(static_cast<int>(cell.outcome));
    runs.not_converged.push_back(cell.not_converged);
    runs.energy_errors.push_back(cell.energy_error);
  }
  return runs;
}

/// Copies a record's cells into a map.
void read_map(RunsRecord& record, StabilityMap& map) {
  MapRuns runs;
  describe_map(record, runs);
  const std::size_t count = runs.cells.size();
  if (runs.outcomes.size() != count || runs.not_converged.size() != count || runs.energy_errors.size() != count) {
    record.fail(record.line(), "of some cells not everything is there");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = static_cast<std::size_t>(runs.cells[i]);
    if (place >= map.cells.size()) record.fail(record.line(), fmt::format("there is no cell {}", runs.cells[i]));
    if (runs.outcomes[i] < 0 || runs.outcomes[i] > static_cast<int>(StabilityOutcome::blown_up)) {
      record.fail(record.line(), fmt::format("there is no outcome {}", runs.outcomes[i]));
    }
    map.cells[place] = {.step = map.steps[place % map.steps.size()],
                        .stiffness = map.stiffnesses[place / map.steps.size()],
                        .outcome = static_cast<StabilityOutcome>(runs.outcomes[i]),
                        .energy_error = runs.energy_errors[i],
                        .not_converged = runs.not_converged[i]};
  }
}

/// Copies a record into its part of a study.
void read_part(RunsRecord& record, StabilityStudy& study) {
  for (StabilityMap& map : study.maps) {
    if (record.key == key_of(map)) return read_map(record, map);
  }
  for (std::size_t i = 0; i < study.borders.size(); ++i) {
    if (record.key == key_of(study.borders[i], i)) return describe_border(record, study.borders[i]);
  }
  for (std::size_t i = 0; i < study.energies.size(); ++i) {
    if (record.key == key_of(study.energies[i], i)) return describe_curve(record, study.energies[i]);
  }
  record.fail(record.line(), fmt::format("a study of stability has no {} {}", record.key.kind, record.key.scene));
}

}  // namespace

std::vector<std::size_t> parts_of_shard(const StabilityStudy& study, const Shard& shard) {
  return runs_of_shard(stability_costs(study), shard);
}

std::string stability_runs(const StabilityStudy& study, const Shard& shard) {
  const std::vector<std::size_t> list = parts_of_shard(study, shard);
  const std::set<std::size_t> parts(list.begin(), list.end());
  RunsWriter file;
  const Heading heading{studying_program(), shard.text(), study.detail, study.seconds};
  file.begin({{}, "study", {}, {}, {}});
  describe_heading(file, heading);
  std::size_t part = 0;
  for (const StabilityMap& map : study.maps) {
    const MapRuns runs = runs_of(map, parts, part);
    file.begin(key_of(map));
    describe_map(file, runs);
    part += map.cells.size();
  }
  for (std::size_t i = 0; i < study.borders.size(); ++i, ++part) {
    if (!parts.contains(part)) continue;
    file.begin(key_of(study.borders[i], i));
    describe_border(file, study.borders[i]);
  }
  for (std::size_t i = 0; i < study.energies.size(); ++i, ++part) {
    if (!parts.contains(part)) continue;
    file.begin(key_of(study.energies[i], i));
    describe_curve(file, study.energies[i]);
  }
  return file.finish();
}

MergedStability merge_stability(const std::vector<std::filesystem::path>& files) {
  constexpr std::size_t most_bytes = std::size_t{1} << 31;
  MergedStability merged;
  std::map<std::size_t, std::string> found;  // shard numbers and their files
  std::size_t count = 0;
  for (const std::filesystem::path& path : files) {
    std::vector<RunsRecord> records = parse_runs(read_text(path, most_bytes), shown(path));
    if (records.empty()) throw UsageError(fmt::format("{}: there is nothing in it", shown(path)));
    Heading heading;
    describe_heading(records.front(), heading);
    const Shard shard = parse_shard(heading.shard);
    if (heading.program != studying_program()) {
      throw UsageError(fmt::format("{} was made by {}, but this is {}: one study is made by one program", shown(path),
                                   heading.program, studying_program()));
    }
    if (found.empty()) {
      merged.study = plan_stability(heading.detail);
      count = shard.count;
    }
    const StabilityDetail& detail = merged.study.detail;
    if (shard.count != count || heading.detail.per_decade != detail.per_decade ||
        heading.detail.steps != detail.steps) {
      throw UsageError(fmt::format("{} and {} are not of one study", shown(path), found.begin()->second));
    }
    if (!found.try_emplace(shard.number, path.string()).second) continue;
    merged.study.seconds += heading.seconds;
    for (std::size_t i = 1; i < records.size(); ++i) read_part(records[i], merged.study);
    for (const RunsRecord& record : records) record.done();
  }
  for (std::size_t k = 1; k <= count; ++k) {
    if (!found.contains(k)) merged.missing.push_back({k, count});
  }
  return merged;
}

}  // namespace drape

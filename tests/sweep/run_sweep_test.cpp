#include "sweep/run_sweep.hpp"

#include <gtest/gtest.h>

#include "cli/exit_code.hpp"
#include "sweep/page.hpp"
#include "sweep/results.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/files.hpp"
#include "tests/sweep/sweep_runs.hpp"

namespace drape {
namespace {

using test::request_of;
using test::sweep;
using test::tiny_scene;
using test::without_times;

class Sweep : public testing::Test {
 protected:
  /// Makes a request of twelve runs, one of which is refused.
  [[nodiscard]] SweepRequest twelve() const {
    return request_of(scene_, {"cloth.stiffness=10,20", "time.step=0.01,0.02,0.09", "integrator.method=liu13,verlet"});
  }
  [[nodiscard]] SweepOptions into(const std::string& name) const { return {.folder = folder_.path(name), .shard = {}}; }

  test::SceneFolder folder_;
  std::filesystem::path scene_ = folder_.write("a.toml", tiny_scene);
};

TEST_F(Sweep, MakesARowOfEveryRun) {
  const SweepResults results = sweep(twelve(), into("out"));
  ASSERT_EQ(results.rows.size(), 12U);
  EXPECT_EQ(results.count(RunOutcome::completed) + results.count(RunOutcome::refused), 12U);
  EXPECT_GT(results.count(RunOutcome::refused), 0U);
  EXPECT_EQ(exit_code(results), ExitCode::usage);
  for (const SweepRow& row : results.rows) {
    if (row.record.outcome == RunOutcome::refused) continue;
    EXPECT_EQ(row.record.timed, "alone");
    EXPECT_GT(std::stod(row.record.figure("steps")), 0);
    EXPECT_TRUE(std::filesystem::exists(run_place(folder_.path("out"), results.planned(row).key) / "stats.json"));
  }
  const std::vector<std::string> csv = without_times(runs_csv(results));
  EXPECT_EQ(csv.size(), 13U);
  EXPECT_TRUE(csv.front().starts_with("run,scene,cloth.stiffness,time.step,integrator.method,outcome,reason,"))
      << csv.front();
}

TEST_F(Sweep, HasTheSameBitsWithManyJobs) {
  SweepRequest request = request_of(scene_, {"cloth.stiffness=10..60/6"});
  request.films = {"gif"};
  request.motion = true;
  SweepOptions many = into("many");
  many.jobs = 3;
  const SweepResults alone = sweep(request, into("alone")), beside = sweep(request, many);
  ASSERT_EQ(exit_code(alone), ExitCode::ok);
  for (const SweepRow& row : alone.rows) {
    const std::string& key = alone.planned(row).key;
    for (const char* file : {"film.gif", "sheet.png"}) {
      const std::string bytes = test::content(run_place(folder_.path("alone"), key) / file);
      EXPECT_FALSE(bytes.empty());
      EXPECT_EQ(bytes, test::content(run_place(folder_.path("many"), key) / file)) << file;
    }
    EXPECT_TRUE(std::filesystem::exists(run_place(folder_.path("many"), key) / "motion.drape"));
  }
  EXPECT_EQ(beside.rows.front().record.timed, "beside 2 others");
  EXPECT_EQ(without_times(runs_csv(alone)), without_times(runs_csv(beside)));
}

TEST_F(Sweep, GoesOnWhereItEnded) {
  const SweepRequest request = request_of(scene_, {"cloth.stiffness=10..50/5"});
  const SweepResults first = sweep(request, into("out"));
  const auto record = [&](std::size_t row) {
    return run_place(folder_.path("out"), first.planned(first.rows[row]).key) / "run.json";
  };
  // One is lost, one is half written, and a running one has its hidden folder.
  std::filesystem::remove_all(record(1).parent_path());
  folder_.put(record(2), "{\"format\": 1, \"key\"");
  folder_.put(folder_.path("out/runs/.0123456789abcdef/stats.json"), "{");
  const auto untouched = std::filesystem::last_write_time(record(0)),
             redone = std::filesystem::last_write_time(record(2));
  SweepOptions again = into("out");
  again.resume = true;
  const SweepResults second = sweep(request, again);
  EXPECT_EQ(without_times(runs_csv(first)), without_times(runs_csv(second)));
  EXPECT_EQ(std::filesystem::last_write_time(record(0)), untouched);
  EXPECT_NE(std::filesystem::last_write_time(record(2)), redone);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/runs/.0123456789abcdef")));
}

TEST_F(Sweep, LosesNothingButTheRunsUnderWayWhenItIsStopped) {
  const SweepPlan plan = make_plan(twelve());
  std::stop_source stop;
  stop.request_stop();
  Progress progress;
  run_sweep(plan, into("out"), stop.get_token(), progress);
  const SweepResults results = read_results(folder_.path("out"), {plan, {}});
  EXPECT_EQ(results.count(RunOutcome::not_run) + results.count(RunOutcome::refused), 12U);
  EXPECT_EQ(exit_code(results), ExitCode::interrupted);
  EXPECT_EQ(folder_.file_count(), 1U) << "only the scene is there";
}

TEST_F(Sweep, OfADivergedRunKeepsWhatThereIsAndTheOthersGoOn) {
  SweepRequest request = request_of(scene_, {"time.step=0.001,0.1,0.002", "time.duration=0.01,1000,0.01"});
  request.zipped = true;
  request.overrides = {"integrator.method=verlet", "integrator.allow_unstable=true", "cloth.stiffness=1e6",
                       "cloth.pins=[0]"};
  const SweepResults results = sweep(request, into("out"));
  EXPECT_EQ(results.rows[1].record.outcome, RunOutcome::diverged);
  EXPECT_NE(results.rows[1].record.reason, "");
  EXPECT_EQ(exit_code(results), ExitCode::diverged);
}

TEST_F(Sweep, SaysWhatCannotBeWrittenAndKeepsWhatIsThere) {
  const SweepRequest few = request_of(scene_, {"cloth.stiffness=10,20"});
  sweep(few, into("out"));
  SweepRequest more = request_of(scene_, {"cloth.stiffness=10,20,30,40"});
  const SweepPlan plan = make_plan(more);
  const std::stop_source never;
  Progress progress;
  SweepOptions options = into("out");
  options.resume = true;
  std::map<std::size_t, RunRecord> unwritten;
  {
    const test::FileSizeLimit full(64);
    unwritten = run_sweep(plan, options, never.get_token(), progress);
  }
  EXPECT_EQ(unwritten.size(), 2U);
  const SweepResults results = read_results(folder_.path("out"), {plan, {}}, unwritten);
  EXPECT_EQ(results.count(RunOutcome::completed), 2U);
  EXPECT_EQ(results.count(RunOutcome::failed), 2U);
  EXPECT_EQ(exit_code(results), ExitCode::output);
  EXPECT_NE(results.rows[2].record.reason.find("File too large"), std::string::npos) << results.rows[2].record.reason;
}

TEST_F(Sweep, OfShardsIsThatOfOneRun) {
  const SweepResults whole = sweep(twelve(), into("whole"));
  std::vector<std::string> folders;
  std::size_t rows = 0;
  for (std::size_t k = 1; k <= 3; ++k) {
    const Shard shard{k, 3};
    SweepOptions options = into(shard_place("parts", shard).string());
    options.shard = shard;
    rows += sweep(twelve(), options).rows.size();
  }
  EXPECT_EQ(rows, 12U);
  const std::vector<std::filesystem::path> parts = parts_in(folder_.path("parts"), sweep_mark);
  EXPECT_EQ(parts.size(), 3U);
  const SweepResults merged = read_results(folder_.path("merged"), merge_sweeps(parts, folder_.path("merged")));
  EXPECT_EQ(without_times(runs_csv(whole)), without_times(runs_csv(merged)));
  EXPECT_EQ(exit_code(whole), exit_code(merged));
  EXPECT_EQ(whole.headline(), merged.headline());

  // Without one of the parts its runs are reported as missing.
  const SweepResults less =
      read_results(folder_.path("less"), merge_sweeps({parts[0], parts[2]}, folder_.path("less")));
  EXPECT_GT(less.count(RunOutcome::not_run), 0U);
  EXPECT_EQ(exit_code(less), ExitCode::interrupted);
}

TEST_F(Sweep, IsNotMergedWithAnother) {
  sweep(request_of(scene_, {"cloth.stiffness=10"}), into("a"));
  sweep(request_of(scene_, {"cloth.stiffness=20"}), into("b"));
  EXPECT_NE(test::usage_error([&] {
              merge_sweeps({folder_.path("a"), folder_.path("b")}, folder_.path("c"));
            }).find("are not of one sweep: they differ in 'vary'"),
            std::string::npos);
  EXPECT_TRUE(parts_in(folder_.path(), sweep_mark).empty());
}

TEST_F(Sweep, OfAnotherFormatIsRefused) {
  folder_.write("out/sweep.json", "{\"format\": 99}");
  EXPECT_NE(test::usage_error([&] { read_sweep_file(folder_.path("out")); }).find("format 99"), std::string::npos);
  folder_.write("out/sweep.json", "{\"format\": 3}");
  EXPECT_NE(test::usage_error([&] { read_sweep_file(folder_.path("out")); }).find("damaged"), std::string::npos);
}

TEST_F(Sweep, WritesWhatAReportNeeds) {
  SweepRequest request = request_of(scene_, {"cloth.stiffness=10,20", "integrator.method=liu13,implicit"});
  request.films = {"gif"};
  const SweepResults results = sweep(request, into("out"));
  EXPECT_EQ(write_sweep_report(results, folder_.path("out")), "");
  const std::string text = test::content(folder_.path("out/report.md"));
  for (const SweepRow& row : results.rows) {
    EXPECT_NE(text.find("](runs/" + results.planned(row).key + "/film.gif)"), std::string::npos) << text;
  }
  EXPECT_NE(text.find("| µs per step |"), std::string::npos);
  const std::string latex = test::content(folder_.path("out/table.tex"));
  EXPECT_NE(latex.find("\\usepackage{array,booktabs}"), std::string::npos) << latex;
  EXPECT_NE(latex.find("integrator.method = implicit"), std::string::npos) << latex;
  EXPECT_NE(test::content(folder_.path("out/report.html")).find("films-in-step"), std::string::npos);
  const std::string diagram = folder_.path("out/diagrams/step_us.median-over-integrator.method");
  EXPECT_EQ(test::content(diagram + ".csv").find("series,integrator.method,µs per step (median)\n"), 0U);
  EXPECT_NE(test::content(diagram + ".svg").find("<svg"), std::string::npos);
  EXPECT_TRUE(test::content(diagram + ".pdf").starts_with("%PDF"));
  EXPECT_TRUE(test::content(diagram + ".png").starts_with("\x89PNG"));
}

TEST_F(Sweep, SaysThatARecordIsDamaged) {
  const SweepRequest request = request_of(scene_, {"cloth.stiffness=10,20"});
  const SweepResults whole = sweep(request, into("out"));
  const std::filesystem::path record = run_place(folder_.path("out"), whole.planned(whole.rows[0]).key) / "run.json";
  std::string of_another = test::content(record);
  of_another.replace(of_another.find("\"key\": \"") + 8, 1, "x");
  for (const std::string& text : {std::string("{"), std::string("{\"format\": 1}"), std::string(), of_another}) {
    folder_.write(std::filesystem::relative(record, folder_.path()).string(), text);
    const SweepResults read = read_results(folder_.path("out"), *read_sweep_file(folder_.path("out")));
    EXPECT_EQ(read.count(RunOutcome::not_run), 1U);
    EXPECT_TRUE(read.rows[0].record.damaged) << text;
    const std::vector<std::string> troubles = read.troubles();
    ASSERT_EQ(troubles.size(), 1U) << text;
    EXPECT_NE(troubles[0].find("run.json is damaged: --resume runs it again"), std::string::npos) << troubles[0];
  }
  SweepOptions again = into("out");
  again.resume = true;
  EXPECT_EQ(sweep(request, again).count(RunOutcome::completed), 2U);
  for (const std::string text : {"{", "{\"format\": 3, \"shard\": \"1/1\"}", "{\"format\": \"x\"}"}) {
    folder_.write("out/sweep.json", text);
    const std::string problem = test::usage_error([&] { read_sweep_file(folder_.path("out")); });
    EXPECT_NE(problem.find("sweep.json: it is damaged"), std::string::npos) << problem;
    EXPECT_EQ(problem.find("json.exception"), std::string::npos) << problem;
  }
}

}  // namespace
}  // namespace drape

#include "study/validation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "study/known_answers.hpp"
#include "study/report.hpp"

namespace drape {
namespace {

constexpr double least_shown = 1e-3;  // smallest error shown on a logarithmic axis, in tolerances
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

std::string figure_text(double value) {
  if (!std::isfinite(value)) return "–";
  return value != 0 && (std::abs(value) < 1e-3 || std::abs(value) >= 1e5) ? fmt::format("{:.2e}", value)
                                                                          : fmt::format("{:.5g}", value);
}

std::string seconds_text(double seconds) { return fmt::format("{:.2g}", seconds); }

/// An answer with the value found by a run.
struct FoundAnswer {
  const KnownAnswer* answer;
  double value = not_known;

  [[nodiscard]] double error() const { return std::abs(value - answer->value); }
  [[nodiscard]] double tolerances() const {
    return std::isfinite(value) ? in_tolerances(*answer, value) : std::numeric_limits<double>::infinity();
  }
};

std::vector<FoundAnswer> found_answers(const ValidationProblem& problem, const ValidationRun& run) {
  std::vector<FoundAnswer> found;
  for (const KnownAnswer& answer : problem.answers) {
    found.push_back({&answer, run.failure.empty() ? run.value(answer.name).value_or(not_known) : not_known});
  }
  return found;
}

/// Returns the largest error of a run, in tolerances.
double worst_of(const ValidationProblem& problem, const ValidationRun& run) {
  double worst = 0;
  for (const FoundAnswer& one : found_answers(problem, run)) worst = std::max(worst, one.tolerances());
  return worst;
}

ResultTable answers_table(const ValidationStudy& study, const ValidationCase& of) {
  ResultTable table{of.name + "-answers",
                    of.title + ": known answers and drape's",
                    {"problem", "quantity", "known", "drape", "error", "allowed", "verdict", "time [s]",
                     "default's error", "default's time [s]"},
                    {},
                    {}};
  for (const ValidationProblem& problem : of.problems) {
    const ValidationRun* run = study.run(of.name, problem.name);
    if (run == nullptr) continue;
    const ValidationRun* otherwise = study.run(of.name, problem.name, default_factor);
    for (const FoundAnswer& one : found_answers(problem, *run)) {
      const double by_default = otherwise != nullptr && otherwise->failure.empty()
                                    ? otherwise->value(one.answer->name).value_or(not_known)
                                    : not_known;
      table.rows.push_back({problem.name, one.answer->name, figure_text(one.answer->value), figure_text(one.value),
                            figure_text(one.error()), figure_text(one.answer->tolerance),
                            one.tolerances() <= 1 ? "met" : "not met", seconds_text(run->seconds),
                            figure_text(std::abs(by_default - one.answer->value)),
                            otherwise == nullptr ? "–" : seconds_text(otherwise->seconds)});
    }
    if (!run->failure.empty()) table.notes.push_back(fmt::format("{}: {}", problem.name, run->failure));
    if (otherwise != nullptr && !otherwise->failure.empty()) {
      table.notes.push_back(fmt::format("{} by default: {}", problem.name, otherwise->failure));
    }
  }
  return table;
}

ResultTable factors_table(const ValidationStudy& study, const ValidationCase& of) {
  ResultTable table{of.name + "-factors",
                    of.title + ": one factor at a time",
                    {"factor", "setting", "problem", "quantity", "value", "error", "error / allowed", "h [s]",
                     "mean edge [m]", "vertices", "capped", "time [s]"},
                    {},
                    {}};
  for (const ValidationRun& run : study.runs) {
    if (!run.measured || run.name != of.name || run.factor == scene_factor || run.factor == default_factor) continue;
    if (!run.failure.empty()) table.notes.push_back(fmt::format("{} {}: {}", run.factor, run.setting, run.failure));
    for (const FoundAnswer& one : found_answers(of.problem(run.problem), run)) {
      table.rows.push_back({run.factor, run.setting, run.problem, one.answer->name, figure_text(one.value),
                            figure_text(one.error()), three_digits(one.tolerances()), figure_text(run.step),
                            figure_text(run.cell), fmt::format("{}", run.vertices), fmt::format("{}", run.capped),
                            seconds_text(run.seconds)});
    }
  }
  return table;
}

/// Calls use(problem, answer) for every known answer on a curve.
template <class Use>
void for_answers_on(const ValidationCase& of, const ValidationCurve& curve, Use use) {
  for (const ValidationProblem& problem : of.problems) {
    for (const KnownAnswer& answer : problem.answers) {
      if (answer.curve == curve.name) use(problem, answer);
    }
  }
}

/// Returns the theoretical curve between its first and last answer, or published values as points.
html::ChartSeries theory_series(const ValidationCase& of, const ValidationCurve& curve) {
  html::ChartSeries theory{"theory", {}};
  theory.markers = false;
  theory.style = 0;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for_answers_on(of, curve, [&](const ValidationProblem&, const KnownAnswer& answer) {
    low = std::min(low, answer.x);
    high = std::max(high, answer.x);
    theory.points.push_back({answer.x, answer.value, fmt::format("known: {}", figure_text(answer.value)), {}, {}});
  });
  std::ranges::stable_sort(theory.points, {}, &html::ChartPoint::x);
  const KnownCurve known = known_curve(of.name, curve.name);
  if (known.value == nullptr) {
    theory.name = "published";
    theory.markers = true;
    for (std::size_t k = 1; k < theory.points.size(); k += 2) {
      theory.points.insert(theory.points.begin() + static_cast<std::ptrdiff_t>(k),
                           {theory.points[k].x, not_known, {}, {}, {}});
    }
    return theory;
  }
  if (!known.continuous || !(high > low)) return theory;
  theory.points.clear();
  constexpr int parts = 80;
  for (int k = 0; k <= parts; ++k) {
    const double x = low + (high - low) * k / parts;
    theory.points.push_back(
        {x, known.value(x), fmt::format("{}: {}", figure_text(x), figure_text(known.value(x))), {}, {}});
  }
  return theory;
}

/// Returns the values found by the runs of a factor, as points without a line.
html::ChartSeries found_series(const ValidationStudy& study, const ValidationCase& of, const ValidationCurve& curve,
                               const std::string& factor) {
  html::ChartSeries found{factor == scene_factor ? "drape" : "drape by default", {}};
  found.style = 3;
  found.other = factor != scene_factor;
  for_answers_on(of, curve, [&](const ValidationProblem& problem, const KnownAnswer& answer) {
    const ValidationRun* run = study.run(of.name, problem.name, factor);
    const std::optional<double> value = run == nullptr ? std::nullopt : run->value(answer.name);
    if (!value) return;
    if (!found.points.empty()) found.points.push_back({answer.x, not_known, {}, {}, {}});
    found.points.push_back(
        {answer.x,
         *value,
         fmt::format("{}: {}, known {}", problem.name, figure_text(*value), figure_text(answer.value)),
         run->study_case.command(),
         {}});
  });
  return found;
}

/// Plots theory as a line and drape's answers as points.
NamedChart master_curve(const ValidationStudy& study, const ValidationCase& of, const ValidationCurve& curve) {
  const bool has_formula = known_curve(of.name, curve.name).value != nullptr;
  html::Chart chart{fmt::format("{}: {}. {}", of.title, curve.title,
                                has_formula ? "Theory is a line, drape's runs are points."
                                            : "Points are published values and drape's runs."),
                    of.x_title,
                    curve.title,
                    html::Scale::linear,
                    html::Scale::linear,
                    {theory_series(of, curve)},
                    {}};
  for (const char* factor : {default_factor, scene_factor}) {
    html::ChartSeries found = found_series(study, of, curve, factor);
    if (!found.points.empty()) chart.series.push_back(std::move(found));
  }
  return {fmt::format("{}-{}", of.name, curve.name), std::move(chart)};
}

/// Plots error against computing time, a series per factor.
NamedChart cost_chart(const ValidationStudy& study, const ValidationCase& of) {
  html::Chart chart{of.title + ": largest error against computing time, one factor varied at a time.",
                    "computing time [s]",
                    "error / allowed",
                    html::Scale::logarithmic,
                    html::Scale::logarithmic,
                    {},
                    {{1, "allowed"}}};
  std::vector<std::string> names;
  for (const ValidationRun& run : study.runs) {
    if (!run.measured || run.name != of.name || !run.failure.empty()) continue;
    auto place = std::ranges::find(names, run.factor);
    if (place == names.end()) {
      names.push_back(run.factor);
      chart.series.push_back({run.factor, {}});
      place = names.end() - 1;
    }
    html::ChartSeries& series = chart.series[static_cast<std::size_t>(place - names.begin())];
    const double worst = worst_of(of.problem(run.problem), run);
    if (!series.points.empty() && run.factor != "cell" && run.factor != "step") {
      series.points.push_back({run.seconds, not_known, {}, {}, {}});
    }
    series.points.push_back({std::max(run.seconds, 1e-4),
                             worst,
                             fmt::format("{} {}, {}: {} of what is allowed, {} s", run.factor, run.setting, run.problem,
                                         three_digits(worst), seconds_text(run.seconds)),
                             run.study_case.command(),
                             {}});
  }
  return {of.name + "-cost", std::move(chart)};
}

StudySection section_of(const ValidationStudy& study, const ValidationCase& of) {
  StudySection section;
  section.title = of.title;
  section.group = verdict_of(study, of, scene_factor).met ? "met" : "not met";
  section.text = {of.question, fmt::format("Known from: {} {}", of.theory, of.source),
                  fmt::format("Mesh: {}", of.mesh)};
  for (const ValidationRun& run : study.runs) {
    if (run.name != of.name || run.played.frames == 0) continue;
    section.motions.push_back({run.problem, run.study_case.film_command("motion.html"), run.played});
  }
  for (const ValidationCurve& curve : of.curves) {
    section.text.push_back(fmt::format("{}: {}", curve.title, curve.how));
    section.charts.push_back(master_curve(study, of, curve));
  }
  // A single factor's costs are those of the summary.
  if (NamedChart cost = cost_chart(study, of); cost.chart.series.size() > 1) section.charts.push_back(std::move(cost));
  section.tables.push_back(answers_table(study, of));
  ResultTable factors = factors_table(study, of);
  if (!factors.rows.empty() || !factors.notes.empty()) section.tables.push_back(std::move(factors));
  return section;
}

ResultTable summary_table(const ValidationStudy& study) {
  ResultTable table{
      "validation",
      "Cases with known answers",
      {"case", "answers", "met", "worst error / allowed", "at", "time [s]", "default's worst", "default's time [s]"},
      {},
      {"An answer is met if |drape − known| is at most what is allowed. The default is the same scene without "
       "a key about how to compute: step, method, tolerance, accuracy.",
       "Time is computing time of one thread for all problems of the case."}};
  for (const ValidationCase& one : study.cases) {
    const ValidationVerdict scene = verdict_of(study, one, scene_factor);
    const ValidationVerdict otherwise = verdict_of(study, one, default_factor);
    if (scene.answers == 0) continue;
    table.rows.push_back({one.title, fmt::format("{}", scene.answers), fmt::format("{}", scene.answers - scene.missed),
                          three_digits(scene.worst), scene.worst_problem + " " + scene.worst_answer,
                          seconds_text(scene.seconds), otherwise.answers > 0 ? three_digits(otherwise.worst) : "–",
                          otherwise.answers > 0 ? seconds_text(otherwise.seconds) : "–"});
  }
  return table;
}

/// Plots each case's worst error against its computing time.
NamedChart summary_chart(const ValidationStudy& study) {
  html::Chart chart{"Every case's largest error against its computing time, as its scene is and by default.",
                    "computing time [s]",
                    "largest error / allowed",
                    html::Scale::logarithmic,
                    html::Scale::logarithmic,
                    {},
                    {{1, "allowed"}}};
  for (const char* factor : {scene_factor, default_factor}) {
    html::ChartSeries series{factor == std::string(scene_factor) ? "as the scene is" : "by default", {}};
    for (const ValidationCase& one : study.cases) {
      const ValidationVerdict verdict = verdict_of(study, one, factor);
      if (verdict.answers == 0 || !std::isfinite(verdict.worst)) continue;
      if (!series.points.empty()) series.points.push_back({verdict.seconds, not_known, {}, {}, {}});
      series.points.push_back({std::max(verdict.seconds, 1e-4),
                               std::max(verdict.worst, least_shown),
                               fmt::format("{}: {} of what is allowed, {} s", one.title, three_digits(verdict.worst),
                                           seconds_text(verdict.seconds)),
                               fmt::format("drape study validation {}", one.name),
                               {}});
    }
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  return {"validation-summary", std::move(chart)};
}

StudyFinding finding_of(const ValidationStudy& study, const ValidationCase& of) {
  const ValidationVerdict scene = verdict_of(study, of, scene_factor);
  const ValidationVerdict otherwise = verdict_of(study, of, default_factor);
  StudyFinding finding;
  finding.tone = scene.met ? html::Tone::good : html::Tone::bad;
  finding.verdict = scene.met ? "met" : "not met";
  finding.claim = of.title + ".";
  finding.of = of.title;
  finding.figures =
      fmt::format("{} of {} answers are within their tolerance; the worst, {} {}, is at {} of what is allowed; {} s.",
                  scene.answers - scene.missed, scene.answers, scene.worst_problem, scene.worst_answer,
                  three_digits(scene.worst), seconds_text(scene.seconds));
  if (otherwise.answers > 0) {
    finding.figures += fmt::format(" By default the worst is at {}, in {} s.", three_digits(otherwise.worst),
                                   seconds_text(otherwise.seconds));
  }
  return finding;
}

}  // namespace

ValidationVerdict verdict_of(const ValidationStudy& study, const ValidationCase& of, const std::string& factor) {
  ValidationVerdict verdict;
  for (const ValidationProblem& problem : of.problems) {
    const ValidationRun* run = study.run(of.name, problem.name, factor);
    if (run == nullptr) continue;
    verdict.seconds += run->seconds;
    for (const FoundAnswer& one : found_answers(problem, *run)) {
      ++verdict.answers;
      if (one.tolerances() > 1) ++verdict.missed;
      if (verdict.answers > 1 && one.tolerances() <= verdict.worst) continue;
      verdict.worst = one.tolerances();
      verdict.worst_problem = problem.name;
      verdict.worst_answer = one.answer->name;
    }
  }
  verdict.met = verdict.answers > 0 && verdict.missed == 0;
  return verdict;
}

bool all_met(const ValidationStudy& study) {
  return std::ranges::all_of(study.cases, [&](const ValidationCase& one) {
    const ValidationVerdict verdict = verdict_of(study, one, scene_factor);
    return verdict.answers == 0 || verdict.met;
  });
}

StudyReport validation_report(const ValidationStudy& study) {
  StudyReport report;
  report.kind = "drape study validation";
  report.title = "Problems whose answers are known";
  report.command = study.typed_command.empty() ? study.command : study.typed_command;
  report.provenance = study.provenance;
  report.seconds = study.seconds;
  report.introduction =
      "Each case is a scene whose answer is known from a formula, from an ordinary differential equation solved to "
      "1e-10, or from "
      "published figures. Its question, answer and tolerance are in scenes/validation/CASE/case.json, so that another "
      "simulator's answer can be judged, too: drape validate CASE answer.csv.";
  std::size_t measured = 0, met = 0;
  for (const ValidationCase& one : study.cases) {
    const ValidationVerdict verdict = verdict_of(study, one, scene_factor);
    if (verdict.answers == 0) continue;
    ++measured;
    met += verdict.met ? 1 : 0;
    report.findings.push_back(finding_of(study, one));
  }
  std::ranges::stable_sort(report.findings, {}, [](const StudyFinding& f) { return f.tone == html::Tone::good; });
  report.headline = met < measured  ? fmt::format("{} of {} cases with known answers are met", met, measured)
                    : measured == 1 ? "The case with known answers is met"
                                    : fmt::format("All {} cases with known answers are met", measured);
  if (const std::size_t missing = study.missing(); missing > 0) {
    report.headline = fmt::format("{} of {} runs are missing; {} of the {} measured cases {} met", missing,
                                  study.planned, met, measured, met == 1 ? "is" : "are");
  }
  report.answer = StudySection{"Summary", {}, {}, {summary_chart(study)}, {}};
  report.list = StudyList{"cases", summary_table(study)};
  for (const ValidationCase& one : study.cases) {
    if (verdict_of(study, one, scene_factor).answers > 0) report.sections.push_back(section_of(study, one));
  }
  return report;
}

}  // namespace drape

#include "study/scaling_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/method_series.hpp"
#include "study/power_law.hpp"

namespace drape {
namespace {

std::string percent(double share) { return share > 0 ? fmt::format("{:.1f}", 100 * share) : "–"; }
std::string exponent(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : "–"; }

double per_iteration(const ScalingPoint& p) { return p.time.median / std::max(1.0, p.iterations); }

/// Returns the methods in the order of their points.
std::vector<std::string> methods_of(const ScalingStudy& study) {
  std::vector<std::string> names;
  for (const ScalingPoint& p : study.points) {
    if (names.empty() || names.back() != p.method) names.push_back(p.method);
  }
  return names;
}

template <class Value>
double growth(const ScalingStudy& study, const std::string& method, Value value) {
  std::vector<std::array<double, 2>> points;
  for (const ScalingPoint& p : study.points) {
    if (p.method == method) points.push_back({p.vertices, value(p)});
  }
  return fitted_exponent(points);
}

struct Growth {
  std::string method;
  double step, iterations, iteration, factor, memory;
};

std::vector<Growth> growths(const ScalingStudy& study) {
  std::vector<Growth> all;
  for (const std::string& method : methods_of(study)) {
    all.push_back({method, growth(study, method, [](const ScalingPoint& p) { return p.time.median; }),
                   growth(study, method, [](const ScalingPoint& p) { return p.iterations; }),
                   growth(study, method, per_iteration),
                   growth(study, method, [](const ScalingPoint& p) { return p.factor; }),
                   growth(study, method, [](const ScalingPoint& p) { return p.memory; })});
  }
  return all;
}

ResultTable time_table(const ScalingStudy& study) {
  ResultTable table{
      "scaling-times",
      "Time and memory",
      {"method", "grid", "vertices", "h [s]", "iterations", "µs per step", "from", "to", "runs", "µs per iteration",
       "set-up [µs]", "of which factor", "memory [MB]"},
      {},
      {"Semi-implicit steps are just below the stability limit; set-up is then the search for that limit."}};
  for (const ScalingPoint& p : study.points) {
    table.rows.push_back({p.method, fmt::format("{0}×{0}", p.cells), fmt::format("{}", p.vertices),
                          fmt::format("{:g}", p.step), p.iterations > 0 ? fmt::format("{:.1f}", p.iterations) : "–",
                          three_digits(p.time.median), three_digits(p.time.lower), three_digits(p.time.upper),
                          fmt::format("{}", p.time.count), three_digits(per_iteration(p)), three_digits(p.setup.median),
                          p.factor > 0 ? three_digits(p.factor) : "–", three_digits(1e-6 * p.memory)});
  }
  return table;
}

ResultTable growth_table(const ScalingStudy& study) {
  ResultTable table{"scaling-growth",
                    "Growth: p in (number of vertices)ᵖ, fitted to all grids",
                    {"method", "time per step", "iterations", "time per iteration", "factor", "memory"},
                    {},
                    {}};
  for (const Growth& g : growths(study)) {
    table.rows.push_back({g.method, exponent(g.step), exponent(g.iterations), exponent(g.iteration), exponent(g.factor),
                          exponent(g.memory)});
  }
  return table;
}

ResultTable share_table(const ScalingStudy& study) {
  ResultTable table{"scaling-shares",
                    "Where step time goes [%]",
                    {"method", "grid", "local", "assembly", "products", "global", "vectors", "contact", "rest"},
                    {},
                    {"Local: the springs' energies and forces. Assembly: the blocks of Newton's matrix. Products: with "
                     "that matrix, in conjugate gradients. Global: solves with the constant factor, also Newton's "
                     "preconditioner. Vectors: their sums and products. Contact: the sphere, and gravity.",
                     "With cholesky, the rest is Newton's matrix, its factorisation and the solve. Measured in a "
                     "separate run with a clock around every hot loop."}};
  for (const ScalingPoint& p : study.points) {
    const TimeShares& s = p.shares;
    table.rows.push_back({p.method, fmt::format("{0}×{0}", p.cells), percent(s.local), percent(s.assembly),
                          percent(s.product), percent(s.global), percent(s.vectors), percent(s.contact),
                          percent(s.rest)});
  }
  return table;
}

template <class Value>
NamedChart chart_of(const ScalingStudy& study, const std::string& name, const std::string& title,
                    const std::string& quantity, const std::string& unit, Value value) {
  html::Chart chart{title, "vertices", quantity + " [" + unit + "]", html::Scale::logarithmic, html::Scale::logarithmic,
                    {},    {}};
  for (const std::string& method : methods_of(study)) {
    html::ChartSeries series = method_series(method);
    for (const ScalingPoint& p : study.points) {
      if (p.method != method) continue;
      series.points.push_back({p.vertices,
                               value(p),
                               fmt::format("{0}×{0}: {1} {2}", p.cells, three_digits(value(p)), unit),
                               p.what.command(),
                               {}});
    }
    chart.series.push_back(std::move(series));
  }
  return {name, std::move(chart)};
}

/// Returns the most expensive part of a step.
std::string largest_share(const TimeShares& s) {
  const std::array<std::pair<const char*, double>, 7> parts{{{"the local step", s.local},
                                                             {"the assembly", s.assembly},
                                                             {"products with Newton's matrix", s.product},
                                                             {"the constant factor's triangles", s.global},
                                                             {"sums of vectors", s.vectors},
                                                             {"contact", s.contact},
                                                             {"the rest", s.rest}}};
  const auto* most =
      std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return fmt::format("{} ({:.0f} %)", most->first, 100 * most->second);
}

}  // namespace

StudyReport scaling_report(const ScalingStudy& study) {
  StudyReport report;
  report.kind = "drape study scaling";
  report.title = "How time and memory grow with the cloth";
  report.command =
      fmt::format("drape study scaling --largest {}", study.options.largest) + runs_option(study.options.runs);
  report.introduction =
      "The homework's cloth on the sphere, k = 180 N/m, h = 0.02 s and ε = 1e-3 m, on ever finer grids. Every method "
      "starts from the same state, 0.5 s into the motion.";
  report.seconds = study.seconds;
  report.headline = "How time and memory grow with the cloth";
  for (const Growth& g : growths(study)) {
    const auto last = std::find_if(study.points.rbegin(), study.points.rend(),
                                   [&](const ScalingPoint& p) { return p.method == g.method; });
    report.findings.push_back(
        {html::Tone::neutral, "",
         fmt::format("{}: time per step grows as n to the power {}.", g.method, exponent(g.step)),
         fmt::format("On {0}×{0} cells a step takes {1} µs{2}, most of it {3}, and the simulation {4} MB.", last->cells,
                     three_digits(last->time.median),
                     last->iterations > 0 ? fmt::format(" in {:.1f} iterations", last->iterations) : "",
                     largest_share(last->shares), three_digits(1e-6 * last->memory))});
  }
  report.sections = {
      {"Growth",
       study.notes,
       {growth_table(study), time_table(study)},
       {chart_of(study, "scaling-step", "Time per step against the number of vertices.", "time per step", "µs",
                 [](const ScalingPoint& p) { return p.time.median; }),
        chart_of(study, "scaling-iteration", "Time per iteration against the number of vertices.", "time per iteration",
                 "µs", per_iteration),
        chart_of(study, "scaling-memory", "Memory against the number of vertices.", "memory", "MB",
                 [](const ScalingPoint& p) { return 1e-6 * p.memory; })},
       {}},
      {"Where the time goes", {}, {share_table(study)}, {}, {}},
      {"How it was measured",
       {fmt::format("Five steps from the same state, as computing time of one thread that stays on one processor: "
                    "{}. The methods take turns on each grid. Every run sets "
                    "the simulation up anew and takes a step that is not timed. Memory is what the "
                    "heap has given to the simulation.",
                    describe_runs(study.options.runs))},
       {},
       {},
       {}}};
  return report;
}

}  // namespace drape

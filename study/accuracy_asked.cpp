#include "study/accuracy_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/text.hpp"
#include "drape/scene/scene.hpp"
#include "reports/chart.hpp"

namespace drape {
namespace {

constexpr std::array<double, 4> limits{1e-3, 1e-4, 1e-5, smallest_error};
constexpr const char* per_step = "µs per step";
constexpr const char* per_second = "ms per second of motion";

/// A kind of error, the offers for it, and its resolution.
struct Kind {
  std::string name, unit;
  std::vector<Offer> offers;
  double unknown = 0;    ///< errors up to this size cannot be resolved [m]
  std::string why = {};  ///< the reason
};

constexpr const char* poor_reference = "unknown: the reference is not accurate enough";

/// Returns the errors of whole motions, with a given accuracy or with fixed steps and the default tolerance.
std::vector<Kind> whole_errors(const SceneAccuracy& scene) {
  std::vector<Kind> kinds;
  if (scene.asked.empty() && scene.fixed.empty()) return kinds;
  for (std::size_t i = 0; i < scene.options.times.size(); ++i) {
    Kind kind{fmt::format("whole, at {:g} s", scene.options.times[i]), per_second, {}, 0, poor_reference};
    if (i < scene.step_gained.size()) kind.unknown = scene.step_gained[i];
    for (const auto* points : {&scene.asked, &scene.fixed}) {
      const char* const setting = points == &scene.asked ? "accuracy = {:g} m" : "h = {:g} s";
      for (const MotionPoint& p : *points) {
        if (!p.measured.failure.empty() || i >= p.errors.size()) continue;
        kind.offers.push_back({step_method_name(p.method), fmt::format(fmt::runtime(setting), p.setting),
                               p.errors[i].max, p.measured.cost()});
      }
    }
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

/// Returns the errors of a single step, and of the motion with the same step.
std::vector<Kind> tolerance_errors(const SceneAccuracy& scene) {
  if (scene.points.empty()) return {};
  std::vector<Kind> kinds{{"solve", per_step, solve_offers(scene)}};
  for (std::size_t i = 0; i < scene.options.times.size(); ++i) {
    Kind kind{fmt::format("motion, at {:g} s", scene.options.times[i]), per_step, solve_offers(scene), scene.apart[i],
              "unknown: the motion is chaotic"};
    for (std::size_t p = 0; p < scene.points.size(); ++p) kind.offers[p].error = scene.points[p].motion.at(i).max;
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

std::vector<Kind> step_errors(const SceneAccuracy& scene) {
  if (scene.steps.empty()) return {};
  Kind kind{fmt::format("time step, at {:g} s", scene.options.times.front()),
            per_second,
            {},
            scene.step_gained.front(),
            poor_reference};
  for (const StepPoint& p : scene.steps) {
    kind.offers.push_back(
        {step_method_name(p.method), fmt::format("h = {:g} s", p.step), p.error.max, p.measured.cost()});
  }
  return {kind};
}

std::vector<Kind> kinds_of(const SceneAccuracy& scene) {
  std::vector<Kind> kinds = whole_errors(scene);
  for (Kind& kind : tolerance_errors(scene)) kinds.push_back(std::move(kind));
  for (Kind& kind : step_errors(scene)) kinds.push_back(std::move(kind));
  return kinds;
}

/// Returns the reason why no offer is below a limit; empty if one is.
std::string why_none(const Kind& kind, double limit) {
  if (kind.unknown >= limit) return kind.why;
  return find_cheapest(kind.offers, limit).first == nullptr ? "none of those run" : "";
}

}  // namespace

Cheapest find_cheapest(const std::vector<Offer>& offers, double limit) {
  Cheapest found;
  const auto best = [&](const std::string& but) {
    const Offer* least = nullptr;
    for (const Offer& offer : offers) {
      if (!(offer.error < limit) || offer.method == but) continue;
      // Equal errors of one method mean equal iterations: only clock noise differs.
      if (least != nullptr && offer.method == least->method && offer.error == least->error) continue;
      if (least == nullptr || offer.cost.median < least->cost.median) least = &offer;
    }
    return least;
  };
  found.first = best("");
  if (found.first != nullptr) found.next = best(found.first->method);
  return found;
}

std::vector<Offer> solve_offers(const SceneAccuracy& scene) {
  std::vector<Offer> offers;
  for (const TolerancePoint& p : scene.points) {
    offers.push_back({step_method_name(p.method), fmt::format("ε = {:g} {}", p.tolerance, scene.tolerance_unit),
                      p.solve.max, p.measured.time()});
  }
  return offers;
}

std::string first_answer(const SceneAccuracy& scene) {
  for (const Kind& kind : kinds_of(scene)) {
    for (const double limit : limits) {
      if (!why_none(kind, limit).empty()) continue;
      const Offer& offer = *find_cheapest(kind.offers, limit).first;
      return fmt::format("Below {}, {} at {} costs least: {} {} ({})", readable_length(limit), offer.method, offer.at,
                         three_digits(offer.cost.median), kind.unit, kind.name);
    }
  }
  return {};
}

ResultTable answer_table(const SceneAccuracy& scene) {
  ResultTable table{
      scene.name + "-answer", fmt::format("{}: what to take for an error", scene.scene), {"error"}, {}, {}};
  for (const double limit : limits) table.columns.push_back("below " + readable_length(limit));
  for (const Kind& kind : kinds_of(scene)) {
    table.rows.push_back({fmt::format("{} [{}]", kind.name, kind.unit)});
    for (const double limit : limits) {
      std::string cell = why_none(kind, limit);
      const Offer* offer = find_cheapest(kind.offers, limit).first;
      if (cell.empty() && offer != nullptr) {
        cell = fmt::format("{}, {}: {}", offer->method, offer->at, three_digits(offer->cost.median));
      }
      table.rows.back().push_back(std::move(cell));
    }
  }
  return table;
}

ResultTable cheapest_table(const SceneAccuracy& scene) {
  ResultTable table{scene.name + "-cheapest",
                    fmt::format("{}: what accuracy costs", scene.scene),
                    {"error", "below", "cheapest", "at", "cost", "unit", "next best", "next at", "next cost"},
                    {},
                    {}};
  for (const Kind& kind : kinds_of(scene)) {
    for (const double limit : limits) {
      std::vector<std::string> row{kind.name, readable_length(limit)};
      const Cheapest c = find_cheapest(kind.offers, limit);
      if (const std::string none = why_none(kind, limit); !none.empty()) {
        row.push_back(none);
      } else {
        row.insert(row.end(), {c.first->method, c.first->at, three_digits(c.first->cost.median), kind.unit});
        if (c.next != nullptr) row.insert(row.end(), {c.next->method, c.next->at, three_digits(c.next->cost.median)});
      }
      row.resize(table.columns.size(), "–");
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::string describe_cheapest(const SceneAccuracy& scene) {
  const std::vector<Offer> offers = solve_offers(scene);
  std::string text = "The cheapest";
  for (const double limit : limits) {
    const Cheapest c = find_cheapest(offers, limit);
    text += fmt::format("{} below {} is {}", limit == limits.front() ? "" : "; the cheapest", readable_length(limit),
                        c.first == nullptr ? "none of those run"
                                           : fmt::format("{} at {} with {} µs per step", c.first->method, c.first->at,
                                                         three_digits(c.first->cost.median)));
  }
  return text + ".";
}

namespace {

constexpr double factor = 3, far_below = 0.1, known_share = 0.3, miss = 10;

std::string length(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–"; }

std::string median_of(std::vector<double> values) {
  return values.empty() ? "–" : fmt::format("{:g}", median_interval(std::move(values)).median);
}

html::ChartPoint point_of(const SceneAccuracy& scene, const MotionPoint& p, double x, double y, const char* name) {
  const MedianInterval cost = p.measured.cost();
  return {x,
          y,
          fmt::format("{} = {:g}: error {:.3g} m at {:g} s, {:.3g} ms per second of motion", name, p.setting,
                      p.errors.front().max, scene.options.times.front(), cost.median),
          motion_commands(scene, p),
          {}};
}

/// Plots a property of the motions (up) against their cost (across), for the methods of one order. Motions with an
/// accuracy are solid lines, fixed steps dashed.
template <class Value>
html::Chart by_cost(const SceneAccuracy& scene, int order, const std::string& title, const std::string& y_title,
                    Value value) {
  html::Chart chart{title, cost_title, y_title, html::Scale::logarithmic, html::Scale::logarithmic, {}, {}};
  for (const auto* points : {&scene.asked, &scene.fixed}) {
    const bool fixed = points == &scene.fixed;
    for (const StepMethod method : scene.options.methods) {
      if (order_of(method) != order) continue;
      html::ChartSeries series = method_series(step_method_name(method));
      if (fixed) series.name += ", fixed steps";
      series.other = fixed;
      for (const MotionPoint& p : *points) {
        if (p.method != method || !p.measured.failure.empty()) continue;
        series.points.push_back(point_of(scene, p, p.measured.cost().median, value(p), fixed ? "h" : "accuracy"));
        series.points.back().spread = spread_of(p.measured.cost());
      }
      if (!series.points.empty()) chart.series.push_back(std::move(series));
    }
  }
  return chart;
}

html::Chart asked_and_got(const SceneAccuracy& scene) {
  html::Chart chart{
      fmt::format("Error at {:g} s against the requested accuracy of each step.", scene.options.times.front()),
      "requested accuracy [m]",
      "error [m]",
      html::Scale::logarithmic,
      html::Scale::logarithmic,
      {},
      {}};
  for (const StepMethod method : scene.options.methods) {
    html::ChartSeries series = method_series(step_method_name(method));
    for (const MotionPoint& p : scene.asked) {
      if (p.method != method || !p.measured.failure.empty()) continue;
      series.points.push_back(point_of(scene, p, p.setting, p.errors.front().max, "accuracy"));
    }
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  html::ChartSeries same{"got = asked", {}, false};
  same.style = 5;  // used by no method
  for (const double accuracy : scene.options.accuracies) {
    same.points.push_back({accuracy, accuracy, fmt::format("{:g} m", accuracy), {}, {}});
  }
  chart.series.push_back(std::move(same));
  if (scene.step_gained.front() > 0) {
    chart.levels.push_back({scene.step_gained.front(), "uncertainty of the reference"});
  }
  return chart;
}

ResultTable asked_table(const SceneAccuracy& scene) {
  ResultTable table{
      scene.name + "-asked",
      fmt::format("{}: accuracies asked for", scene.scene),
      {"method", "accuracy [m]", "substeps: least", "median", "most", "not converged", "largest error of a step [m]"},
      {},
      {}};
  for (const double time : scene.options.times) table.columns.push_back(fmt::format("error at {:g} s [m]", time));
  table.columns.insert(table.columns.end(), {"ms per second of motion", "from", "to", "runs", "FLIP of the film"});
  for (const MotionPoint& p : scene.asked) {
    const MedianInterval cost = p.measured.microseconds.empty() ? MedianInterval{NAN, NAN, NAN, 0} : p.measured.cost();
    const auto [least, most] = std::ranges::minmax_element(p.substeps);
    const bool cut = !p.substeps.empty();
    double local = 0;
    for (const double error : p.local_errors) local = std::max(local, error);
    table.rows.push_back({step_method_name(p.method), plain_number(p.setting), cut ? fmt::format("{:g}", *least) : "–",
                          median_of(p.substeps), cut ? fmt::format("{:g}", *most) : "–",
                          fmt::format("{}", std::ranges::count(p.converged, 0.0)), local > 0 ? length(local) : "–"});
    for (const Distance& d : p.errors) table.rows.back().push_back(length(d.max));
    table.rows.back().insert(table.rows.back().end(),
                             {three_digits(cost.median), three_digits(cost.lower), three_digits(cost.upper),
                              fmt::format("{}", cost.count), p.flip ? fmt::format("{:.4f}", *p.flip) : "–"});
    if (!p.measured.failure.empty()) {
      table.notes.push_back(fmt::format("{}, {:g} m: {}", step_method_name(p.method), p.setting, p.measured.failure));
    }
  }
  table.notes.emplace_back(interval_note);
  std::string known;
  for (std::size_t i = 0; i < scene.step_gained.size(); ++i) {
    known += fmt::format("{}{:.2g} m at {:g} s", i == 0 ? "" : ", ", scene.step_gained[i], scene.options.times[i]);
  }
  table.notes.push_back(
      fmt::format("The reference is extrapolated from h = {:g} s and twice that, which changes it by {}.",
                  scene.step_reference, known));
  return table;
}

ResultTable estimate_table(const SceneAccuracy& scene) {
  ResultTable table{
      scene.name + "-estimates",
      fmt::format("{}: what a step says of its error, and what that is", scene.scene),
      {"method", "accuracy [m]", "steps judged before", "within a factor of 3", "worst: error by estimate",
       "steps after", "worst after", "missed tenfold", "missed, not reported", "not known"},
      {},
      {}};
  const auto ratio = [](double value) { return value > 0 ? fmt::format("{:.2f}", value) : "–"; };
  for (const MotionPoint& p : scene.asked) {
    const EstimateCheck c = check_estimates(scene, p);
    table.rows.push_back(
        {step_method_name(p.method), plain_number(p.setting), fmt::format("{}", c.judged),
         c.judged > 0 ? fmt::format("{:.0f} %", 100.0 * static_cast<double>(c.close) / static_cast<double>(c.judged))
                      : "–",
         ratio(c.worst_before), fmt::format("{}", c.after), ratio(c.worst_after), fmt::format("{}", c.missed),
         fmt::format("{}", c.unreported), fmt::format("{}", c.unknown)});
  }
  const double until = smooth_until(scene);
  table.notes.push_back(
      std::isfinite(until)
          ? fmt::format("Before: until {:g} s, when the cloth {}.", until,
                        scene.contact_from && *scene.contact_from == until
                            ? "is first where it would not be if nothing touched it or limited its strain"
                            : "begins to buckle: two motions that differ by rounding part by more than 10 nm")
          : fmt::format("Before: all steps up to {:g} s; nothing is touched and nothing buckles until then.",
                        scene.options.times.front()));
  table.notes.emplace_back(
      "Steps whose error and estimate are both below a tenth of the accuracy are not judged. Missed tenfold: an error "
      "above ten times the accuracy.");
  return table;
}

}  // namespace

EstimateCheck& EstimateCheck::operator+=(const EstimateCheck& other) {
  judged += other.judged;
  close += other.close;
  worst_before = std::max(worst_before, other.worst_before);
  worst_after = std::max(worst_after, other.worst_after);
  after += other.after;
  unknown += other.unknown;
  missed += other.missed;
  unreported += other.unreported;
  return *this;
}

double smooth_until(const SceneAccuracy& scene) {
  constexpr double always = std::numeric_limits<double>::infinity();
  const double until = std::min(scene.contact_from.value_or(always), scene.buckling_from.value_or(always));
  return until <= scene.options.times.front() * (1 + 1e-9) ? until : always;
}

EstimateCheck check_estimates(const SceneAccuracy& scene, const MotionPoint& asked) {
  EstimateCheck check;
  const double until = smooth_until(scene);
  for (std::size_t i = 0; i < asked.local_errors.size(); ++i) {
    const double error = asked.local_errors[i], estimate = asked.estimates[i];
    if (std::max(error, estimate) < far_below * asked.setting) continue;
    if (!(asked.local_unknown[i] <= known_share * error)) {
      ++check.unknown;
      continue;
    }
    if (error > miss * asked.setting) {
      ++check.missed;
      if (asked.converged[i] == 1) ++check.unreported;
    }
    const double ratio = error / estimate;
    if (static_cast<double>(i + 1) * scene.step < until * (1 - 1e-9)) {
      ++check.judged;
      if (ratio <= factor && ratio >= 1 / factor) ++check.close;
      check.worst_before = std::max(check.worst_before, ratio);
    } else {
      ++check.after;
      check.worst_after = std::max(check.worst_after, ratio);
    }
  }
  return check;
}

std::vector<NamedChart> asked_charts(const SceneAccuracy& scene) {
  std::vector<NamedChart> charts;
  if (!scene.asked.empty()) charts.push_back({scene.name + "-asked-and-got", asked_and_got(scene)});
  if (scene.asked.empty() && scene.fixed.empty()) return charts;
  for (const int order : {1, 2}) {
    const std::string of_order = order == 1 ? "Methods of first order" : "Methods of second order";
    const std::string of_second = order == 1 ? "" : "-second-order";
    html::Chart errors =
        by_cost(scene, order,
                fmt::format("{}: error at {:g} s by what the motion costs, with an accuracy that was asked for and, "
                            "dashed, with fixed steps and the default tolerance.",
                            of_order, scene.options.times.front()),
                "error [m]", [](const MotionPoint& p) { return p.errors.front().max; });
    if (errors.series.empty()) continue;
    charts.push_back({scene.name + "-error-cost" + of_second, std::move(errors)});
    if (!scene.options.parts.films) continue;
    html::Chart films =
        by_cost(scene, order,
                fmt::format("{}: how different the film looks, the mean FLIP error of its frames up to {:g} s, "
                            "0 to 1, by what the motion costs.",
                            of_order, scene.options.times.back()),
                "FLIP error", [](const MotionPoint& p) { return p.flip.value_or(NAN); });
    if (scene.film_unknown && *scene.film_unknown > 0) {
      films.levels.push_back({*scene.film_unknown, "uncertainty of the reference"});
    }
    charts.push_back({scene.name + "-film" + of_second, std::move(films)});
  }
  return charts;
}

std::vector<ResultTable> asked_tables(const SceneAccuracy& scene) {
  if (scene.asked.empty()) return {};
  std::vector<ResultTable> tables{asked_table(scene)};
  if (scene.options.parts.estimates) tables.push_back(estimate_table(scene));
  return tables;
}

void add_asked_findings(StudyReport& report, const SceneAccuracy& scene) {
  if (scene.asked.empty() || !scene.options.parts.estimates) return;
  EstimateCheck all;
  for (const MotionPoint& p : scene.asked) all += check_estimates(scene, p);
  const std::string before =
      all.judged == 0 ? "No step was judged before anything is touched or buckles"
                      : fmt::format(
                            "Of {} steps before anything is touched or buckles, {} are within a factor of 3 of the "
                            "true error, and the worst is {:.2g} times its estimate",
                            all.judged, all.close, all.worst_before);
  const std::string after =
      all.after == 0 ? "" : fmt::format("; of {} later ones, the worst is {:.2g} times", all.after, all.worst_after);
  const std::string missed = fmt::format(
      ". {} are above ten times what was asked{}.", all.missed,
      all.missed == 0 ? "" : fmt::format(", of which {} did not say that they had not converged", all.unreported));
  report.findings.push_back({all.unreported == 0 ? html::Tone::good : html::Tone::bad, "",
                             fmt::format("{}: what a step says of its error.", scene.scene), before + after + missed});
}

}  // namespace drape

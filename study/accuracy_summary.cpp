#include "study/accuracy_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/text.hpp"
#include "scene/method_names.hpp"
#include "study/accuracy_asked.hpp"
#include "study/accuracy_cheapest.hpp"

namespace drape {
namespace {

constexpr std::array<double, 3> wanted{1e-2, 1e-3, 1e-4};  // errors of a motion [m]
constexpr std::array<double, 4> solve_limits{1e-3, 1e-4, 1e-5, smallest_error};

/// Returns the offers of motions with an accuracy.
std::vector<Offer> asked_offers(const SceneAccuracy& scene, bool with_explicit) {
  std::vector<Offer> offers;
  for (const MotionPoint& p : scene.asked) {
    if (!p.measured.failure.empty() || (is_explicit(p.method.method) && !with_explicit)) continue;
    offers.push_back({step_method_name(p.method), fmt::format("accuracy = {}", plain_number(p.setting)),
                      p.errors.front().max, p.measured.cost()});
  }
  return offers;
}

ResultTable take_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"asked-take", "What to take for an error of the motion", {"scene", "methods"}, {}, {}};
  for (const double limit : wanted) table.columns.push_back("below " + readable_length(limit));
  for (const SceneAccuracy& scene : scenes) {
    for (const bool with_explicit : {true, false}) {
      const std::vector<Offer> offers = asked_offers(scene, with_explicit);
      table.rows.push_back({scene.name, with_explicit ? "all" : "implicit"});
      for (const double limit : wanted) {
        const Offer* const first = find_cheapest(offers, limit).first;
        const bool known = scene.step_gained.front() < limit;
        table.rows.back().push_back(first != nullptr && known ? fmt::format("{}, {}: {}", first->method, first->at,
                                                                            three_digits(first->cost.median))
                                                              : "–");
      }
    }
  }
  table.notes.emplace_back(
      "The cheapest method and accuracy [m] that end so near to the reference at the first time, and ms of computing "
      "time for a second of motion. Implicit methods also take what springs are too stiff, or meshes too fine, for the "
      "explicit ones.");
  return table;
}

/// Returns "13 mm, 30.9 ms, 1.22": final error, cost, and cost relative to the best fixed step.
std::string describe_cost(const SceneAccuracy& scene, const MotionPoint& p) {
  if (!p.measured.failure.empty()) return "–";
  const double error = p.errors.front().max, cost = p.measured.cost().median;
  const std::optional<double> fixed = fixed_step_cost(scene, p.method, error);
  return fmt::format("{:.2g} mm, {} ms, {}", 1e3 * error, three_digits(cost),
                     fixed ? fmt::format("{:.2f}", cost / *fixed) : "–");
}

ResultTable cost_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"asked-cost", "Accuracies that were asked for, and what they cost", {"scene", "method"}, {}, {}};
  const std::vector<double>& accuracies = scenes.front().options.accuracies;
  for (const double accuracy : accuracies) table.columns.push_back("accuracy = " + plain_number(accuracy));
  for (const SceneAccuracy& scene : scenes) {
    for (const StepMethod method : scene.options.methods) {
      std::vector<std::string> row{scene.name, step_method_name(method)};
      for (const double accuracy : accuracies) {
        const auto found = std::ranges::find_if(scene.asked, [method, accuracy](const MotionPoint& p) {
          return p.method == method && p.setting == accuracy;
        });
        row.push_back(found != scene.asked.end() ? describe_cost(scene, *found) : "–");
      }
      if (std::ranges::any_of(row.begin() + 2, row.end(), [](const std::string& cell) { return cell != "–"; })) {
        table.rows.push_back(std::move(row));
      }
    }
  }
  table.notes.emplace_back(
      "The error of the motion at the first time, ms of computing time for a second of motion, and that by what the "
      "best "
      "fixed step of the same method takes which ends with the same error, with the default tolerance, interpolated "
      "between those that were run (–: none of them gets there).");
  return table;
}

ResultTable checks_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"asked-checks",
                    "What steps say of their errors, and what these are",
                    {"scene", "steps before", "within a factor of 3", "largest error by estimate", "steps after",
                     "largest", "missed tenfold", "of these unreported"},
                    {},
                    {}};
  const auto ratio = [](double value) { return value > 0 ? fmt::format("{:.2f}", value) : "–"; };
  for (const SceneAccuracy& scene : scenes) {
    if (!scene.options.parts.estimates) continue;
    EstimateCheck all;
    for (const MotionPoint& p : scene.asked) all += check_estimates(scene, p);
    table.rows.push_back({scene.name, fmt::format("{}", all.judged), fmt::format("{}", all.close),
                          ratio(all.worst_before), fmt::format("{}", all.after), ratio(all.worst_after),
                          fmt::format("{}", all.missed), fmt::format("{}", all.unreported)});
  }
  table.notes.emplace_back(
      "All methods and accuracies together. Before and after the cloth first touches something or buckles. Steps whose "
      "error and estimate are both below a tenth of the accuracy are not judged.");
  return table;
}

ResultTable solve_table(const std::vector<SceneAccuracy>& scenes) {
  ResultTable table{"solve-costs", "What a step costs whose solve ends so near to the minimiser", {}, {}, {}};
  table.columns = {"scene", "method"};
  for (const double limit : solve_limits) table.columns.push_back("below " + readable_length(limit));
  for (const SceneAccuracy& scene : scenes) {
    const std::vector<Offer> offers = solve_offers(scene);
    for (const StepMethod method : scene.options.methods) {
      std::vector<Offer> own;
      std::ranges::copy_if(offers, std::back_inserter(own),
                           [name = step_method_name(method)](const Offer& o) { return o.method == name; });
      if (own.empty()) continue;
      table.rows.push_back({scene.name, step_method_name(method)});
      for (const double limit : solve_limits) {
        const Offer* const least = find_cheapest(own, limit).first;
        table.rows.back().push_back(least != nullptr ? three_digits(least->cost.median) : "–");
      }
    }
  }
  table.notes.emplace_back("µs per step, by the loosest tolerance that gets there.");
  return table;
}

}  // namespace

std::optional<StudySection> solve_summary(const std::vector<SceneAccuracy>& scenes) {
  std::vector<SceneAccuracy> solved;
  std::ranges::copy_if(scenes, std::back_inserter(solved), [](const SceneAccuracy& s) { return !s.points.empty(); });
  if (solved.empty()) return std::nullopt;
  return StudySection{"Solves by how near they end", {}, {solve_table(solved)}, {}, {}};
}

std::optional<double> fixed_step_cost(const SceneAccuracy& scene, StepMethod method, double error) {
  std::vector<std::pair<double, double>> runs;  // errors and costs
  for (const MotionPoint& p : scene.fixed) {
    if (p.method == method && p.measured.failure.empty()) {
      runs.emplace_back(p.errors.front().max, p.measured.cost().median);
    }
  }
  std::optional<double> least;
  const auto offer = [&least](double cost) { least = std::min(cost, least.value_or(cost)); };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto [larger, cost] = runs[i];
    if (larger <= error) offer(cost);
    if (i + 1 == runs.size()) continue;
    const auto [smaller, next_cost] = runs[i + 1];
    if (!(smaller < error && error < larger)) continue;
    const double part = std::log(larger / error) / std::log(larger / smaller);
    offer(cost * std::pow(next_cost / cost, part));
  }
  return least;
}

std::optional<StudySection> asked_summary(const std::vector<SceneAccuracy>& scenes) {
  std::vector<SceneAccuracy> asked;
  std::ranges::copy_if(scenes, std::back_inserter(asked), [](const SceneAccuracy& s) { return !s.asked.empty(); });
  if (asked.empty()) return std::nullopt;
  std::vector<ResultTable> tables{take_table(asked), cost_table(asked)};
  if (ResultTable checks = checks_table(asked); !checks.rows.empty()) tables.push_back(std::move(checks));
  return StudySection{"Accuracies that are asked for",
                      {fmt::format("Errors of motions are at {:g} s.", asked.front().options.times.front())},
                      std::move(tables),
                      {},
                      {}};
}

}  // namespace drape

#include "study/accuracy_cheapest.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/text.hpp"
#include "scene/method_names.hpp"

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

}  // namespace drape

#include "study/homework_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drape {
namespace {

/// Threshold for visible flipped pairs per frame, more than one pair in two frames; the report's Liu13 has about four.
constexpr double visible_pairs = 0.5;

std::string per_frame(double pairs) { return pairs > 0 ? fmt::format("{:.2g}", pairs) : "none"; }

/// Returns the root mean square of a(t) − b(t) over the first `seconds`, at the coarser steps, relative to the range of
/// `a` in that time.
double relative_distance(const Measured& a, const Measured& b, double seconds) {
  const Measured& coarse = a.step > b.step ? a : b;
  const auto at = [](const Measured& m, double time) {
    return m.height[static_cast<std::size_t>(std::lround(time / m.step)) - 1];
  };
  double sum = 0, low = INFINITY, high = -INFINITY;
  int count = 0;
  for (double time = coarse.step; time < seconds; time = ++count * coarse.step + coarse.step) {
    sum += std::pow(at(a, time) - at(b, time), 2);
    low = std::min(low, at(a, time));
    high = std::max(high, at(a, time));
  }
  return std::sqrt(sum / count) / (high - low);
}

/// Returns the mean iterations of steps with the centre of mass in the lowest and in the highest quarter of its range.
std::pair<double, double> iterations_low_and_high(const Measured& m) {
  const auto [low, high] = std::minmax_element(m.height.begin(), m.height.end());
  const double range = *high - *low;
  std::pair<double, double> sums{}, counts{};
  for (std::size_t i = 0; i < m.height.size(); ++i) {
    if (m.height[i] < *low + range / 4) sums.first += m.iterations[i], ++counts.first;
    if (m.height[i] > *high - range / 4) sums.second += m.iterations[i], ++counts.second;
  }
  return {sums.first / counts.first, sums.second / counts.second};
}

/// Measurements by table, method and tolerance.
class Results {
 public:
  Results(const std::vector<HomeworkRow>& rows, const std::vector<Measured>& tables) : rows_(rows), tables_(tables) {}
  const Measured& operator()(int table, const std::string& method, const std::string& tolerance = "") const {
    return tables_[find_row(rows_, table, method, tolerance)];
  }

 private:
  const std::vector<HomeworkRow>& rows_;
  const std::vector<Measured>& tables_;
};

Conclusion implicit_looks_right(const Results& of) {
  const double pairs = of(3, "implicit", "1").flipped_pairs;
  return {"Implicit Euler looks right even at ε = 1.", pairs < visible_pairs,
          fmt::format("Flipped pairs of triangles per frame: {} at ε = 1, {} at ε = 1e-5.", per_frame(pairs),
                      per_frame(of(3, "implicit", "1e-5").flipped_pairs))};
}

Conclusion liu13_flips(const Results& of) {
  const double one = of(3, "liu13", "1").flipped_pairs, tenth = of(3, "liu13", "1e-1").flipped_pairs,
               tight = of(3, "liu13", "1e-4").flipped_pairs;
  return {"Liu13 flips triangles over at ε = 1 or 0.1.",
          one > visible_pairs && tenth > visible_pairs && tight < visible_pairs,
          fmt::format("Pairs per frame: {} at ε = 1, {} at 0.1, {} at 1e-2, {} at 1e-3, {} at 1e-4.", per_frame(one),
                      per_frame(tenth), per_frame(of(3, "liu13", "1e-2").flipped_pairs),
                      per_frame(of(3, "liu13", "1e-3").flipped_pairs), per_frame(tight))};
}

Conclusion liu13_slows_down(const Results& of) {
  const double one = of(3, "liu13", "1").mean_iterations(), hundredth = of(3, "liu13", "1e-2").mean_iterations(),
               thousandth = of(3, "liu13", "1e-3").mean_iterations(), next = of(3, "liu13", "1e-4").mean_iterations();
  const double newton = of(3, "implicit", "1e-4").mean_iterations() - of(3, "implicit", "1e-3").mean_iterations();
  return {"Liu13 converges quickly at first, then slowly.", hundredth - one < 1 && next - thousandth > 10 * newton,
          fmt::format("From ε = 1 to 1e-2 it needs {:.2f} more iterations, from 1e-3 to 1e-4 {:.1f} more; Newton's "
                      "method needs {:.2f} more there.",
                      hundredth - one, next - thousandth, newton)};
}

Conclusion sphere_slows_down(const Results& of, const Measured& semi_without) {
  const Measured &newton = of(2, "implicit"), &liu13 = of(2, "liu13"), &semi = of(2, "semi-implicit");
  const auto steps = static_cast<std::size_t>(newton.what.steps);
  const double newton_before = of(3, "implicit", "1e-3").mean_iterations(0, steps);
  const double liu13_before = of(3, "liu13", "1e-3").mean_iterations();
  const double before = semi_without.time().median, with = semi.time().median;
  return {
      "The sphere makes every method slower.",
      newton.mean_iterations() > newton_before && liu13.mean_iterations() > liu13_before && with > before,
      fmt::format("Iterations: implicit {:.2f} → {:.2f} over the first {} steps, liu13 {:.2f} → {:.2f}. Semi-implicit: "
                  "{:.2f} µs → {:.2f} µs per step.",
                  newton_before, newton.mean_iterations(), steps, liu13_before, liu13.mean_iterations(), before, with)};
}

Conclusion newton_at_the_lowest_point(const Results& of) {
  const auto [soft_low, soft_high] = iterations_low_and_high(of(1, "implicit"));
  const auto [low, high] = iterations_low_and_high(of(3, "implicit", "1e-3"));
  return {"Newton's method needs more iterations when the cloth swings through its lowest point.",
          soft_low > soft_high && low > high,
          fmt::format("With the centre of mass in the lowest and in the highest quarter of its range: {:.2f} and "
                      "{:.2f} iterations per step at k = 18, {:.2f} and {:.2f} at k = 180.",
                      soft_low, soft_high, low, high)};
}

Conclusion implicit_looks_like_semi_implicit(const Results& of, const Measured& undamped) {
  constexpr double seconds = 2;
  const double distance = relative_distance(undamped, of(1, "implicit"), seconds);
  return {
      "The implicit motion looks like the semi-implicit one.", distance < 0.1,
      fmt::format("Without damping and with k = 18, the heights of the two centres of mass differ by {:.1f}% (RMS) of "
                  "their range over the first {:g} s.",
                  100 * distance, seconds)};
}

Conclusion damping_at_any_step(const Results& of, const Measured& half) {
  constexpr double seconds = 8;
  const double distance = relative_distance(of(1, "semi-implicit"), half, seconds);
  return {
      "Damping looks the same at any time step.", distance < 0.02,
      fmt::format("Semi-implicit with h = 0.001 s and 0.0005 s, damped by 0.2: the heights of the two centres of mass "
                  "differ by {:.3f}% (RMS) of their range over {:g} s.",
                  100 * distance, seconds)};
}

}  // namespace

std::size_t find_row(const std::vector<HomeworkRow>& rows, int table, const std::string& method,
                     const std::string& tolerance) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HomeworkRow& r = rows[i];
    if (r.table == table && r.method == method && (tolerance.empty() || r.tolerance == tolerance)) return i;
  }
  throw std::out_of_range("no such row in the homework's tables");
}

std::vector<Conclusion> judge_conclusions(const std::vector<HomeworkRow>& rows, const std::vector<Measured>& tables,
                                          const std::vector<Measured>& extras) {
  const Results of(rows, tables);
  const auto extra = [&](Extra which) -> const Measured& { return extras.at(static_cast<std::size_t>(which)); };
  return {implicit_looks_right(of),
          liu13_flips(of),
          liu13_slows_down(of),
          sphere_slows_down(of, extra(Extra::no_sphere)),
          newton_at_the_lowest_point(of),
          implicit_looks_like_semi_implicit(of, extra(Extra::undamped)),
          damping_at_any_step(of, extra(Extra::half_step))};
}

std::vector<std::string> homework_differences() {
  return {
      // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): there is one after each sentence
      "drape also holds pins in Liu13's first local step, where the report's code lets them move. With pins held "
      "throughout, the report's code takes 2, 2, 2.295, 9.307, 52.12 and 99.64 iterations in table 3 and 7.240 in "
      "table 1.",
      "A step that ends at the limit of 100 iterations counts as 100; the report counts 101. The report's table 1 "
      "gives Liu13 one iteration too few.",
      "Newton's method evaluates all terms of its first iteration at its starting point y. The report's code evaluates "
      "the elastic ones at the last positions, and needs more iterations. Compressed springs keep the stiffness k x̂x̂ᵀ, "
      "as in the course's notes; the report's code scales it by L/‖x‖.",
      "With the sphere the implicit method's count is sensitive: the report prints 7.07, but its own code (the "
      "column \"its code again\") gives 8.59 when run again.",
      "The report's times are from its author's machine; drape's are CPU times of one thread on the machine below."};
}

StudyReport homework_report(const HomeworkStudy& study) {
  const auto confirmed = std::count_if(study.conclusions.begin(), study.conclusions.end(),
                                       [](const Conclusion& c) { return c.confirmed; });
  StudyReport report;
  report.kind = report.command = "drape study homework";
  report.title = "The homework's results, measured again";
  report.headline = fmt::format("{} of the report's {} conclusions are confirmed", confirmed, study.conclusions.size());
  report.introduction =
      "drape grew out of a course's homework: mass-spring cloth of 20×20 cells, 8.34 s of motion, by two implicit "
      "methods and an explicit one. In tables, \"report\" is what the report on that homework printed, \"its code "
      "again\" what its program gives when it is compiled and run today, and \"drape\" what was measured just now. In "
      "diagrams, the report's figures are dashed, in the colour of their method.";
  for (const Conclusion& c : study.conclusions) {
    report.findings.push_back({c.confirmed ? html::Tone::good : html::Tone::bad,
                               c.confirmed ? "confirmed" : "Not confirmed.", c.claim, c.figures});
  }
  report.sections = {
      {"Tables", {}, study.tables, {}, {}},
      {.title = "Motions", .text = {}, .tables = {}, .charts = {}, .pictures = {}, .motions = study.motions},
      {"Diagrams", {}, {}, study.charts, {}},
      {"Where drape differs on purpose", study.differences, {}, {}, {}},
      {"How it was measured", {describe_measuring(study.runs)}, {}, {}, {}}};
  report.data = {study.energies};
  report.seconds = study.seconds;
  return report;
}

}  // namespace drape

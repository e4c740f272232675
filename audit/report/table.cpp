#include "audit/report/table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/text.hpp"

namespace drape {
namespace {

using audit::Check;
using audit::CheckFindings;

constexpr std::array all_checks{Check::crossings, Check::ways, Check::inside, Check::stretch, Check::stuck};

std::string limit_of(Check check, const audit::AuditLimits& limits) {
  switch (check) {
    case Check::inside:
      return readable_length(limits.depth);
    case Check::stretch:
      return std::isinf(limits.stretch) ? "none" : fmt::format("{:.4g}", limits.stretch);
    case Check::crossings:
    case Check::ways:
    case Check::stuck:
      break;
  }
  return "–";
}

/// Returns the worst value of a check in a state: "2 pairs", "1.2", "3 mm".
std::string most_of(Check check, const CheckFindings& found) {
  const std::size_t count = found.states > 0 ? found.worst.count : 0;
  switch (check) {
    case Check::inside:
      return readable_length(found.largest);
    case Check::stretch:
      return fmt::format("{:.4g}", found.largest);
    case Check::crossings:
    case Check::ways:
      return fmt::format("{} pair{}", count, count == 1 ? "" : "s");
    case Check::stuck:
      break;
  }
  return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

}  // namespace

std::string check_name(Check check) {
  switch (check) {
    case Check::crossings:
      return "triangles that cross";
    case Check::ways:
      return "crossings between states";
    case Check::inside:
      return "depth in solids";
    case Check::stretch:
      return "stretch of edges";
    case Check::stuck:
      return "vertices stuck in mid-air";
  }
  return {};
}

std::string describe_worst(Check check, const CheckFindings& found) {
  return fmt::format("at {:.4g} s (step {}): {}; {}", found.worst.time, found.worst.step,
                     check == Check::stretch  ? fmt::format("{} edges", found.worst.count)
                     : check == Check::inside ? fmt::format("{} vertices", found.worst.count)
                                              : most_of(check, found),
                     found.worst.text);
}

ResultTable audit_table(const AuditReport& report) {
  ResultTable table{
      .name = "audit",
      .title = fmt::format("Audit of {}: {} states, {:.4g} s", report.file, report.findings.states(), report.duration),
      .columns = {"check", "limit", "states found in", "first", "most"},
      .rows = {},
      .notes = {}};
  for (const Check check : all_checks) {
    const CheckFindings& found = report.findings.findings(check);
    table.rows.push_back({check_name(check), limit_of(check, report.limits), fmt::format("{}", found.states),
                          found.states > 0 ? fmt::format("{:.4g} s", found.first_time) : "–", most_of(check, found)});
    if (found.states > 0) table.notes.push_back(fmt::format("{}, {}", check_name(check), describe_worst(check, found)));
  }
  const EnergyAudit& energy = report.energy;
  const bool judged = energy.not_judged.empty();
  table.rows.push_back({"rise of energy", judged ? fmt::format("{:g} %", 100 * EnergyAudit::most) : "–",
                        judged ? (energy.found() ? "found" : "0") : "not judged",
                        energy.found() ? fmt::format("{:.4g} s", energy.from) : "–",
                        judged ? fmt::format("{:.2g} %", 100 * energy.of_available) : "–"});
  if (energy.found()) {
    table.notes.push_back(fmt::format("rise of energy: {:.3g} J from {:.4g} s to {:.4g} s, with nothing that gives any",
                                      energy.rise, energy.from, energy.to));
  }
  if (!judged) table.notes.push_back(fmt::format("rise of energy: not judged, because {}", energy.not_judged));
  const std::size_t touches = report.findings.findings(Check::ways).touches;
  if (touches > 0) {
    table.notes.push_back(
        fmt::format("crossings between states: {} pairs only touch, which counts as no crossing", touches));
  }
  if (report.gaps) {
    table.notes.emplace_back(
        "crossings between states: the states are more than a step apart, so the straight ways between them are not "
        "those of the steps");
  }
  return table;
}

std::string audit_summary(const AuditReport& report) {
  if (report.clean()) return fmt::format("{}: nothing found in {} states", report.file, report.findings.states());
  std::string text;
  for (const Check check : all_checks) {
    if (report.findings.findings(check).states == 0) continue;
    text += (text.empty() ? "" : ", ") + check_name(check);
  }
  if (report.energy.found()) text += std::string(text.empty() ? "" : ", ") + "rise of energy";
  return fmt::format("{}: found {}", report.file, text);
}

}  // namespace drape

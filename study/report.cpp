#include "study/report.hpp"

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/text.hpp"
#include "reports/latex.hpp"
#include "reports/page.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

html::Markup to_html(const StudyFinding& finding) {
  std::string claim = finding.claim;
  // The page's sign marks good findings only; a bad verdict needs the word.
  if (finding.tone == html::Tone::bad && !finding.verdict.empty()) claim += " " + finding.verdict;
  return html::element("strong", claim) + " " + finding.figures;
}

/// Returns players for motions, which open one at a time. Omits those too large for a browser.
html::Markup to_html(const std::vector<StudyMotion>& motions, const std::string& id) {
  html::Markup content;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const StudyMotion& motion = motions[i];
    if (motion.played.frames == 0) continue;
    html::Markup player = html::motion_player(fmt::format("{}-motion-{}", id, i + 1), motion.played, motion.label) +
                          html::note(describe(motion.played));
    if (!motion.command.empty()) player += html::command("Make a page of this motion", motion.command);
    content += html::details("Turn the cloth: " + motion.label, player);
  }
  return content;
}

/// @param is_answer true for the answer section, which begins with its tables
html::Markup to_html(const StudySection& section, const std::string& id, bool is_answer = false) {
  html::Markup content, tables;
  for (const ResultTable& table : section.tables) tables += to_html(table);
  if (is_answer) content += tables;
  for (const std::string& paragraph : section.text) content += html::paragraph(paragraph);
  for (std::size_t i = 0; i < section.pictures.size(); ++i) {
    const StudyPicture& picture = section.pictures[i];
    content += html::figure(html::animation(picture.bytes, picture.stills, picture.caption), picture.caption) +
               html::command("Reproduce this animation", picture.command) +
               to_html(picture.motions, fmt::format("{}-animation-{}", id, i + 1));
  }
  content += to_html(section.motions, id);
  if (!section.charts.empty()) {
    content += html::element("p", {{"class", "note on-screen"}},
                             "Point at a curve, or move along it with the arrow keys, to see its values and the "
                             "command that reproduces them.");
  }
  for (const NamedChart& chart : section.charts) content += html::chart(chart.chart);
  if (!section.maps.empty()) {
    std::vector<html::Markup> drawings;
    for (const StabilityMap& map : section.maps) drawings.push_back(map_figure(map));
    content += map_legend() + html::row(drawings);
  }
  if (!is_answer) content += tables;
  return html::section(2, id, section.title, content);
}

std::string to_markdown(const StudySection& section) {
  const auto image = [](const std::string& words, const std::string& file) {
    return fmt::format("![{}]({})\n\n", markdown(words), link_to_file(file));
  };
  std::string text = fmt::format("\n## {}\n\n", markdown(section.title));
  for (const std::string& paragraph : section.text) text += markdown(paragraph) + "\n\n";
  for (const StudyPicture& picture : section.pictures) {
    text += image(picture.caption, picture.file) + fmt::format("    {}\n\n", shown(picture.command));
  }
  for (const NamedChart& chart : section.charts) text += image(chart.chart.title, chart.name + ".svg");
  for (const StabilityMap& map : section.maps) text += image(map_title(map), map_name(map) + ".svg");
  for (const ResultTable& table : section.tables) text += to_markdown(table) + "\n";
  return text;
}

/// Returns all sections in reading order.
std::vector<StudySection> all_sections(const StudyReport& report) {
  std::vector<StudySection> sections = report.sections;
  if (report.answer) sections.insert(sections.begin(), *report.answer);
  return sections;
}

/// Cuts a text to a width; a cut text ends with "…".
std::string cut(std::string text, std::size_t width) {
  if (columns_of(text) <= width) return text;
  while (columns_of(text) >= width) {
    std::size_t end = text.size() - 1;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // a UTF-8 character
    text.resize(end);
  }
  return text + "…";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> study_provenance() {
  std::vector<std::pair<std::string, std::string>> facts = html::provenance();
  facts.emplace_back("Instruction set", std::string(kernels().name));
  return facts;
}

std::string to_summary(const StudyReport& report, std::size_t width) {
  constexpr std::size_t most_lines = 5;
  std::vector<std::string> lines{report.headline};
  for (const StudyFinding& f : report.findings) {
    lines.push_back(fmt::format("  {}{}{} {}", f.verdict, f.verdict.empty() ? "" : ": ", f.claim, f.figures));
  }
  for (const StudySection& section : report.sections) {
    for (const std::string& paragraph : section.text) {
      if (lines.size() < most_lines) lines.push_back("  " + paragraph);
    }
  }
  if (lines.size() > most_lines) {
    const std::size_t more = lines.size() - most_lines + 1;
    lines.resize(most_lines - 1);
    lines.push_back(fmt::format("  and {} more findings", more));
  }
  std::string text;
  for (const std::string& line : lines) text += cut(line, width) + "\n";
  return text;
}

std::string to_text(const StudyReport& report, std::size_t width) {
  std::string text;
  const auto add_tables = [&](const StudySection& section) {
    for (const ResultTable& table : section.tables) text += to_text(table, width) + "\n";
  };
  for (const StudySection& section : report.sections) add_tables(section);
  if (report.answer) add_tables(*report.answer);  // the end stays visible in a terminal
  text += wrapped(report.headline, width) + "\n";
  for (const StudyFinding& f : report.findings) {
    text += wrapped(fmt::format("  {}{}{}\n", f.verdict, f.verdict.empty() ? "" : ": ", f.claim), width, 2);
    if (!f.figures.empty()) text += wrapped(fmt::format("      {}\n", f.figures), width);
  }
  for (const StudySection& section : report.sections) {
    if (section.text.empty()) continue;
    text += fmt::format("\n{}\n", section.title);
    for (const std::string& paragraph : section.text) text += wrapped(fmt::format("  {}\n", paragraph), width);
  }
  return text;
}

std::string to_markdown(const StudyReport& report) {
  std::string text = fmt::format("# {}\n\n{}.\n\n{}\n\n", markdown(report.title), markdown(report.headline),
                                 markdown(report.introduction));
  if (report.answer) text += to_markdown(*report.answer);
  for (const StudyFinding& f : report.findings) {
    text += fmt::format("- {}{} {}\n", f.verdict.empty() ? "" : "**" + markdown(f.verdict) + "** ", markdown(f.claim),
                        markdown(f.figures));
  }
  for (const StudySection& section : report.sections) text += to_markdown(section);
  return text + fmt::format("    {}\n", shown(report.command));
}

std::string to_page(const StudyReport& report) {
  std::vector<html::Finding> findings;
  for (const StudyFinding& finding : report.findings) findings.push_back({finding.tone, to_html(finding)});
  html::Page page;
  page.kind = report.kind;
  page.title = report.title;
  page.heading = report.headline;
  page.introduction = html::paragraph(report.introduction);
  if (report.answer) {
    page.content =
        to_html(*report.answer, "answer", true) + html::section(2, "findings", "Findings", html::findings(findings));
  } else {
    page.content = html::findings(findings);
  }
  page.content += html::command("Run this study again", report.command);
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    page.content += to_html(report.sections[i], fmt::format("section-{}", i + 1));
  }
  for (const auto& [name, value] : report.provenance.empty() ? study_provenance() : report.provenance) {
    page.foot.emplace_back(name, value);
  }
  page.foot.emplace_back("Duration", fmt::format("{:.0f} s", report.seconds));
  return html::render(page);
}

std::string write_report(const StudyReport& report, const std::filesystem::path& folder, FigureStyle style) {
  std::string problem;  // the first one
  const auto note = [&](const std::string& missing) {
    if (problem.empty()) problem = missing;
  };
  for (const ResultTable& table : report.data) write_table(table, folder);
  for (const StudySection& section : all_sections(report)) {
    for (const ResultTable& table : section.tables) write_table(table, folder);
    for (const NamedChart& chart : section.charts) note(write_chart(chart, folder, style));
    for (const StabilityMap& map : section.maps) {
      write_file_atomically(folder / (map_name(map) + ".csv"), map_csv(map));
      write_set_table(map_table(map), folder);
      note(write_diagram(map_diagram(map), folder, map_name(map), style));
    }
  }
  write_file_atomically(folder / "report.md", to_markdown(report));
  write_file_atomically(folder / report_page, to_page(report));
  return problem;
}

}  // namespace drape

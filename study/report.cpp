#include "study/report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>

#include "core/files.hpp"
#include "core/text.hpp"
#include "reports/latex.hpp"
#include "reports/listing.hpp"
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

html::Markup to_html(const std::vector<StudyFinding>& list) {
  std::vector<html::Finding> findings;
  for (const StudyFinding& finding : list) findings.push_back({finding.tone, to_html(finding)});
  return findings.empty() ? html::Markup() : html::findings(findings);
}

/// @param is_answer true for the answer section, which begins with its tables
/// @param before    content between heading and text
html::Markup to_html(const StudySection& section, const std::string& id, bool is_answer = false,
                     const html::Markup& before = {}) {
  html::Markup content = before, tables;
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

/// Returns the answer with the table of the list, if any, as its first table.
std::optional<StudySection> whole_answer(const StudyReport& report) {
  std::optional<StudySection> answer = report.answer;
  if (answer && report.list) answer->tables.insert(answer->tables.begin(), report.list->table);
  return answer;
}

/// Returns all sections in reading order.
std::vector<StudySection> all_sections(const StudyReport& report) {
  std::vector<StudySection> sections = report.sections;
  if (const auto answer = whole_answer(report)) sections.insert(sections.begin(), *answer);
  return sections;
}

bool is_listed(const StudySection& section) { return !section.group.empty(); }

std::string anchor(std::size_t section) { return fmt::format("section-{}", section + 1); }

/// Returns the listed sections, which begin with their findings, under the list's table.
html::Markup list_page(const StudyReport& report) {
  html::Listing listing{report.list->kind, page_table(report.list->table), {}};
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    const StudySection& section = report.sections[i];
    if (!is_listed(section)) continue;
    std::vector<StudyFinding> own;
    std::ranges::copy_if(report.findings, std::back_inserter(own),
                         [&](const StudyFinding& finding) { return finding.of == section.title; });
    html::Markup& name = listing.table.rows.at(listing.entries.size()).front();
    name = html::link("#" + anchor(i), name);
    listing.entries.push_back({anchor(i), section.group, to_html(section, anchor(i), false, to_html(own))});
  }
  html::Markup page = html::listing(listing);
  for (const std::string& note : report.list->table.notes) page += html::note(note);
  return page;
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
  if (const auto answer = whole_answer(report)) add_tables(*answer);  // the end stays visible in a terminal
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
  if (const auto answer = whole_answer(report)) text += to_markdown(*answer);
  for (const StudyFinding& f : report.findings) {
    text += fmt::format("- {}{} {}\n", f.verdict.empty() ? "" : "**" + markdown(f.verdict) + "** ", markdown(f.claim),
                        markdown(f.figures));
  }
  for (const StudySection& section : report.sections) text += to_markdown(section);
  return text + fmt::format("    {}\n", shown(report.command));
}

namespace {

/// Returns the page's content if it shows all sections below each other.
html::Markup plain_content(const StudyReport& report) {
  html::Markup content;
  if (const auto answer = whole_answer(report)) {
    content = to_html(*answer, "answer", true) + html::section(2, "findings", "Findings", to_html(report.findings));
  } else {
    content = to_html(report.findings);
  }
  content += html::command("Run this study again", report.command);
  for (std::size_t i = 0; i < report.sections.size(); ++i) content += to_html(report.sections[i], anchor(i));
  return content;
}

/// Returns the page's content if its listed sections open one at a time. Above the list are only findings that are bad,
/// or about the whole study; a section has its own.
html::Markup listed_content(const StudyReport& report) {
  std::vector<StudyFinding> first;
  std::ranges::copy_if(report.findings, std::back_inserter(first), [](const StudyFinding& finding) {
    return finding.of.empty() || finding.tone == html::Tone::bad;
  });
  html::Markup content = to_html(first) + html::command("Run this study again", report.command) + list_page(report);
  if (report.answer) content += to_html(*report.answer, "answer", true);
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    if (!is_listed(report.sections[i])) content += to_html(report.sections[i], anchor(i));
  }
  return content;
}

}  // namespace

std::string to_page(const StudyReport& report) {
  html::Page page;
  page.kind = report.kind;
  page.title = report.title;
  page.heading = report.headline;
  page.introduction = html::paragraph(report.introduction);
  const bool listed = report.list && report.list->table.rows.size() >= html::many_entries;
  page.content = listed ? listed_content(report) : plain_content(report);
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

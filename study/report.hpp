#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "reports/components.hpp"
#include "reports/diagram_files.hpp"
#include "reports/result_table.hpp"
#include "study/motions.hpp"
#include "study/stability_map.hpp"

namespace drape {

/// A finding of a study.
struct StudyFinding {
  html::Tone tone = html::Tone::neutral;
  std::string verdict;  ///< one word, if any: "confirmed"
  std::string claim;
  std::string figures;
  std::string of = {};  ///< title of the section that it is about; empty: it is about the whole study
};

/// An animation of a study.
struct StudyPicture {
  std::string file;                       ///< file name in the results folder
  std::string bytes;                      ///< bytes of the GIF
  std::string caption;                    ///< also serves as the text alternative
  std::string command;                    ///< command to reproduce it
  std::string stills = {};                ///< frames side by side for print: bytes of a PNG
  std::vector<StudyMotion> motions = {};  ///< some of the motions shown, for interactive viewing
};

struct StudySection {
  std::string title;
  std::vector<std::string> text;  ///< one paragraph each
  std::vector<ResultTable> tables;
  std::vector<NamedChart> charts;
  std::vector<StudyPicture> pictures;
  std::vector<StabilityMap> maps = {};
  std::vector<StudyMotion> motions = {};  ///< motions for interactive viewing
  std::string group = {};                 ///< filter that shows it in the report's list; empty: it is not listed
};

/// List of the sections with a group, one per case or scene. With many of them a page opens one at a time.
struct StudyList {
  std::string kind;   ///< plural noun of their subjects: "cases"
  ResultTable table;  ///< a row per listed section, whose first cell is its name
};

/// The report of a study in reading order, findings first.
struct StudyReport {
  std::string kind;      ///< "drape study homework"
  std::string title;     ///< title of the page's window
  std::string headline;  ///< the finding in one sentence
  std::string introduction;
  std::string command;                 ///< command to reproduce it
  std::optional<StudySection> answer;  ///< the result for users, before the evidence
  std::vector<StudyFinding> findings;
  std::vector<StudySection> sections;
  std::optional<StudyList> list = {};
  std::vector<ResultTable> data;                                     ///< tables written as CSV only
  double seconds = 0;                                                ///< duration of the study
  std::vector<std::pair<std::string, std::string>> provenance = {};  ///< empty: study_provenance()
};

/// Returns names and values that describe the running program and its machine.
std::vector<std::pair<std::string, std::string>> study_provenance();

/// Returns up to five lines: the headline and the first findings, then the first paragraphs.
/// @param width of a line; longer lines are cut and end with "…"
std::string to_summary(const StudyReport& report, std::size_t width = unlimited_width);
/// Returns the report for a terminal of this width: tables first, findings last.
std::string to_text(const StudyReport& report, std::size_t width = unlimited_width);
std::string to_markdown(const StudyReport& report);
/// Returns a self-contained HTML page.
std::string to_page(const StudyReport& report);

/// File name of the page.
inline constexpr const char* report_page = "report.html";

/// Writes a report into a folder: the page, report.md, every table as CSV, Markdown and LaTeX, every diagram as SVG,
/// PDF and PNG. The points of a diagram are written like a table. Animations are already there.
/// @returns the first problem as a sentence; empty if everything was written
/// @throws OutputError
std::string write_report(const StudyReport& report, const std::filesystem::path& folder,
                         FigureStyle style = FigureStyle::screen);

}  // namespace drape

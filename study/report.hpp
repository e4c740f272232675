#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/wrap.hpp"
#include "figures/diagram_files.hpp"
#include "figures/result_table.hpp"
#include "html/components.hpp"
#include "study/stability_map.hpp"
#include "study/study_motion.hpp"

namespace drape {

/// Something that came out of a study.
struct StudyFinding {
  html::Tone tone = html::Tone::neutral;
  std::string verdict;  ///< in a word, where there is one: "confirmed"
  std::string claim;
  std::string figures;
};

/// An animation that a study has made.
struct StudyPicture {
  std::string file;                       ///< its name in the folder of the results
  std::string bytes;                      ///< of the GIF
  std::string caption;                    ///< also for who cannot see it
  std::string command;                    ///< that makes it again
  std::string stills = {};                ///< some of its moments side by side, for paper: bytes of a PNG
  std::vector<StudyMotion> motions = {};  ///< some that it shows, to turn
};

struct StudySection {
  std::string title;
  std::vector<std::string> text;  ///< a paragraph each
  std::vector<ResultTable> tables;
  std::vector<NamedChart> charts;
  std::vector<StudyPicture> pictures;
  std::vector<StabilityMap> maps = {};
  std::vector<StudyMotion> motions = {};  ///< to turn
};

/// What every study hands out: read from top to bottom, findings first.
struct StudyReport {
  std::string kind;      ///< "drape study homework"
  std::string title;     ///< of the page's window
  std::string headline;  ///< the finding in one sentence
  std::string introduction;
  std::string command;                 ///< that makes it again
  std::optional<StudySection> answer;  ///< what a reader has come for, before what speaks for it
  std::vector<StudyFinding> findings;
  std::vector<StudySection> sections;
  std::vector<ResultTable> data;                                     ///< tables that are written as CSV and not shown
  double seconds = 0;                                                ///< that it took
  std::vector<std::pair<std::string, std::string>> provenance = {};  ///< empty: study_provenance()
};

/// What a study that runs now is made by and measured on: names and values.
std::vector<std::pair<std::string, std::string>> study_provenance();

/// In five lines: the headline and the first findings, then the first paragraphs.
/// @param width of a line; what does not fit is cut, and ends with "…"
std::string to_summary(const StudyReport& report, std::size_t width = unlimited_width);
/// For a terminal of this width: the tables, and at the end what came out.
std::string to_text(const StudyReport& report, std::size_t width = unlimited_width);
std::string to_markdown(const StudyReport& report);
/// A self-contained page.
std::string to_page(const StudyReport& report);

/// The name of the page's file.
inline constexpr const char* report_page = "report.html";

/// Writes all of it into a folder: the page, report.md, every table as CSV, Markdown and LaTeX, and every diagram as
/// SVG, PDF and PNG and, with its points, like a table. Animations have been written where they were made.
/// @returns what could not be done, as a sentence; empty if all is there
/// @throws OutputError
std::string write_report(const StudyReport& report, const std::filesystem::path& folder);

}  // namespace drape

#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "check/archive.hpp"
#include "cli/command_line.hpp"

namespace drape {

/// Files of a check's report. No scene folder beside them may have such a name.
inline constexpr std::array<const char*, 3> check_report_files{"report.html", "report.json", "junit.xml"};

/// Printer of results that records write errors.
class ResultPrinter {
 public:
  /// Prints a line. @param line escaped, see escape_controls()
  void print(const std::string& line);

  /// Returns the first write error; empty without errors.
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// Prints the result of a scene's check.
void tell(const SceneResult& result, const CommonOptions& common, ResultPrinter& verdicts);

/// Returns for example "drape accept out/check".
std::string accept_command(const std::filesystem::path& report);

/// Writes the report of a check, or of one shard, and the summary for GitHub Actions.
/// @returns the highest code of all scenes; interrupted if scenes are missing
ExitCode conclude_check(const CheckShard& shard, const std::filesystem::path& folder, const CommonOptions& common,
                        ResultPrinter& verdicts);

}  // namespace drape

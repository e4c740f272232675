#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "check/archive.hpp"
#include "cli/command_line.hpp"

namespace drape {

/// The files of a check's report, which no scene's folder beside them may be called.
inline constexpr std::array<const char*, 3> check_report_files{"report.html", "report.json", "junit.xml"};

/// Prints the verdicts, and remembers if one could not be printed.
class Verdicts {
 public:
  /// @param line escaped, see escape_controls()
  void print(const std::string& line);

  /// Why not all of them could be printed; empty: they could.
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// Says what came of a scene's check.
void tell(const SceneResult& result, const CommonOptions& common, Verdicts& verdicts);

/// "drape accept out/check"
std::string accept_command(const std::filesystem::path& report);

/// Writes the report of a check, or of a shard of one, and the summary for GitHub where that runs it.
/// @returns the exit code of the scene that is worst off; interrupted where scenes that should be there are not
ExitCode conclude_check(const CheckShard& shard, const std::filesystem::path& folder, const CommonOptions& common,
                        Verdicts& verdicts);

}  // namespace drape

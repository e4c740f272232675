#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/reference.hpp"

namespace drape {

/// A motion on a study's page, with the part of the page that shows it: a picture's file, or a case.
struct ShownMotion {
  std::string part;
  StudyMotion motion;
};

/// Name of the file with the motions of a study's page, beside its runs.
inline constexpr const char* motions_name = "motions.csv";

/// Returns the motions as RunsWriter writes them, their numbers in base64.
std::string motions_csv(const std::vector<ShownMotion>& motions);

/// Reads the motions of a study, so that its page can be made again. A study without the file has none.
/// @throws UsageError "file:line: message" if the file is damaged
std::vector<ShownMotion> read_motions(const std::filesystem::path& file);

}  // namespace drape

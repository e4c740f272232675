#include "check/candidate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "check/golden.hpp"
#include "check/golden_motion.hpp"
#include "check/manifest.hpp"
#include "check/picture.hpp"
#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "scene/motion_scene.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_description = 1 << 20;  // [bytes]
constexpr std::uintmax_t most_report = 1 << 28;       // [bytes]

fs::path description_file(const fs::path& report, const std::string& name) { return report / name / "candidate.json"; }

std::string candidate_hash(const fs::path& folder) {
  return checksum_of(read_golden_file(folder / "manifest.json", UINTMAX_MAX));
}

/// Stores a path byte by byte if needed: file names may be other than the UTF-8 of JSON.
void describe_path(const fs::path& path, Json& json) {
  json["scene"] = printable(path.string());
  if (json["scene"] == path.string()) return;
  const std::string& bytes = path.native();
  json["scene_bytes"] = std::vector<std::uint8_t>(bytes.begin(), bytes.end());
}

/// @throws std::invalid_argument
fs::path described_path(const Json& json) {
  const std::string text = Fields(json, "").text("scene");
  if (!json.contains("scene_bytes")) return text;
  try {
    const auto bytes = json.at("scene_bytes").get<std::vector<std::uint8_t>>();
    return std::string(bytes.begin(), bytes.end());
  } catch (const Json::exception&) {
    throw std::invalid_argument("'scene_bytes': expected a list of bytes");
  }
}

/// @param hash as listed in the report
Candidate read_candidate(const fs::path& file, std::string hash) {
  try {
    const Json json = parse_json(read_file(file, most_description));
    const Fields fields(json, "");
    return {.folder = file.parent_path() / "candidate",
            .hash = std::move(hash),
            .name = file.parent_path().filename().string(),
            .scene_file = described_path(json),
            .scene_digest = fields.text("scene_hash"),
            .program = fields.text("program")};
  } catch (const std::invalid_argument& error) {
    throw UsageError(shown(file) + ": " + error.what() + "; check the scene again");
  }
}

/// Returns the candidates listed in report.json.
std::vector<Candidate> listed_candidates(const fs::path& report) {
  const fs::path file = report / "report.json";
  std::vector<Candidate> candidates;
  try {
    const Json json = parse_json(read_file(file, most_report));
    const std::vector<Fields> scenes = Fields(json, "").objects("scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      std::string hash = scenes[i].text("candidate");
      if (hash.empty()) continue;
      const std::string name = name_in_folder(scenes[i].text("name"), file, fmt::format("scenes[{}].name", i));
      candidates.push_back(read_candidate(description_file(report, name), std::move(hash)));
    }
  } catch (const std::invalid_argument& error) {
    throw UsageError(shown(file) + ": " + error.what() + "; check the scenes again");
  }
  return candidates;
}

/// A golden with its unmodified pictures.
struct Whole {
  Golden golden;
  std::vector<Png> pictures;
};

Whole read_whole(const fs::path& folder) {
  Whole whole{read_golden(folder), {}};
  for (const GoldenFrame& frame : whole.golden.frames) {
    const fs::path file = golden_picture(folder, frame.frame);
    whole.pictures.push_back(read_golden_file(file, most_png_bytes(whole.golden.size)));
    try {
      if (pixel_hash(decode_png(whole.pictures.back(), whole.golden.size)) == frame.pixels) continue;
    } catch (const std::invalid_argument&) {
      // reported below
    }
    fail_to_read(file, "has been modified since it was recorded");
  }
  return whole;
}

[[noreturn]] void refuse(const Candidate& candidate, const std::string& why) {
  throw UsageError(fmt::format("{}: cannot be accepted: {}", shown(candidate.scene_file), why));
}

/// Returns the golden after accepting a candidate, or only some of its pictures.
Whole accepted(const Candidate& candidate, const std::vector<int>& frames) {
  if (candidate.scene_digest != no_scene_digest && digest_of_file(candidate.scene_file) != candidate.scene_digest) {
    refuse(candidate, "the scene has changed since the check; check it again");
  }
  if (program_hash() != candidate.program)
    refuse(candidate, "it was checked by a different build of drape; check it again");
  if (candidate_hash(candidate.folder) != candidate.hash)
    refuse(candidate, "another check has left this since the report was written; check it again");
  Whole whole = read_whole(candidate.folder);
  if (frames.empty()) return whole;

  Whole there = read_whole(golden_folder(candidate.scene_file));
  Golden alike = whole.golden;
  alike.group_count = there.golden.group_count;
  if (whole.golden.size != there.golden.size || pack_motion(alike) != pack_motion(there.golden)) {
    refuse(candidate,
           "the motion or the size of the pictures has changed, so single pictures would not match; accept everything, "
           "without --frames");
  }
  for (const int frame : frames) {
    const auto& all = there.golden.frames;
    const auto found = std::find_if(all.begin(), all.end(), [&](const GoldenFrame& f) { return f.frame == frame; });
    if (found == all.end()) refuse(candidate, fmt::format("--frames: its golden has no frame {}", frame));
    const auto index = static_cast<std::size_t>(found - all.begin());
    there.pictures[index] = whole.pictures[index];
  }
  return there;
}

}  // namespace

std::string write_candidate(const fs::path& report, const std::string& name, const LoadedScene& scene,
                            const Golden& golden, const std::vector<Png>& pictures) {
  write_golden(report / name / "candidate", golden, pictures);
  Json json{{"scene_hash", scene.source.digest}, {"program", program_hash()}};
  describe_path(scene.source.file, json);
  write_file_atomically(description_file(report, name),
                        json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return candidate_hash(report / name / "candidate");
}

void require_own_candidate(const fs::path& report, const std::string& name) {
  require_inside(report / name, report);
  require_links_inside(report / name);
  require_only_golden(report / name / "candidate");
  const fs::path file = description_file(report, name);
  std::error_code ignored;
  const fs::file_type type = fs::symlink_status(file, ignored).type();
  if (type == fs::file_type::not_found) return;
  if (type == fs::file_type::regular && read_file(file, most_description).find("\"scene_hash\"") != std::string::npos) {
    return;
  }
  throw UsageError(fmt::format("{}: drape has not written it and will not replace it: move it away", shown(file)));
}

void remove_candidate(const fs::path& report, const std::string& name) {
  require_own_candidate(report, name);
  std::error_code ignored;
  fs::remove(description_file(report, name), ignored);
  remove_golden(report / name / "candidate");
}

std::vector<Candidate> find_candidates(const fs::path& report, const std::vector<std::string>& wanted) {
  require_links_inside(report);
  std::vector<Candidate> all = listed_candidates(report);
  if (all.empty()) {
    throw UsageError(
        fmt::format("{}: there is nothing to accept: this check found no scene changed, or ran with --set, "
                    "whose results cannot be accepted: edit the scene and check it again",
                    shown(report)));
  }
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.name < b.name; });
  if (wanted.empty()) return all;

  std::vector<Candidate> chosen;
  std::vector<std::string> names;
  for (const Candidate& candidate : all) names.push_back(candidate.name);
  for (const std::string& name : wanted) {
    const fs::path normal = fs::path(name).lexically_normal();  // "./-a" is a way to give the name "-a"
    const auto found = std::find_if(all.begin(), all.end(), [&](const Candidate& candidate) {
      return normal == candidate.name || normal == candidate.scene_file.lexically_normal();
    });
    if (found == all.end()) {
      throw UsageError(fmt::format("{}: there is nothing to accept of '{}'{}", shown(report), shown(name),
                                   did_you_mean(name, names, "there is")));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

void require_acceptable(const Candidate& candidate, const std::vector<int>& frames) {
  has_golden(golden_folder(candidate.scene_file));  // throws if another file is in its place
  accepted(candidate, frames);
}

fs::path accept_candidate(const Candidate& candidate, const std::vector<int>& frames) {
  const Whole whole = accepted(candidate, frames);
  fs::path folder = golden_folder(candidate.scene_file);
  write_golden(folder, whole.golden, whole.pictures);
  return folder;
}

}  // namespace drape

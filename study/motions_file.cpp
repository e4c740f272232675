#include "study/motions_file.hpp"

#include <fmt/format.h>
#include <utility>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "study/runs_file.hpp"

namespace drape {
namespace {

constexpr const char* motion_kind = "motion";
constexpr std::size_t most_motion_bytes = std::size_t{1} << 28;

// The fields of a motion but its bytes, described once for both directions: a RunsWriter (with const data) or a
// RunsRecord.
template <class Fields, class Motion>
void describe_motion(Fields& f, Motion& motion) {
  f("label", motion.label);
  f("command", motion.command);
  f("description", motion.played.description);
  f("frames", motion.played.frames);
  f("precision", motion.played.precision);
  f("size", motion.played.size);
  f("vertices", motion.played.vertices);
  f("triangles", motion.played.triangles);
}

std::string bytes_in(RunsRecord& record, const char* quantity) {
  std::string text;
  record(quantity, text);
  std::optional<std::string> bytes = from_base64(text);
  if (!bytes) record.fail(record.line(), fmt::format("'{}' is no base64", quantity));
  return std::move(*bytes);
}

ShownMotion read_motion(RunsRecord& record) {
  if (record.key.kind != motion_kind) {
    record.fail(record.line(), fmt::format("expected the kind '{}', found '{}'", motion_kind, record.key.kind));
  }
  ShownMotion shown{record.key.scene, {}};
  html::PlayedMotion& played = shown.motion.played;
  describe_motion(record, shown.motion);
  played.data = bytes_in(record, "data");
  played.texture = bytes_in(record, "texture");
  record.done();
  if (played.frames < 1) record.fail(record.line(), fmt::format("expected frames, found {}", played.frames));
  return shown;
}

}  // namespace

std::string motions_csv(const std::vector<ShownMotion>& motions) {
  RunsWriter f;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const html::PlayedMotion& played = motions[i].motion.played;
    if (played.frames == 0) continue;
    f.begin({motions[i].part, motion_kind, {}, {}, std::to_string(i + 1)});
    describe_motion(f, motions[i].motion);
    f("data", base64(played.data));
    f("texture", base64(played.texture));
  }
  return f.finish();
}

std::vector<ShownMotion> read_motions(const std::filesystem::path& file) {
  std::vector<ShownMotion> motions;
  if (!std::filesystem::exists(file)) return motions;
  for (RunsRecord& record : parse_runs(read_text(file, most_motion_bytes), shown(file))) {
    motions.push_back(read_motion(record));
  }
  return motions;
}

}  // namespace drape

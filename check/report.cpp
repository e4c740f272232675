#include "check/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>
#include <algorithm>
#include <cmath>
#include <new>

#include "core/bytes.hpp"

namespace drape {

std::string pack_words(const Words& words) {
  const std::string planes = byte_planes(words);
  uLongf size = compressBound(planes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(planes.data()),
                planes.size(), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return std::to_string(planes.size()) + "\n" + packed;
}

Words unpack_words(std::string_view bytes, std::uint64_t most) {
  const std::size_t line = bytes.find('\n');
  std::size_t size = 0;
  for (const char c : bytes.substr(0, line)) {
    if (c < '0' || c > '9' || size > (std::size_t{1} << 40))
      throw std::invalid_argument("has a size that cannot be read");
    size = 10 * size + static_cast<std::size_t>(c - '0');
  }
  // The compression ratio of zlib is below 1100: reserve no more for a damaged file.
  if (line == std::string_view::npos || size % 8 != 0 || size / 1100 > bytes.size()) {
    throw std::invalid_argument("is truncated");
  }
  if (size / 8 > most) throw std::invalid_argument("holds more than its manifest allows");
  bytes.remove_prefix(line + 1);
  std::string planes(size, '\0');
  uLongf unpacked = size;
  uLong used = bytes.size();
  if (uncompress2(reinterpret_cast<Bytef*>(planes.data()), &unpacked, reinterpret_cast<const Bytef*>(bytes.data()),
                  &used) != Z_OK ||
      unpacked != size || used != bytes.size()) {
    throw std::invalid_argument("is damaged");
  }
  return from_byte_planes(planes);
}

double WordReader::number() { return finite(std::bit_cast<double>(bits())); }

double finite(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("contains a number that is not finite");
  return value;
}

bool CheckReport::passed() const {
  return std::ranges::all_of(scenes, [](const SceneResult& scene) { return scene.passed(); });
}

std::string describe_ignored(const SceneResult& scene) {
  std::vector<int> frames;
  for (const FrameResult& frame : scene.windows.frames) {
    if (!frame.judged) frames.push_back(frame.frame);
  }
  const std::string part = scene.ignored > 0 ? fmt::format("{:.3g} % of the picture", 100 * scene.ignored) : "";
  const std::string whole =
      frames.empty() ? "" : fmt::format("frame{} {}", frames.size() == 1 ? "" : "s", fmt::join(frames, ", "));
  if (part.empty() && whole.empty()) return {};
  const bool several = frames.size() > 1 || (!part.empty() && !whole.empty());
  return part + (part.empty() || whole.empty() ? "" : " and ") + whole + (several ? " are ignored" : " is ignored");
}

std::string picture_verdict(const SceneResult& scene, const Comparison& comparison) {
  const bool judged = scene.ignored < 1 && std::ranges::any_of(comparison.frames, &FrameResult::judged);
  const bool compared = !comparison.frames.empty() && comparison.picture != PictureVerdict::changed;
  return compared && !judged ? "not judged" : verdict_name(comparison.picture);
}

const char* verdict_name(MotionVerdict verdict) {
  switch (verdict) {
    case MotionVerdict::same_bits:
      return "same bits";
    case MotionVerdict::within_tolerance:
      return "within tolerance";
    case MotionVerdict::changed:
      return "changed";
  }
  return "";
}

const char* verdict_name(PictureVerdict verdict) {
  switch (verdict) {
    case PictureVerdict::exact:
      return "exact";
    case PictureVerdict::noise:
      return "noise";
    case PictureVerdict::changed:
      return "changed";
  }
  return "";
}

const char* verdict_name(SceneVerdict verdict) {
  switch (verdict) {
    case SceneVerdict::passed:
      return "passed";
    case SceneVerdict::changed:
      return "changed";
    case SceneVerdict::missing:
      return "missing";
    case SceneVerdict::updated:
      return "updated";
    case SceneVerdict::error:
      return "error";
  }
  return "";
}

std::filesystem::path frame_file(const SceneResult& scene, int frame, const std::string& kind) {
  return std::filesystem::path(scene.name) / fmt::format("frame_{:04}.{}.png", frame, kind);
}

}  // namespace drape

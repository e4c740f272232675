#include "output/video_check.hpp"

#include <fmt/format.h>

#include "codecs/codecs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {

int readable_frames(const PartialFile& file) { return codecs().readable_frames(file.temporary().string()); }

void require_frames(PartialFile& file, int count) {
  const int found = readable_frames(file);
  if (found == count) return;
  file.require_space();
  throw OutputError(
      fmt::format("cannot write {}: of {} frames, {} can be read back", shown(file.file()), count, found));
}

}  // namespace drape

// Motion files: as raw bytes, as assembled parts, and as edits of a valid one, because random changes of compressed
// bytes with checksums are rarely readable.

#include <cmath>

#include "motion/blocks.hpp"
#include "motion/reader.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"
#include "tests/fuzz/sealed_motion.hpp"

namespace {

void read(const drape::FuzzFolder& folder, std::string_view bytes) {
  drape::accepts_or_refuses([&] {
    drape::MotionReader motion(folder.put("read.drape", bytes));
    for (std::size_t k = 0; k < motion.header().files.size(); ++k) static_cast<void>(motion.scene_file(k));
    for (std::size_t i = 0; i < motion.states(); ++i) {
      const drape::State& state = motion.state(i);
      if (state.step != motion.step(i) || state.x.rows() != motion.header().vertices) std::abort();
      if (!state.x.allFinite() || !state.v.allFinite()) std::abort();
    }
    for (std::int64_t step = 0; step < motion.rows(); ++step) {
      const drape::StepRow& row = motion.row(step);
      if (row.step != step || !std::isfinite(row.energies.total()) || !std::isfinite(row.residual)) std::abort();
    }
  });
}

/// Assembles a file of parts, each with a tag of four bytes and a size of one: compressed blocks with checksums. A part
/// "INDX" becomes the index of the blocks before it.
std::string assembled(std::string_view parts) {
  std::string bytes = drape::motion_magic;
  std::uint64_t index = 0;
  drape::ByteWriter states, rows;
  std::uint64_t state_count = 0, rows_count = 0;
  while (parts.size() > 5) {
    const std::string_view tag = parts.substr(0, 4);
    const std::string_view payload = parts.substr(5, static_cast<unsigned char>(parts[4]));
    parts.remove_prefix(5 + payload.size());
    std::string packed = drape::pack(payload);
    if ((tag == drape::state_tag || tag == drape::rows_tag) && payload.size() >= 16) {
      packed = std::string(payload.substr(0, 16)) + drape::pack(payload.substr(16));
      const bool state = tag == drape::state_tag;
      (state ? states : rows).bytes(payload.substr(0, 8)).whole(bytes.size());
      ++(state ? state_count : rows_count);
    } else if (tag == drape::index_tag) {
      index = bytes.size();
      packed = drape::pack(
          drape::ByteWriter().whole(state_count).whole(rows_count).bytes(states.text()).bytes(rows.text()).text());
    }
    bytes += drape::block_head(tag, packed) + packed;
  }
  return bytes + drape::ByteWriter().whole(index).bytes(drape::motion_end).text();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const drape::FuzzFolder folder;
  static const drape::SealedMotion good(folder);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read(folder, bytes);
  read(folder, assembled(bytes));
  read(folder, drape::with_edits(good.complete, bytes));
  return 0;
}

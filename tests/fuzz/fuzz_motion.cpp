// motion.bin of a golden: as raw bytes, and as the words compressed in it, because random changes of compressed bytes
// are rarely readable.

#include <cstring>
#include <stdexcept>

#include "check/golden_motion.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"
#include "tests/support/motion_bytes.hpp"

namespace {

/// Describes two vertices and three windows with two pictures.
drape::Golden described() {
  drape::Golden golden;
  golden.vertex_count = 2;
  golden.step_count = 5;
  golden.window_steps = 2;
  golden.body_count = 4;
  golden.quanta = {0x1p-29, 0x1p-25, 0x1p-24};
  golden.frames = {{.frame = 0, .why = {}, .x = {}}, {.frame = 3, .why = {}, .x = {}}};
  return golden;
}

void read(std::string_view bytes) {
  drape::accepts_or_refuses<std::invalid_argument>([&] {
    drape::Golden golden = described();
    drape::unpack_motion(bytes, golden);
    if (golden.windows.size() != 4) std::abort();
    for (const drape::GoldenWindow& window : golden.windows) {
      if (!window.start.x.allFinite() || !window.start.v.allFinite() || !window.middle.allFinite()) std::abort();
      if (window.start.x.rows() != 2 || window.start.v.rows() != 2) std::abort();
    }
    // Readable content can be written and read again unchanged.
    drape::Golden again = described();
    drape::unpack_motion(drape::pack_motion(golden), again);
    if (again.windows.back().start.x != golden.windows.back().start.x) std::abort();
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read({reinterpret_cast<const char*>(data), size});
  std::vector<std::uint64_t> words(size / sizeof(std::uint64_t));
  if (!words.empty()) std::memcpy(words.data(), data, sizeof(std::uint64_t) * words.size());
  read(drape::test::motion_bytes(words));
  return 0;
}

// motion.bin of a golden: as the bytes of the file, and as the words that are packed in it, since hardly any change of
// packed bytes can be unpacked.

#include <cstring>
#include <stdexcept>

#include "check/motion_file.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"
#include "tests/support/motion_bytes.hpp"

namespace {

constexpr double quantum = 1e-7;

void read(std::string_view bytes) {
  drape::accepts_or_refuses<std::invalid_argument>([&] {
    const auto windows = drape::unpack_motion(bytes, quantum, 1 << 16);
    for (const drape::GoldenWindow& window : windows) {
      if (!window.start.x.allFinite() || !window.start.v.allFinite()) std::abort();
      if (window.start.v.rows() != window.start.x.rows()) std::abort();
      for (const drape::GoldenStep& step : window.steps) {
        if (!step.x.allFinite() || step.x.rows() != window.start.x.rows()) std::abort();
      }
    }
    // What can be read can be written, and says the same.
    if (drape::unpack_motion(drape::pack_motion(windows, quantum), quantum, 1 << 16).size() != windows.size()) {
      std::abort();
    }
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

// manifest.json of a golden.

#include <algorithm>
#include <stdexcept>

#include "check/manifest.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

namespace {

void read(std::string_view bytes) {
  drape::accepts_or_refuses<std::invalid_argument>([&] {
    const drape::Manifest manifest = drape::read_manifest(bytes);
    const drape::Golden& golden = manifest.golden;
    const bool sound = golden.quanta.compared >= drape::least_quantum && golden.vertex_count > 0 && golden.step > 0 &&
                       golden.window_steps > 0 && golden.size.minCoeff() >= 16 && golden.size.maxCoeff() <= 8192 &&
                       std::all_of(golden.frames.begin(), golden.frames.end(), [](const drape::GoldenFrame& frame) {
                         return frame.view.position.allFinite() && frame.view.axes().allFinite();
                       });
    if (!sound) std::abort();
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read(bytes);
  // Random changes of a text rarely leave its checksum valid.
  drape::accepts_or_refuses<std::invalid_argument>([&] { read(drape::sealed_manifest(bytes)); });
  return 0;
}

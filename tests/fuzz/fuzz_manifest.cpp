// manifest.json of a golden.

#include <stdexcept>

#include "check/manifest.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  drape::accepts_or_refuses<std::invalid_argument>([&] {
    const drape::Manifest manifest = drape::read_manifest({reinterpret_cast<const char*>(data), size});
    const drape::Golden& golden = manifest.golden;
    const bool sound = golden.quantum >= drape::least_quantum && golden.vertex_count > 0 && golden.step > 0 &&
                       golden.size.minCoeff() >= 16 && golden.size.maxCoeff() <= 8192 &&
                       golden.view.position.allFinite() && golden.view.axes().allFinite();
    if (!sound) std::abort();
  });
  return 0;
}

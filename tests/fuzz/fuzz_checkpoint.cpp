// Checkpoints beside a growing motion: as raw bytes, and as edits of a valid one with corrected checksums.

#include "tests/fuzz/accepts_or_refuses.hpp"
#include "tests/fuzz/sealed_motion.hpp"

namespace {

void read(const drape::FuzzFolder& folder, std::string_view checkpoint) {
  folder.put("m.drape.checkpoint", checkpoint);
  drape::accepts_or_refuses([&] {
    const drape::ResumePoint found = drape::read_resumption(folder.path("m.drape"));
    const drape::State& state = found.checkpoint.state;
    if (state.x.rows() != found.partial->header().vertices || state.v.rows() != state.x.rows()) std::abort();
    if (!state.x.allFinite() || !state.v.allFinite() || !state.restraint.tensions.allFinite()) std::abort();
    if (found.microseconds.size() != static_cast<std::size_t>(state.step)) std::abort();
    for (std::int64_t step = 0; step <= state.step; ++step) {
      if (found.row(step).step != step) std::abort();
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const drape::FuzzFolder folder;
  static const drape::SealedMotion good(folder);
  static const std::filesystem::path growing = folder.put("m.drape.partial", good.growing);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read(folder, bytes);
  read(folder, drape::with_edits(good.checkpoint, bytes));
  return 0;
}

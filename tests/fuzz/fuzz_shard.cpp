// check.cbor of a check's shard with a valid checksum, and the reports made of it.

#include "check/html_report.hpp"
#include "check/manifest.hpp"
#include "check/report.hpp"
#include "core/installation.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  drape::accepts_or_refuses([&] {
    const drape::CheckShard shard = drape::unpack_shard(drape::seal_shard({reinterpret_cast<const char*>(data), size}),
                                                        "in/shard-1-of-2/check.cbor");
    for (const drape::SceneResult& scene : shard.report.scenes) {
      if (drape::name_in_folder(scene.name, "", "").find('/') != std::string::npos) std::abort();
    }
    const drape::CheckReport whole = drape::merge_shards({shard}, {"in/shard-1-of-2"});
    if (whole.missing > shard.scenes) std::abort();
    if (drape::json_report(whole).empty() || drape::junit_report(whole).empty() || drape::html_report(whole).empty()) {
      std::abort();
    }
  });
  return 0;
}

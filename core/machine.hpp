#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drape {

/// The machine that runs this process.
struct MachineFacts {
  std::string processor;           ///< its model's name
  std::vector<std::string> flags;  ///< the instruction sets that matter here, as in /proc/cpuinfo: "avx2", "fma"
  int threads = 0;                 ///< that run at once
  std::uint64_t memory = 0;        ///< [bytes]
  std::string system;              ///< "Debian GNU/Linux 12 (bookworm), Linux 6.1.0"
};

/// What the system says; what it does not say stays empty.
MachineFacts machine_facts();

}  // namespace drape

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drape {

/// The machine that runs this process.
struct MachineFacts {
  std::string processor;           ///< name of the model
  std::vector<std::string> flags;  ///< the instruction sets that matter here, as in /proc/cpuinfo: "avx2", "fma"
  int threads = 0;                 ///< hardware threads
  std::uint64_t memory = 0;        ///< [bytes]
  std::string system;              ///< "Debian GNU/Linux 12 (bookworm), Linux 6.1.0"
};

/// Asks the system for these facts; unknown ones stay empty.
MachineFacts machine_facts();

}  // namespace drape

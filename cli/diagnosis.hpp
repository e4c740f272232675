#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/build_info.hpp"
#include "core/machine.hpp"
#include "render/backend.hpp"
#include "render/gl/inspect.hpp"

namespace drape {

/// Something that drape uses and may or may not find.
struct Finding {
  std::string name;      ///< "egl", ".mp4", "fonts"
  std::string detail;    ///< what was found: "H.264", "DejaVuSans"
  std::string problem;   ///< empty if it works
  std::string packages;  ///< of Debian, separated by spaces: what to install if it does not

  [[nodiscard]] bool works() const { return problem.empty(); }
};

/// An OpenGL backend, with what it says of itself if it works.
struct BackendFinding : Finding {
  GlFacts facts;
};

/// What drape finds on this machine.
struct Diagnosis {
  BuildInfo build;
  MachineFacts machine;
  std::vector<std::pair<std::string, std::string>> environment;  ///< variables that change what drape does, if set

  std::vector<std::string> kernels;           ///< instruction sets that drape has code for
  std::vector<std::string> runnable_kernels;  ///< those that this processor runs
  Finding chosen_kernels;                     ///< detail: the one that drape picked
  Finding blas;                               ///< detail: the file, and its own description
  std::string cholmod;                        ///< version

  std::vector<BackendFinding> backends;
  Finding drawing;  ///< detail: the backend that --backend auto picks; works if a picture came out as it should
  Finding codecs;   ///< detail: the module that encodes and decodes
  std::vector<Finding> outputs;   ///< the formats of films
  std::vector<Finding> optional;  ///< what only some commands use

  /// What to install for everything to work, each package once; empty if all does.
  [[nodiscard]] std::vector<std::string> missing_packages() const;
};

/// Looks. Loads the OpenGL libraries, draws a small picture, and writes two frames in every format in a folder for
/// temporary files.
Diagnosis diagnose();

}  // namespace drape

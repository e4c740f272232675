#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/installation.hpp"
#include "core/machine.hpp"
#include "drape/render/settings.hpp"
#include "render/gl/inspect.hpp"

namespace drape {

/// A component that drape uses, with the result of its check.
struct Finding {
  std::string name;      ///< "egl", ".mp4", "fonts"
  std::string detail;    ///< result: "H.264", "DejaVuSans"
  std::string problem;   ///< empty if it works
  std::string packages;  ///< Debian packages that provide it, separated by spaces

  [[nodiscard]] bool works() const { return problem.empty(); }
};

/// An OpenGL backend and its properties if it works.
struct BackendFinding : Finding {
  GlFacts facts;
};

/// The environment of drape on this machine.
struct Diagnosis {
  BuildInfo build;
  MachineFacts machine;
  std::vector<std::pair<std::string, std::string>> environment;  ///< environment variables that affect drape, if set

  std::vector<std::string> kernels;           ///< instruction sets with code in drape
  std::vector<std::string> runnable_kernels;  ///< those supported by this processor
  Finding chosen_kernels;                     ///< detail: the selected one
  Finding blas;                               ///< detail: the file, and its own description
  std::string cholmod;                        ///< version

  std::vector<BackendFinding> backends;
  Finding drawing;                ///< detail: the backend selected by --backend auto; works if a test picture is right
  Finding codecs;                 ///< detail: the encoding and decoding module
  std::vector<Finding> outputs;   ///< film formats
  std::vector<Finding> optional;  ///< components of some commands only

  /// Returns the packages to install, each once; empty if everything works.
  [[nodiscard]] std::vector<std::string> missing_packages() const;
};

/// Checks this machine: loads the OpenGL libraries, draws a small picture, and writes two frames in every format to a
/// temporary folder.
Diagnosis diagnose();

}  // namespace drape

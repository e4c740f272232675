// The parts of script/arm64 that need no cross-compiler.

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/run_drape.hpp"

namespace drape::arm64 {
namespace {

namespace fs = std::filesystem;
using test::Finished;
using test::SceneFolder;

const fs::path repository = DRAPE_SOURCE_DIR;

Finished cmake(const SceneFolder& folder, const std::string& arguments) {
  return test::run_shell(folder, std::string("'") + DRAPE_CMAKE + "' " + arguments);
}

TEST(Toolchain, NamesTheScriptThatUnpacksItsLibraries) {
  const SceneFolder folder;
  fs::create_directories(folder.path() / "cmake");
  fs::copy(repository / "cmake/arm64.cmake", folder.path() / "cmake");
  const Finished without = cmake(folder, "-P cmake/arm64.cmake");
  EXPECT_NE(without.code, 0);
  EXPECT_NE(without.text.find("libraries for arm64 are missing: script/arm64 unpacks them into"), std::string::npos)
      << without.text;
  fs::create_directories(folder.path() / "build/arm64-sysroot/usr/include");
  const Finished with = cmake(folder, "-P cmake/arm64.cmake");
  EXPECT_EQ(with.code, 0) << with.text;
}

/// The versions of the kernels that are built for a processor, a line each.
std::string versions(const std::string& processor) {
  const SceneFolder folder;
  folder.write("print.cmake",
               "function(drape_kernels)\n  string(JOIN \" \" line ${ARGN})\n  message(\"${line}\")\nendfunction()\n"
               "include(" +
                   (repository / "sim/kernels/Versions.cmake").string() + ")\n");
  const Finished finished = cmake(folder, "-D CMAKE_SYSTEM_PROCESSOR=" + processor + " -P print.cmake");
  EXPECT_EQ(finished.code, 0) << finished.text;
  return finished.text;
}

TEST(KernelVersions, AreThoseOfTheProcessorThatIsCompiledFor) {
  EXPECT_EQ(versions("aarch64"), "neon 2\n");
  EXPECT_EQ(versions("arm64"), "neon 2\n") << "as macOS calls it";
  EXPECT_EQ(versions("riscv64"), "generic 2\n");
  const std::string x86 = versions("x86_64");
  EXPECT_EQ(x86.find("sse2 2\navx2 4 -mavx2\navx512 8 -mavx512f"), 0U) << x86;
}

// A register's width may not show in the bits, so no option may let the compiler fuse or reorder.
TEST(KernelVersions, AreCompiledWithoutContraction) {
  for (const char* processor : {"aarch64", "x86_64"}) {
    const std::string options = versions(processor);
    for (const char* wrong : {"fast-math", "-mfma", "contract", "-march"}) {
      EXPECT_EQ(options.find(wrong), std::string::npos) << processor << ": " << options;
    }
  }
}

}  // namespace
}  // namespace drape::arm64

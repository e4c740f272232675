// The Python reader of motion files, docs/reference/motion_reader.py, reads the same data as drape.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>

#include "tests/motion/recorded.hpp"
#include "tests/support/files.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

const std::filesystem::path source = DRAPE_SOURCE_DIR;

struct RecordedRun {
  std::vector<std::string> overrides;
  RecordedSteps recorded;
};

/// Returns the bytes that the page's reader should write for a motion: states, rows and surface.
std::string expected_bytes(MotionReader& motion, const Mesh& mesh) {
  std::string bytes;
  const auto add = [&](const void* begin, std::size_t size) { bytes.append(static_cast<const char*>(begin), size); };
  for (std::size_t i = 0; i < motion.states(); ++i) {
    const State& state = motion.state(i);
    add(&state.step, sizeof state.step);
    add(state.x.data(), static_cast<std::size_t>(state.x.size()) * sizeof(double));
    add(state.v.data(), static_cast<std::size_t>(state.v.size()) * sizeof(double));
  }
  for (std::int64_t i = 0; i < motion.rows(); ++i) {
    const StepRow& row = motion.row(i);
    const std::array<double, 4> numbers{row.energies.kinetic, row.energies.gravity, row.energies.elastic,
                                        static_cast<double>(row.iterations)};
    add(numbers.data(), sizeof numbers);
  }
  add(mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
  add(mesh.uvs.data(), mesh.uvs.size() * sizeof mesh.uvs[0]);
  return bytes;
}

TEST(PagesReader, ReadsWhatDrapeDoes) {
  if (std::getenv("DRAPE_INTEROP") == nullptr) GTEST_SKIP() << "script/interop installs numpy and runs this";
  const SceneFolder folder;
  folder.write(
      "reader.py",
      content(source / "docs/reference/motion_reader.py") +
          "import os, sys\nm = Motion(sys.argv[1])\nout = open(os.path.dirname(sys.argv[1]) + '/read.bin', 'wb')\n"
          "for step, x, v in m:\n  out.write(struct.pack('<q', step) + x.T.tobytes() + v.T.tobytes())\n"
          "out.write(m.rows()[:, :4].astype('<f8').tobytes())\n"
          "t, uv = m.surface()\nout.write(t.tobytes() + uv.tobytes())\n");
  const std::vector<RecordedRun> runs{{{}, {}},
                                      {{}, {.every = 7}},
                                      {{}, {.every = std::nullopt}},
                                      {{"integrator.method=verlet", "time.step=0.0005"}, {}},
                                      {{"integrator.scheme=sdirk2"}, {}}};
  for (const RecordedRun& run : runs) {
    RunOptions options;
    options.motion.emplace();
    options.motion->recorded = run.recorded;
    record(folder.load(recorded_scene + "[effects.ground]\nheight = -1\n", run.overrides), folder.path("m.drape"),
           options);
    EXPECT_EQ(std::system(("/usr/bin/python3 " + folder.path("reader.py") + " " + folder.path("m.drape")).c_str()), 0);
    MotionReader motion(folder.path("m.drape"));
    EXPECT_TRUE(content(folder.path("read.bin")) == expected_bytes(motion, make_grid(5, 4)));
  }
}

}  // namespace
}  // namespace drape::test

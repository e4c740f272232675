#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>

#include "drape/sim/mesh.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::import_cli {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;

/// Returns an OBJ of a sheet of 8×8 cells after a fall of some frames of 20 ms.
std::string falling(int frame, const std::function<void(Vertices&)>& fault = {}) {
  const Mesh grid = make_grid(8, 8);
  Vertices x = grid.positions;
  x.col(2).array() -= 0.5 * 9.81 * std::pow(0.02 * frame, 2);
  if (fault) fault(x);
  std::string text;
  for (const auto& p : x.rowwise()) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  for (const auto& [a, b, c] : grid.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

/// Writes a sequence of ten frames, one of which may have a defect.
void write_sequence(const SceneFolder& folder, const std::function<void(Vertices&)>& fault = {}) {
  for (int frame = 0; frame < 10; ++frame) {
    folder.write(fmt::format("m/{:02}.obj", frame), falling(frame, frame == 5 ? fault : nullptr));
  }
}

const std::string sequence = "'m/{frame:02}.obj'";

TEST(Import, MakesAMotionThatIsDrawnComparedAndAudited) {
  const SceneFolder folder;
  write_sequence(folder);
  const Finished imported = drape(folder, "import " + sequence + " --fps 50 -o motion.drape");
  EXPECT_EQ(imported.code, 0) << imported.text;
  EXPECT_NE(imported.text.find("10 frames, 0.02 s apart, of 81 vertices and 128 triangles"), std::string::npos)
      << imported.text;
  folder.write("scene.toml",
               "[cloth]\nmesh = { grid = [8, 8] }\nstiffness = 10\n[time]\nstep = 0.02\nduration = 0.18\n"
               "[effects.gravity]\n[video]\nsize = [64, 48]\n");
  folder.write("look.toml", test::least_scene + "[look]\ncolor = \"navy\"\n[video]\nsize = [64, 48]\nfps = 50\n");
  EXPECT_EQ(drape(folder, "render motion.drape --scene look.toml -o film.gif").code, 0);
  EXPECT_EQ(drape(folder, "render motion.drape --set look.color_by=speed --set 'video.size=[64, 48]' -o a.png").code,
            0);
  EXPECT_EQ(drape(folder, "render " + sequence + " --set 'video.size=[64, 48]' -o b.png").code, 0);
  const Finished compared = drape(folder, "compare scene.toml motion.drape --difference -o ab.png");
  EXPECT_EQ(compared.code, 0) << compared.text;
  // The import knows neither energies nor a scene.
  EXPECT_EQ(drape(folder, "compare scene.toml motion.drape --frames 0..3 -o page.html").code, 0);
  const std::string page = test::content(folder.path("page.html"));
  EXPECT_EQ(page.find("The scenes are the same"), std::string::npos);
  EXPECT_NE(page.find("A motion of another program has no scene"), std::string::npos);
  const std::size_t row = page.find("motion</td>");
  EXPECT_EQ(page.substr(row, page.find("</tr>", row) - row).find(">0<"), std::string::npos);
  const Finished audited = drape(folder, "audit motion.drape");
  EXPECT_EQ(audited.code, 0) << audited.text;
  EXPECT_NE(audited.text.find("masses and springs of an imported motion are not known"), std::string::npos);
}

// A sheet that hangs in the xz plane looks like one that lies, with y up; the import has said which axis it is.
TEST(Import, NeedsNoHintAboutItsAxis) {
  const SceneFolder folder;
  for (int frame = 0; frame < 2; ++frame) {
    folder.write(fmt::format("{}.obj", frame), "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 1 2 0.1\nf 1 2 3\nf 2 4 3\n");
  }
  EXPECT_EQ(drape(folder, "import '{frame}.obj' --up y -o motion.drape").code, 0);
  const Finished drawn = drape(folder, "render motion.drape --set 'video.size=[64, 48]' -o a.png");
  EXPECT_EQ(drawn.code, 0) << drawn.text;
  EXPECT_EQ(drawn.text.find("looks as if"), std::string::npos) << drawn.text;
}

TEST(Import, IsFoundByTheAuditToHaveTheFaultsThatWerePutIntoIt) {
  const SceneFolder folder;
  write_sequence(folder, [](Vertices& x) {  // a corner through the middle, for one frame
    x.row(0) = x.row(40) + Eigen::RowVector3d(0.06, 0.02, -0.1);
    x.row(1) = x.row(40) + Eigen::RowVector3d(0.05, 0.01, 0.1);
  });
  const Finished crossing = drape(folder, "audit " + sequence + " --max-stretch 100 -o page.html");
  EXPECT_EQ(crossing.code, 1) << crossing.text;
  EXPECT_NE(crossing.text.find("(step 5): "), std::string::npos) << crossing.text;
  EXPECT_NE(crossing.text.find("cloth edge 0 1 goes through cloth triangle"), std::string::npos) << crossing.text;
  const std::string page = test::content(folder.path("page.html"));
  EXPECT_NE(page.find("data:image/png;base64"), std::string::npos);
  EXPECT_NE(page.find("Turn this state"), std::string::npos);

  write_sequence(folder, [](Vertices& x) { x(0, 0) -= 0.05; });  // a side grows from 0.25 to 0.3
  const Finished stretched = drape(folder, "audit " + sequence);
  EXPECT_EQ(stretched.code, 1) << stretched.text;
  EXPECT_NE(stretched.text.find("cloth edge 0 1 is stretched to 1.2"), std::string::npos) << stretched.text;
}

TEST(Import, RefusesInOneMessageWithExitCode2) {
  const SceneFolder folder;
  write_sequence(folder);
  const auto expect_refused = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
    EXPECT_EQ(std::count(finished.text.begin(), finished.text.end(), '\n'), 1) << finished.text;
  };
  expect_refused("import " + sequence + " -o motion.npz", "expected the name of a motion file");
  expect_refused("import missing.npz -o motion.drape", "missing.npz");
  expect_refused("import " + sequence + " --prim /a -o motion.drape", "only a USD file has prims");
  expect_refused("import " + sequence + " --up x -o motion.drape", "--up");
  expect_refused("simulate " + sequence, "is already a motion");
  const std::string unknown = "made this motion without these values: omit ";
  expect_refused("render " + sequence + " --set overlay.energies=true -o film.gif", unknown + "[overlay] energies\n");
  expect_refused("render " + sequence + " --set 'caption.text=\"{time} {energy.total} {iterations}\"' -o film.gif",
                 unknown + "{energy.total} in the caption, {iterations} in the caption\n");
  folder.write("energies.toml", test::least_scene + "[overlay]\nenergies = true\n");
  ASSERT_EQ(drape(folder, "import " + sequence + " -o i.drape").code, 0);
  for (const std::string option : {"--stats", "--trace", "--energies"}) {
    expect_refused("simulate --resume i.drape " + option + " record", "another program made i.drape without these");
  }
  expect_refused("compare energies.toml " + sequence + " -o film.gif", unknown + "[overlay] energies\n");
  folder.write("m/12.obj", falling(0));
  expect_refused("render " + sequence + " -o film.gif", "10.obj is missing before 12.obj");
}

/// Returns the greatest memory of the finished child processes [kB].
double most_memory() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_maxrss);
}

TEST(Import, KeepsItsMemoryHoweverLongAUsdFileIs) {
#ifdef DRAPE_SANITIZED
  GTEST_SKIP() << "a sanitizer keeps what is freed";
#endif
  const SceneFolder folder;
  const auto imported = [&](const std::string& name, int frames) {
    const Mesh grid = make_grid(30, 30);
    std::string counts, corners;
    for (const auto& [a, b, c] : grid.triangles) {
      counts += "3, ";
      corners += fmt::format("{}, {}, {}, ", a, b, c);
    }
    std::ofstream file(folder.path(name));
    file << "#usda 1.0\n( upAxis = \"Z\"\n metersPerUnit = 1 )\ndef Mesh \"m\"\n{\nint[] faceVertexCounts = [" << counts
         << "]\nint[] faceVertexIndices = [" << corners << "]\npoint3f[] points.timeSamples = {\n";
    for (int frame = 0; frame < frames; ++frame) {
      file << frame << ": [";
      for (const auto& p : grid.positions.rowwise()) {
        file << fmt::format("({:.9f}, {:.9f}, {:.9f}), ", p[0], p[1], p[2] - 1e-4 * frame * frame);
      }
      file << "],\n";
    }
    file << "}\n}\n";
    file.close();
    const Finished finished = drape(folder, "import " + name + " -o " + name + ".drape");
    EXPECT_EQ(finished.code, 0) << finished.text;
  };
  imported("short.usda", 5);
  const double small = most_memory();
  imported("long.usda", 1200);
  const double size = static_cast<double>(std::filesystem::file_size(folder.path("long.usda"))) / 1024;
  EXPECT_GT(size, 30000) << "kB of file, so that it would be seen";
  EXPECT_LT(most_memory(), small + 0.2 * size);
}

}  // namespace
}  // namespace drape::import_cli

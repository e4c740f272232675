// Files of other programs, and invalid files: one message each.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "motion/import/import_motion.hpp"
#include "motion/reader.hpp"
#include "output/mesh_writers.hpp"
#include "output/npz_writer.hpp"
#include "sim/system.hpp"
#include "tests/import/random_motion.hpp"
#include "tests/support/files.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::test {
namespace {

class Strangers : public InScratchFolder {
 protected:
  ImportedMotion read(const std::string& name, ImportOptions options = {}) {
    options.cloths = {path(name)};
    Progress progress;
    std::filesystem::remove(path("out.drape"));
    return import_motion(options, path("out.drape"), {}, progress);
  }
  void expect_refused(const std::string& name, const std::string& message) {
    const std::string found = usage_error([&] { read(name); });
    EXPECT_NE(found.find(message), std::string::npos) << name << ": " << found;
    EXPECT_FALSE(std::filesystem::exists(path("out.drape.partial"))) << name;
    EXPECT_FALSE(std::filesystem::exists(path("out.drape"))) << name;
  }
  void put(const std::string& name, const std::string& text) { ScratchFolder::put(path(name), text); }
};

const std::string triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(Strangers, HaveQuadsAndAsciiAndBigEndianNumbers) {
  put("a/0.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
      "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0.5 4\n4 0 1 2 3\n");
  EXPECT_EQ(read("a/{frame}.ply").triangles, 2);
  std::string binary = "# vtk DataFile Version 3.0\ncloth\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n";
  const auto big = [&](std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8) binary += static_cast<char>(word >> shift & 0xFF);
  };
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.25F}) big(std::bit_cast<std::uint32_t>(x));
  binary += "\nPOLYGONS 1 4\n";
  for (const std::uint32_t word : {3U, 0U, 1U, 2U}) big(word);
  binary += "\nPOINT_DATA 3\n";
  put("b/0.vtk", binary);
  EXPECT_EQ(read("b/{frame}.vtk").triangles, 1);
  EXPECT_EQ(MotionReader(path("out.drape")).state(0).x(2, 2), 0.25);
  put("c.vtk",
      "# vtk DataFile Version 5.1\ncloth\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
      "0 0 0 1 0 0 1 1 0 0 1 0\nCELLS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\n"
      "CELL_TYPES 1\n9\n");
  EXPECT_EQ(read("c.vtk").triangles, 2);
}

/// A bending quad is divided along its shorter diagonal, which changes during the motion.
TEST_F(Strangers, HaveQuadsThatBend) {
  const std::string face = "f 1//1 2//1 3//1 4//1\n";
  put("q/0.obj", "v 0 0 0\nv 1 0 0\nv 0.9 0.9 0\nv 0 1 0\nvn 0 0 1\n" + face);
  put("q/1.obj", "v -0.5 -0.5 0\nv 1 0 0\nv 1.5 1.5 0\nv 0 1 0\nvn 0 0 1\n" + face);
  EXPECT_EQ(read("q/{frame}.obj").triangles, 2);
  put("q/1.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 4//1 3//1\n");
  expect_refused("q/{frame}.obj", "has other vertices");
}

TEST_F(Strangers, HaveTimesOfTheirOwn) {
  put("a.usda",
      "#usda 1.0\n(\n upAxis = \"Z\"\n metersPerUnit = 1\n timeCodesPerSecond = 10\n)\ndef Mesh \"m\"\n{\n"
      " int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2]\n point3f[] points.timeSamples = {\n"
      "  0: [(0, 0, 0), (1, 0, 0), (0, 1, 0)],\n  1: [(0, 0, 1), (1, 0, 1), (0, 1, 1)],\n"
      "  4: [(0, 0, 4), (1, 0, 4), (0, 1, 4)],\n }\n}\n");
  const ImportedMotion found = read("a.usda");
  EXPECT_EQ(found.frames, 3);
  EXPECT_NEAR(found.step, 0.1, 1e-15);
  MotionReader reader(path("out.drape"));
  EXPECT_EQ(reader.last_step(), 4);
  EXPECT_NEAR(reader.state(1).v(0, 2), 10, 1e-9);  // (4 − 0)/0.4 s
}

/// The samples of a USD file are read when needed; errors name their place.
TEST_F(Strangers, AreToldWhatIsWrongWithASample) {
  const std::string first = "  0: [(0, 0, 0), (1, 0, 0), (0, 1, 0)],\n";
  const auto motion = [](const std::string& samples) {
    return "#usda 1.0\n(\n upAxis = \"Z\"\n metersPerUnit = 1\n)\ndef Mesh \"m\"\n{\n int[] faceVertexCounts = [3]\n"
           " int[] faceVertexIndices = [0, 1, 2]\n point3f[] points.timeSamples = {\n" +
           samples + " }\n}\n";
  };
  const std::string second = "  24: [(0, 0, 1), (1, 0, 1), (0, 1, 1)],\n",
                    third = "  48: [(0, 0, 3), (1, 0, 3), (0, 1, 3)],\n";
  for (const std::string& samples : {first + second + third, third + second + first}) {
    put("good.usda", motion(samples));
    EXPECT_EQ(read("good.usda").frames, 3);
    MotionReader reader(path("out.drape"));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(reader.state(k).x(2, 2), k == 2 ? 3 : k);
  }
  put("more.usda", motion(first + second + "  48: [(0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)],\n"));
  expect_refused("more.usda", "more.usda:13:7: points: expected 3 as in the first sample, found 4");
  put("word.usda", motion(first + "  24: [(0, 0, 1), (1, x, 1), (0, 1, 1)],\n"));
  expect_refused("word.usda", "word.usda:12:23: expected a finite number");
}

TEST_F(Strangers, AreToldWhatIsWrongWithASequence) {
  put("gap/0.obj", triangle_obj);
  put("gap/2.obj", triangle_obj);
  expect_refused("gap/{frame}.obj", "1.obj is missing before 2.obj");
  expect_refused("none/{frame}.obj", "none");
  put("more/0.obj", triangle_obj);
  put("more/1.obj", "v 0 0 1\n" + triangle_obj);
  expect_refused("more/{frame}.obj",
                 "1.obj: expected the 3 vertices and 1 triangles of the first frame, found 4 vertices and 1 triangles");
  put("other/0.obj", triangle_obj);
  put("other/1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n");
  expect_refused("other/{frame}.obj", "triangle 0 has other vertices");
  put("nan/0.obj", triangle_obj);
  put("nan/1.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_refused("nan/{frame}.obj", "1.obj:1:7: expected a finite number, found 'nan'");
  put("nan.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n");
  expect_refused("nan.ply", "vertex 1 has the y coordinate nan");
  put("large.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n");
  expect_refused("large.ply", "the file is too short for them");
  put("far/0.obj", "v 0 0 0\nv 5e90 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_refused("far/{frame}.obj", "it cannot be drawn: ");
  put("up.usda", "#usda 1.0\n");
  EXPECT_NE(usage_error([&] { read("up.usda", {.axes = {.y_up = true}}); }).find("omit --up"), std::string::npos);
  put("a.stl", "solid");
  expect_refused("a.stl", "expected a motion: .npz");
}

TEST_F(Strangers, AreToldWhatIsWrongWithOneFile) {
  const RandomMotion motion(3);
  motion.write_film<NpzWriter>(path("a.npz"));
  motion.write_film<Pc2Writer>(path("c.pc2"));
  const std::string npz = content(path("a.npz")), pc2 = content(path("c.pc2"));
  put("cut.npz", npz.substr(0, npz.size() / 2));
  expect_refused("cut.npz", "expected an NPZ file");
  put("cut.pc2", pc2.substr(0, pc2.size() - 4));
  std::filesystem::copy(path("c.obj"), path("cut.obj"));
  expect_refused("cut.pc2", "it is cut short: ");
  put("other.pc2", pc2);
  put("other.obj", triangle_obj);
  expect_refused("other.pc2", "points, and");
  put("text.pc2", "hello, this is no point cache at all");
  expect_refused("text.pc2", "it does not begin with POINTCACHE2");
  std::string nan = pc2;
  const float not_a_number = NAN;
  std::memcpy(nan.data() + nan.size() - 4, &not_a_number, 4);
  put("nan.pc2", nan);
  std::filesystem::copy(path("c.obj"), path("nan.obj"));
  expect_refused("nan.pc2", "z coordinate nan");
  put("a.pvd", "<VTKFile type=\"Collection\"><Collection></Collection></VTKFile>");
  expect_refused("a.pvd", "it names no file");
  put("b.pvd", "<VTKFile");
  expect_refused("b.pvd", "no whole XML file");
  expect_refused("missing.npz", "cannot be read");
}

TEST_F(Strangers, AreToldWhatIsWrongWithNumpysArrays) {
  struct Array {
    std::string name;
    std::vector<std::size_t> row;
    std::vector<double> numbers;
  };
  const auto put_npz = [this](const std::string& name, const std::vector<Array>& arrays) {
    PartialFile file(path(name));
    ZipWriter zip(file);
    for (const Array& array : arrays) {
      NpyArray npy(file, array.name, "'<f8'", array.row);
      std::size_t size = 1;
      for (const std::size_t length : array.row) size *= length;
      npy.append_rows(array.numbers.size() / size, bytes_of(array.numbers));
      zip.begin(npy.file_name(), npy.header().size() + npy.data_size(), npy.crc32());
      npy.copy_to(file);
    }
    zip.finish();
    file.commit();
  };
  const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<double> twice = corners;
  twice.insert(twice.end(), corners.begin(), corners.end());
  const Array positions{"positions", {3, 3}, twice}, faces{"faces", {3}, {0, 1, 2}};
  put_npz("good.npz", {positions, faces});
  EXPECT_EQ(read("good.npz").frames, 2);
  std::vector<double> bad = twice;
  bad[16] = NAN;
  put_npz("nan.npz", {{"positions", {3, 3}, bad}, faces});
  expect_refused("nan.npz", "vertex 2 has the y coordinate nan");
  put_npz("flat.npz", {{"positions", {9}, twice}, faces});
  expect_refused("flat.npz", "expected the shape (frames, vertices, 3), found (2, 9)");
  put_npz("beyond.npz", {positions, {"faces", {3}, {0, 1, 3}}});
  expect_refused("beyond.npz", "faces");
  put_npz("rest.npz", {positions, faces, {"rest", {3}, twice}});
  expect_refused("rest.npz", "expected the shape (vertices, 3), found (6, 3)");
  put_npz("times.npz", {positions, faces, {"times", {}, {0, 0.1, 0.2}}});
  expect_refused("times.npz", "expected the shape (frames,), found (3)");
  put_npz("back.npz", {positions, faces, {"times", {}, {0.1, 0}}});
  expect_refused("back.npz", "times");
  put_npz("none.npz", {faces});
  expect_refused("none.npz", "expected the arrays positions and faces, found faces.npy");
  bad = twice;
  bad[4] = NAN;
  put_npz("speeds.npz", {positions, faces, {"velocities", {3, 3}, bad}});
  expect_refused("speeds.npz", "velocities: vertex 1 has the y coordinate nan");
  std::string shorter = content(path("good.npz"));  // the directory's last entry is cut after 20 bytes
  const std::size_t end = shorter.rfind("PK\x06\x06"), last = shorter.rfind("PK\x01\x02");
  ASSERT_NE(end, std::string::npos) << "64-bit sizes";
  const auto whole = static_cast<unsigned char>(shorter[end + 40]);
  shorter[end + 40] = static_cast<char>(whole - (end - last) + 20);
  ASSERT_GT(whole, end - last);
  put("shorter.npz", shorter);
  expect_refused("shorter.npz", "found no directory of one: it is cut short");
  std::string many = content(path("good.npz"));  // claims ten million vertices but has three
  const std::string shape = "'shape': (2, 3, 3,), }", larger = "'shape': (2, 9999999, 3,), }";
  ASSERT_NE(many.find(shape), std::string::npos);
  many.replace(many.find(shape), larger.size(), larger);  // replaces spaces behind it
  put("many.npz", many);
  expect_refused("many.npz", "damaged or cut short");
}

TEST_F(Strangers, MayHaveFieldsBeforeTheirPointsButNoSolidCells) {
  const std::string head = "# vtk DataFile Version 3.0\ncloth\nASCII\nDATASET POLYDATA\n",
                    mesh = "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
  put("f/0.vtk", head + "FIELD FieldData 2\nTimeValue 1 1 double\n0.5\nparts 2 1 unsigned_char\n1 2\n" + mesh);
  put("f/1.vtk", head + "FIELD FieldData 1\nTimeValue 1 1 double\n0.7\n" + mesh);
  EXPECT_NEAR(read("f/{frame}.vtk").step, 0.2, 1e-12);
  const auto grid = [](const std::string& type) {
    return "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
           "<UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" "
           "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 1</DataArray></Points><Cells><DataArray "
           "type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray><DataArray type=\"Int32\" "
           "Name=\"offsets\" format=\"ascii\">4</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
           "format=\"ascii\">" +
           type + "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
  };
  put("quad.vtu", grid("9"));
  EXPECT_EQ(read("quad.vtu").triangles, 2);
  put("tet.vtu", grid("10"));
  expect_refused("tet.vtu", "a cell is of type 10; expected polygons alone, of type 5, 7 or 9");
}

/// A USD triangle at heights that differ from sample to sample, at 10 time codes per second.
std::string rising_usd(const std::string& name, const std::vector<std::pair<int, double>>& heights,
                       const std::string& unit = "1") {
  std::string text = "#usda 1.0\n(\n upAxis = \"Z\"\n metersPerUnit = " + unit +
                     "\n timeCodesPerSecond = 10\n)\ndef Mesh \"" + name +
                     "\"\n{\n int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2]\n point3f[] "
                     "points.timeSamples = {\n";
  for (const auto& [code, z] : heights) {
    text += fmt::format("  {0}: [(0, 0, {1}), (1, 0, {1}), (0, 1, {1})],\n", code, z);
  }
  return text + " }\n}\n";
}

// A body of a USD file is where it is at the cloth's times, and has its own unit.
TEST_F(Strangers, HaveBodiesAtTheTimesOfTheCloth) {
  put("cloth.usda", rising_usd("Cloth", {{0, 5}, {1, 5}, {2, 5}, {3, 5}}));
  put("arm.usda", rising_usd("Arm", {{1, 100}, {3, 300}, {9, 900}}, "0.01"));
  read("cloth.usda", {.bodies = {path("arm.usda")}, .axes = {.scale = 2}});
  MotionReader reader(path("out.drape"));
  EXPECT_EQ(reader.state(0).x(2, 2), 10) << "twice the cloth's unit";
  const MotionScene folder(reader);
  const System system = make_system(folder.scene().simulation);
  const std::vector<double> expected{1, 1, 2, 3};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const std::vector<Collider> found = system.colliders_at(0.1 * static_cast<double>(k));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(std::get<MeshShape>(found[0]).positions(2, 2), expected[k], 1e-6) << k;
  }
}

TEST_F(Strangers, NeedTheSameTimesWhereTheyAreJoined) {
  put("slow.usda", rising_usd("Cloth", {{0, 1}, {1, 2}, {2, 3}}));
  put("fast.usda", rising_usd("Cloth", {{0, 1}, {2, 2}, {4, 3}}));
  Progress progress;
  const auto join = [&](std::optional<double> fps) {
    const ImportOptions options{.cloths = {path("slow.usda"), path("fast.usda")}, .fps = fps};
    import_motion(options, path("out.drape"), {}, progress);
  };
  const std::string found = usage_error([&] { join({}); });
  EXPECT_NE(found.find("its frame 1 is at 0.2 s, and that of"), std::string::npos) << found;
  join(10);
  EXPECT_EQ(MotionReader(path("out.drape")).states(), 3U);
}

/// Truncated and damaged files give a message or a motion, and nothing else.
TEST_F(Strangers, MayBeDamagedAnywhere) {
  const RandomMotion motion(3);
  motion.write_film<NpzWriter>(path("a.npz"));
  motion.write_frames(path("v"), ".vtp", vtp_writer(motion.info()));
  motion.write_frames(path("p"), ".ply", ply_writer(motion.info()));
  put("l0000.vtk",
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
      "POLYGONS 1 4\n3 0 1 2\n");
  Random random(8);
  for (const char* name : {"a.npz", "v0000.vtp", "p0000.ply", "l0000.vtk"}) {
    const std::string whole = content(path(name));
    const std::string damaged = std::string("damaged") + std::filesystem::path(name).extension().string();
    for (int i = 0; i < tries(60); ++i) {
      std::string bytes = whole;
      if (i % 3 == 0) bytes.resize(static_cast<std::size_t>(random.below(static_cast<int>(bytes.size()))));
      for (int k = 0; k < 3 && !bytes.empty(); ++k) {
        bytes[static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())))] =
            static_cast<char>(random.below(256));
      }
      put(damaged, bytes);
      const std::string found = usage_error([&] { read(damaged); });
      EXPECT_TRUE(found == "(no error)" || found.find(damaged) != std::string::npos) << found;
    }
  }
}

}  // namespace
}  // namespace drape::test

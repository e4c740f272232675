#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "drape/sim/settings.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/cli/without_opengl.hpp"

namespace drape::doctor {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;
using test::without_libraries;
using test::without_opengl;

const std::string scene = test::least_scene + "duration = 0.05\n[video]\nsize = [32, 32]\n";

TEST(Doctor, SaysInJsonWhatItFound) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "doctor --json");
  ASSERT_EQ(finished.code, 0) << finished.text;
  const auto json = nlohmann::json::parse(finished.text);
  EXPECT_TRUE(json.at("drawing").at("works"));
  EXPECT_EQ(json.at("backends").size(), 2U);
  for (const auto& backend : json.at("backends")) {
    if (!backend.at("works")) continue;
    EXPECT_FALSE(backend.at("renderer").get<std::string>().empty());
    EXPECT_GE(backend.at("max_samples"), 4);
    EXPECT_GE(backend.at("max_texture_size"), 4096);
  }
  for (const auto& output : json.at("outputs")) EXPECT_TRUE(output.at("works")) << output;
  EXPECT_GE(json.at("machine").at("threads"), 1);
}

TEST(Doctor, TriesEveryFormatWhateverTheFolderForTemporaryFilesIsCalled) {
  const SceneFolder folder;
  std::filesystem::create_directory(folder.path("{odd}"));
  const Finished finished = drape(folder, "doctor --json", "TMPDIR='" + folder.path("{odd}") + "'");
  std::vector<std::string> formats;
  const auto json = nlohmann::json::parse(finished.text);
  for (const auto& output : json.at("outputs")) {
    EXPECT_TRUE(output.at("works")) << output;
    formats.push_back(output.at("name"));
  }
  EXPECT_EQ(formats,
            (std::vector<std::string>{".gif", ".webp", ".apng", ".png", ".mp4", ".webm", ".avi", ".obj", ".ply", ".npz",
                                      ".usda", ".pvd", ".vtp", ".pc2", ".glb", ".html", ".drape"}));
}

TEST(Doctor, ObeysTheCapOnInstructionSets) {
  const SceneFolder folder;
  const std::string baseline = instruction_sets().front();
  const auto json = nlohmann::json::parse(drape(folder, "doctor --json", "DRAPE_ISA=" + baseline).text);
  EXPECT_EQ(json.at("instruction_set").at("chosen"), baseline);
  EXPECT_EQ(json.at("environment").at("DRAPE_ISA"), baseline);
}

TEST(Doctor, SaysWhatToInstallAndExitsWith4IfNothingCanDraw) {
  const SceneFolder folder;
  const std::string environment = without_opengl(folder);
  Finished finished = drape(folder, "doctor", environment);
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_NE(finished.text.find("\n  apt-get install --no-install-recommends libosmesa6 libegl1 libgl1-mesa-dri\n"),
            std::string::npos)
      << finished.text;
  finished = drape(folder, "doctor --json", environment);
  EXPECT_EQ(finished.code, 4);
  const auto json = nlohmann::json::parse(finished.text);
  EXPECT_FALSE(json.at("drawing").at("works"));
  EXPECT_EQ(json.at("missing_packages"), (nlohmann::json{"libosmesa6", "libegl1", "libgl1-mesa-dri"}));
}

TEST(Doctor, NoticesThatTextWouldBeMissing) {
  const SceneFolder folder;
  const auto optional = [&](const std::string& environment) {
    return nlohmann::json::parse(drape(folder, "doctor --json", environment).text).at("optional");
  };
  const auto here = optional("");
  if (!here.at(0).at("works")) GTEST_SKIP() << here.at(0).at("problem");
  EXPECT_EQ(here.at(0).at("name"), "diagrams");
  // No folder has fonts.
  const auto file = folder.write("fonts.conf", "<fontconfig></fontconfig>");
  const auto without = optional("FONTCONFIG_FILE='" + file.string() + "'");
  EXPECT_EQ(without.at(1).at("name"), "fonts");
  EXPECT_FALSE(without.at(1).at("works")) << without;
  EXPECT_EQ(without.at(1).at("packages"), "fonts-dejavu-core");
  EXPECT_EQ(without.at(2).at("name"), "text");
  EXPECT_FALSE(without.at(2).at("works")) << without;
}

TEST(Doctor, SaysWhichFontCaptionsAreWrittenIn) {
  const SceneFolder folder;
  const auto optional = nlohmann::json::parse(drape(folder, "doctor --json").text).at("optional");
  if (!optional.back().at("works")) GTEST_SKIP() << optional.back().at("problem");
  EXPECT_NE(optional.back().at("detail").get<std::string>().find("; Chinese from "), std::string::npos) << optional;
}

TEST(Captions, WithoutAFontAreRefusedBeforeTheRun) {
  const SceneFolder folder;
  const auto file = folder.write("fonts.conf", "<fontconfig></fontconfig>");
  folder.write("scene.toml", scene + "[caption]\ntext = \"t = {time}\"\n");
  const std::string environment = "FONTCONFIG_FILE='" + file.string() + "'";
  const Finished finished = drape(folder, "render scene.toml -o still.png", environment);
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_NE(finished.text.find("scene.toml:10:8: cannot draw text: no font is found; on Debian: apt-get install "
                               "fonts-dejavu-core"),
            std::string::npos)
      << finished.text;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "still.png"));
  EXPECT_EQ(drape(folder, "simulate scene.toml", environment).code, 0) << "nothing is drawn";
  folder.write("plain.toml", scene);
  EXPECT_EQ(drape(folder, "render plain.toml -o still.png", environment).code, 0) << "there is no text";
}

TEST(Doctor, DrawsWithEglIfThereIsNoOsMesa) {
  const SceneFolder folder;
  const auto present = nlohmann::json::parse(drape(folder, "doctor --json").text);
  if (!present.at("backends").at(1).at("works")) GTEST_SKIP() << present.at("backends").at(1).at("problem");
  const std::string environment = without_libraries(folder, test::osmesa_libraries);
  const Finished finished = drape(folder, "doctor --json", environment);
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_EQ(nlohmann::json::parse(finished.text).at("drawing").at("detail"), "egl");
  folder.write("scene.toml", scene);
  EXPECT_EQ(drape(folder, "render scene.toml -o still.png", environment).code, 0);
  EXPECT_EQ(drape(folder, "render scene.toml -o still.png --backend osmesa", environment).code, 4);
}

TEST(Backend, ThatIsMissingExitsWith4AndSaysWhatToInstall) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string environment = without_opengl(folder);
  const auto says = [&](const std::string& option, const std::string& what) {
    const Finished finished = drape(folder, "render scene.toml -o still.png " + option, environment);
    EXPECT_EQ(finished.code, 4) << finished.text;
    EXPECT_NE(finished.text.find(what), std::string::npos) << finished.text;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "still.png"));
  };
  says("--backend osmesa", "apt-get install libosmesa6");
  says("--backend egl", "apt-get install libegl1 libgl1-mesa-dri");
  says("", "apt-get install libosmesa6");
  says("", "apt-get install libegl1 libgl1-mesa-dri");
}

TEST(Backend, OfAnUnknownNameIsAUsageError) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  const Finished finished = drape(folder, "render scene.toml --backend osmessa");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("did you mean 'osmesa'"), std::string::npos) << finished.text;
}

}  // namespace
}  // namespace drape::doctor

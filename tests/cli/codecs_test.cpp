#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/run_drape.hpp"

// Encoders and decoders are in a module loaded at first use: drape starts without it, finds it wherever both were
// installed or moved, and reports its absence.

namespace drape::codecs_apart {
namespace {

namespace fs = std::filesystem;
using test::drape;
using test::Finished;
using test::run_shell;
using test::SceneFolder;

const std::string scene = test::least_scene + "duration = 0.05\n[video]\nsize = [32, 32]\n";

/// Returns the libraries that the loader opens in a run, one per line.
std::string loaded_by(const SceneFolder& folder, const std::string& arguments) {
  const Finished finished = drape(folder, arguments, "LD_DEBUG=files");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("libcholmod"), std::string::npos) << "the loader says nothing";
  return finished.text;
}

bool loads_codecs(const std::string& text) {
  return text.find("libopencv_imgcodecs") != std::string::npos || text.find("libavcodec") != std::string::npos;
}

TEST(Codecs, AreLoadedOnlyByWhatEncodesVideos) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  EXPECT_FALSE(loads_codecs(loaded_by(folder, "--version")));
  EXPECT_FALSE(loads_codecs(loaded_by(folder, "render --help")));
  EXPECT_FALSE(loads_codecs(loaded_by(folder, "simulate scene.toml --energies energies.csv -o last.obj")));
  EXPECT_FALSE(loads_codecs(loaded_by(folder, "render scene.toml -o last.png")));
  fs::copy_file(DRAPE_SOURCE_DIR "/tests/data/red.jpg", folder.path("texture.jpg"));
  EXPECT_FALSE(loads_codecs(loaded_by(folder, "render scene.toml --set look.texture=texture.jpg -o last.png")));
  EXPECT_FALSE(loads_codecs(loaded_by(folder, "render scene.toml -o film.gif")));
  EXPECT_TRUE(loads_codecs(loaded_by(folder, "render scene.toml -o film.avi")));
}

/// An installation by cmake --install, moved to another folder.
struct MovedTree : SceneFolder {
  MovedTree() {
    write("scene.toml", scene);
    const std::string install = std::string(DRAPE_CMAKE) + " --install " + DRAPE_BUILD_FOLDER + " --prefix ";
    const Finished finished = run_shell(*this, install + path("installed"));
    EXPECT_EQ(finished.code, 0) << finished.text;
    fs::rename(path("installed"), path("moved"));
    for (const auto& entry : fs::recursive_directory_iterator(path("moved"))) {
      if (entry.path().filename() == "codecs.so") module = entry.path();
    }
    EXPECT_FALSE(module.empty());
  }
  [[nodiscard]] Finished drape(const std::string& arguments) const {
    return run_shell(*this, "moved/bin/drape " + arguments);
  }
  fs::path module;
};

TEST(Codecs, AreFoundWhereTheProgramWasMovedTo) {
  const MovedTree tree;
  const Finished finished = tree.drape("render scene.toml -o film.gif -o film.avi -o last.png");
  EXPECT_EQ(finished.code, 0) << finished.text;
  const auto doctor = nlohmann::json::parse(tree.drape("doctor --json").text);
  EXPECT_EQ(fs::canonical(doctor.at("codecs").at("detail").get<std::string>()), fs::canonical(tree.module));
}

TEST(Codecs, ThatAreMissingAreMissedOnlyWhereTheyAreNeededAndAtOnce) {
  const MovedTree tree;
  fs::remove(tree.module);
  EXPECT_EQ(tree.drape("--version").code, 0);
  EXPECT_EQ(tree.drape("simulate scene.toml -o last.obj").code, 0);
  EXPECT_EQ(tree.drape("render scene.toml -o last.png -o film.gif").code, 0);
  for (const std::string file : {"film.mp4", "film.avi", "film.webp"}) {
    const Finished finished = tree.drape("render scene.toml -o " + file);
    EXPECT_EQ(finished.code, 4) << finished.text;
    EXPECT_NE(finished.text.find("cannot encode or decode: a part of drape is missing"), std::string::npos)
        << finished.text;
    EXPECT_EQ(finished.text.find("frames"), std::string::npos) << "it was drawn first: " << finished.text;
    EXPECT_FALSE(fs::exists(tree.path(file)));
  }
  const auto doctor = nlohmann::json::parse(tree.drape("doctor --json").text);
  EXPECT_FALSE(doctor.at("codecs").at("works"));
}

TEST(Codecs, ThatCannotBeLoadedSayWhatToInstall) {
  const MovedTree tree;
  const std::ofstream emptied(tree.module, std::ios::trunc);
  const Finished finished = tree.drape("render scene.toml -o film.avi");
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_NE(finished.text.find("apt-get install libopencv-dev"), std::string::npos) << finished.text;
}

}  // namespace
}  // namespace drape::codecs_apart

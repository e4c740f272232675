#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include "drape/core/rgb.hpp"
#include "drape/core/warp_weft.hpp"
#include "scene/tables.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

// The schema accepts the scenes that drape accepts, and rejects those with keys or values that drape rejects. The
// validator is independent.

namespace drape::schema_of_scenes {
namespace {

namespace fs = std::filesystem;
using test::Finished;
using test::SceneFolder;

constexpr const char* validator = R"(
import json, sys, tomllib, warnings
warnings.simplefilter("ignore")
import jsonschema
schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
for file in sys.stdin.read().split("\n")[:-1]:
    errors = [e.message[:200] for e in validator.iter_errors(tomllib.load(open(file, "rb")))]
    print(file, "|", errors[0].replace("\n", " ") if errors else "valid", sep="")
)";

/// Returns the validator's verdict on each file: "valid", or its error.
std::map<std::string, std::string> validate(const SceneFolder& folder, const std::vector<fs::path>& files) {
  folder.write("validate.py", validator);
  std::string list;
  for (const fs::path& file : files) list += file.string() + "\n";
  folder.write("files.txt", list);
  EXPECT_EQ(test::drape(folder, "schema -o schema.json").text, "");
  const Finished finished = test::run_shell(folder, "/usr/bin/python3 validate.py schema.json < files.txt");
  EXPECT_EQ(finished.code, 0) << finished.text;
  std::map<std::string, std::string> said;
  for (std::size_t begin = 0; begin < finished.text.size();) {
    const std::size_t end = finished.text.find('\n', begin), bar = finished.text.find('|', begin);
    said[finished.text.substr(begin, bar - begin)] = finished.text.substr(bar + 1, end - bar - 1);
    begin = end + 1;
  }
  return said;
}

bool has_validator(const SceneFolder& folder) {
  return test::run_shell(folder, "/usr/bin/python3 -W ignore -c 'import jsonschema, tomllib'").code == 0;
}

TEST(Schema, EverySceneIsValid) {
  const SceneFolder folder;
  if (!has_validator(folder)) GTEST_SKIP() << "no validator: apt-get install python3-jsonschema";
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(DRAPE_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  ASSERT_GT(files.size(), 60U);
  for (const auto& [file, verdict] : validate(folder, files)) EXPECT_EQ(verdict, "valid") << file;
}

TEST(Schema, EverySceneNamesTheSchemaThatTheProgramPrints) {
  const SceneFolder folder;
  const fs::path scenes = DRAPE_SOURCE_DIR "/scenes";
  const std::string printed = test::drape(folder, "schema").text;
  if (std::getenv("DRAPE_UPDATE_DOCS") != nullptr) test::ScratchFolder::put(scenes / "scene.schema.json", printed);
  EXPECT_EQ(test::content(scenes / "scene.schema.json"), printed)
      << "out of date: run this test with DRAPE_UPDATE_DOCS=1 and look at what changes";
  for (const auto& entry : fs::recursive_directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string text = test::content(entry.path()), directive = "#:schema ";
    ASSERT_TRUE(text.starts_with(directive)) << entry.path();
    const std::string named = text.substr(directive.size(), text.find('\n') - directive.size());
    EXPECT_TRUE(fs::equivalent(entry.path().parent_path() / named, scenes / "scene.schema.json")) << entry.path();
  }
}

/// Formats a number for TOML.
std::string number(double value, bool whole) {
  return whole ? fmt::format("{}", std::llround(value)) : fmt::format("{:.17e}", value);
}

/// Returns values that a key rejects, each wrong in one respect.
std::vector<std::string> wrong_values(const Key& key) {
  std::vector<std::string> wrong{"1979-05-27", "{ nonsense = 1 }"};
  std::size_t count = 0;  // of the key's numbers
  bool whole = false;
  const bool woven = key.pointer<std::optional<WarpWeft>>() != nullptr;  // one number or two
  if (woven || key.pointer<double>() != nullptr || key.pointer<std::optional<double>>() != nullptr) {
    count = 1;
  } else if (key.pointer<int>() != nullptr || key.pointer<std::optional<int>>() != nullptr) {
    count = 1, whole = true;
  } else if (key.pointer<Eigen::Vector2i>() != nullptr) {
    count = 2, whole = true;
  } else if (key.pointer<Eigen::Vector3d>() != nullptr) {
    count = 3;
  }
  const auto of = [&](double value) {
    std::string text = number(value, whole);
    for (std::size_t i = 1; i < count; ++i) text += ", " + number(value, whole);
    return count == 1 ? text : "[" + text + "]";
  };
  if (count > 0) {
    wrong.emplace_back("\"1\"");
    if (std::isfinite(key.minimum)) {
      wrong.push_back(of(key.minimum_excluded ? key.minimum : key.minimum - 1));
    }
    if (std::isfinite(key.maximum)) wrong.push_back(of(key.maximum + 1));
  }
  if (count > 1 || woven) wrong.emplace_back("[1]");
  if (key.as<Choice>() != nullptr) wrong.emplace_back("\"nonsense\"");
  if (key.pointer<Rgb>() != nullptr) wrong.emplace_back("\"#12345\"");
  if (key.pointer<bool>() != nullptr) wrong.emplace_back("1");
  return wrong;
}

TEST(Schema, RefusesWhatDrapeRefuses) {
  const SceneFolder folder;
  if (!has_validator(folder)) GTEST_SKIP() << "no validator: apt-get install python3-jsonschema";
  std::vector<fs::path> files;
  const auto add = [&](const std::string& text) {
    files.push_back(folder.write(fmt::format("{}.toml", files.size()), text));
    EXPECT_THROW(static_cast<void>(load_scene(files.back())), Error) << text;
  };
  const std::string mesh = "mesh = { grid = [2, 2] }\n", cloth = "[cloth]\n" + mesh + "stiffness = 10\n";
  const auto add_keys = [&](const TableType& table) {
    for (const Key& key : table.keys.all()) {
      for (const std::string& value : wrong_values(key)) {
        std::string line = key.name + " = " + value + "\n";
        if (table.name != "cloth") {
          add(cloth + "[" + table.name + "]\n" + line);
        } else if (key.name != "mesh") {
          add("[cloth]\n" + mesh + (key.name == "stiffness" ? "" : "stiffness = 10\n") + line);
        }
      }
    }
    if (table.name != "cloth") add(cloth + "[" + table.name + "]\nnonsense = 1\n");
  };
  for_each_table(add_keys);
  for (const char* text :
       {"", "nonsense = 1\n", "[cloth]\nstiffness = 1\n", "[cloth]\nmesh = { grid = [2, 2] }\n",
        "[cloth]\nmesh = { grid = [0, 2] }\nstiffness = 1\n", "[cloth]\nmesh = { grid = [2] }\nstiffness = 1\n",
        "[cloth]\nmesh = { prim = \"/a\" }\nstiffness = 1\n", "[cloth]\nmesh = 3\nstiffness = 1\n"}) {
    add(text);
  }
  for (const char* pins :
       {"3", "[-1]", "[\"corner\"]", "[\"corner:w+\"]", "[{ every = 2 }]", "[{ box = 1 }]",
        "[{ ball = { radius = 1 } }]", "[{ border = \"up\" }]", "[{ border = \"all\", every = 0 }]"}) {
    add(cloth + "pins = " + pins + "\n");
  }
  ASSERT_GT(files.size(), 100U);
  const std::map<std::string, std::string> said = validate(folder, files);
  EXPECT_EQ(said.size(), files.size());
  for (const auto& [file, verdict] : said) EXPECT_NE(verdict, "valid") << test::content(file);
}

TEST(Schema, SaysWhereItCannotBeWritten) {
  const SceneFolder folder;
  const Finished finished = test::drape(folder, "schema -o .");
  EXPECT_NE(finished.code, 0);
  EXPECT_NE(finished.text.find("a folder"), std::string::npos) << finished.text;
}

}  // namespace
}  // namespace drape::schema_of_scenes

#include "tests/cli/documents.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

namespace drape::test {
namespace {

/// Returns the text of a comment "<!-- key: text -->", or nothing.
std::string mark(const std::string& line, const std::string& key) {
  const std::string begin = "<!-- " + key + ": ", end = " -->";
  if (!line.starts_with(begin) || !line.ends_with(end)) return {};
  return line.substr(begin.size(), line.size() - begin.size() - end.size());
}

std::string without_comment(const std::string& command) {
  const std::size_t comment = command.find("  #");
  const std::string text = comment == std::string::npos ? command : command.substr(0, comment);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

int code_of(const std::string& test) { return test.starts_with("exit ") ? std::stoi(test.substr(5)) : 0; }

}  // namespace

std::vector<std::filesystem::path> pages_of(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> pages;
  const auto add = [&](const fs::path& file) {
    if (file.extension() == ".md") pages.push_back(file.lexically_relative(folder));
  };
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("README.")) add(entry.path());
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder / "docs")) add(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

std::vector<Block> blocks_of(const std::filesystem::path& page) {
  std::ifstream text(page);
  std::vector<Block> blocks;
  Block next;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.starts_with("```")) {
      if (inside) blocks.push_back(std::exchange(next, {}));
      inside = !inside;
      if (!inside) continue;
      next.language = line.substr(3);
      next.line = number + 1;
    } else if (inside) {
      next.lines.push_back(line);
    } else if (const std::string file = mark(line, "file"); !file.empty()) {
      next.file = file;
    } else if (const std::string test = mark(line, "test"); !test.empty()) {
      next.test = test;
    }
  }
  return blocks;
}

std::vector<QuotedCommand> commands_of(const Block& block) {
  std::vector<QuotedCommand> commands;
  const bool console = block.language == "console";
  if (!console && !block.language.empty() && block.language != "sh") return commands;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    const std::string& line = block.lines[i];
    const int number = block.line + static_cast<int>(i);
    if (console && line.starts_with("$ ")) {
      commands.push_back({line.substr(2), {}, code_of(block.test), number});
    } else if (!console && line.starts_with("drape ")) {
      commands.push_back({without_comment(line), {}, code_of(block.test), number});
    } else if (console && !commands.empty()) {
      commands.back().output.push_back(line);
    }
  }
  return commands;
}

bool is_as_quoted(const std::string& quoted, const std::string& line) {
  const std::string any = "…";
  std::size_t at = 0, begin = 0;
  for (bool first = true;; first = false) {
    const std::size_t end = quoted.find(any, begin);
    const std::string part = quoted.substr(begin, end == std::string::npos ? end : end - begin);
    if (end == std::string::npos) {  // the last part must match the end
      if (first) return line == part;
      return line.size() >= at + part.size() && line.ends_with(part);
    }
    const std::size_t found = first ? (line.starts_with(part) ? 0 : std::string::npos) : line.find(part, at);
    if (found == std::string::npos) return false;
    at = found + part.size();
    begin = end + any.size();
  }
}

bool are_as_quoted(const std::vector<std::string>& quoted, const std::vector<std::string>& output) {
  std::size_t at = 0;
  bool others = false;  // other lines may precede the next quoted line
  for (const std::string& line : quoted) {
    if (line == "…") {
      others = true;
      continue;
    }
    while (others && at < output.size() && !is_as_quoted(line, output[at])) ++at;
    if (at == output.size() || !is_as_quoted(line, output[at])) return false;
    ++at;
    others = false;
  }
  return others || at == output.size();
}

}  // namespace drape::test

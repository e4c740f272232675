#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape::test {

/// A command of a page, with what the page quotes of its output.
struct QuotedCommand {
  std::string command;
  std::vector<std::string> output;  ///< lines; empty: nothing is quoted
  int code = 0;                     ///< that it should end with
  int line = 0;                     ///< of the page
};

/// A fenced block of a Markdown page, and the marks in HTML comments before it:
///   <!-- file: NAME -->      the block is this file
///   <!-- test: skip WHY -->  installs something, or belongs to another system
///   <!-- test: nightly -->   takes minutes
///   <!-- test: exit N -->    its commands end with this code
struct Block {
  std::string language, file, test;
  std::vector<std::string> lines;
  int line = 0;  ///< of the first of them in the page
};

std::vector<Block> blocks_of(const std::filesystem::path& page);

/// The commands of a block: of a `console`, what follows "$ ", with the output up to the next; of one without a
/// language or of `sh`, the lines that begin with "drape ".
std::vector<QuotedCommand> commands_of(const Block& block);

/// Whether a line is as it is quoted, where "…" stands for anything.
bool is_as_quoted(const std::string& quoted, const std::string& line);

/// Whether the output is as it is quoted: the quoted lines in order, and others only where a line "…" stands.
bool are_as_quoted(const std::vector<std::string>& quoted, const std::vector<std::string>& output);

}  // namespace drape::test

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape::test {

/// A command of a page, with its quoted output.
struct QuotedCommand {
  std::string command;
  std::vector<std::string> output;  ///< lines; empty: no output is quoted
  int code = 0;                     ///< expected exit code
  int line = 0;                     ///< line number in the page
};

/// A fenced block of a Markdown page, and its directives in preceding HTML comments:
///   <!-- file: NAME -->      the block is this file
///   <!-- test: skip WHY -->  installs programs, or belongs to another system
///   <!-- test: nightly -->   takes minutes
///   <!-- test: exit N -->    its commands exit with this code
struct Block {
  std::string language, file, test;
  std::vector<std::string> lines;
  int line = 0;  ///< line number of the first one in the page
};

/// Returns README.md, its translations and all pages of docs/ below a folder, relative to it, in order.
std::vector<std::filesystem::path> pages_of(const std::filesystem::path& folder);

std::vector<Block> blocks_of(const std::filesystem::path& page);

/// Returns the commands of a block. In a `console` block they follow "$ ", each with the output up to the next; in a
/// block without a language or of `sh` they are the lines that begin with "drape ".
std::vector<QuotedCommand> commands_of(const Block& block);

/// Returns true if a line matches its quotation, in which "…" matches any text.
bool is_as_quoted(const std::string& quoted, const std::string& line);

/// Returns true if the output matches its quotation: the quoted lines in order, and others only at a line "…".
bool are_as_quoted(const std::vector<std::string>& quoted, const std::vector<std::string>& output);

}  // namespace drape::test

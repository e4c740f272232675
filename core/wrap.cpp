#include "core/wrap.hpp"

#include <algorithm>

namespace drape {
namespace {

constexpr std::size_t least_room = 20;      // columns that must remain after the indent
constexpr std::size_t description_at = 30;  // column of CLI11's descriptions

std::size_t indent_of(std::string_view line) {
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string_view::npos ? 0 : first;
}

std::string wrapped_line(std::string_view line, std::size_t width, std::size_t indent) {
  if (columns_of(line) <= width || width < indent + least_room) return std::string(line);
  const std::size_t begin = indent_of(line);
  std::string text(begin, ' ');
  std::size_t used = begin;
  bool at_start = true;  // of a line of the result
  for (std::size_t at = begin; at < line.size();) {
    // A word with the spaces before it; they are dropped only where the line is broken.
    const std::size_t word = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = std::min(line.find(' ', word), line.size());
    const std::string_view spaces = line.substr(at, word - at), letters = line.substr(word, end - word);
    if (!at_start && used + spaces.size() + columns_of(letters) > width) {
      text.append("\n").append(indent, ' ').append(letters);
      used = indent + columns_of(letters);
    } else {
      text.append(spaces).append(letters);
      used += spaces.size() + columns_of(letters);
    }
    at_start = false;
    at = end;
  }
  return text;
}

template <class Indent>
std::string wrapped_lines(std::string_view text, std::size_t width, Indent indent) {
  if (width == unlimited_width) return std::string(text);
  std::string result;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    result += wrapped_line(line, width, indent(line));
    if (end < text.size()) result += '\n';
    begin = end + 1;
  }
  return result;
}

}  // namespace

std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t hanging) {
  return wrapped_lines(text, width, [hanging](std::string_view line) { return indent_of(line) + hanging; });
}

std::string wrapped_help(std::string_view text, std::size_t width) {
  return wrapped_lines(text, width, [](std::string_view line) {
    const bool described = line.size() > description_at && indent_of(line) > 0 && line[description_at - 1] == ' ' &&
                           line[description_at] != ' ';
    return described ? description_at : indent_of(line) + 2;
  });
}

}  // namespace drape

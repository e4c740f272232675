#include "output/sink.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>

#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"

namespace drape {

PathTemplate::PathTemplate(std::string_view text) : text_(text) {
  const auto append = [this](char c) {
    if (pieces_.empty() || pieces_.back().kind != Piece::Kind::text) pieces_.push_back({Piece::Kind::text, {}});
    pieces_.back().text += c;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool doubled = (c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c;
    if (doubled) {
      append(c);
      ++i;
    } else if (c == '{') {
      const std::size_t end = text.find('}', i);
      if (end == std::string_view::npos) throw UsageError(fmt::format("a '}}' is missing in the output path {}", text));
      pieces_.push_back(placeholder(text.substr(i + 1, end - i - 1)));
      i = end;
    } else if (c == '}') {
      throw UsageError(fmt::format("a '}}' without '{{' in the output path {}; write '}}}}' for a brace", text));
    } else {
      append(c);
    }
  }
}

PathTemplate::Piece PathTemplate::placeholder(std::string_view inside) const {
  const std::size_t colon = inside.find(':');
  const std::string_view name = inside.substr(0, colon);
  if (inside == "scene") return {Piece::Kind::scene, {}};
  if (inside == "frame") return {Piece::Kind::frame, {}};
  if (name == "frame") {
    constexpr int widest = 18;
    const std::string_view width = inside.substr(colon + 1);
    Piece piece{Piece::Kind::frame, {}};
    const auto [end, error] = std::from_chars(width.data(), width.data() + width.size(), piece.width);
    const bool complete = error == std::errc{} && end == width.data() + width.size();
    if (complete && piece.width >= 1 && piece.width <= widest) return piece;
    throw UsageError(
        fmt::format("'{{{}}}' in the output path {}: expected a number of digits, as in {{frame:04}}", inside, text_));
  }
  const std::vector<std::string> names{"scene", "frame"};
  const std::string nearest = nearest_name(name, names);
  throw UsageError(
      fmt::format("unknown placeholder '{{{}}}' in the output path {}; {}the valid ones are {{scene}}, "
                  "{{frame}} and {{frame:04}}",
                  inside, text_, nearest.empty() ? "" : fmt::format("did you mean '{{{}}}'? ", nearest)));
}

bool PathTemplate::has_frame() const {
  return std::any_of(pieces_.begin(), pieces_.end(), [](const Piece& p) { return p.kind == Piece::Kind::frame; });
}

std::string PathTemplate::path(std::string_view scene, int frame, int default_width) const {
  std::string result;
  for (const Piece& piece : pieces_) {
    switch (piece.kind) {
      case Piece::Kind::text:
        result += piece.text;
        break;
      case Piece::Kind::scene:
        result += name_in_folder(scene, text_, "{scene}");
        break;
      case Piece::Kind::frame:
        result += fmt::format("{:0{}}", frame, piece.width ? piece.width : default_width);
        break;
    }
  }
  return result;
}

}  // namespace drape

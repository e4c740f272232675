#include "overlay/text_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace drape {
namespace {

constexpr std::string_view digits = "0123456789";

/// Returns true for a format of {fmt} without names and numbers of arguments, and with widths of at most two digits.
bool well_formed(std::string_view format) {
  const auto take = [&](std::string_view any) {
    if (format.empty() || any.find(format.front()) == std::string_view::npos) return false;
    format.remove_prefix(1);
    return true;
  };
  const auto number = [&] { return !take(digits) || !take(digits) || !take(digits); };  // at most two digits
  if (format.size() > 1 && std::string_view("<>^").find(format[1]) != std::string_view::npos) format.remove_prefix(1);
  take("<>^");
  take("+- ");
  take("#");
  take("0");
  if (!number()) return false;
  if (take(".") && (format.empty() || digits.find(format.front()) == std::string_view::npos || !number())) return false;
  take("aAbBcdeEfFgGosxX");
  return format.empty();
}

std::string format_number(double number, const std::string& format) {
  return fmt::format(fmt::runtime("{:" + (format.empty() ? std::string(".6g") : format) + "}"), number);
}

struct FormatField {
  const std::string& format;

  std::string operator()(std::int64_t number) const {
    // Whole numbers accept formats with decimals.
    if (!format.empty() && std::string_view("eEfFgG").find(format.back()) != std::string_view::npos) {
      return format_number(static_cast<double>(number), format);
    }
    return fmt::format(fmt::runtime("{:" + format + "}"), number);
  }
  std::string operator()(double number) const { return format_number(number, format); }
  std::string operator()(const std::string& word) const { return fmt::format(fmt::runtime("{:" + format + "}"), word); }
  std::string operator()(const std::vector<double>& numbers) const {
    std::string text = "[";
    for (const double number : numbers) text += (text.size() > 1 ? ", " : "") + format_number(number, format);
    return text + "]";
  }
};

}  // namespace

std::string format_field(const FieldValue& value, const std::string& format) {
  try {
    if (well_formed(format)) return std::visit(FormatField{format}, value);
  } catch (const fmt::format_error&) {
    // reported below
  }
  throw std::invalid_argument(
      fmt::format("unknown format '{}'; {}", format,
                  std::holds_alternative<std::string>(value)
                      ? "text takes only a width, as in ':>12'"
                      : "a number takes one like ':.2f', ':.1e', ':.3g', ':6.1f' or, if it is whole, ':04'"));
}

TextTemplate::TextTemplate(std::string_view text) {
  std::string plain;
  const auto end_plain = [&] {
    if (!plain.empty()) pieces_.push_back({plain, false, {}});
    plain.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '{' && text[i] != '}') {
      plain += text[i];
    } else if (i + 1 < text.size() && text[i + 1] == text[i]) {
      plain += text[i++];
    } else if (text[i] == '}') {
      throw std::invalid_argument("there is a '}' without its '{'; write '}}' for a brace");
    } else {
      const std::size_t end = text.find_first_of("{}", i + 1);
      if (end == std::string_view::npos || text[end] == '{') {
        throw std::invalid_argument(fmt::format("'{}' has no '}}'; write '{{{{' for a brace",
                                                text.substr(i, std::min<std::size_t>(text.size() - i, 24))));
      }
      const std::string_view field = text.substr(i + 1, end - i - 1);
      const std::size_t colon = std::min(field.find(':'), field.size());
      end_plain();
      pieces_.push_back(
          {std::string(field.substr(0, colon)), true, std::string(field.substr(std::min(colon + 1, field.size())))});
      i = end;
    }
  }
  end_plain();
}

std::string TextTemplate::fill(const std::function<FieldValue(const std::string&)>& value) const {
  std::string text;
  for (const Piece& piece : pieces_)
    text += piece.is_field ? format_field(value(piece.text), piece.format) : piece.text;
  return text;
}

}  // namespace drape

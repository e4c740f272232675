#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace drape {

/// Value of a field of a text: a number, a word, or several numbers.
using FieldValue = std::variant<std::int64_t, double, std::string, std::vector<double>>;

/// Formats a value as text.
/// @param format format of {fmt}: [[fill]align][sign][#][0][width][.precision][type], applied to each of several
///               numbers. Empty: numbers have at most six digits.
/// @throws std::invalid_argument with the error in the format
std::string format_field(const FieldValue& value, const std::string& format);

/// A text with fields in braces: "t = {time:.2f} s". "{{" and "}}" are braces.
class TextTemplate {
 public:
  struct Piece {
    std::string text;  ///< plain text, or the name of a field
    bool is_field = false;
    std::string format;  ///< of a field, see format_field()
    bool operator==(const Piece&) const = default;
  };

  TextTemplate() = default;
  /// @throws std::invalid_argument with the error in the braces
  explicit TextTemplate(std::string_view text);

  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

  /// Replaces a field by text.
  void replace(std::size_t piece, std::string text) { pieces_[piece] = {std::move(text), false, {}}; }

  /// Fills in all fields.
  /// @param value returns a field's value by its name
  [[nodiscard]] std::string fill(const std::function<FieldValue(const std::string&)>& value) const;

 private:
  std::vector<Piece> pieces_;
};

}  // namespace drape

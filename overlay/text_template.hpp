#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace drape {

/// What a field of a text can stand for: a number, a word, or several numbers.
using FieldValue = std::variant<std::int64_t, double, std::string, std::vector<double>>;

/// A value as text.
/// @param format empty, or as {fmt} has it: [[fill]align][sign][#][0][width][.precision][type]; each of several numbers
///               has it. Without one a number has six digits at most.
/// @throws std::invalid_argument saying what is wrong with the format
std::string format_field(const FieldValue& value, const std::string& format);

/// A text with fields in braces: "t = {time:.2f} s". "{{" and "}}" are braces.
class TextTemplate {
 public:
  struct Piece {
    std::string text;  ///< as it is, or the name of a field
    bool is_field = false;
    std::string format;  ///< of a field, see format_field()
    bool operator==(const Piece&) const = default;
  };

  TextTemplate() = default;
  /// @throws std::invalid_argument saying what is wrong with the braces
  explicit TextTemplate(std::string_view text);

  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

  /// Puts text in the place of a field.
  void replace(std::size_t piece, std::string text) { pieces_[piece] = {std::move(text), false, {}}; }

  /// The text.
  /// @param value of a field, by its name
  [[nodiscard]] std::string fill(const std::function<FieldValue(const std::string&)>& value) const;

 private:
  std::vector<Piece> pieces_;
};

}  // namespace drape

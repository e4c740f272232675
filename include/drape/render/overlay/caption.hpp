#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drape/core/rgb.hpp"
#include "drape/render/image.hpp"
#include "drape/render/overlay/pen.hpp"

namespace drape {

/// Value of a template field: a number, a word, or several numbers.
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
    std::string format;  ///< format of a field, see format_field()
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

/// Position in a picture. Enumerators have the order of their names in scenes.
enum class CaptionPlace { top_left, top, top_right, bottom_left, bottom, bottom_right };

/// A text on every picture of a film.
struct CaptionSettings {
  std::string text;     ///< text from the scene
  TextTemplate filled;  ///< template with all constant fields filled in
  CaptionPlace place = CaptionPlace::top_left;
  std::optional<int> size;   ///< font size [pixels]; absent: text_size() of the picture
  std::optional<Rgb> color;  ///< absent: black or white, whichever contrasts more with the background
  Backing backing = Backing::halo;
};

/// Content of the bands below the picture.
struct OverlaySettings {
  bool energies = false;
};

/// Returns the default text size for a picture: readable, and no larger than necessary [pixels].
int text_size(int picture_height);

/// Smallest readable text size [pixels].
inline constexpr int least_text_size = 6;

/// Returns the largest text size up to `most` [pixels] with which a caption and its margin fit into a picture.
/// @returns 0 if the caption would be too small to read
int largest_caption_size(Pen& pen, const std::string& text, int most, int width, int height);

/// Checks that a caption fits into the picture. A caption without a size may shrink, down to `least_text_size`.
/// @param text longest text that may appear
/// @throws UsageError with the largest size that fits, if there is one
void require_room(Pen& pen, const CaptionSettings& caption, const std::string& text, int width, int height);

/// Writes a caption into a picture, in as many lines as needed. A caption that has outgrown the picture during the film
/// is written smaller.
/// @param text       text at this moment
/// @param background colour behind the caption; a caption without its own colour contrasts with it
void draw_caption(Image& picture, Pen& pen, const CaptionSettings& caption, const std::string& text,
                  const Rgb& background);

}  // namespace drape

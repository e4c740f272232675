#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// An output path with placeholders: {scene}, {frame}, {frame:04}; "{{" and "}}" stand for a brace.
class PathTemplate {
 public:
  /// @throws UsageError that names the valid placeholders if it has an unknown one
  explicit PathTemplate(std::string_view text);

  /// Returns true if the path contains {frame}, so that each frame has its own file.
  [[nodiscard]] bool has_frame() const;

  /// @param default_width digits of a {frame} without a width; larger numbers get as many as they need
  /// @throws UsageError if the scene's name leads out of a folder, see name_in_folder()
  [[nodiscard]] std::string path(std::string_view scene, int frame, int default_width) const;

 private:
  struct Piece {
    enum class Kind { text, scene, frame } kind;
    std::string text;
    int width = 0;  // digits of a frame's number; 0: the default
  };

  Piece placeholder(std::string_view inside) const;

  std::string text_;
  std::vector<Piece> pieces_;
};

}  // namespace drape

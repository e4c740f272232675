#pragma once

#include <string>
#include <vector>

namespace drape::test {

/// Names of scenes, files and machines with a special meaning, if not escaped, in HTML, XML, Markdown, LaTeX,
/// spreadsheets, shells, terminals, build servers or Slurm. A shell that executes one makes a file "owned".
inline const std::vector<std::string> hostile_names{"it's \"quoted\"",
                                                    "<script>alert(1)</script>",
                                                    "<img src=x onerror=alert(1)>&amp;",
                                                    "]]>--><!--",
                                                    "a\nb",
                                                    "c\n::error title=owned::d",
                                                    "e\r\n  ::warning::f##[add-mask]g",
                                                    "h\n#SBATCH --wrap=owned",
                                                    "red \x1b[31m and \x1b]0;title\x07",
                                                    std::string("eight bits \xc2\x9b") + "31m \xff\x9b",
                                                    "right to left \xe2\x80\xaegpj \xe2\x80\x8f\xe2\x81\xa6",
                                                    "line \xe2\x80\xa8 separator",
                                                    "`touch owned`",
                                                    "$(touch owned)",
                                                    "'; touch owned; '",
                                                    "\"; touch owned; \"",
                                                    "${HOME} $HOME !! ~",
                                                    "100%a %n %s {} {scene}",
                                                    "=1+1",
                                                    "+cmd|' /C calc'!A0",
                                                    "-x",
                                                    "--help",
                                                    "@SUM(A1)",
                                                    "a|b*c_d[e](f)~~g~~$h$",
                                                    "[1cm] \\input{x} a\\b{c}^d~e#f&g",
                                                    "* ",
                                                    "tab\tand back\\slash",
                                                    std::string(4096, 'x')};

/// Returns true for a text with control characters, or characters that change the direction of writing.
inline bool has_controls(const std::string& text) {
  for (const unsigned char c : text) {
    if ((c < 0x20 && c != '\n' && c != '\t') || c == 0x7f) return true;
  }
  for (const char* sign : {"\xc2\x9b", "\xff", "\xe2\x80\xae", "\xe2\x80\x8f", "\xe2\x81\xa6", "\xe2\x80\xa8"}) {
    if (text.find(sign) != std::string::npos) return true;
  }
  return false;
}

}  // namespace drape::test

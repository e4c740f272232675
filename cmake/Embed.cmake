# Writes HEADER with the texts of FOLDER's NAMES (separated by spaces) as constants: page.css becomes page_css.
separate_arguments(NAMES)
set(text "#pragma once\n#include <string_view>\nnamespace drape::html {\n")
foreach(name ${NAMES})
  file(READ ${FOLDER}/${name} content)
  string(REPLACE . _ constant ${name})
  string(APPEND text "inline constexpr std::string_view ${constant} = R\"embedded(${content})embedded\";\n")
endforeach()
file(WRITE ${HEADER} "${text}}  // namespace drape::html\n")

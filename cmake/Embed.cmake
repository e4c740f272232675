# Writes HEADER with the texts of FOLDER/page.css and FOLDER/page.js as constants.
set(text "#pragma once\n#include <string_view>\nnamespace drape::html {\n")
foreach(kind css js)
  file(READ ${FOLDER}/page.${kind} content)
  string(APPEND text "inline constexpr std::string_view page_${kind} = R\"embedded(${content})embedded\";\n")
endforeach()
file(WRITE ${HEADER} "${text}}  // namespace drape::html\n")

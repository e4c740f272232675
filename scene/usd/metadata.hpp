#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/usd/layer.hpp"
#include "scene/usd/lexer.hpp"

namespace drape {

/// One entry `edit key = value` in the parentheses after a layer, prim or attribute.
struct UsdMetadatum {
  std::string edit;  ///< list edit, "prepend", …; empty: none
  std::string key;
  struct Value {
    UsdToken::Kind kind = UsdToken::Kind::end;
    std::size_t offset = 0;
    std::string text;
  } value;  ///< first token of the value
};

/// Reads the entries after '(' up to and including ')', whatever their values; skips comments.
/// @param owner owner for messages: "the file"
std::vector<UsdMetadatum> usd_metadata(UsdLexer& lexer, const std::string& owner);

/// Returns true at a word that edits a list.
bool at_list_edit(const UsdLexer& lexer);

/// Returns the finite number of an entry.
/// @throws UsageError if it is not one, or not positive where required
double usd_number(const SourceText& source, const UsdMetadatum& datum, bool positive);

/// Returns the arcs in a list of references, payloads, inherited prims or sublayers; none for None and deleted items.
std::vector<UsdArc> usd_arcs(const SourceText& source, const UsdMetadatum& datum, UsdArc::Kind kind);

/// Returns the selections of `variants = { string set = "variant" }`.
std::vector<std::pair<std::string, std::string>> usd_selections(const SourceText& source, const UsdMetadatum& datum);

/// Reads the metadata of a layer after its header; the lexer is behind '('.
void read_layer_metadata(const SourceText& source, UsdLexer& lexer, UsdLayer& layer);

/// Reads the metadata of a prim or a variant before its '{'; the lexer is behind '('.
void read_prim_metadata(const SourceText& source, UsdLexer& lexer, const std::string& owner, UsdSpec& prim);

}  // namespace drape

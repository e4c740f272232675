#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/usd/layer.hpp"
#include "scene/usd/lexer.hpp"

namespace drape {

/// `edit key = value` in the parentheses behind a layer, prim or attribute.
struct UsdMetadatum {
  std::string edit;  ///< "prepend", …, or nothing
  std::string key;
  struct Value {
    UsdToken::Kind kind = UsdToken::Kind::end;
    std::size_t offset = 0;
    std::string text;
  } value;  ///< its first token
};

/// Goes past what follows '(' up to and including ')', whatever its values are; comments are passed over.
/// @param owner for messages: "the file"
std::vector<UsdMetadatum> usd_metadata(UsdLexer& lexer, const std::string& owner);

/// Whether the lexer is at a word that says how a list is edited.
bool at_list_edit(const UsdLexer& lexer);

/// The finite number that a key has.
/// @throws UsageError if it is not one, or not a positive one where it has to be
double usd_number(const SourceText& source, const UsdMetadatum& datum, bool positive);

/// What a list of references, payloads, inherited prims or sublayers names; nothing for None, and for what is deleted.
std::vector<UsdArc> usd_arcs(const SourceText& source, const UsdMetadatum& datum, UsdArc::Kind kind);

/// What `variants = { string set = "variant" }` selects.
std::vector<std::pair<std::string, std::string>> usd_selections(const SourceText& source, const UsdMetadatum& datum);

/// What a layer says of itself behind its header; the lexer is behind '('.
void read_layer_metadata(const SourceText& source, UsdLexer& lexer, UsdLayer& layer);

/// What a prim or a variant says of itself before its '{'; the lexer is behind '('.
void read_prim_metadata(const SourceText& source, UsdLexer& lexer, const std::string& owner, UsdSpec& prim);

}  // namespace drape

#include "scene/usd/metadata.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

namespace drape {
namespace {

using Kind = UsdToken::Kind;

constexpr std::array<std::string_view, 5> list_edits = {"add", "append", "delete", "prepend", "reorder"};

/// Returns a token's text without its delimiters: one character, or three @, at each end.
std::string unwrapped(const UsdToken& token) {
  const std::size_t width = token.kind == Kind::asset && token.text.starts_with("@@@") ? 3 : 1;
  return std::string(token.text.substr(width, token.text.size() - 2 * width));
}

/// Parses @file@, </Prim> or both, and an optional shift of times.
UsdArc arc(const SourceText& source, UsdLexer& lexer, UsdArc::Kind kind) {
  UsdArc arc{.kind = kind, .file = {}, .path = {}, .place = {&source, lexer.token().offset}};
  const bool has_file = lexer.at(Kind::asset);
  if (has_file) arc.file = unwrapped(lexer.take());
  if (lexer.at(Kind::path)) {
    arc.path = unwrapped(lexer.take());
  } else if (!has_file) {
    lexer.fail_expected("a file name such as @file.usda@ or a path such as </Prim>");
  }
  if (!lexer.accept('(')) return arc;
  for (const UsdMetadatum& datum : usd_metadata(lexer, "the reference")) {
    if (datum.key == "offset") arc.offset = usd_number(source, datum, false);
    if (datum.key == "scale") arc.scale = usd_number(source, datum, true);
  }
  return arc;
}

}  // namespace

bool at_list_edit(const UsdLexer& lexer) {
  return std::any_of(list_edits.begin(), list_edits.end(), [&](auto word) { return lexer.at_word(word); });
}

std::vector<UsdMetadatum> usd_metadata(UsdLexer& lexer, const std::string& owner) {
  std::vector<UsdMetadatum> found;
  while (!lexer.accept(')')) {
    if (lexer.accept(';') || lexer.accept(',')) continue;
    if (lexer.at(Kind::string)) {  // a comment
      lexer.take();
      continue;
    }
    std::string edit(at_list_edit(lexer) ? lexer.take().text : std::string_view());
    std::string key(lexer.expect(Kind::word, "')' or a key in the metadata of " + owner).text);
    lexer.expect('=', fmt::format("'=' after {}", key));
    const UsdToken& value = lexer.token();
    found.push_back({std::move(edit), std::move(key), {value.kind, value.offset, std::string(value.text)}});
    lexer.skip_value();
    if (lexer.at('(')) lexer.skip_value();  // time shift of a reference
  }
  return found;
}

double usd_number(const SourceText& source, const UsdMetadatum& datum, bool positive) {
  const std::string what = fmt::format("a {} number for {}", positive ? "positive" : "finite", datum.key);
  const std::optional<double> value = UsdLexer(source, datum.value.offset).accept_number();
  if (!value || (positive && *value <= 0)) {
    source.fail(datum.value.offset, fmt::format("expected {}, found {}", what, in_quotes(datum.value.text)));
  }
  return *value;
}

std::vector<UsdArc> usd_arcs(const SourceText& source, const UsdMetadatum& datum, UsdArc::Kind kind) {
  std::vector<UsdArc> arcs;
  UsdLexer lexer(source, datum.value.offset);
  if (datum.edit == "delete" || datum.edit == "reorder" || lexer.at_word("None")) return arcs;
  if (!lexer.accept('[')) return {arc(source, lexer, kind)};
  while (!lexer.accept(']')) {
    arcs.push_back(arc(source, lexer, kind));
    if (!lexer.at(']')) lexer.expect(',', fmt::format("',' or ']' in {}", datum.key));
  }
  return arcs;
}

std::vector<std::pair<std::string, std::string>> usd_selections(const SourceText& source, const UsdMetadatum& datum) {
  std::vector<std::pair<std::string, std::string>> selections;
  UsdLexer lexer(source, datum.value.offset);
  lexer.expect('{', "'{' and the variants that are selected");
  while (!lexer.accept('}')) {
    if (lexer.accept(';') || lexer.accept(',')) continue;
    lexer.expect(Kind::word, "'}' or 'string' before the name of a variant set");
    const bool quoted = lexer.at(Kind::string);
    std::string set(lexer.expect(quoted ? Kind::string : Kind::word, "the name of a variant set").text);
    lexer.expect('=', fmt::format("'=' after {}", set));
    selections.emplace_back(std::move(set), lexer.expect(Kind::string, "the name of a variant in quotes").text);
  }
  return selections;
}

void read_layer_metadata(const SourceText& source, UsdLexer& lexer, UsdLayer& layer) {
  bool has_time_codes_per_second = false;
  for (const UsdMetadatum& datum : usd_metadata(lexer, "the file")) {
    if (datum.key == "upAxis") {
      if (datum.value.text != "Y" && datum.value.text != "Z") {
        source.fail(datum.value.offset, "upAxis: expected \"Y\" or \"Z\", found " + in_quotes(datum.value.text));
      }
      layer.z_up = datum.value.text == "Z";
    } else if (datum.key == "metersPerUnit") {
      layer.metres_per_unit = usd_number(source, datum, true);
    } else if (datum.key == "timeCodesPerSecond") {
      layer.time_codes_per_second = usd_number(source, datum, true);
      has_time_codes_per_second = true;
    } else if (datum.key == "framesPerSecond" && !has_time_codes_per_second) {
      layer.time_codes_per_second = usd_number(source, datum, true);
    } else if (datum.key == "startTimeCode") {
      layer.start_time_code = usd_number(source, datum, false);
    } else if (datum.key == "defaultPrim" && datum.value.kind == Kind::string) {
      layer.default_prim = datum.value.text;
    } else if (datum.key == "subLayers") {
      layer.sublayers = usd_arcs(source, datum, UsdArc::Kind::sublayer);
    }
  }
}

void read_prim_metadata(const SourceText& source, UsdLexer& lexer, const std::string& owner, UsdSpec& prim) {
  using Arc = UsdArc::Kind;
  constexpr std::array<std::pair<std::string_view, Arc>, 5> arc_names = {{{"inherits", Arc::inherits},
                                                                          {"references", Arc::reference},
                                                                          {"payload", Arc::payload},
                                                                          {"payloads", Arc::payload},
                                                                          {"specializes", Arc::specializes}}};
  for (const UsdMetadatum& datum : usd_metadata(lexer, owner)) {
    const auto* kind =
        std::find_if(arc_names.begin(), arc_names.end(), [&](const auto& k) { return k.first == datum.key; });
    if (kind != arc_names.end()) {
      const std::vector<UsdArc> arcs = usd_arcs(source, datum, kind->second);
      const auto where = datum.edit == "prepend" ? prim.arcs.begin() : prim.arcs.end();
      prim.arcs.insert(where, arcs.begin(), arcs.end());
    } else if (datum.key == "variants") {
      prim.selections = usd_selections(source, datum);
    }
  }
}

}  // namespace drape

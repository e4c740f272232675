#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "scene/usd/layer.hpp"
#include "scene/usd/lexer.hpp"
#include "scene/usd/metadata.hpp"
#include "scene/usd/value.hpp"

namespace drape {
namespace {

using Kind = UsdToken::Kind;

/// Limit of nested prims. Real scenes have a few dozen; it protects the stack against hostile files.
constexpr int most_depth = 200;

/// Limit of elements per point; rarely more than eight joints move a point.
constexpr double most_per_element = 1000;

bool is_specifier(const UsdLexer& lexer) {
  return lexer.at_word("def") || lexer.at_word("over") || lexer.at_word("class");
}

/// Returns true if UsdLayer keeps an attribute.
bool is_kept(std::string_view name, std::string_view type, const UsdReading& reading) {
  constexpr std::array<std::string_view, 15> kept_names = {
      "points",       "faceVertexCounts", "faceVertexIndices",  "orientation",  "radius",    "axis",
      "xformOpOrder", "joints",           "bindTransforms",     "translations", "rotations", "restTransforms",
      "scales",       "skel:joints",      "skel:skinningMethod"};
  constexpr std::string_view primvars_prefix = "primvars:";
  if (std::find(kept_names.begin(), kept_names.end(), name) != kept_names.end() || name.starts_with("xformOp:"))
    return true;
  if (!name.starts_with(primvars_prefix)) return false;
  const std::string_view primvar = name.substr(primvars_prefix.size());
  return type.starts_with("texCoord2") || type.ends_with('2') || name.ends_with(":indices") ||
         primvar.starts_with("skel:") || primvar == reading.primvar;
}

/// Returns true for an attribute that can answer a request for a primvar.
bool is_primvar_of_numbers(const UsdAttribute& attribute) {
  return attribute.is_array && attribute.components == 1 && attribute.name.starts_with("primvars:") &&
         !attribute.name.ends_with(":indices");
}

bool is_kept_relationship(std::string_view name) { return name == "skel:skeleton" || name == "skel:animationSource"; }

class Parser {
 public:
  Parser(const SourceText& source, const UsdReading& reading)
      : source_(source), reading_(reading), lexer_(source, check_header(source)) {}

  UsdLayer layer() {
    UsdLayer layer;
    if (lexer_.accept('(')) read_layer_metadata(source_, lexer_, layer);
    while (!lexer_.at(Kind::end)) {
      if (lexer_.at_word("reorder")) {
        skip_reorder();
      } else {
        layer.prims.push_back(prim(0));
      }
    }
    return layer;
  }

 private:
  static std::size_t check_header(const SourceText& source) {
    std::string memory;
    const std::string_view text = source.piece(0, memory);
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (!text.substr(0, end).starts_with("#usda 1.")) {
      source.fail(0, "expected '#usda 1.0', found " + in_quotes(text.substr(0, end)));
    }
    return end;
  }

  void skip_reorder() {
    lexer_.take();
    lexer_.expect(Kind::word, "what to reorder");
    lexer_.expect('=', "'='");
    lexer_.skip_value();
  }

  UsdSpec prim(int depth) {
    if (!is_specifier(lexer_)) lexer_.fail_expected("'def', 'over' or 'class'");
    UsdSpec prim;
    prim.place = {&source_, lexer_.token().offset};
    prim.is_defined = lexer_.take().text == "def";
    if (lexer_.at(Kind::word)) prim.type = lexer_.take().text;
    prim.name = lexer_.expect(Kind::string, "the prim's name in quotes").text;
    read_body(prim, "the prim " + in_quotes(prim.name), depth);
    return prim;
  }

  /// Reads the metadata and statements of a prim or of one of its variants.
  void read_body(UsdSpec& prim, const std::string& owner, int depth) {
    if (depth == most_depth) prim.place.fail(fmt::format("prims nested deeper than {}", most_depth));
    if (lexer_.accept('(')) read_prim_metadata(source_, lexer_, owner, prim);
    lexer_.expect('{', "'{' after the name of " + owner);
    while (!lexer_.at('}')) {
      if (lexer_.at(Kind::end)) {
        lexer_.fail_expected(fmt::format("'}}' to close {} of line {}", owner, source_.line(prim.place.offset)));
      }
      read_item(prim, depth);
    }
    lexer_.take();
  }

  void read_item(UsdSpec& prim, int depth) {
    if (lexer_.accept(';')) return;
    if (is_specifier(lexer_)) {
      prim.children.push_back(this->prim(depth + 1));
    } else if (lexer_.at_word("variantSet")) {
      prim.variant_sets.push_back(variant_set(depth + 1));
    } else if (lexer_.at_word("reorder")) {
      skip_reorder();
    } else {
      read_property(prim);
    }
  }

  UsdVariantSet variant_set(int depth) {
    lexer_.take();
    UsdVariantSet set;
    set.name = lexer_.expect(Kind::string, "the variant set's name in quotes").text;
    lexer_.expect('=', "'='");
    lexer_.expect('{', "'{' before the variants of " + in_quotes(set.name));
    while (!lexer_.accept('}')) {
      UsdSpec& variant = set.variants.emplace_back();
      variant.place = {&source_, lexer_.token().offset};
      variant.name = lexer_.expect(Kind::string, "'}' or the name of a variant in quotes").text;
      read_body(variant, "the variant " + in_quotes(variant.name), depth);
    }
    return set;
  }

  void read_property(UsdSpec& prim) {
    if (at_list_edit(lexer_)) lexer_.take();
    while (lexer_.at_word("custom") || lexer_.at_word("uniform") || lexer_.at_word("varying") ||
           lexer_.at_word("config")) {
      lexer_.take();
    }
    UsdAttribute declared;
    declared.place = {&source_, lexer_.token().offset};
    declared.type = lexer_.expect(Kind::word, "'}' or a property of the prim " + in_quotes(prim.name)).text;
    if (lexer_.accept('[')) {
      lexer_.expect(']', "']' after '['");
      declared.is_array = true;
    }
    declared.name = lexer_.expect(Kind::word, "a property's name").text;
    const UsdType type = usd_type(declared.type);
    declared.components = type.components();
    const bool kept = type.kind != UsdType::Kind::other && is_kept(declared.name, declared.type, reading_);

    std::string aspect;
    if (lexer_.accept('.')) aspect = lexer_.expect(Kind::word, "'timeSamples' or 'connect'").text;
    if (!kept) {
      const bool relationship = declared.type == "rel" && is_kept_relationship(declared.name);
      if (lexer_.accept('=')) {
        if (relationship) prim.relationships.push_back({std::string(declared.name), targets()});
        if (!relationship) lexer_.skip_value();
      }
      if (lexer_.accept('(')) usd_metadata(lexer_, declared.name);
      if (!reading_.primvar.empty() && is_primvar_of_numbers(declared)) find_or_add(prim, std::move(declared));
      return;
    }
    UsdAttribute& attribute = find_or_add(prim, std::move(declared));
    if (lexer_.accept('=')) read_aspect(attribute, type, aspect);
    if (!lexer_.accept('(')) return;
    for (const UsdMetadatum& datum : usd_metadata(lexer_, attribute.name)) {
      if (datum.key == "interpolation") attribute.interpolation = datum.value.text;
      if (datum.key == "elementSize") read_element_size(datum, attribute);
    }
  }

  void read_element_size(const UsdMetadatum& datum, UsdAttribute& attribute) const {
    const double size = usd_number(source_, datum, true);
    if (size != std::floor(size) || size > most_per_element) {
      source_.fail(datum.value.offset, fmt::format("elementSize: expected a whole number from 1 to {}, found {}",
                                                   most_per_element, datum.value.text));
    }
    attribute.element_size = static_cast<std::size_t>(size);
  }

  /// Reads the paths of a relationship: one, several between brackets, or None.
  std::vector<std::string> targets() {
    std::vector<std::string> paths;
    const auto read = [&] {
      const std::string_view path = lexer_.expect(Kind::path, "a path such as </Prim>").text;
      paths.emplace_back(path.substr(1, path.size() - 2));
    };
    if (lexer_.at_word("None")) {
      lexer_.take();
    } else if (!lexer_.accept('[')) {
      read();
    } else {
      while (!lexer_.accept(']')) {
        read();
        if (!lexer_.at(']')) lexer_.expect(',', "',' or ']' after a path");
      }
    }
    return paths;
  }

  /// Finds or adds an attribute: its default value and its time samples are two statements.
  static UsdAttribute& find_or_add(UsdSpec& prim, UsdAttribute&& declared) {
    for (UsdAttribute& attribute : prim.attributes) {
      if (attribute.name != declared.name) continue;
      if (attribute.components == declared.components && attribute.is_array == declared.is_array) return attribute;
      attribute = std::move(declared);
      return attribute;
    }
    return prim.attributes.emplace_back(std::move(declared));
  }

  void read_aspect(UsdAttribute& attribute, const UsdType& type, std::string_view aspect) {
    if (aspect == "timeSamples") {
      read_samples(attribute, type);
    } else if (aspect.empty() || aspect == "default") {
      attribute.value = parse_usd_value(source_, lexer_, attribute, type);
    } else {
      lexer_.skip_value();
    }
  }

  void read_samples(UsdAttribute& attribute, const UsdType& type) {
    const std::string owner = "the time samples of " + attribute.name;
    const bool all = reading_.moving_points || attribute.name.starts_with("xformOp:");
    std::vector<UsdSample> samples;
    lexer_.expect('{', "'{' before " + owner);
    while (!lexer_.accept('}')) {
      const std::optional<double> time = lexer_.accept_number();
      if (!time) lexer_.fail_expected("'}' or a finite time in " + owner);
      lexer_.expect(':', "':' after the time in " + owner);
      std::optional<UsdValue> sample = read_sample(attribute, type, samples.empty());
      if (sample && (all || samples.empty())) {
        samples.push_back({*time, std::move(*sample)});
      } else if (sample && *time < samples.front().time) {
        samples.front() = {*time, std::move(*sample)};
      }
      if (!lexer_.at('}')) lexer_.expect(',', "',' or '}' in " + owner);
    }
    std::stable_sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    for (std::size_t i = 1; i < samples.size(); ++i) {
      if (samples[i - 1].time < samples[i].time) continue;
      samples[i].value.place.fail(fmt::format("the time {} appears twice in {}", samples[i].time, owner));
    }
    if (!samples.empty()) samples.front().value = usd_value_of(attribute, samples.front().value);
    attribute.samples = std::move(samples);
  }

  /// Reads the value at the lexer's token, or only its place.
  std::optional<UsdValue> read_sample(const UsdAttribute& attribute, const UsdType& type, bool first) {
    const bool located = reading_.located_points && attribute.name == "points" && !first && !lexer_.at_word("None");
    if (!located) return parse_usd_value(source_, lexer_, attribute, type);
    UsdValue value;
    value.place = {&source_, lexer_.token().offset};
    value.located = true;
    lexer_.skip_value();
    return value;
  }

  const SourceText& source_;
  const UsdReading& reading_;
  UsdLexer lexer_;
};

}  // namespace

UsdLayer parse_usd(const SourceText& source, const UsdReading& reading) { return Parser(source, reading).layer(); }

}  // namespace drape

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "scene/usd/layer.hpp"
#include "scene/usd/lexer.hpp"
#include "scene/usd/value.hpp"

namespace drape {
namespace {

using Kind = UsdToken::Kind;

/// Real scenes nest a few dozen prims; the cap keeps a hostile file from exhausting the stack.
constexpr int kMaxDepth = 200;

constexpr std::array<std::string_view, 5> kListEdits = {"add", "append", "delete", "prepend", "reorder"};

bool is_list_edit(const UsdLexer& lexer) {
  return std::any_of(kListEdits.begin(), kListEdits.end(), [&](auto word) { return lexer.at_word(word); });
}

bool is_specifier(const UsdLexer& lexer) {
  return lexer.at_word("def") || lexer.at_word("over") || lexer.at_word("class");
}

/// Whether an attribute is one that UsdLayer keeps.
bool is_kept(std::string_view name, std::string_view type) {
  constexpr std::array<std::string_view, 6> kNames = {"points",      "faceVertexCounts", "faceVertexIndices",
                                                      "orientation", "radius",           "xformOpOrder"};
  if (std::find(kNames.begin(), kNames.end(), name) != kNames.end()) return true;
  if (name.starts_with("xformOp:")) return true;
  return name.starts_with("primvars:") &&
         (type.starts_with("texCoord2") || type.ends_with('2') || name.ends_with(":indices"));
}

/// `key = value` in the parentheses behind a layer, prim or attribute, where the value is a single token.
struct Metadatum {
  std::string_view key;
  UsdToken value;
};

class Parser {
 public:
  explicit Parser(const SourceText& source) : source_(source), lexer_(source, check_header(source)) {}

  UsdLayer layer() {
    UsdLayer layer;
    if (lexer_.accept('(')) read_layer_metadata(layer);
    while (!lexer_.at(Kind::end)) {
      if (lexer_.at_word("reorder")) {
        skip_reorder();
      } else {
        layer.prims.push_back(prim(0));
      }
    }
    layer.mesh_in_variant = mesh_in_variant_;
    return layer;
  }

 private:
  static std::size_t check_header(const SourceText& source) {
    const std::string_view text = source.text();
    if (text.starts_with("PXR-USDC")) {
      source.fail("this is a binary USD file (usdc); export it as ASCII, with the ending .usda");
    }
    if (text.starts_with("PK\x03\x04")) {
      source.fail("this is a packed USD file (usdz); export it as ASCII, with the ending .usda");
    }
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (!text.substr(0, end).starts_with("#usda 1.")) {
      source.fail(0, "expected '#usda 1.0', found " + in_quotes(text.substr(0, end)));
    }
    return end;
  }

  void read_layer_metadata(UsdLayer& layer) {
    bool has_time_codes_per_second = false;
    for (const Metadatum& datum : metadata("the file")) {
      if (datum.key == "upAxis") {
        if (datum.value.text != "Y" && datum.value.text != "Z") {
          source_.fail(datum.value.offset, "upAxis: expected \"Y\" or \"Z\", found " + in_quotes(datum.value.text));
        }
        layer.z_up = datum.value.text == "Z";
      } else if (datum.key == "metersPerUnit") {
        layer.metres_per_unit = number_of(datum, true);
      } else if (datum.key == "timeCodesPerSecond") {
        layer.time_codes_per_second = number_of(datum, true);
        has_time_codes_per_second = true;
      } else if (datum.key == "framesPerSecond" && !has_time_codes_per_second) {
        layer.time_codes_per_second = number_of(datum, true);
      } else if (datum.key == "startTimeCode") {
        layer.start_time_code = number_of(datum, false);
      }
    }
  }

  double number_of(const Metadatum& datum, bool positive) const {
    const std::string what = fmt::format("a {} number for {}", positive ? "positive" : "finite", datum.key);
    const std::optional<double> value = UsdLexer(source_, datum.value.offset).accept_number();
    if (!value || (positive && *value <= 0)) {
      source_.fail(datum.value.offset, fmt::format("expected {}, found {}", what, in_quotes(datum.value.text)));
    }
    return *value;
  }

  /// What follows '(' up to and including ')'. Lists, dictionaries and comments are passed over.
  std::vector<Metadatum> metadata(const std::string& owner) {
    std::vector<Metadatum> found;
    while (!lexer_.accept(')')) {
      if (lexer_.accept(';') || lexer_.accept(',')) continue;
      if (lexer_.at(Kind::string)) {  // a comment
        lexer_.take();
        continue;
      }
      if (is_list_edit(lexer_)) lexer_.take();
      const std::string_view key = lexer_.expect(Kind::word, "')' or a key in the metadata of " + owner).text;
      lexer_.expect('=', fmt::format("'=' after {}", key));
      if (lexer_.at(Kind::string) || lexer_.at(Kind::number)) found.push_back({key, lexer_.token()});
      lexer_.skip_value();
      if (lexer_.at('(')) lexer_.skip_value();  // the layer offset of a payload
    }
    return found;
  }

  void skip_reorder() {
    lexer_.take();
    lexer_.expect(Kind::word, "what to reorder");
    lexer_.expect('=', "'='");
    lexer_.skip_value();
  }

  UsdPrim prim(int depth) {
    if (!is_specifier(lexer_)) lexer_.fail_expected("'def', 'over' or 'class'");
    UsdPrim prim;
    prim.offset = lexer_.token().offset;
    if (depth == kMaxDepth) source_.fail(prim.offset, fmt::format("prims nested deeper than {}", kMaxDepth));
    prim.is_defined = lexer_.take().text == "def";
    if (lexer_.at(Kind::word)) prim.type = lexer_.take().text;
    prim.name = lexer_.expect(Kind::string, "the prim's name in quotes").text;
    const std::string owner = "the prim " + in_quotes(prim.name);
    if (lexer_.accept('(')) metadata(owner);
    lexer_.expect('{', "'{' after the name of " + owner);
    while (!lexer_.at('}')) {
      if (lexer_.at(Kind::end)) {
        lexer_.fail_expected(fmt::format("'}}' to close {} of line {}", owner, source_.line(prim.offset)));
      }
      read_item(prim, depth);
    }
    lexer_.take();
    return prim;
  }

  void read_item(UsdPrim& prim, int depth) {
    if (lexer_.accept(';')) return;
    if (is_specifier(lexer_)) {
      prim.children.push_back(this->prim(depth + 1));
    } else if (lexer_.at_word("variantSet")) {
      skip_variants();
    } else if (lexer_.at_word("reorder")) {
      skip_reorder();
    } else {
      read_property(prim);
    }
  }

  void skip_variants() {
    lexer_.take();
    lexer_.expect(Kind::string, "the variant set's name in quotes");
    lexer_.expect('=', "'='");
    UsdLexer inside = lexer_;
    lexer_.skip_value();
    while (!mesh_in_variant_ && inside.token().offset < lexer_.token().offset) {
      const UsdToken token = inside.take();
      if (token.kind == Kind::word && token.text == "def" && inside.at_word("Mesh")) mesh_in_variant_ = token.offset;
    }
  }

  void read_property(UsdPrim& prim) {
    if (is_list_edit(lexer_)) lexer_.take();
    while (lexer_.at_word("custom") || lexer_.at_word("uniform") || lexer_.at_word("varying") ||
           lexer_.at_word("config")) {
      lexer_.take();
    }
    UsdAttribute declared;
    declared.offset = lexer_.token().offset;
    declared.type = lexer_.expect(Kind::word, "'}' or a property of the prim " + in_quotes(prim.name)).text;
    if (lexer_.accept('[')) {
      lexer_.expect(']', "']' after '['");
      declared.is_array = true;
    }
    declared.name = lexer_.expect(Kind::word, "a property's name").text;
    const UsdType type = usd_type(declared.type);
    declared.components = type.components();
    const bool kept = type.kind != UsdType::Kind::other && is_kept(declared.name, declared.type);

    std::string_view aspect;
    if (lexer_.accept('.')) aspect = lexer_.expect(Kind::word, "'timeSamples' or 'connect'").text;
    if (!kept) {
      if (lexer_.accept('=')) lexer_.skip_value();
      if (lexer_.accept('(')) metadata(declared.name);
      return;
    }
    UsdAttribute& attribute = find_or_add(prim, std::move(declared));
    if (lexer_.accept('=')) read_aspect(attribute, type, aspect);
    if (!lexer_.accept('(')) return;
    for (const Metadatum& datum : metadata(attribute.name)) {
      if (datum.key == "interpolation") attribute.interpolation = datum.value.text;
    }
  }

  /// An attribute's value and its time samples are two statements.
  static UsdAttribute& find_or_add(UsdPrim& prim, UsdAttribute&& declared) {
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
      attribute.value = parse_usd_value(lexer_, attribute, type);
    } else {
      lexer_.skip_value();
    }
  }

  void read_samples(UsdAttribute& attribute, const UsdType& type) {
    const std::string owner = "the time samples of " + attribute.name;
    // Only motion needs more than one sample; the shapes of a deforming mesh would be many megabytes.
    const bool all = attribute.name.starts_with("xformOp:");
    std::vector<UsdSample> samples;
    lexer_.expect('{', "'{' before " + owner);
    while (!lexer_.accept('}')) {
      const std::optional<double> time = lexer_.accept_number();
      if (!time) lexer_.fail_expected("'}' or a finite time in " + owner);
      lexer_.expect(':', "':' after the time in " + owner);
      std::optional<UsdValue> sample = parse_usd_value(lexer_, attribute, type);
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
      source_.fail(samples[i].value.offset, fmt::format("the time {} appears twice in {}", samples[i].time, owner));
    }
    attribute.samples = std::move(samples);
  }

  const SourceText& source_;
  UsdLexer lexer_;
  std::optional<std::size_t> mesh_in_variant_;
};

}  // namespace

const UsdAttribute* UsdPrim::find(std::string_view attribute) const {
  for (const UsdAttribute& candidate : attributes) {
    if (candidate.name == attribute) return &candidate;
  }
  return nullptr;
}

UsdLayer parse_usd(const SourceText& source) { return Parser(source).layer(); }

}  // namespace drape

#include "scene/usd/parser.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "scene/usd/layer.hpp"
#include "scene/usd/stage.hpp"

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

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Bytes from 0x80 on are letters of UTF-8 names.
bool starts_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

bool continues_word(char c) { return starts_word(c) || is_digit(c); }

std::string found(const UsdToken& token) {
  return token.kind == UsdToken::Kind::end ? "the end of the file" : in_quotes(token.text);
}

char closing(char opening) { return opening == '(' ? ')' : opening == '[' ? ']' : '}'; }

}  // namespace

UsdLexer::UsdLexer(const SourceText& source, std::size_t offset)
    : source_(&source), begin_of_text_(offset), ended_(!source.stays_in_file()) {
  std::string piece;
  const std::string_view text = source.piece(offset, piece);
  if (source.stays_in_file()) {
    memory_ = std::make_shared<const std::string>(std::move(piece));
    text_ = *memory_;
  } else {
    text_ = text;
  }
  token_ = scan();
}

/// Appends a piece to the text in memory and keeps the current token.
/// @returns false at the end of the text
bool UsdLexer::read_more() {
  if (ended_) return false;
  std::string kept(text_.substr(begin_)), piece;
  const std::size_t before = kept.size();
  // Double the text, so that the time for a token of any length is linear.
  do {
    ended_ = source_->piece(begin_of_text_ + begin_ + kept.size(), piece).empty();
    kept += piece;
  } while (!ended_ && kept.size() < 2 * before);
  if (kept.size() == before) return false;
  // The previous token lies in the memory in which this scan began.
  if (memory_before_ == nullptr) memory_before_ = memory_;
  memory_ = std::make_shared<const std::string>(std::move(kept));
  text_ = *memory_;
  begin_of_text_ += begin_;
  next_ -= begin_;
  begin_ = 0;
  return true;
}

/// Advances to the next occurrence of a mark, or to the end of the text.
/// @param keep true if the current token extends up to there
void UsdLexer::find(std::string_view mark, bool keep) {
  do {
    const std::size_t found = text_.find(mark, next_);
    if (found != std::string_view::npos) {
      next_ = found;
      return;
    }
    next_ = std::max(next_, text_.size() - std::min(text_.size(), mark.size() - 1));
    if (!keep) begin_ = next_;
  } while (read_more());
  next_ = text_.size();
}

void UsdLexer::skip_blanks_and_comments() {
  while (!at_end()) {
    begin_ = next_;  // drop everything before
    const char c = peek();
    if (c == '#' || (c == '/' && peek(1) == '/')) {
      find("\n", false);
    } else if (c == '/' && peek(1) == '*') {
      const std::size_t offset = here();
      next_ += 2;
      find("*/", false);
      if (at_end()) source_->fail(offset, "this comment is never closed");
      next_ += 2;
    } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++next_;
    } else {
      return;
    }
  }
  begin_ = next_;
}

UsdToken UsdLexer::scan() {
  using Kind = UsdToken::Kind;
  memory_before_.reset();
  skip_blanks_and_comments();
  if (at_end()) return {Kind::end, here(), {}};
  const auto token = [&](Kind kind) {
    return UsdToken{kind, begin_of_text_ + begin_, text_.substr(begin_, next_ - begin_)};
  };

  const char c = peek();
  const std::size_t sign = c == '-' || c == '+' ? 1 : 0;
  if (is_digit(peek(sign)) || (peek(sign) == '.' && is_digit(peek(sign + 1)))) {
    next_ += sign;
    while (is_digit(peek()) || peek() == '.') ++next_;
    const std::size_t exponent_sign = peek(1) == '-' || peek(1) == '+' ? 1 : 0;
    if ((peek() == 'e' || peek() == 'E') && is_digit(peek(1 + exponent_sign))) {
      next_ += 1 + exponent_sign;
      while (is_digit(peek())) ++next_;
    }
    return token(Kind::number);
  }
  if (starts_word(peek(sign))) {  // with a sign: -inf
    next_ += sign;
    while (continues_word(peek()) || (peek() == ':' && (continues_word(peek(1)) || peek(1) == ':'))) ++next_;
    return token(Kind::word);
  }
  if (c == '"' || c == '\'') return scan_string(c);
  if (c == '@') return scan_asset();
  if (c == '<') {
    while (!at_end() && peek() != '>' && peek() != '\n') ++next_;
    if (peek() != '>') source_->fail(begin_of_text_ + begin_, "this path is never closed by '>'");
    ++next_;
    return token(Kind::path);
  }
  if (c == '\0' || std::string_view("()[]{}=,:;.&").find(c) == std::string_view::npos) {
    source_->fail(here(), "unexpected character " + in_quotes(text_.substr(begin_, 1)));
  }
  ++next_;
  return token(Kind::symbol);
}

UsdToken UsdLexer::scan_string(char quote) {
  const bool triple = peek(1) == quote && peek(2) == quote;
  const std::size_t width = triple ? 3 : 1;
  for (next_ += width; !at_end(); ++next_) {
    if (peek() == '\\') {
      if (peek(1) != '\0') ++next_;
    } else if (peek() == '\n' && !triple) {
      break;
    } else if (peek() == quote && (!triple || (peek(1) == quote && peek(2) == quote))) {
      const std::string_view inside = text_.substr(begin_ + width, next_ - begin_ - width);
      next_ += width;
      return {UsdToken::Kind::string, begin_of_text_ + begin_, inside};
    }
  }
  source_->fail(begin_of_text_ + begin_, fmt::format("this string is never closed by {}", std::string(width, quote)));
}

UsdToken UsdLexer::scan_asset() {
  const std::string_view mark = peek(1) == '@' && peek(2) == '@' ? "@@@" : "@";
  next_ += mark.size();
  find(mark, true);
  if (at_end()) {
    source_->fail(begin_of_text_ + begin_, fmt::format("this file name is never closed by {}", mark));
  }
  next_ += mark.size();
  return {UsdToken::Kind::asset, begin_of_text_ + begin_, text_.substr(begin_, next_ - begin_)};
}

UsdToken UsdLexer::take() {
  const UsdToken taken = token_;
  token_ = scan();
  return taken;
}

bool UsdLexer::accept(char symbol) {
  if (!at(symbol)) return false;
  take();
  return true;
}

UsdToken UsdLexer::expect(UsdToken::Kind kind, const std::string& what) {
  if (!at(kind)) fail_expected(what);
  return take();
}

void UsdLexer::expect(char symbol, const std::string& what) {
  if (!accept(symbol)) fail_expected(what);
}

void UsdLexer::fail_expected(const std::string& what) const {
  source_->fail(token_.offset, fmt::format("expected {}, found {}", what, found(token_)));
}

std::optional<double> UsdLexer::accept_number() {
  if (!at(UsdToken::Kind::number)) return std::nullopt;
  const std::string_view digits = token_.text.substr(token_.text[0] == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
  take();
  return value;
}

void UsdLexer::skip_brackets() {
  struct Bracket {
    char sign;
    std::size_t offset;
  };
  std::vector<Bracket> open;
  do {
    if (at('(') || at('[') || at('{')) {
      open.push_back({token_.text[0], token_.offset});
    } else if (at(')') || at(']') || at('}') || at(UsdToken::Kind::end)) {
      const char expected = closing(open.back().sign);
      if (!at(expected)) {
        fail_expected(
            fmt::format("'{}' for the '{}' of line {}", expected, open.back().sign, source_->line(open.back().offset)));
      }
      open.pop_back();
    }
    take();
  } while (!open.empty());
}

void UsdLexer::skip_value() {
  if (at('(') || at('[') || at('{')) return skip_brackets();
  if (at(UsdToken::Kind::end) || at(UsdToken::Kind::symbol)) fail_expected("a value");
  // A reference to a prim of another file is two tokens, @file@</Prim>.
  if (take().kind == UsdToken::Kind::asset && at(UsdToken::Kind::path)) take();
}

}  // namespace drape

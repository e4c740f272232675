#include "scene/usd/stage.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <unordered_map>
#include <vector>

#include "drape/core/error.hpp"

namespace drape {
namespace {

void collect(const std::vector<UsdPrim>& prims, std::initializer_list<std::string_view> types, bool also_undefined,
             UsdPath& path, std::vector<UsdPath>& found) {
  for (const UsdPrim& prim : prims) {
    if (!prim.is_defined && !also_undefined) continue;
    path.push_back(&prim);
    if (types.size() == 0 || std::find(types.begin(), types.end(), prim.type) != types.end()) found.push_back(path);
    collect(prim.children, types, also_undefined, path, found);
    path.pop_back();
  }
}

}  // namespace

const UsdAttribute* UsdPrim::find(std::string_view attribute) const {
  const UsdAttribute* strongest = nullptr;
  for (const UsdAttribute* candidate : attributes) {
    if (candidate->name != attribute) continue;
    if (candidate->first() != nullptr) return candidate;
    if (strongest == nullptr) strongest = candidate;
  }
  return strongest;
}

std::vector<std::filesystem::path> UsdStage::referenced_files() const {
  std::vector<std::filesystem::path> files;
  for (const SourceText& text : texts_) files.emplace_back(text.name());
  return files;
}

UsdPath UsdStage::find(std::string_view path) const {
  UsdPath found;
  const UsdPrim* at = &root_;
  while (!path.empty()) {
    if (path.front() != '/') return {};
    path.remove_prefix(1);
    const std::string_view name = path.substr(0, path.find('/'));
    const auto child =
        std::find_if(at->children.begin(), at->children.end(), [&](const UsdPrim& p) { return p.name == name; });
    if (child == at->children.end()) return {};
    found.push_back(at = &*child);
    path.remove_prefix(name.size());
  }
  return found;
}

std::vector<UsdPath> find_prims(const UsdStage& stage, std::initializer_list<std::string_view> types,
                                bool also_undefined) {
  std::vector<UsdPath> found;
  UsdPath path;
  collect(stage.prims(), types, also_undefined, path, found);
  return found;
}

std::string inherited_target(const UsdPath& path, std::string_view relationship) {
  for (auto prim = path.rbegin(); prim != path.rend(); ++prim) {
    for (const UsdRelationship& candidate : (*prim)->relationships) {
      if (candidate.name == relationship && !candidate.targets.empty()) return candidate.targets.front();
    }
  }
  return {};
}

const UsdAttribute* inherited_attribute(const UsdPath& path, std::string_view name) {
  for (auto prim = path.rbegin(); prim != path.rend(); ++prim) {
    const UsdAttribute* attribute = (*prim)->find(name);
    if (attribute != nullptr && attribute->first() != nullptr) return attribute;
  }
  return nullptr;
}

namespace {

constexpr int most_arcs = 64;                   // depth of nested arcs
constexpr std::size_t most_nested = 200;        // depth of nested prims, as in one file
constexpr std::size_t most_specs = 1 << 20;     // visited, of all prims together
constexpr std::size_t most_opinions = 1 << 14;  // of one prim

bool is_within(std::string_view path, std::string_view root) {
  return path.starts_with(root) && (path.size() == root.size() || path[root.size()] == '/');
}

using Selections = std::map<std::string, std::string>;

}  // namespace

/// Composer of prims from their specs.
class UsdComposer {
 public:
  explicit UsdComposer(UsdStage& stage) : stage_(stage) {}

  void compose() {
    const File& root = read(stage_.source_);
    Siblings siblings;
    for (const File* file : root.sublayers) {
      for (const UsdSpec& spec : file->layer.prims) {
        siblings.add({.spec = &spec, .stack = &root, .site = '/' + spec.name});
      }
    }
    stage_.root_.children = prims(siblings, "", 0);
  }

 private:
  using File = UsdStage::File;

  /// Map from the times of a file to those of the stage: offset + scale·t.
  struct TimeMap {
    double offset = 0, scale = 1;
    [[nodiscard]] TimeMap after(const TimeMap& inner) const {
      return {offset + scale * inner.offset, scale * inner.scale};
    }
  };

  /// Replacement of a path's prefix `from` by `to`, its prefix in the referring file.
  struct PathMapping {
    std::string from, to;
  };

  /// A spec of a prim with its context in the composition.
  struct Opinion {
    const UsdSpec* spec = nullptr;
    const File* stack = nullptr;              // layer stack that resolves its paths
    std::string site;                         // path of the prim in that stack
    bool selected = true;                     // false within an unselected variant
    std::vector<PathMapping> renamings = {};  // from this stack's paths up to the stage's
    TimeMap time = {};
  };

  /// Specs grouped by the names of their prims, strongest first.
  struct Siblings {
    std::vector<std::vector<Opinion>> families;
    std::unordered_map<std::string_view, std::size_t> places = {};

    void add(Opinion opinion) {
      const auto place = places.emplace(opinion.spec->name, families.size()).first->second;
      if (place == families.size()) families.emplace_back();
      families[place].push_back(std::move(opinion));
    }
  };

  const File& read(const SourceText& source) {
    File& file = stage_.files_.emplace_back(File{&source, parse_usd(source, stage_.reading_)});
    file.sublayers.push_back(&file);
    for (const UsdArc& arc : file.layer.sublayers) {
      const File* sublayer = file_of(arc);
      if (sublayer == nullptr) continue;
      for (const File* one : std::vector(sublayer->sublayers)) {
        if (std::ranges::find(file.sublayers, one) == file.sublayers.end()) file.sublayers.push_back(one);
      }
    }
    return file;
  }

  /// Returns the file of an arc, read on first use; if that fails, adds a gap and returns null.
  const File* file_of(const UsdArc& arc) {
    const std::filesystem::path folder = std::filesystem::path(arc.place.source->name()).parent_path();
    std::filesystem::path path = (folder / arc.file).lexically_normal();
    std::error_code error;
    // A motion file keeps all of them in one folder.
    if (!std::filesystem::exists(path, error)) path = (folder / path.filename()).lexically_normal();
    const auto known = std::find_if(stage_.files_.begin(), stage_.files_.end(), [&](const File& file) {
      return std::filesystem::path(file.source->name()).lexically_normal() == path;
    });
    if (known != stage_.files_.end()) return &*known;
    const bool ascii = path.extension() == ".usda" || path.extension() == ".usd";
    if (!ascii || !std::filesystem::is_regular_file(path, error)) {
      gap(arc, fmt::format("{} is {}", in_quotes(arc.file), ascii ? "not there" : "no .usda file"));
      return nullptr;
    }
    try {
      const bool by_pieces = stage_.source_.stays_in_file();
      return &read(stage_.texts_.emplace_back(by_pieces ? SourceText::open(path) : SourceText::read(path)));
    } catch (const UsageError& wrong) {
      gap(arc, fmt::format("{} cannot be read: {}", in_quotes(arc.file), wrong.what()));
      return nullptr;
    }
  }

  void gap(const UsdArc& arc, std::string reason) { stage_.gaps_.push_back({arc.place, std::move(reason)}); }

  std::vector<UsdPrim> prims(const Siblings& siblings, const std::string& parent, std::size_t depth) {
    std::vector<UsdPrim> result;
    for (const std::vector<Opinion>& family : siblings.families) {
      std::vector<Opinion> all;
      Selections selections;
      for (const Opinion& opinion : family) expand(opinion, selections, 0, all);
      result.push_back(prim(all, parent + '/' + family.front().spec->name, depth));
    }
    return result;
  }

  UsdPrim prim(const std::vector<Opinion>& opinions, std::string path, std::size_t depth) {
    UsdPrim prim;
    prim.place = opinions.front().spec->place;
    if (depth == most_nested) prim.place.fail(fmt::format("prims nested deeper than {}", most_nested));
    prim.name = path.substr(path.rfind('/') + 1);
    prim.path = std::move(path);
    for (const Opinion& opinion : opinions) {
      prim.is_defined = prim.is_defined || (opinion.selected && opinion.spec->is_defined);
    }
    for (const Opinion& opinion : opinions) {
      if (prim.is_defined && !opinion.selected) continue;
      if (prim.type.empty()) prim.type = opinion.spec->type;
      for (const UsdAttribute& attribute : opinion.spec->attributes) {
        prim.attributes.push_back(retimed(attribute, opinion.time));
      }
      for (const UsdRelationship& relationship : opinion.spec->relationships) {
        prim.relationships.push_back(renamed(relationship, opinion.renamings));
      }
    }
    Siblings children;
    for (const Opinion& opinion : opinions) {
      for (const UsdSpec& child : opinion.spec->children) children.add(child_of(opinion, child));
    }
    prim.children = prims(children, prim.path, depth + 1);
    return prim;
  }

  static Opinion child_of(const Opinion& parent, const UsdSpec& child) {
    Opinion opinion = parent;
    opinion.spec = &child;
    opinion.site += '/' + child.name;
    return opinion;
  }

  /// Adds a spec of a prim and those that it refers to, strongest first.
  /// @param selections selections of stronger specs of this prim
  void expand(const Opinion& opinion, Selections& selections, int depth, std::vector<Opinion>& all) {
    const UsdSpec& spec = *opinion.spec;
    if (depth == most_arcs) spec.place.fail(fmt::format("references nested deeper than {}", most_arcs));
    if (++specs_ > most_specs) spec.place.fail(fmt::format("references lead to more than {} prims", most_specs));
    if (all.size() == most_opinions) {
      spec.place.fail(fmt::format("references lead to more than {} specs of one prim", most_opinions));
    }
    for (const auto& [set, variant] : spec.selections) selections.emplace(set, variant);
    all.push_back(opinion);
    const auto follow = [&](UsdArc::Kind kind) {
      for (const UsdArc& arc : spec.arcs) {
        if (arc.kind == kind) expand_arc(opinion, arc, selections, depth, all);
      }
    };
    follow(UsdArc::Kind::inherits);
    for (const UsdVariantSet& set : spec.variant_sets) expand_variant(opinion, set, selections, depth, all);
    follow(UsdArc::Kind::reference);
    follow(UsdArc::Kind::payload);
    follow(UsdArc::Kind::specializes);
  }

  void expand_variant(const Opinion& opinion, const UsdVariantSet& set, Selections& selections, int depth,
                      std::vector<Opinion>& all) {
    const auto selection = selections.find(set.name);
    const bool selected = selection != selections.end() && !selection->second.empty();
    const auto variant = std::find_if(set.variants.begin(), set.variants.end(), [&](const UsdSpec& candidate) {
      return !selected || candidate.name == selection->second;
    });
    if (variant == set.variants.end()) return;
    Opinion chosen = opinion;
    chosen.spec = &*variant;
    chosen.selected = opinion.selected && selected;
    expand(chosen, selections, depth + 1, all);
  }

  void expand_arc(const Opinion& opinion, const UsdArc& arc, Selections& selections, int depth,
                  std::vector<Opinion>& all) {
    const File* stack = arc.file.empty() ? opinion.stack : file_of(arc);
    if (stack == nullptr) return;
    const std::string path = arc.path.empty() ? '/' + stack->layer.default_prim : arc.path;
    // As in USD, a prim cannot refer to its own ancestor.
    if (stack == opinion.stack && is_within(opinion.site, path)) return gap(arc, "the prim refers to itself");
    std::vector<Opinion> found = specs_at(*stack, path, depth + 1);
    if (found.empty()) return gap(arc, fmt::format("there is no prim {}", in_quotes(path)));
    const double rate = opinion.stack->layer.time_codes_per_second / stack->layer.time_codes_per_second;
    const TimeMap here = opinion.time.after({arc.offset, arc.scale * rate});
    for (Opinion& weaker : found) {
      weaker.selected = weaker.selected && opinion.selected;
      weaker.renamings.push_back({path, opinion.site});
      weaker.renamings.insert(weaker.renamings.end(), opinion.renamings.begin(), opinion.renamings.end());
      weaker.time = here.after(weaker.time);
      expand(weaker, selections, depth + 1, all);
    }
  }

  /// Returns the specs of a path's prim, not expanded. Its ancestors are expanded, as they may inherit the prim.
  std::vector<Opinion> specs_at(const File& stack, std::string_view path, int depth) {
    std::vector<Opinion> found;
    if (!path.starts_with('/')) return found;
    path.remove_prefix(1);
    const std::string_view first = path.substr(0, path.find('/'));
    for (const File* file : stack.sublayers) {
      for (const UsdSpec& spec : file->layer.prims) {
        if (spec.name == first) found.push_back({.spec = &spec, .stack = &stack, .site = '/' + spec.name});
      }
    }
    for (path.remove_prefix(first.size()); !path.empty() && !found.empty();) {
      path.remove_prefix(1);
      const std::string_view name = path.substr(0, path.find('/'));
      std::vector<Opinion> ancestors;
      Selections selections;
      for (const Opinion& opinion : found) expand(opinion, selections, depth, ancestors);
      found.clear();
      for (const Opinion& ancestor : ancestors) {
        for (const UsdSpec& child : ancestor.spec->children) {
          if (child.name == name) found.push_back(child_of(ancestor, child));
        }
      }
      path.remove_prefix(name.size());
    }
    return found;
  }

  const UsdAttribute* retimed(const UsdAttribute& attribute, const TimeMap& time) {
    if (attribute.samples.empty() || (time.offset == 0 && time.scale == 1)) return &attribute;
    UsdAttribute& copy = stage_.retimed_.emplace_back(attribute);
    for (UsdSample& sample : copy.samples) sample.time = time.offset + time.scale * sample.time;
    return &copy;
  }

  /// Translates a relationship's targets to paths of the stage; drops targets outside of the referenced prim.
  static UsdRelationship renamed(const UsdRelationship& relationship, const std::vector<PathMapping>& renamings) {
    UsdRelationship result{relationship.name, {}};
    for (std::string target : relationship.targets) {
      const bool known = std::all_of(renamings.begin(), renamings.end(), [&](const PathMapping& renaming) {
        if (!is_within(target, renaming.from)) return false;
        target = renaming.to + target.substr(renaming.from.size());
        return true;
      });
      if (known) result.targets.push_back(std::move(target));
    }
    return result;
  }

  UsdStage& stage_;
  std::size_t specs_ = 0;
};

UsdStage::UsdStage(const SourceText& source, const UsdReading& reading) : source_(source), reading_(reading) {
  UsdComposer(*this).compose();
}

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

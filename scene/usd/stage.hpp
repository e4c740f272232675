#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/usd/layer.hpp"
#include "scene/usd/parser.hpp"

namespace drape {

/// A prim of the scene tree, composed from all of its specs.
struct UsdPrim {
  bool is_defined = false;  ///< declared by a `def`; otherwise not part of the scene by itself
  std::string type;         ///< "Mesh"
  std::string name;
  std::string path;                             ///< "/World/cloth"
  SourcePlace place;                            ///< place of the strongest spec
  std::vector<const UsdAttribute*> attributes;  ///< strongest first; a name may appear several times
  std::vector<UsdRelationship> relationships;   ///< strongest first
  std::vector<UsdPrim> children;

  /// Returns the strongest attribute of this name that has a value, otherwise the strongest; null if there is none.
  [[nodiscard]] const UsdAttribute* find(std::string_view attribute) const;
};

/// A prim with its ancestors, from the root of the tree down to the prim itself.
using UsdPath = std::vector<const UsdPrim*>;

/// A referenced file or prim that could not be read.
struct UnresolvedReference {
  SourcePlace place;
  std::string reason;
};

/// An ASCII USD file and its referenced files as one tree of prims. Specs of a prim are composed in USD's order of
/// strength: own, inherited, selected variants, references, payloads, specialised; see
/// https://openusd.org/release/glossary.html#liverps-strength-ordering. Without a selection the first variant of a set
/// is read, but prims defined only there are not part of the scene (is_defined). Unit, up axis and times are those of
/// the root file; times of other files are mapped to its time codes. A missing referenced file is searched beside the
/// referring file.
class UsdStage {
 public:
  /// @param source must outlive this object; referenced files are searched relative to its name
  /// @throws UsageError "file:line:column: message" for errors in files that are read, and for endless references;
  ///         a missing file, or one that is not ASCII USD, becomes a gap
  explicit UsdStage(const SourceText& source, const UsdReading& reading = {});
  UsdStage(const UsdStage&) = delete;
  UsdStage& operator=(const UsdStage&) = delete;

  [[nodiscard]] const SourceText& source() const { return source_; }
  [[nodiscard]] const UsdLayer& layer() const { return files_.front().layer; }
  [[nodiscard]] const std::vector<UsdPrim>& prims() const { return root_.children; }
  [[nodiscard]] const std::vector<UnresolvedReference>& gaps() const { return gaps_; }

  /// Returns the referenced files that were read.
  [[nodiscard]] std::vector<std::filesystem::path> referenced_files() const;

  /// Returns the prim of a path, "/World/cloth", with its ancestors; empty if there is none.
  [[nodiscard]] UsdPath find(std::string_view path) const;

 private:
  friend class UsdComposer;

  struct File {
    const SourceText* source;
    UsdLayer layer;
    std::vector<const File*> sublayers = {};  // with this file, by strength; complete after all are read
  };

  const SourceText& source_;
  UsdReading reading_;
  std::deque<SourceText> texts_;  // texts of the files besides source_
  std::deque<File> files_;        // the first is that of source_
  std::deque<UsdAttribute> retimed_;
  std::vector<UnresolvedReference> gaps_;
  UsdPrim root_;
};

/// Returns the prims of the given types (any type if none is given) in the file's order, pointing into the stage.
/// @param also_undefined include prims that are not part of the scene
std::vector<UsdPath> find_prims(const UsdStage& stage, std::initializer_list<std::string_view> types,
                                bool also_undefined = false);

/// Returns the first target of a relationship of a prim or of its nearest ancestor that has it; empty if none has.
std::string inherited_target(const UsdPath& path, std::string_view relationship);

/// Returns the attribute of a prim or of its nearest ancestor that has it; null if none has.
const UsdAttribute* inherited_attribute(const UsdPath& path, std::string_view name);

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

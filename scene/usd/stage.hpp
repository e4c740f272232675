#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/usd/layer.hpp"

namespace drape {

/// A prim of the scene tree, put together from every spec of it.
struct UsdPrim {
  bool is_defined = false;  ///< by a `def`; otherwise it is not part of the scene by itself
  std::string type;         ///< "Mesh"
  std::string name;
  std::string path;                             ///< "/World/cloth"
  SourcePlace place;                            ///< of the strongest spec
  std::vector<const UsdAttribute*> attributes;  ///< the strongest first; a name may appear several times
  std::vector<UsdRelationship> relationships;   ///< likewise
  std::vector<UsdPrim> children;

  /// The strongest attribute of this name that has a value, else the strongest; null if there is none.
  [[nodiscard]] const UsdAttribute* find(std::string_view attribute) const;
};

/// A prim with its ancestors, from the root of the tree down to the prim itself.
using UsdPath = std::vector<const UsdPrim*>;

/// What could not be read where a prim refers to it.
struct UsdGap {
  SourcePlace place;
  std::string reason;
};

/// An ASCII USD file with what it refers to, as one tree of prims. Specs of a prim are put together in the order of
/// strength that USD has: its own, inherited, of the variants that are selected, of references, of payloads,
/// specialised; see https://openusd.org/release/glossary.html#liverps-strength-ordering. Where no variant of a set is
/// selected, the first one is read, but what only it has is not part of the scene (is_defined). Units, up axis and
/// times are those of the file itself; the times of others are stretched to its time codes. A file that is not where a
/// reference says is looked for beside the one that refers to it.
class UsdStage {
 public:
  /// @param source must outlive this object; its name is where files are looked for that it refers to
  /// @throws UsageError "file:line:column: message" for what is wrong in a file that is read, and for references that
  ///         never end; what cannot be read, since it is not there or no ASCII USD, becomes a gap
  explicit UsdStage(const SourceText& source, const UsdReading& reading = {});
  UsdStage(const UsdStage&) = delete;
  UsdStage& operator=(const UsdStage&) = delete;

  [[nodiscard]] const SourceText& source() const { return source_; }
  [[nodiscard]] const UsdLayer& layer() const { return files_.front().layer; }
  [[nodiscard]] const std::vector<UsdPrim>& prims() const { return root_.children; }
  [[nodiscard]] const std::vector<UsdGap>& gaps() const { return gaps_; }

  /// The files that it refers to and that were read.
  [[nodiscard]] std::vector<std::filesystem::path> referenced_files() const;

  /// The prim of a path, "/World/cloth", with its ancestors; empty if there is none.
  [[nodiscard]] UsdPath find(std::string_view path) const;

 private:
  friend class UsdComposer;

  struct File {
    const SourceText* source;
    UsdLayer layer;
    std::vector<const File*> sublayers = {};  // this one too, by strength; complete once all of them are read
  };

  const SourceText& source_;
  UsdReading reading_;
  std::deque<SourceText> texts_;  // of the files beside source_
  std::deque<File> files_;        // the first is that of source_
  std::deque<UsdAttribute> retimed_;
  std::vector<UsdGap> gaps_;
  UsdPrim root_;
};

/// The prims of the given types that are part of the scene, or also the others, in the order of the file; of any type
/// where none is given. They point into the stage.
std::vector<UsdPath> find_prims(const UsdStage& stage, std::initializer_list<std::string_view> types,
                                bool also_undefined = false);

/// The first target of a relationship of a prim or else of its nearest ancestor that has it; empty if none has.
std::string inherited_target(const UsdPath& path, std::string_view relationship);

/// The attribute of a prim or else of its nearest ancestor that has it; null if none has.
const UsdAttribute* inherited_attribute(const UsdPath& path, std::string_view name);

}  // namespace drape

#include "scene/usd/stage.hpp"

#include <algorithm>

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

}  // namespace drape

#include "sim/collision/feature_set.hpp"

namespace drape {
namespace {

template <class Values>
void keep_each_once(Values& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

void FeatureSet::complete() {
  keep_each_once(triangles);
  for (const Triangle& t : triangles) {
    vertices.insert(vertices.end(), t.begin(), t.end());
    for (const Edge& e : {Edge{t[0], t[1]}, Edge{t[1], t[2]}, Edge{t[2], t[0]}}) {
      edges.push_back({std::min(e[0], e[1]), std::max(e[0], e[1])});
    }
  }
  keep_each_once(edges);
  keep_each_once(vertices);
}

}  // namespace drape

#include "sim/collision/entanglement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace drape {
namespace {

std::size_t slot(int vertex) { return static_cast<std::size_t>(vertex); }

}  // namespace

int root_of(const std::vector<int>& parent, int vertex) {
  while (parent[slot(vertex)] != vertex) vertex = parent[slot(vertex)];
  return vertex;
}

void join_trees(std::vector<int>& parent, int i, int j) {
  const auto [low, high] = std::minmax({root_of(parent, i), root_of(parent, j)});
  parent[slot(high)] = low;
  for (int v : {i, j}) {
    while (parent[slot(v)] != low) v = std::exchange(parent[slot(v)], low);
  }
}

Entanglement::Entanglement(std::vector<std::vector<Triangle>> meshes, std::size_t point_count,
                           const std::vector<int>& pins)
    : meshes_(std::move(meshes)), piece_(point_count), weights_(point_count, 1), astray_(point_count, 0) {
  for (const std::vector<Triangle>& triangles : meshes_) edges_.push_back(unique_edges(triangles));
  std::iota(piece_.begin(), piece_.end(), 0);
  for (const std::vector<Edge>& edges : edges_) {
    for (const auto& [i, j] : edges) join_trees(piece_, i, j);
  }
  for (int v = 0; v < static_cast<int>(point_count); ++v) piece_[slot(v)] = root_of(piece_, v);
  for (const int pin : pins) weights_[slot(pin)] = static_cast<long>(point_count);
}

int Entanglement::root(int vertex) const { return root_of(parent_, vertex); }

void Entanglement::find(const std::vector<Point>& points) {
  crossings_.clear();
  for (std::size_t mesh = 0; mesh < meshes_.size(); ++mesh) {
    const std::vector<Triangle>& triangles = meshes_[meshes_.size() - 1 - mesh];
    for (const Intersection& found : find_intersections(edges_[mesh], triangles, points)) {
      crossings_.push_back({found.edge, triangles[found.triangle]});
    }
  }
  passed_.clear();
  std::ranges::fill(astray_, 0);
  if (crossings_.empty()) return;
  find_parts();
  for (const Crossing& crossing : crossings_) add(crossing, points);
}

void Entanglement::find_parts() {
  std::vector<Edge> cut;
  for (const Crossing& crossing : crossings_) cut.push_back(crossing.edge);
  std::ranges::sort(cut);
  parent_.resize(piece_.size());
  std::iota(parent_.begin(), parent_.end(), 0);
  for (const std::vector<Edge>& edges : edges_) {
    for (const Edge& edge : edges) {
      if (!std::ranges::binary_search(cut, edge)) join_trees(parent_, edge[0], edge[1]);
    }
  }
  std::vector<long> size(piece_.size(), 0);
  const auto count = static_cast<int>(piece_.size());
  for (int v = 0; v < count; ++v) size[slot(root(v))] += weights_[slot(v)];
  std::map<int, int> largest;  // part of each piece, by their roots
  for (int v = 0; v < count; ++v) {
    if (root(v) != v) continue;
    const auto [known, first] = largest.try_emplace(piece_[slot(v)], v);
    if (!first && size[slot(v)] > size[slot(known->second)]) known->second = v;
  }
  for (int v = 0; v < count; ++v) astray_[slot(v)] = root(v) != largest.at(piece_[slot(v)]) ? 1 : 0;
}

void Entanglement::add(const Crossing& crossing, const std::vector<Point>& points) {
  int here = crossing.edge[0], there = crossing.edge[1];  // clang 14 does not let lambdas capture structured bindings
  if (root(here) == root(there)) return;
  if (!is_astray(here)) std::swap(here, there);
  const auto known = [&](const Passed& one) { return one.vertex == here && one.triangle == crossing.triangle; };
  if (std::ranges::any_of(passed_, known)) return;
  const Triangle& t = crossing.triangle;
  const Point &a = points[slot(t[0])], &b = points[slot(t[1])], &c = points[slot(t[2])];
  const Point across = (b - a).cross(c - a), normal = across.normalized();
  const double below = normal.dot(points[slot(here)] - a), above = normal.dot(points[slot(there)] - a);
  if (below == above) return;
  const Point place = points[slot(here)] + below / (below - above) * (points[slot(there)] - points[slot(here)]);
  const double area = across.squaredNorm();
  const double second = (place - a).cross(c - a).dot(across) / area,
               third = (b - a).cross(place - a).dot(across) / area;
  passed_.push_back({here, t, {1 - second - third, second, third}, above > below ? normal : Point(-normal)});
}

}  // namespace drape

#include "motion/encoding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/installation.hpp"
#include "motion/blocks.hpp"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t most_steps = 1'000'000'000'000;
constexpr std::size_t own_columns = 9, columns_of_collider = 4, columns_of_cloth = 3;

double bounded(const Json& json, const char* key) {
  const double value = json.at(key).get<double>();
  if (!(value > 0 && std::isfinite(value))) throw std::invalid_argument("has a time step that cannot be");
  return value;
}

std::int64_t count(const Json& json, const char* key, std::int64_t least, std::int64_t most) {
  const auto value = json.at(key).get<std::int64_t>();
  if (!json.at(key).is_number_integer() || value < least || value > most) {
    throw std::invalid_argument(std::string("has a number of ") + key + " that cannot be");
  }
  return value;
}

/// Returns four numbers that locate a collider; for a mesh, the ball around the middle of its vertices.
std::array<double, columns_of_collider> numbers_of(const Collider& collider) {
  if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
    return {sphere->center[0], sphere->center[1], sphere->center[2], sphere->radius};
  }
  if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
    const Eigen::RowVector3d middle = mesh->positions.colwise().mean();
    const double radius = (mesh->positions.rowwise() - middle).rowwise().norm().maxCoeff();
    return {middle[0], middle[1], middle[2], radius};
  }
  const auto& ground = std::get<GroundShape>(collider);
  return {ground.normal[0], ground.normal[1], ground.normal[2], ground.height};
}

Collider collider_of(const std::string& kind, const std::array<double, columns_of_collider>& n) {
  if (kind == "sphere" || kind == "body")
    return SphereShape{.center = {n[0], n[1], n[2]}, .radius = n[3], .reach = n[3]};
  return GroundShape{.normal = {n[0], n[1], n[2]}, .height = n[3]};
}

}  // namespace

std::vector<std::string> collider_kinds(const std::vector<Collider>& colliders) {
  std::vector<std::string> kinds;
  for (const Collider& collider : colliders) {
    const bool is_mesh = std::holds_alternative<MeshShape>(collider);
    kinds.emplace_back(is_mesh ? "body" : std::holds_alternative<SphereShape>(collider) ? "sphere" : "ground");
  }
  return kinds;
}

std::string this_program() { return build_info().version + " (" + build_info().revision + ")"; }

std::string pack_header(const MotionHeader& header) {
  Json json{{"program", header.program},
            {"name", header.name},
            {"scene", header.scene},
            {"files", header.files},
            {"physics", header.physics},
            {"step", header.step},
            {"steps", header.steps},
            {"every", header.recorded.every ? Json(*header.recorded.every) : Json("frames")},
            {"vertices", header.vertices},
            {"triangles", header.triangles},
            {"texture_coordinates", header.textured},
            {"colliders", header.colliders},
            {"group", states_in_group}};
  if (!header.cloths.empty()) json["cloths"] = header.cloths;
  if (header.imported) json["imported"] = true;
  if (!header.energies) json["energies"] = false;
  return pack(json.dump(1, ' ', false, Json::error_handler_t::replace));
}

MotionHeader unpack_header(std::string_view payload) {
  constexpr std::int64_t most_vertices = std::numeric_limits<int>::max() / 8;
  MotionHeader header;
  try {
    const Json json = Json::parse(unpack(payload));
    header.program = json.at("program").get<std::string>();
    header.name = json.at("name").get<std::string>();
    header.scene = json.at("scene").get<std::string>();
    header.files = json.at("files").get<std::vector<std::string>>();
    header.physics = json.at("physics").get<std::string>();
    header.step = bounded(json, "step");
    header.steps = count(json, "steps", 0, most_steps);
    const bool of_frames = json.at("every") == "frames";
    header.recorded.every = of_frames ? std::nullopt : std::optional(count(json, "every", 1, most_steps));
    header.vertices = static_cast<int>(count(json, "vertices", 1, most_vertices));
    header.triangles = static_cast<int>(count(json, "triangles", 0, most_vertices));
    header.textured = json.at("texture_coordinates").get<bool>();
    header.colliders = json.at("colliders").get<std::vector<std::string>>();
    count(json, "group", states_in_group, states_in_group);
    if (json.contains("cloths")) header.cloths = json.at("cloths").get<std::vector<std::string>>();
    header.imported = json.value("imported", false);
    header.energies = json.value("energies", true);
  } catch (const Json::exception&) {
    throw std::invalid_argument("has an invalid header");
  }
  for (const std::string& kind : header.colliders) {
    if (kind != "sphere" && kind != "ground" && kind != "body")
      throw std::invalid_argument("has a collider of an unknown kind");
  }
  return header;
}

namespace {

double flags_of(const StepRow& row) { return (row.converged ? 1 : 0) + (row.redone ? 2 : 0); }

}  // namespace

std::string pack_rows(const std::vector<StepRow>& rows) {
  const std::size_t before_cloths = own_columns + columns_of_collider * rows.front().colliders.size();
  std::vector<std::vector<double>> columns(before_cloths + columns_of_cloth * rows.front().cloths.size());
  for (const StepRow& row : rows) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const std::array<double, own_columns> own{row.energies.kinetic,
                                              row.energies.gravity,
                                              row.energies.elastic,
                                              static_cast<double>(row.iterations),
                                              flags_of(row),
                                              row.residual,
                                              row.error.value_or(unknown),
                                              static_cast<double>(row.substeps),
                                              row.estimate.value_or(unknown)};
    for (std::size_t k = 0; k < own.size(); ++k) columns[k].push_back(own[k]);
    for (std::size_t c = 0; c < row.colliders.size(); ++c) {
      const auto numbers = numbers_of(row.colliders[c]);
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        columns[own_columns + columns_of_collider * c + k].push_back(numbers[k]);
      }
    }
    for (std::size_t c = 0; c < row.cloths.size(); ++c) {
      const Energies& one = row.cloths[c];
      std::size_t column = before_cloths + columns_of_cloth * c;
      for (const double number : {one.kinetic, one.gravity, one.elastic}) columns[column++].push_back(number);
    }
  }
  std::vector<std::uint64_t> words;
  for (const auto& column : columns) {
    for (const double number : column) words.push_back(std::bit_cast<std::uint64_t>(number));
  }
  return ByteWriter()
      .whole(static_cast<std::uint64_t>(rows.front().step))
      .whole(rows.size())
      .bytes(pack_planes(words))
      .text();
}

namespace {

constexpr std::size_t error_column = 6, estimate_column = 8;  // may be unknown (NaN)

double number_of_row(std::uint64_t word, std::size_t column) {
  const auto number = std::bit_cast<double>(word);
  const bool unknown = std::isnan(number) && (column == error_column || column == estimate_column);
  if (!std::isfinite(number) && !unknown) throw std::invalid_argument("holds a number that is not finite");
  return number;
}

}  // namespace

std::vector<StepRow> unpack_rows(std::string_view payload, const MotionHeader& header) {
  ByteReader reader(payload);
  const std::uint64_t first = reader.whole(), size = reader.whole();
  if (size > rows_in_block || first > static_cast<std::uint64_t>(most_steps)) {
    throw std::invalid_argument("has rows that cannot be");
  }
  const std::size_t before_cloths = own_columns + columns_of_collider * header.colliders.size();
  const std::size_t columns = before_cloths + columns_of_cloth * header.cloths.size();
  const std::vector<std::uint64_t> words = unpack_planes(reader.rest(), columns * size);
  std::vector<StepRow> rows(size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto number = [&](std::size_t column) { return number_of_row(words[column * size + i], column); };
    StepRow& row = rows[i];
    row.step = static_cast<std::int64_t>(first + i);
    row.energies = {.kinetic = number(0), .gravity = number(1), .elastic = number(2)};
    if (!(number(3) >= 0 && number(3) < 1e9)) throw std::invalid_argument("has a number of iterations that cannot be");
    row.iterations = static_cast<int>(number(3));
    if (!(number(4) >= 0 && number(4) < 4)) throw std::invalid_argument("has flags that cannot be");
    row.converged = (static_cast<int>(number(4)) & 1) != 0;
    row.redone = (static_cast<int>(number(4)) & 2) != 0;
    row.residual = number(5);
    if (!std::isnan(number(error_column))) row.error = number(error_column);
    if (!(number(7) >= 1 && number(7) < 1e9)) throw std::invalid_argument("has a number of substeps that cannot be");
    row.substeps = static_cast<std::int64_t>(number(7));
    if (!std::isnan(number(estimate_column))) row.estimate = number(estimate_column);
    for (std::size_t c = 0; c < header.colliders.size(); ++c) {
      const std::size_t at = own_columns + columns_of_collider * c;
      row.colliders.push_back(
          collider_of(header.colliders[c], {number(at), number(at + 1), number(at + 2), number(at + 3)}));
    }
    for (std::size_t at = before_cloths; at < columns; at += columns_of_cloth) {
      row.cloths.push_back({.kinetic = number(at), .gravity = number(at + 1), .elastic = number(at + 2)});
    }
  }
  return rows;
}

std::string pack_surface(const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs) {
  ByteWriter writer;
  writer.bytes({reinterpret_cast<const char*>(triangles.data()), triangles.size() * sizeof(Triangle)});
  writer.bytes({reinterpret_cast<const char*>(uvs.data()), uvs.size() * sizeof(std::array<float, 2>)});
  return pack(writer.text());
}

namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// Returns the difference of bits modulo 2⁶⁴, which is invertible. Zigzag encoding maps small differences of either
/// sign to small words: 0, −1, 1, −2, …
std::uint64_t difference(double value, double predicted) {
  const std::uint64_t d = bits(value) - bits(predicted);
  return d << 1 ^ (d >> 63 == 0 ? 0 : ~std::uint64_t{0});
}

double undone(std::uint64_t word, double predicted) {
  const std::uint64_t d = word >> 1 ^ ((word & 1) == 0 ? 0 : ~std::uint64_t{0});
  const auto value = std::bit_cast<double>(d + bits(predicted));
  if (!std::isfinite(value)) throw std::invalid_argument("holds a number that is not finite");
  return value;
}

}  // namespace

std::array<double, StateCodec::most_known> StateCodec::weights(int order, std::int64_t step) const {
  std::array<double, most_known> w{};
  for (int i = 0; i < order; ++i) {
    w[static_cast<std::size_t>(i)] = 1;
    for (int j = 0; j < order; ++j) {
      if (j == i) continue;
      w[static_cast<std::size_t>(i)] *=
          static_cast<double>(step - before(j + 1).step) / static_cast<double>(before(i + 1).step - before(j + 1).step);
    }
  }
  return w;
}

template <class Use>
void StateCodec::predict(int how, bool velocities, const State& state, Eigen::Index stride, const Use& use) const {
  const Eigen::Index count = 3 * vertices_;
  const auto field = [&](const State& s) { return velocities ? s.v.data() : s.x.data(); };
  if (how == by_way || how == by_mean_way) {
    const double* const x = state.x.data();
    const double* const x1 = before(1).x.data();
    const double* const v1 = before(1).v.data();
    const double duration = static_cast<double>(state.step - before(1).step) * step_;
    for (Eigen::Index i = 0; i < count; i += stride) {
      const double mean = (x[i] - x1[i]) / duration;
      use(i, how == by_way ? mean : 2 * mean - v1[i]);
    }
    return;
  }
  const std::array<double, most_known> w = weights(how, state.step);
  std::array<const double*, most_known> past{};
  for (int k = 0; k < how; ++k) past[static_cast<std::size_t>(k)] = field(before(k + 1));
  for (Eigen::Index i = 0; i < count; i += stride) {
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(how); ++k)
      sum = k == 0 ? w[k] * past[k][i] : sum + w[k] * past[k][i];
    use(i, sum);
  }
}

int StateCodec::best(bool velocities, const State& state) const {
  constexpr Eigen::Index looked_at = 512;  // sampled numbers
  const Eigen::Index stride = std::max<Eigen::Index>(1, 3 * vertices_ / looked_at);
  const double* const values = velocities ? state.v.data() : state.x.data();
  int best = 0;
  std::int64_t least = -1;
  for (int how = 0; how <= (velocities && known_ > 0 ? static_cast<int>(by_mean_way) : known_); ++how) {
    if (how > known_ && how < by_way) continue;
    std::int64_t cost = 0;
    predict(how, velocities, state, stride,
            [&](Eigen::Index i, double predicted) { cost += std::bit_width(difference(values[i], predicted)); });
    if (least >= 0 && cost >= least) continue;
    least = cost;
    best = how;
  }
  return best;
}

State& StateCodec::next_place() {
  newest_ = (newest_ + 1) % most_known;
  known_ = std::min(known_ + 1, most_known);
  return states_[static_cast<std::size_t>(newest_)];
}

std::string StateCodec::encode(const State& state) {
  const auto count = static_cast<std::size_t>(3 * vertices_);
  std::vector<std::uint64_t> words(2 * count);
  const int places = best(false, state), velocities = best(true, state);
  predict(places, false, state, 1, [&](Eigen::Index i, double predicted) {
    words[static_cast<std::size_t>(i)] = difference(state.x.data()[i], predicted);
  });
  predict(velocities, true, state, 1, [&](Eigen::Index i, double predicted) {
    words[count + static_cast<std::size_t>(i)] = difference(state.v.data()[i], predicted);
  });
  next_place() = state;
  return ByteWriter()
      .whole(static_cast<std::uint64_t>(state.step))
      .whole(static_cast<std::uint64_t>(places) + 256 * static_cast<std::uint64_t>(velocities))
      .bytes(pack_planes(words))
      .text();
}

const State& StateCodec::decode(std::string_view bytes) {
  ByteReader reader(bytes);
  State state;
  state.step = static_cast<std::int64_t>(reader.whole());
  const std::uint64_t how = reader.whole();
  const auto places = static_cast<int>(how % 256), velocities = static_cast<int>(how / 256 % 256);
  const bool by_places = velocities == by_way || velocities == by_mean_way;
  if (how >= 65536 || places > known_ || (velocities > known_ && !(by_places && known_ > 0))) {
    throw std::invalid_argument("has a state predicted from an earlier one that is missing");
  }
  if (state.step < 0 || (known_ > 0 && state.step <= before(1).step)) {
    throw std::invalid_argument("has steps that are not in order");
  }
  const auto count = static_cast<std::size_t>(3 * vertices_);
  const std::vector<std::uint64_t> words = unpack_planes(reader.rest(), 2 * count);
  state.x.resize(vertices_, 3);
  state.v.resize(vertices_, 3);
  predict(places, false, state, 1, [&](Eigen::Index i, double predicted) {
    state.x.data()[i] = undone(words[static_cast<std::size_t>(i)], predicted);
  });
  predict(velocities, true, state, 1, [&](Eigen::Index i, double predicted) {
    state.v.data()[i] = undone(words[count + static_cast<std::size_t>(i)], predicted);
  });
  return next_place() = std::move(state);
}

}  // namespace drape

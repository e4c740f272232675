#include "audit/report/page.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "audit/report/table.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "html/components.hpp"
#include "html/page.hpp"
#include "output/motion_packer.hpp"
#include "output/png_encoder.hpp"
#include "render/renderer.hpp"
#include "render/view.hpp"

namespace drape {
namespace {

using audit::Check;
using audit::WorstState;
using html::Markup;

constexpr std::array drawn_checks{Check::crossings, Check::ways, Check::inside, Check::stretch, Check::stuck};
constexpr Rgb marked_color{0.86, 0.08, 0.08}, plain_color{0.86, 0.83, 0.74};

View whole_view(const Scene& scene, const WorstState& state, double aspect) {
  if (!needs_motion(scene.camera)) return fixed_view(scene.camera);
  Framing framing(scene.camera, aspect);
  framing.add(state.x);
  for (const Collider& collider : state.colliders) framing.add(collider);
  return framing.view();
}

/// Returns the triangles with a corner among some vertices.
std::vector<Triangle> triangles_at(const std::vector<Triangle>& triangles, const std::vector<int>& vertices) {
  std::vector<Triangle> found;
  const auto marked = [&](int v) { return std::ranges::binary_search(vertices, v); };
  std::ranges::copy_if(triangles, std::back_inserter(found),
                       [&](const Triangle& t) { return std::ranges::any_of(t, marked); });
  return found;
}

/// Returns a close view of a finding, from the front side of the cloth's triangles there.
/// @param vertices at least one, of the cloth
View close_view(const Scene& scene, const WorstState& state, const View& whole, double aspect) {
  constexpr double part = 0.12;  // relative to the cloth's size: more distant vertices are another place
  const double size = (state.x.colwise().maxCoeff() - state.x.colwise().minCoeff()).norm();
  std::vector<int> place;
  std::ranges::copy_if(state.vertices, std::back_inserter(place), [&](int v) {
    return (state.x.row(v) - state.x.row(state.vertices.front())).norm() <= part * size;
  });
  const std::vector<Triangle> around = triangles_at(scene.simulation.cloth.triangles, place);
  Vertices near(static_cast<Eigen::Index>(3 * around.size()), 3);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t t = 0; t < around.size(); ++t) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      near.row(static_cast<Eigen::Index>(3 * t + c)) = state.x.row(around[t][c]);
      corners[c] = state.x.row(around[t][c]).transpose();
    }
    normal += (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  }
  if (near.rows() == 0) return whole;
  const Eigen::Vector3d seen = (whole.position - whole.target).normalized();
  if (normal.norm() < 1e-12) normal = seen;
  if (normal.dot(seen) < 0) normal = -normal;
  const Eigen::Vector3d towards = (normal.normalized() + seen).normalized();
  constexpr double degrees = 180 / std::numbers::pi;
  Camera camera;
  camera.azimuth = degrees * std::atan2(towards.y(), towards.x());
  camera.elevation = degrees * std::asin(std::clamp(towards.z(), -1.0, 1.0));
  camera.margin = 0.2;
  Framing framing(camera, aspect);
  framing.add(near);
  return framing.view();
}

/// Returns a state as an interactive view.
html::PlayedMotion turned(const Scene& scene, const Frame& frame) {
  Look look = scene.look;
  look.mesh_lines = true;
  FilmInfo film;
  film.scene = scene.name;
  film.cloth = &scene.simulation.cloth;
  film.look = &look;
  film.camera = &scene.camera;
  MotionPacker packer(film);
  try {
    packer.add(frame);
  } catch (const OutputError&) {
    return {};
  }
  return packer.finish();
}

Markup pictures(const AuditReport& report, const std::vector<DrawnFinding>& drawn) {
  Markup content;
  for (const DrawnFinding& finding : drawn) {
    const std::string name = check_name(finding.check);
    const std::string text = describe_worst(finding.check, report.findings.findings(finding.check));
    const std::string id = fmt::format("check-{}", static_cast<int>(finding.check));
    Markup found = html::figure(html::row({html::picture("image/png", finding.whole, "The whole motion " + text),
                                           html::picture("image/png", finding.close, "The place " + text)}),
                                text);
    if (finding.turned.frames > 0) {
      found +=
          html::details("Turn this state", html::motion_player(id + "-turned", finding.turned, "The state " + text));
    }
    content += html::section(3, id, name, found);
  }
  return html::section(2, "worst", "The worst states", content);
}

}  // namespace

std::vector<DrawnFinding> draw_findings(const Scene& scene, const AuditReport& report, GlBackend backend) {
  std::vector<DrawnFinding> drawn;
  const Cloth& cloth = scene.simulation.cloth;
  const Eigen::Vector2i size = scene.video.size;
  const double aspect = static_cast<double>(size.x()) / size.y();
  Look look = scene.look;
  look.texture.clear();
  look.mesh_lines = true;
  for (const Check check : drawn_checks) {
    const audit::CheckFindings& found = report.findings.findings(check);
    if (found.states == 0) continue;
    const WorstState& state = found.worst;
    std::vector<Rgb> colors(static_cast<std::size_t>(cloth.vertex_count()), plain_color);
    for (const int v : state.vertices) colors[static_cast<std::size_t>(v)] = marked_color;
    const View whole = whole_view(scene, state, aspect);
    Renderer renderer(data_folder(), size, whole, look, cloth.vertex_count(), cloth.triangles, scene.uvs, backend);
    const Frame frame{.time = state.time, .positions = state.x, .colliders = state.colliders};
    DrawnFinding pictures{
        .check = check, .whole = encode_png(renderer.draw(frame, colors)), .close = {}, .turned = turned(scene, frame)};
    renderer.look_from(close_view(scene, state, whole, aspect));
    pictures.close = encode_png(renderer.draw(frame, colors));
    drawn.push_back(std::move(pictures));
  }
  return drawn;
}

std::string audit_page(const AuditReport& report, const std::vector<DrawnFinding>& drawn, const std::string& command) {
  const ResultTable table = audit_table(report);
  std::vector<html::Finding> findings;
  if (report.clean()) findings.push_back({html::Tone::good, "Nothing was found"});
  for (const DrawnFinding& finding : drawn) {
    findings.push_back({html::Tone::bad, check_name(finding.check) + ", " +
                                             describe_worst(finding.check, report.findings.findings(finding.check))});
  }
  if (report.energy.found()) {
    findings.push_back({html::Tone::bad, fmt::format("The energy rises by {:.3g} J from {:.4g} s to {:.4g} s",
                                                     report.energy.rise, report.energy.from, report.energy.to)});
  }
  if (!report.divergence.empty()) findings.push_back({html::Tone::bad, report.divergence});
  html::Page page;
  page.title = "drape audit: " + report.file;
  page.kind = "drape audit";
  page.heading = audit_summary(report);
  page.introduction = html::findings(findings) + html::command("Reproduce this page", command);
  page.content = html::section(2, "checks", "Checks", to_html(table));
  if (!drawn.empty()) page.content += pictures(report, drawn);
  for (const auto& [name, value] : html::provenance()) page.foot.emplace_back(name, value);
  return html::render(page);
}

}  // namespace drape

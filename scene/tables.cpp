#include "scene/tables.hpp"

#include <fmt/format.h>
#include <cmath>

#include "drape/scene/scene.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {
namespace {

Keys cloth_keys(ClothTable& cloth) {
  Keys keys;
  keys.add("name", &cloth.name, "",
           "Name of the cloth: letters, digits, `_` and `-`. Each of several `[[cloth]]` needs one.")
      .omit_from_hash();
  keys.add("mesh", Written<MeshKind>{&cloth.mesh}, "", "The shape that the cloth starts from.").must_be_given();
  keys.add("rest", Written<MeshKind>{&cloth.rest}, "",
           "The shape whose edge lengths are the springs' rest lengths, with the same vertices and triangles as "
           "`mesh`. Default: the starting shape.");
  keys.add("mass", &cloth.mass, "kg", "Total mass, shared equally by all vertices. Not with `density` or `material`.")
      .above(0);
  keys.add("density", &cloth.density, "kg/m²",
           "Mass per area of the rest shape, instead of `mass`: each triangle gives a third of its mass to each of its "
           "vertices.")
      .above(0);
  keys.add("stiffness", &cloth.stiffness, "N/m",
           "Stiffness of every spring. There is one spring along each edge of the mesh.")
      .must_be_given_unless({"modulus", "material"})
      .above(0);
  keys.add("modulus", &cloth.modulus, "N/m",
           "Force per width and strain, instead of `stiffness`: each spring's stiffness follows from the adjacent "
           "areas, see [Materials](#materials). Two numbers: along the warp and along the weft, see "
           "[Warp and weft](#warp-and-weft).")
      .above(0);
  keys.add("warp", &cloth.warp, "degrees",
           "Direction of the warp in the rest shape, from the x axis towards y. Applies where `modulus` or the "
           "`rigidity` of [effects.bending] has two numbers.");
  std::vector<std::string> names;
  for (const Fabric& fabric : fabrics()) names.emplace_back(fabric.name);
  std::optional<std::size_t> chosen;
  if (cloth.material != nullptr) chosen = static_cast<std::size_t>(cloth.material - fabrics().data());
  keys.add("material", Choice{std::move(names), [&cloth](std::size_t i) { cloth.material = &fabrics()[i]; }, chosen},
           "",
           "A fabric. Sets density, modulus and bending rigidity unless the scene gives them, see "
           "[Materials](#materials).");
  keys.choice("spring", cloth.springs, {"edges", "edges+bend"},
              "Springs along the mesh's edges, or those of a course's grid: along the sides of its cells with "
              "`stiffness`, along both diagonals, and between every other vertex of a row or column, see "
              "[Springs of a grid](#springs-of-a-grid).");
  keys.add("shear_stiffness", &cloth.shear_stiffness, "N/m",
           "With `spring = \"edges+bend\"`: stiffness along the diagonals. Default: `stiffness`.")
      .above(0);
  keys.add("bend_stiffness", &cloth.bend_stiffness, "N/m",
           "With `spring = \"edges+bend\"`: stiffness between every other vertex. Default: `stiffness`.")
      .above(0);
  keys.add("pins", Written<PinsKind>{&cloth.pins}, "", "Vertices that do not move.");
  keys.add("velocity", &cloth.velocity, "m/s", "Initial velocity of every vertex that is not pinned.");
  keys.add("color", &cloth.color, "", "Colour of this cloth. Default: that of [look].").omit_from_hash();
  keys.add("texture", &cloth.texture, "", "Picture on this cloth, likewise. Needs a mesh with texture coordinates.")
      .omit_from_hash();
  return keys;
}

Keys transform_keys(ClothTable& cloth) {
  Keys keys;
  keys.add("scale", Written<ScaleKind>{&cloth.scale}, "",
           "Scales the mesh about its origin; applied first. Without `rest` the rest lengths scale too.");
  keys.add("rotate", &cloth.rotate, "degrees", "Rotates about the fixed x axis, then y, then z.");
  keys.add("translate", &cloth.translate, "m", "Moves the mesh; applied last.");
  return keys;
}

Keys seam_keys(SeamTable& seam) {
  Keys keys;
  keys.add("a", Written<SeamSideKind>{&seam.a}, "",
           "A side: the name of its cloth, and vertices in one open row along its edges, in any order.")
      .must_be_given();
  keys.add("b", Written<SeamSideKind>{&seam.b}, "", "The other side, of the same or of another cloth.").must_be_given();
  keys.add("time", &seam.time, "s",
           "Time at which the seam is closed. Until then each tie becomes shorter at constant speed.")
      .at_least(0)
      .omit_from_hash();
  keys.add("reverse", &seam.reverse, "",
           "Side b runs the other way. Otherwise it runs in the direction that keeps the ties shorter at the start.")
      .omit_from_hash();
  return keys;
}

Keys time_keys(Scene& scene) {
  Keys keys;
  keys.add("step", &scene.simulation.step, "s", "Length of a time step.").above(0);
  keys.add("accuracy", &scene.simulation.accuracy, "m",
           "Largest error a step may add to any vertex. Steps are cut into substeps (explicit: `verlet`); "
           "`scheme`, `tolerance` and `stop` follow "
           "([accuracy.md](../notes/accuracy.md#asking-for-an-accuracy)).")
      .above(0);
  keys.add("duration", &scene.duration, "s", "The scene's length, rounded to whole steps.")
      .at_least(0)
      .omit_from_hash();
  return keys;
}

Keys integrator_keys(IntegratorSettings& integrator) {
  Keys keys;
  std::string explicit_names, implicit_names;
  for (const MethodTraits& method : method_traits) {
    std::string& names = method.order > 0 ? explicit_names : implicit_names;
    names.append(names.empty() ? "" : ", ").append(method.name);
  }
  keys.choice("method", integrator.method, {method_names.begin(), method_names.end()},
              "How a step is computed. Auto: verlet in substeps, or quasi-newton where that is cheaper, see "
              "[command-line.md](command-line.md#methods). Explicit: " +
                  explicit_names + ". Implicit: " + implicit_names + ".");
  std::string schemes;
  for (const SchemeTraits& scheme : scheme_traits) schemes.append(schemes.empty() ? "" : ", or ").append(scheme.title);
  keys.choice("scheme", integrator.scheme, {scheme_names.begin(), scheme_names.end()},
              "Time integration of the implicit methods: " + schemes + ".");
  keys.choice("stop", integrator.stop, {stopping_rule_names.begin(), stopping_rule_names.end()},
              "Quantity that must fall below `tolerance` to end a step: the norm of an iteration's change (m), of the "
              "unbalanced force (N), or the [estimated error](../notes/accuracy.md#stopping-at-an-error) (m). Default: "
              "change if a `tolerance` is given, otherwise error. Implicit methods only, like the next two keys.");
  keys.add("tolerance", &integrator.tolerance, "m or N",
           "See `stop`. Default: 1e-3 for change and gradient; for error [a tenth of the time step's "
           "own](../notes/accuracy.md#the-default-tolerance).")
      .above(0);
  keys.add("max_iterations", &integrator.max_iterations, "",
           "Limit on the iterations of a step. Default: 20 for implicit, 100 for liu13, 500 for quasi-newton; 2000 for "
           "implicit and quasi-newton with `stop = \"error\"`.")
      .at_least(1);
  keys.choice("linear_solver", integrator.linear_solver, {"automatic", "cholesky", "conjugate-gradients"},
              "How implicit solves Newton's equations: by sparse Cholesky factorisation, or by conjugate gradients "
              "preconditioned with liu13's matrix. Automatic: by conjugate gradients until those have cost as much as "
              "a factorisation, then by that.");
  keys.add("substeps", &integrator.substeps, "",
           "Equal substeps that an explicit method cuts each step into. Default: 1; with method auto as many as are "
           "stable.")
      .at_least(1)
      .at_most(most_substeps);
  keys.add("allow_unstable", &integrator.allow_unstable, "",
           "Runs scenes that are otherwise rejected: explicit steps beyond the safe one, or implicit ones beyond "
           "double precision.");
  return keys;
}

Keys camera_keys(Camera& camera) {
  Keys keys;
  keys.add("position", &camera.position, "m",
           "Position of the camera. Default: placed so that the whole motion is in view.");
  keys.add("target", &camera.target, "m", "Point at the centre of the picture. Default: the centre of the motion.");
  keys.add("up", &camera.up, "", "Direction that points up in the picture.");
  keys.add("field_of_view", &camera.field_of_view, "degrees", "Vertical field of view.").at_least(1).at_most(170);
  keys.add("azimuth", &camera.azimuth, "degrees",
           "Viewing direction of a camera without a position: the angle in the xy plane, from +x towards +y. Default: "
           "the [best of sixteen](camera.md#viewing-direction).");
  keys.add("elevation", &camera.elevation, "degrees", "Angle above the xy plane, with the same default.")
      .at_least(-90)
      .at_most(90);
  keys.add("margin", &camera.margin, "", "Free border around the motion, as a fraction of the picture.")
      .at_least(0)
      .at_most(0.45);
  keys.add("follow", &camera.follow, "", "Follows the motion smoothly and as closely as possible.");
  keys.add("orbit", &camera.orbit, "degrees",
           "Angle by which the camera circles its target during the film: 360 loops without a break.");
  keys.add("outside", &camera.outside, "",
           "Fraction of the frames that may reach beyond a side of the picture, for a camera that is placed "
           "automatically and stays.")
      .at_least(0)
      .at_most(0.5);
  return keys;
}

Keys look_keys(Look& look, std::optional<Quality>& quality) {
  Keys keys;
  keys.add("texture", &look.texture, "", "Picture on the cloth. Needs a mesh with texture coordinates.");
  keys.add("color", &look.color, "", "Colour of the cloth without a texture.");
  keys.choice("color_by", look.color_by, {"stretch", "speed", "curvature"},
              "Colours the cloth by this quantity, with a colour bar below the picture, see "
              "[captions.md](captions.md#colours). `drape check` ignores it.");
  keys.add("color_limit", &look.color_limit, "1, m/s or 1/m",
           "Value of the last of these colours; the first is 0. Default: a value that 95 % of the cloth stays below.")
      .above(0);
  keys.add("anisotropy", &look.anisotropy, "",
           "Stretch of the texture, where the cloth is seen aslant, up to which it stays sharp; 1 is off. Takes time.")
      .at_least(1)
      .at_most(16);
  keys.add("mesh_lines", &look.mesh_lines, "", "Draws the edges of the triangles.");
  keys.add("line_color", &look.line_color, "", "Colour of these edges.");
  keys.add("line_width", &look.line_width, "pixels", "Width of these edges.").above(0).at_most(64);
  keys.add("background", &look.background, "", "Background colour. Default: studio grey.");
  keys.add("background_top", &look.background_top, "", "Colour at the top of the picture, for a gradient.");
  keys.add("sphere_color", &look.sphere_color, "", "Colour of the spheres.");
  keys.add("body_color", &look.body_color, "", "Colour of the bodies.");
  keys.add("ground_color", &look.ground_color, "", "Colour of the ground, which fades into the background.");
  keys.add("ground_grid", &look.ground_grid, "m", "Spacing of the lines on the ground; 0 draws none.").at_least(0);
  keys.add("shadows", &look.shadows, "", "Cloth and spheres cast shadows.");
  keys.add("ambient_occlusion", &look.ambient_occlusion, "",
           "Darkens surfaces close to the cloth and to spheres, where less ambient light arrives.");
  keys.add("translucency", &look.translucency, "",
           "Fraction of the key light that shines through the cloth: 0 for felt, 0.5 for thin cotton.")
      .at_least(0)
      .at_most(1);
  keys.add("thickness", &look.thickness, "m",
           "Thickness of the cloth's rounded hem; 0 draws none. Not with mesh_lines.")
      .at_least(0);
  keys.add("exposure", &look.exposure, "", "Factor on all light.").above(0).at_most(100);
  keys.add("key_azimuth", &look.key_azimuth, "degrees",
           "Direction of the key light: the angle in the xy plane, from +x towards +y. Default: it stands to the "
           "camera's upper left and goes with it.");
  keys.add("key_elevation", &look.key_elevation, "degrees", "Angle of the key light above the xy plane, likewise.")
      .at_least(-90)
      .at_most(90);
  keys.add("backdrop", &look.backdrop, "", "A floor below the motion, in `ground_color`, that only shows shadows.");
  keys.add("samples", &look.samples, "",
           "Samples per pixel: 1, 2 or 4. With 1, outlines are smoothed by the part of a pixel that they cover.")
      .at_least(1)
      .at_most(4);
  keys.choice("quality", quality, {"draft", "film", "print"},
              "Everything that trades time for detail: draft halves size, rate and a grid's cells, print doubles the "
              "size, see [command-line.md](command-line.md#quality).");
  return keys;
}

Keys video_keys(Video& video) {
  Keys keys;
  keys.add("fps", &video.fps, "1/s", "Frames per second.").above(0).at_most(1000);
  keys.add("speed", &video.speed, "", "Seconds of the scene per second of the film.").above(0);
  keys.add("size", &video.size, "pixels", "Width and height.").at_least(16).at_most(8192);
  return keys;
}

Keys caption_keys(CaptionSettings& caption) {
  Keys keys;
  keys.add("text", &caption.text, "",
           "The text, with values in braces: `t = {time:.2f} s`, see [captions.md](captions.md).")
      .must_be_given();
  keys.choice("place", caption.place, {"top-left", "top", "top-right", "bottom-left", "bottom", "bottom-right"},
              "Position in the picture.");
  keys.add("size", &caption.size, "pixels", "Height of the letters. Default: a 22nd of the picture's height.")
      .at_least(6)
      .at_most(512);
  keys.add("color", &caption.color, "",
           "Colour of the letters. Default: black or white, whichever is more legible on the background.");
  keys.choice("backing", caption.backing, {"none", "halo", "panel"},
              "Background of the letters, in black or white, to keep them legible: nothing, a soft halo, or a "
              "rectangle.");
  return keys;
}

Keys overlay_keys(OverlaySettings& overlay) {
  Keys keys;
  keys.add("energies", &overlay.energies, "",
           "Draws energy curves in a band below the picture, which makes the film higher than `size`.");
  return keys;
}

Keys check_keys(CheckSettings& check) {
  Keys keys;
  keys.replace("window", "the whole motion is compared now, in windows of 'window_time' seconds");
  keys.add("frames", &check.frames, "",
           "Frames of the film to compare, in ascending order. Default: those in which something happens.")
      .at_least(0);
  keys.add("size", &check.size, "pixels", "Size of the golden pictures. Default: that of the film.")
      .at_least(16)
      .at_most(8192);
  keys.add("window_time", &check.window_time, "s",
           "Length of a window of motion, after which the motion restarts from a golden state.")
      .above(0);
  keys.add("motion_tolerance", &check.motion_tolerance, "m",
           "Largest accepted distance of a vertex from its golden position. With 0 the bits must be the same.")
      .at_least(0);
  keys.add("channel_limit", &check.limits.channel, "1/255",
           "A picture is noise if no pixel differs by more than this in any channel…")
      .at_least(0)
      .at_most(255);
  keys.add("pixel_limit", &check.limits.pixels, "", "…and no more than this fraction of the pixels differs at all…")
      .at_least(0)
      .at_most(1);
  keys.add("flip_limit", &check.limits.flip, "", "…and no pixel's FLIP error (Andersson et al. 2020) exceeds this.")
      .at_least(0)
      .at_most(1);
  keys.add("time", &check.time, "",
           "Largest accepted ratio of the time of the first steps to that in the golden, both measured beside a "
           "calibration loop. Default: time is not compared.")
      .above(1);
  keys.add("ignore", &check.ignore, "pixels",
           "Parts of the golden pictures that are shown but not judged, measured from the top left.");
  keys.add("ignore_frames", &check.ignore_frames, "", "Frames whose pictures are shown but not judged.").at_least(0);
  return keys;
}

}  // namespace

std::vector<TableType> cloth_tables(ClothTable& cloth) {
  return {
      {.name = "cloth",
       .help = "A cloth: a mass-spring network on a triangle mesh. Several are `[[cloth]]`, see "
               "[Several cloths](#several-cloths).",
       .keys = cloth_keys(cloth),
       .required = true,
       .repeatable = true},
      {.name = "cloth.transform", .help = "Places the starting shape in the world.", .keys = transform_keys(cloth)}};
}

TableType seam_table(SeamTable& seam) {
  return {.name = "seam",
          .help = "Sews two borders together, see [Seams](#seams).",
          .keys = seam_keys(seam),
          .required = false,
          .repeatable = true};
}

std::vector<TableType> other_tables(Scene& scene) {
  using enum TableType::Affects;
  std::vector<TableType> tables;
  const auto add = [&](const char* name, TableType::Affects affects, const char* help, Keys keys) {
    tables.push_back(TableType{.name = name, .help = help, .keys = std::move(keys), .affects = affects});
  };
  add("time", motion, "Time step and duration.", time_keys(scene));
  add("integrator", motion, "How the motion is computed.", integrator_keys(scene.simulation.integrator));
  add("camera", picture, "The point of view.", camera_keys(scene.camera));
  add("look", picture, "Appearance.", look_keys(scene.look, scene.quality));
  add("video", picture, "The film.", video_keys(scene.video));
  add("caption", nothing, "Text on every frame of a film. `drape check` ignores it.", caption_keys(scene.caption));
  add("overlay", nothing, "Curves below the film, see [captions.md](captions.md). `drape check` ignores them.",
      overlay_keys(scene.overlay));
  add("check", nothing, "Settings of `drape check`, see [regression.md](regression.md). Nothing else uses them.",
      check_keys(scene.check));
  return tables;
}

std::vector<std::string> tables_that_affect(TableType::Affects what) {
  Scene scene;
  std::vector<std::string> names;
  for (const TableType& table : other_tables(scene)) {
    if (table.affects == what) names.push_back(table.name);
  }
  return names;
}

std::vector<TableType> scene_tables(ClothTable& cloth, SeamTable& seam, Scene& scene) {
  std::vector<TableType> tables = cloth_tables(cloth);
  tables.push_back(seam_table(seam));
  for (TableType& table : other_tables(scene)) tables.push_back(std::move(table));
  return tables;
}

TableType effect_table(const EffectType& type, Effect& effect) {
  TableType table{.name = "effects." + std::string(type.name), .help = {}, .keys = {}, .repeatable = type.repeatable};
  effect.describe(table.keys);
  return table;
}

namespace {

std::string range_text(const Key& key) {
  if (std::isfinite(key.minimum) && std::isfinite(key.maximum) && !key.minimum_excluded) {
    return fmt::format("{} to {}", key.minimum, key.maximum);
  }
  return Range{key.minimum, key.maximum, key.minimum_excluded}.text();
}

KeyText text_of(const Key& key) {
  const ValueKind& kind = kind_of(key);
  const std::string value = kind.form(key);
  const std::string range = range_text(key);
  return {.name = key.name,
          .form = range.empty() ? value : value + ", " + range,
          .values = kind.words(key),
          .unit = key.unit,
          .initial = kind.text(key),
          .help = key.help,
          .required = key.required,
          .alternatives = key.alternatives};
}

TableText text_of(const TableType& table) {
  TableText text{.name = table.name, .help = table.help, .repeatable = table.repeatable, .keys = {}};
  for (const Key& key : table.keys.all()) text.keys.push_back(text_of(key));
  return text;
}

/// Returns a key's line: its name, form, unit, default and meaning.
std::string item(const KeyText& key) {
  std::string form = key.form;
  if (!key.unit.empty()) form += " [" + key.unit + "]";
  if (key.required || !key.alternatives.empty()) {
    form += ", **required**";
  } else if (!key.initial.empty()) {
    form += ", default `" + key.initial + "`";
  }
  for (std::size_t i = 0; i < key.alternatives.size(); ++i) {
    form += fmt::format("{} `{}`", i == 0 ? " without" : " or", key.alternatives[i]);
  }
  return fmt::format("- `{}`: {}. {}\n", key.name, form, key.help);
}

std::string section(const TableText& table) {
  std::string text = table.repeatable ? fmt::format("### `[{0}]` or several `[[{0}]]`\n\n", table.name)
                                      : fmt::format("### `[{}]`\n\n", table.name);
  if (!table.help.empty()) text += table.help + "\n\n";
  for (const KeyText& key : table.keys) text += item(key);
  return text + "\n";
}

}  // namespace

void for_each_table(const std::function<void(const TableType&)>& use) {
  ClothTable cloth;
  SeamTable seam;
  Scene scene;
  for (const TableType& table : scene_tables(cloth, seam, scene)) use(table);
  for (const EffectType& type : effect_types()) {
    Effect effect = type.make();
    use(effect_table(type, effect));
  }
}

std::vector<TableText> reference_tables() {
  std::vector<TableText> tables;
  for_each_table([&](const TableType& table) { tables.push_back(text_of(table)); });
  return tables;
}

std::string format_reference() {
  std::string text;
  for (const TableText& table : reference_tables()) text += section(table);
  return text;
}

}  // namespace drape

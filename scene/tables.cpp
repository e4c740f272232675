#include "scene/tables.hpp"

namespace drape {
namespace {

Keys cloth_keys(ClothTable& cloth) {
  Keys keys;
  keys.add("mesh", OwnForm{"mesh", &cloth.mesh}, "", "The shape that the cloth starts from.").must_be_given();
  keys.add("rest", OwnForm{"mesh", &cloth.rest}, "",
           "The shape whose edges are as long as the springs want to be, with the vertices and triangles of `mesh`. "
           "Without it that is the starting shape.");
  keys.add("mass", &cloth.mass, "kg",
           "Of the whole cloth, shared equally by all vertices; without `density` and `material`.")
      .above(0);
  keys.add("density", &cloth.density, "kg/m²",
           "Mass per area of the rest shape, instead of `mass`: each triangle gives its vertices a third of its own.")
      .above(0);
  keys.add("stiffness", &cloth.stiffness, "N/m", "Of every spring: there is one along each edge of the mesh.")
      .must_be_given_unless({"modulus", "material"})
      .above(0);
  keys.add("modulus", &cloth.modulus, "N/m",
           "Force per width and strain, instead of `stiffness`: each spring's follows from the areas beside it, see "
           "[Materials](#materials).")
      .above(0);
  std::vector<std::string> names;
  for (const Fabric& fabric : fabrics()) names.emplace_back(fabric.name);
  std::optional<std::size_t> chosen;
  if (cloth.material != nullptr) chosen = static_cast<std::size_t>(cloth.material - fabrics().data());
  keys.add(
      "material", Choice{std::move(names), [&cloth](std::size_t i) { cloth.material = &fabrics()[i]; }, chosen}, "",
      "A fabric that has been measured: its density, modulus and rigidity against bending, where nothing else says "
      "them, see [Materials](#materials).");
  keys.add("pins", OwnForm{"pins", &cloth.pins}, "", "The vertices that do not move.");
  keys.add("velocity", &cloth.velocity, "m/s", "Of every vertex that is not pinned, at the start.");
  return keys;
}

Keys transform_keys(ClothTable& cloth) {
  Keys keys;
  keys.add("scale", OwnForm{"number or [x, y, z], above 0", &cloth.scale}, "",
           "Sizes the mesh about its origin; first of the three. Without `rest` the springs grow with it.");
  keys.add("rotate", &cloth.rotate, "degrees", "Turns about the fixed x axis, then y, then z.");
  keys.add("translate", &cloth.translate, "m", "Moves it; last of the three.");
  return keys;
}

Keys time_keys(Scene& scene) {
  Keys keys;
  keys.add("step", &scene.simulation.step, "s", "Length of a time step.").above(0);
  keys.add(
          "accuracy", &scene.simulation.accuracy, "m",
          "The most that a step may add to the error of a vertex: it is cut into as many equal substeps as that takes, "
          "see [accuracy.md](accuracy.md#asking-for-an-accuracy), and `tolerance` and `stop` follow from it.")
      .above(0);
  keys.add("duration", &scene.duration, "s", "How long the scene lasts, rounded to whole steps.").at_least(0);
  return keys;
}

Keys integrator_keys(IntegratorSettings& integrator) {
  Keys keys;
  keys.choice(
      "method", integrator.method, {method_names.begin(), method_names.end()},
      "How a step is computed: semi-implicit is symplectic Euler and verlet velocity Verlet, both explicit; the "
      "others are implicit, solved by Newton's method, by the alternation of Liu et al. 2013, or by L-BFGS "
      "that starts from its matrix.");
  keys.choice("scheme", integrator.scheme, {scheme_names.begin(), scheme_names.end()},
              "How time advances with an implicit method: backward Euler, of first order, or in two stages that are "
              "solved like its steps, of second order (Alexander 1977).");
  keys.choice(
      "stop", integrator.stop, {stopping_rule_names.begin(), stopping_rule_names.end()},
      "An iteration ends a step when the norm of the change of the positions (in m), the norm of the forces out "
      "of balance (in N), or the estimated distance of the worst vertex from the exact end of the step (in m, "
      "see [accuracy.md](accuracy.md#stopping-at-an-error)) is below the tolerance. Without it change where "
      "there is a tolerance, error where there is none. Only for implicit methods, like the next two.");
  keys.add("tolerance", &integrator.tolerance, "m or N",
           "See `stop`. Without it 1e-3 for change and gradient; for error 1e-4 of the cloth's size, or 0.003 of how "
           "far the external forces move a vertex in a step, if that is less.")
      .above(0);
  keys.add("max_iterations", &integrator.max_iterations, "",
           "The step ends after as many in any case. Without it 20 for implicit, 100 for liu13, and for quasi-newton "
           "500, or 2000 "
           "where it stops at an error.")
      .at_least(1);
  keys.choice(
      "linear_solver", integrator.linear_solver, {"automatic", "cholesky", "conjugate-gradients"},
      "How the implicit method solves Newton's equations: by a sparse factor, or by conjugate gradients that are "
      "preconditioned with liu13's matrix.");
  keys.add("allow_unstable", &integrator.allow_unstable, "",
           "Run what is refused otherwise: an explicit method with a step beyond its largest safe one, or an "
           "implicit one where double precision cannot hold the inertia beside the springs.");
  return keys;
}

Keys camera_keys(Camera& camera) {
  Keys keys;
  keys.add("position", &camera.position, "m",
           "Where the camera stands. Without it, it stands where the whole motion is in view.");
  keys.add("target", &camera.target, "m", "The middle of the picture. Without it the middle of the motion.");
  keys.add("up", &camera.up, "", "A direction that points upwards in the picture.");
  keys.add("field_of_view", &camera.field_of_view, "degrees", "Of the picture's height.").at_least(1).at_most(170);
  keys.add("azimuth", &camera.azimuth, "degrees",
           "Where a camera without a position looks from: the angle in the xy plane, from +x towards +y. Without it, "
           "that from which most is seen of the cloth, of spheres and of the motion: see [camera.md](camera.md).");
  keys.add("elevation", &camera.elevation, "degrees", "The angle above the xy plane, likewise.")
      .at_least(-90)
      .at_most(90);
  keys.add("margin", &camera.margin, "", "What it leaves free around the motion, as a fraction of the picture.")
      .at_least(0)
      .at_most(0.45);
  keys.add(
      "follow", &camera.follow, "",
      "Goes with what moves, and as near as it can: evenly, as it knows what comes. Otherwise the camera stays where "
      "the whole motion is in view.");
  keys.add(
      "orbit", &camera.orbit, "degrees",
      "How far it goes around its target during the film: 360 is a turntable, on which a film that repeats does not "
      "halt.");
  return keys;
}

Keys look_keys(Look& look) {
  Keys keys;
  keys.add("texture", &look.texture, "", "The picture on the cloth, which needs a mesh with texture coordinates.");
  keys.add("color", &look.color, "", "Of the cloth, where it has no texture.");
  keys.choice(
      "color_by", look.color_by, {"stretch", "speed", "curvature"},
      "Colours the cloth by what it does, in place of texture and color, with a bar below the picture that says "
      "what they mean; see [captions.md](captions.md#colours). `drape check` draws the cloth without.");
  keys.add(
          "color_limit", &look.color_limit, "1, m/s or 1/m",
          "What the last of these colours stands for; the first is 0. A stretch of 0.1 is 10 %. Without it 95 % of the "
          "cloth stay below it in the whole motion.")
      .above(0);
  keys.add("anisotropy", &look.anisotropy, "",
           "How much finer the texture is filtered across a slanted view than along it, where OpenGL can; 1 is off. In "
           "software it takes about nine times as long.")
      .at_least(1)
      .at_most(16);
  keys.add("mesh_lines", &look.mesh_lines, "", "Draws the edges of the triangles.");
  keys.add("line_color", &look.line_color, "", "Of these edges.");
  keys.add("line_width", &look.line_width, "pixels", "Of these edges.").above(0).at_most(64);
  keys.add("background", &look.background, "", "Behind everything; without it, the grey of a studio.");
  keys.add("background_top", &look.background_top, "", "At the top of the picture: the background is a gradient.");
  keys.add("sphere_color", &look.sphere_color, "", "Of the spheres.");
  keys.add("ground_color", &look.ground_color, "", "Of the ground, which fades into the background.");
  keys.add("ground_grid", &look.ground_grid, "m", "Distance of the lines on the ground; 0: it has none.").at_least(0);
  keys.add("shadows", &look.shadows, "", "Cloth and spheres hide the brightest light from what is behind them.");
  keys.add("ambient_occlusion", &look.ambient_occlusion, "",
           "What cloth and spheres are close to gets less of the light from all around.");
  keys.add("translucency", &look.translucency, "",
           "The part of the brightest light that shines through the cloth: 0 for felt, 0.5 for thin cotton.")
      .at_least(0)
      .at_most(1);
  keys.add("samples", &look.samples, "", "Per pixel, against jagged edges: 1 (off), 2 or 4.").at_least(1).at_most(4);
  return keys;
}

Keys video_keys(Video& video) {
  Keys keys;
  keys.add("fps", &video.fps, "1/s", "Frames per second.").above(0).at_most(1000);
  keys.add("speed", &video.speed, "", "How many seconds of the scene pass in one second of the film.").above(0);
  keys.add("size", &video.size, "pixels", "Width and height.").at_least(16).at_most(8192);
  return keys;
}

Keys caption_keys(CaptionSettings& caption) {
  Keys keys;
  keys.add("text", &caption.text, "",
           "What it says, with names in braces: `t = {time:.2f} s`, see [captions.md](captions.md).")
      .must_be_given();
  keys.choice("place", caption.place, {"top-left", "top", "top-right", "bottom-left", "bottom", "bottom-right"},
              "Where in the picture.");
  keys.add("size", &caption.size, "pixels", "Of the letters. Without it a 22nd of the picture's height.")
      .at_least(6)
      .at_most(512);
  keys.add("color", &caption.color, "",
           "Of the letters. Without it black or white, whichever is read better on the background.");
  keys.choice(
      "backing", caption.backing, {"none", "halo", "panel"},
      "What is behind the letters, in black or white, so that they are read on anything: nothing, a soft rim, or "
      "a rectangle.");
  return keys;
}

Keys overlay_keys(OverlaySettings& overlay) {
  Keys keys;
  keys.add("energies", &overlay.energies, "",
           "The energies' curves, in a band below the picture, by which the film is higher than `size` says.");
  return keys;
}

Keys check_keys(CheckSettings& check) {
  Keys keys;
  keys.add("frames", &check.frames, "",
           "The film's frames that are compared, ascending. Without it those in which something happens.")
      .at_least(0);
  keys.add("size", &check.size, "pixels", "Of the golden pictures. Without it the film's.").at_least(16).at_most(8192);
  keys.add("window_time", &check.window_time, "s",
           "After which the motion, all of which is compared, starts again from a golden state.")
      .above(0);
  keys.add("motion_tolerance", &check.motion_tolerance, "m",
           "How far a vertex may be from its golden place. With 0 the bits must be the same.")
      .at_least(0);
  keys.add("channel_limit", &check.limits.channel, "1/255",
           "A picture that differs is still the same, but for rounding, if no pixel differs by more in any channel…")
      .at_least(0)
      .at_most(255);
  keys.add("pixel_limit", &check.limits.pixels, "", "…and no larger fraction of the pixels differs at all…")
      .at_least(0)
      .at_most(1);
  keys.add("flip_limit", &check.limits.flip, "", "…and no pixel's FLIP error (Andersson et al. 2020) is larger.")
      .at_least(0)
      .at_most(1);
  keys.add("ignore", OwnForm{"[[x, y, width, height], …]", &check.ignore}, "pixels",
           "Parts of the golden pictures that are shown, but not judged; from the top left.");
  keys.add("ignore_frames", &check.ignore_frames, "", "Frames whose pictures are shown, but not judged.").at_least(0);
  return keys;
}

}  // namespace

std::vector<TableType> scene_tables(ClothTable& cloth, Scene& scene) {
  std::vector<TableType> tables;
  const auto add = [&](const char* name, const char* help, Keys keys) -> TableType& {
    return tables.emplace_back(TableType{.name = name, .help = help, .keys = std::move(keys)});
  };
  add("cloth", "The cloth: a mass-spring network on a triangle mesh.", cloth_keys(cloth)).required = true;
  add("cloth.transform", "Places the starting shape in the world.", transform_keys(cloth));
  add("time", "How time is divided.", time_keys(scene));
  add("integrator", "How the motion is computed.", integrator_keys(scene.simulation.integrator));
  add("camera", "Where the picture is taken from.", camera_keys(scene.camera));
  add("look", "What things look like.", look_keys(scene.look));
  add("video", "The film.", video_keys(scene.video));
  add("caption", "A text on every picture of a film. `drape check` draws none.", caption_keys(scene.caption));
  add("overlay", "What goes along with the film, see [captions.md](captions.md). `drape check` draws none of it.",
      overlay_keys(scene.overlay));
  add("check", "What `drape check` compares, see [regression.md](regression.md). Nothing else reads it.",
      check_keys(scene.check))
      .replaced = {{"window", "the whole motion is compared now, in windows of 'window_time' seconds"}};
  return tables;
}

TableType effect_table(const EffectType& type, Effect& effect) {
  TableType table{.name = "effects." + std::string(type.name), .help = {}, .keys = {}, .repeatable = type.repeatable};
  effect.describe(table.keys);
  return table;
}

}  // namespace drape

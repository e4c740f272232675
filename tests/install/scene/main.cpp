#include <cstdio>
#include <drape/scene/scene.hpp>
#include <drape/sim/simulation.hpp>

// scene SCENE: prints the last positions in the format of drape simulate --positions.
int main(int, char** argv) {
  try {
    const drape::LoadedScene scene = drape::load_scene(argv[1]);
    drape::Simulation simulation(scene.simulation);
    while (simulation.state().step < scene.step_count()) simulation.step();
    const drape::Vertices& x = simulation.state().x;
    std::puts("vertex,x,y,z");
    for (int i = 0; i < x.rows(); ++i) std::printf("%d,%.17g,%.17g,%.17g\n", i, x(i, 0), x(i, 1), x(i, 2));
  } catch (const drape::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

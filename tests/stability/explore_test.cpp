#include <gtest/gtest.h>
#include <filesystem>
#include <cstdio>
#include <cstdlib>
#include "scene/scene.hpp"
#include "tests/stability/step_ledger.hpp"
#include "tests/stability/traps.hpp"
#include "tests/support/methods.hpp"
namespace drape::test {
TEST(Explore, All) {
  std::vector<std::filesystem::path> files;
  for (auto& e : std::filesystem::directory_iterator(DRAPE_SOURCE_DIR "/scenes/hard")) if (e.path().extension()==".toml") files.push_back(e.path());
  std::sort(files.begin(), files.end());
  const char* only = getenv("ONLY");
  for (auto& f : files) for (auto& m : implicit_methods) {
    if (only && f.stem().string().find(only)==std::string::npos) continue;
    try {
    std::vector<std::string> o{std::string("integrator.method=")+ std::string(method_names[(int)m.method])};
    if (m.linear_solver==LinearSolver::cholesky) o.push_back("integrator.linear_solver=cholesky");
    if (getenv("TOL")) o.push_back(std::string("integrator.tolerance=")+getenv("TOL"));
    Scene s = load_scene(f, o);
    std::printf("%-32s %-16s ", f.stem().c_str(), m.name); std::fflush(stdout);
    StepLedger ledger(s.simulation);
    std::unique_ptr<FloatingPointTraps> traps;
    if (getenv("TRAPS")) traps=std::make_unique<FloatingPointTraps>();
    Simulation sim(s.simulation);
    Real p_err=0, res_err=0, bal_err=0, g_rise=-1e300L, gain_max=-1e300L, work=0, e0=0, e1=0, emax=0; int unconv=0; double worst=0; int its=0;
    auto p0=ledger.momentum(sim.state());
    for (int64_t n=0;n<s.step_count();++n) {
      State b=sim.state();
      auto r=sim.step();
      unconv+=!r.converged; its+=r.iterations;
      auto e=ledger.balance(b,sim.state());
      if(n==0) e0=e.kinetic_before+e.energy_before;
      e1=e.kinetic_after+e.energy_after; emax=std::max({emax,e1,e0});
      work+=e.work;
      gain_max=std::max(gain_max,e.gain());
      res_err=std::max(res_err,std::abs(e.gradient_norm-sim.residual())/(e.gradient_rounding+1e-300L));
      g_rise=std::max(g_rise,(e.end_value-e.start_value)/(e.energy_rounding+1e-300L));
      if(!r.converged) worst=std::max(worst,sim.residual());
      Real en=sim.energies().elastic;
      bal_err=std::max(bal_err,std::abs(en-e.elastic_after)/(e.energy_rounding+1e-300L));
    }
    p_err=(ledger.momentum(sim.state())-p0).norm();
    std::printf("unconv %3d its %5.1f worst %8.2g resErr %8.2g elErr %8.2g gRise %8.2g gainMax %8.2g E0 %8.2g E1 %8.2g W %8.2g growth/emax %9.2g p %8.2g x %8.2g\n", unconv, its/(double)s.step_count(), worst,(double)res_err,(double)bal_err,(double)g_rise,(double)gain_max,(double)e0,(double)e1,(double)work,(double)((e1-e0-work)/emax), (double)(p_err/(ledger.momentum_scale(sim.state())+1e-300L)), sim.state().x.cwiseAbs().maxCoeff());
    } catch (const std::exception& e) { std::printf("%-32s %-16s EXC %s\n", f.stem().c_str(), m.name, e.what()); }
  }
}
}

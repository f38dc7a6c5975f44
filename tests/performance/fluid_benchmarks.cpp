// Speed of the fluid: million updates of wet cells per second (MLUPS), against the memory traffic of an update: 19
// populations read and written, 152 bytes in float and 304 in double.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "lbm/step/fluid.h"
#include "tests/performance/benchmark.h"

namespace lahar::performance {

namespace {

using lbm::Fluid;
using lbm::FluidOptions;

template <class Real>
constexpr double kBytesPerCell = 2.0 * 19.0 * sizeof(Real);

/// A periodic box of liquid, no surface: cells per axis.
FluidOptions box_options(const Vec3i& cells) {
  FluidOptions o;
  o.domain.cell_size = 0.01;
  o.domain.upper = 0.01 * cells.cast<double>();
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.time_step = 1e-3;
  o.kinematic_viscosity = 1e-6;
  return o;
}

Vec3 wavy(const Vec3& p) {
  const double k = 2 * std::numbers::pi / 0.64;
  return {0.03 * std::sin(k * p.y()), 0.03 * std::sin(k * p.z()), 0.03 * std::sin(k * p.x())};
}

/// MLUPS of wet cells over a number of steps, best of the session's repeats.
template <class Real>
double rate(Fluid<Real>& fluid, int steps, const Session& session) {
  fluid.step();
  double best = 0;
  for (int r = 0; r < session.repeats; ++r) {
    const double updates = fluid.cell_updates();
    const double seconds = best_seconds(1, [&] {
      for (int s = 0; s < steps; ++s) fluid.step();
    });
    best = std::max(best, (fluid.cell_updates() - updates) / seconds / 1e6);
  }
  return best;
}

template <class Real>
Figure bulk(const std::string& name, double smagorinsky, double bar, const Session& session) {
  FluidOptions o = box_options({192, 192, 192});
  o.smagorinsky = smagorinsky;
  Fluid<Real> fluid(o);
  fluid.fill_everything(wavy, [](const Vec3&) { return 0.0; });
  const double mlups = rate(fluid, 10, session);
  const double limit = session.limits.stream_all * 1e3 / kBytesPerCell<Real>;
  return {name, mlups, "MLUPS", mlups / limit, "in-place stream rate of all threads", bar, true, true};
}

/// Liquid in layers that fill about a third of each block: slabs of 3 of 8 cells between free-slip walls.
Figure thin_layer(const Session& session) {
  FluidOptions o = box_options({384, 384, 64});
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::closed;
  for (int k = 0; k < 8; ++k) {
    const double z = 0.08 * k;
    o.domain.walls.add({"slab", SolidBox{Vec3(-1, -1, z + 0.03), Vec3(5, 5, z + 0.08)}, WallSlip::free_slip});
  }
  Fluid<float> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(0.03, 0.02, 0); }, [](const Vec3&) { return 0.0; });
  const double mlups = rate(fluid, 10, session);
  const double limit = session.limits.stream_all * 1e3 / kBytesPerCell<float>;
  return {"fluid.thin_layer", mlups, "MLUPS", mlups / limit, "in-place stream rate of all threads", 0.25, true, true};
}

FluidOptions dam_options(double cell, const Vec3& upper) {
  FluidOptions o;
  o.domain.cell_size = cell;
  o.domain.upper = upper;
  o.domain.faces[5] = lbm::FaceKind::open;
  o.gravity = Vec3(0, 0, -9.81);
  o.time_step = 0.1 * cell / 3.0;
  return o;
}

/// A column 0.6 m high collapses; from the first contact with the far wall on, so that there is a surface and spray.
Figure dam_break(const Session& session) {
  Fluid<float> fluid(dam_options(0.008, {1.6, 0.6, 0.8}));
  fluid.fill({{Vec3::Zero(), Vec3(0.5, 0.6, 0.6)}});
  while (fluid.steps() * fluid.options().time_step < 0.5) fluid.step();
  const double mlups = rate(fluid, 100, session), plain = session.value_of("fluid.plain");
  return {"fluid.dam_break", mlups, "MLUPS", mlups / plain, "fluid.plain", 0.40};
}

/// Time of the conversion of cells in the same dam break: of one thread over that of all. Both go on from the same
/// state in turn, so that they convert like cells.
Figure conversion_speedup(const Session& session) {
  Fluid<float> fluid(dam_options(0.008, {1.6, 0.6, 0.8}));
  fluid.fill({{Vec3::Zero(), Vec3(0.5, 0.6, 0.6)}});
  while (fluid.steps() * fluid.options().time_step < 0.5) fluid.step();
  const auto seconds = [&](int threads) {
    const ThreadLimit limit(threads);
    const double before = fluid.timers().seconds().at("fluid.conversion");
    for (int s = 0; s < 8; ++s) fluid.step();
    return fluid.timers().seconds().at("fluid.conversion") - before;
  };
  const int threads = thread_count();
  double one = 0, all = 0;
  for (int r = 0; r < 12 * session.repeats; ++r) one += seconds(1), all += seconds(threads);
  return {
      "fluid.conversion_speedup", 1e3 * all / (96 * session.repeats), "ms/step", one / all, "the same on one thread",
      threads > 1 ? 1.7 : 0.9};
}

struct Cost {
  double seconds;
  double bytes;
};

Cost pool_at_rest(const Vec3& upper, const Session& session) {
  FluidOptions o = dam_options(0.01, upper);
  Fluid<float> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.96, 0.96, 0.4)}});
  for (int s = 0; s < 32; ++s) fluid.step();
  const double seconds = best_seconds(session.repeats, [&] {
    for (int s = 0; s < 32; ++s) fluid.step();
  });
  return {seconds, static_cast<double>(fluid.grid().bytes())};
}

/// The same pool in a box that it fills and in one that is 95 % empty, walls at the same places.
Figure sparse(const Session& session, bool memory) {
  const Cost tight = pool_at_rest({0.96, 0.96, 0.48}, session), wide = pool_at_rest({0.96, 0.96, 8.0}, session);
  if (memory)
    return {"fluid.sparse_memory",
            wide.bytes / 1e6,
            "MB",
            wide.bytes / tight.bytes,
            "the same liquid in a tight box",
            1.10,
            false};
  return {
      "fluid.sparse", wide.seconds / 32, "s/step", wide.seconds / tight.seconds, "the same liquid in a tight box", 1.10,
      false};
}

/// The whole fluid step of a box of plain liquid against its bare sweep: what the passes for features cost that the
/// scene does not use.
Figure features_off(const Session& session) {
  Fluid<float> fluid(box_options({192, 192, 192}));
  fluid.fill_everything(wavy, [](const Vec3&) { return 0.0; });
  const double step = rate(fluid, 10, session);
  auto& timers = fluid.timers();
  const double sweep = timers.seconds().at("fluid.sweep");
  double all = 0;
  for (const auto& [name, seconds] : timers.seconds()) all += seconds;
  return {"fluid.features_off", step, "MLUPS", sweep / all, "the sweep's share of the step", 0.97};
}

}  // namespace

std::vector<Benchmark> fluid_benchmarks() {
  return {
      {"fluid.plain", {}, [](Session& s) { return bulk<float>("fluid.plain", 0, 0.65, s); }},
      {"fluid.plain_double", {}, [](Session& s) { return bulk<double>("fluid.plain_double", 0, 0.60, s); }},
      {"fluid.plain_les", {}, [](Session& s) { return bulk<float>("fluid.plain_les", 0.1, 0.55, s); }},
      {"fluid.thin_layer", {}, [](Session& s) { return thin_layer(s); }},
      {"fluid.dam_break", {"fluid.plain"}, [](Session& s) { return dam_break(s); }},
      {"fluid.conversion_speedup", {}, [](Session& s) { return conversion_speedup(s); }},
      {"fluid.sparse", {}, [](Session& s) { return sparse(s, false); }},
      {"fluid.sparse_memory", {}, [](Session& s) { return sparse(s, true); }},
      {"fluid.features_off", {}, [](Session& s) { return features_off(s); }},
  };
}

}  // namespace lahar::performance

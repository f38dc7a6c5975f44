// The same scene on one thread and on two, each twice: every velocity, fill level and pressure must agree in every bit.
#include <bit>
#include <cstdint>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "core/parallel.h"

namespace lahar::validate {

namespace {

template <class Real>
std::vector<std::uint64_t> bits_of(const lbm::Fluid<Real>& fluid) {
  std::vector<std::uint64_t> bits;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    for (const double x : {c.velocity.x(), c.velocity.y(), c.velocity.z(), c.fill_level, c.pressure})
      bits.push_back(std::bit_cast<std::uint64_t>(x));
  });
  return bits;
}

/// An under-resolved vortex between two walls, with an eddy viscosity.
template <class Real>
std::vector<std::uint64_t> single_phase(bool quick) {
  const int n = quick ? 16 : 32;
  lbm::FluidOptions o = lattice_box({n, n, n - 2}, 1e-5);
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::closed;
  o.smagorinsky = 0.1;
  lbm::Fluid<Real> fluid(o);
  const double k = 2 * std::numbers::pi / n;
  fluid.fill_everything(
      [&](const Vec3& p) {
        return Vec3(0.1 * std::sin(k * p.x()) * std::cos(k * p.y()), -0.1 * std::cos(k * p.x()) * std::sin(k * p.z()),
                    0.05 * std::sin(k * p.y()));
      },
      no_pressure);
  advance(fluid, quick ? 200 : 1000);
  return bits_of(fluid);
}

/// A column of water that falls over and splashes against the far wall.
template <class Real>
std::vector<std::uint64_t> splash(bool quick) {
  lbm::FluidOptions o;
  o.domain.upper = Vec3(0.8, 0.2, 0.6);
  o.domain.cell_size = quick ? 0.04 : 0.02;
  o.domain.faces[5] = lbm::FaceKind::open;
  o.time_step = 0.1 * o.domain.cell_size / 3.0;
  o.gravity = Vec3(0, 0, -9.81);
  o.smagorinsky = 0.1;
  lbm::Fluid<Real> fluid(o);
  fluid.fill({{Vec3(0, 0, 0), Vec3(0.2, 0.2, 0.4)}});
  advance(fluid, static_cast<int>(0.8 / o.time_step));
  return bits_of(fluid);
}

/// How many numbers differ from the first run's; all of them if there are not as many.
double differing(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  if (a.size() != b.size()) return static_cast<double>(std::max(a.size(), b.size()));
  double count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

template <class Scene>
void compare(std::vector<Row>& rows, const std::string& name, const Scene& scene) {
  std::vector<std::uint64_t> first;
  for (const int threads : {1, 2})
    for (const int time : {1, 2}) {
      const ThreadLimit limit(threads);
      const auto bits = scene();
      if (first.empty())
        first = bits;
      else
        rows.push_back(at_most_row(
            name + ": numbers that differ, " + std::to_string(thread_count()) + " threads, run " + std::to_string(time),
            differing(first, bits), 0));
    }
  rows.push_back(at_least_row(name + ": numbers compared", static_cast<double>(first.size()), 1000));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const bool quick = context.quick;
  compare(rows, "vortex, double", [&] { return single_phase<double>(quick); });
  compare(rows, "vortex, float", [&] { return single_phase<float>(quick); });
  compare(rows, "splash, double", [&] { return splash<double>(quick); });
  compare(rows, "splash, float", [&] { return splash<float>(quick); });
  {
    const ThreadLimit limit(2);
    rows.push_back(at_least_row("threads of the second pair of runs", thread_count(), 2));
  }
  return rows;
}

}  // namespace

Entry determinism() { return {"fluid.determinism", {"the program itself, run again"}, run}; }

}  // namespace lahar::validate

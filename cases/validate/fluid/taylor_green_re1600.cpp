// Three-dimensional Taylor-Green vortex at Re = 1600: the peak of the dissipation -dE/dt, with the default operator and
// no eddy viscosity. Length L = 1 / wave number, speed V0; E = <u^2> / (2 V0^2), time in L / V0.
//   u = V0 (sin x cos y cos z, -cos x sin y cos z, 0), p = (cos 2x + cos 2y)(cos 2z + 2) rho V0^2 / 16
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "cases/pictures/chart.h"
#include "cases/validate/fluid/entries.h"
#include "cases/validate/fluid/flows.h"

namespace lahar::validate {

namespace {

constexpr double kReynolds = 1600;
constexpr double kSpeed = 0.1;     // V0, lu, what scenes take by default: Ma = 0.17, Ma^2 = 3 %
constexpr double kDuration = 10;   // L / V0
constexpr double kSampling = 0.1;  // L / V0 between two looks at the energy
constexpr double kPeak = 0.01279, kPeakTime = 8.90;

// -dE/dt of a spectral simulation: wang_2013.dat, read in chaos-polymtl/lethe (examples/incompressible-flow/
// 3d-taylor-green-vortex/reference), digitised, every first to second point kept. Trust: peak within 1 %.
const std::vector<double> kReferenceTime = {0.0546, 0.5872, 1.0158, 1.7293, 2.2917, 2.7707, 3.219,  3.5612, 3.8916,
                                            4.1513, 4.3558, 4.5722, 4.8004, 5.1072, 5.3865, 5.8507, 6.2441, 6.5352,
                                            6.9482, 7.2512, 7.44,   7.8375, 8.0658, 8.2988, 8.5021, 8.6558, 8.74,
                                            8.9035, 9.0225, 9.1067, 9.3048, 9.5524, 10.0429};
const std::vector<double> kReferenceDissipation = {
    0.0004967, 0.0005146, 0.0005347, 0.0006551, 0.0008333, 0.0010347, 0.0012999, 0.0015722, 0.001986,
    0.002428,  0.0028594, 0.0033403, 0.0038071, 0.0043977, 0.0047972, 0.0053913, 0.0061057, 0.0068093,
    0.0073504, 0.0080718, 0.0086658, 0.0099388, 0.0107064, 0.0114014, 0.0121142, 0.0126355, 0.0127347,
    0.0127907, 0.0127848, 0.0126578, 0.0121054, 0.0116867, 0.0112813};

struct Curve {
  std::vector<double> time, dissipation;  // L / V0, V0^3 / L
};

template <class Real>
Curve dissipation_curve(int cells, double duration) {
  const double length = cells / (2 * std::numbers::pi), k = 1 / length;
  lbm::Fluid<Real> fluid(lattice_box(Vec3i::Constant(cells), kSpeed * length / kReynolds));
  fluid.fill_everything(
      [&](const Vec3& p) {
        return Vec3(kSpeed * std::sin(k * p.x()) * std::cos(k * p.y()) * std::cos(k * p.z()),
                    -kSpeed * std::cos(k * p.x()) * std::sin(k * p.y()) * std::cos(k * p.z()), 0);
      },
      [&](const Vec3& p) {
        return 3 * kSpeed * kSpeed / 16 * (std::cos(2 * k * p.x()) + std::cos(2 * k * p.y())) *
               (std::cos(2 * k * p.z()) + 2);
      },
      lbm::Start::with_stress);
  const int interval = static_cast<int>(std::lround(kSampling * length / kSpeed));
  const double dt = interval * kSpeed / length, volume = std::pow(cells, 3) * kSpeed * kSpeed;
  Curve curve;
  double before = kinetic_energy(fluid) / volume;
  for (int sample = 0; sample * dt < duration; ++sample) {
    advance(fluid, interval);
    const double energy = kinetic_energy(fluid) / volume;
    curve.time.push_back((sample + 0.5) * dt);
    curve.dissipation.push_back((before - energy) / dt);
    before = energy;
  }
  return curve;
}

void draw(const Curve& curve, int cells, const std::filesystem::path& folder) {
  cases::Chart{
      .title = "Taylor-Green vortex, Re = 1600",
      .x = {"t V_{0} / L"},
      .y = {"−dE/dt L / V_{0}^{3}"},
      .series = {{.name = fmt::format("{}^{{3}}, central moments", cells), .x = curve.time, .y = curve.dissipation},
                 {.name = "spectral (Wang et al. 2013)",
                  .x = kReferenceTime,
                  .y = kReferenceDissipation,
                  .dash = cases::Dash::dashed,
                  .colour = cases::ChartColour::black}}}
      .write_all(folder / "taylor_green_re1600.png");
}

std::vector<Row> run(const Context& context) {
  const int cells = context.quick ? 64 : 128;
  const double duration = context.quick ? 2.4 : kDuration;
  const Curve curve = context.precision == Precision::float32 ? dissipation_curve<float>(cells, duration)
                                                              : dissipation_curve<double>(cells, duration);
  if (!context.plots.empty()) draw(curve, cells, context.plots);
  if (context.quick) {  // the vortices are still resolved by 64 cells at t = 2.3
    const auto at = std::lower_bound(curve.time.begin(), curve.time.end(), 2.25) - curve.time.begin();
    return {relative_row(fmt::format("dissipation at t = 2.3, {}^3", cells),
                         curve.dissipation[static_cast<std::size_t>(at)], 0.000833, 0.1)};
  }
  const auto highest = std::max_element(curve.dissipation.begin(), curve.dissipation.end()) - curve.dissipation.begin();
  const auto peak = static_cast<std::size_t>(highest);
  return {relative_row(fmt::format("peak of -dE/dt, {}^3", cells), curve.dissipation[peak], kPeak, 0.05),
          relative_row("its time", curve.time[peak], kPeakTime, 0.03)};
}

}  // namespace

Entry taylor_green_re1600() {
  return {"fluid.taylor_green_re1600", "Wang et al. 2013 (spectral), digitised in Lethe's examples", run};
}

}  // namespace lahar::validate

// Three-dimensional Taylor-Green vortex at Re = 1600: the peak of the dissipation -dE/dt, with the default operator and
// no eddy viscosity. Length L = 1 / wave number, speed V0; E = <u^2> / (2 V0^2), time in L / V0.
//   u = V0 (sin x cos y cos z, -cos x sin y cos z, 0), p = (cos 2x + cos 2y)(cos 2z + 2) rho V0^2 / 16
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "cases/pictures/chart.h"
#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr double kReynolds = 1600;
constexpr double kSpeed = 0.1;     // V0, lu, what scenes take by default: Ma = 0.17, Ma^2 = 3 %
constexpr double kDuration = 10;   // L / V0
constexpr double kSampling = 0.1;  // L / V0 between two looks at the energy

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

/// -dE/dt of a spectral simulation until the end of the run.
Curve spectral_curve() {
  Curve curve;
  for (const auto& [time, dissipation] : reference("tgv_re1600_dissipation.csv").points("t", "minus_dEdt"))
    if (time < kDuration + 0.5) curve.time.push_back(time), curve.dissipation.push_back(dissipation);
  return curve;
}

std::size_t peak_of(const Curve& curve) {
  return static_cast<std::size_t>(std::max_element(curve.dissipation.begin(), curve.dissipation.end()) -
                                  curve.dissipation.begin());
}

void draw(const Curve& curve, const Curve& spectral, int cells, const std::filesystem::path& folder) {
  cases::Chart{
      .title = "Taylor-Green vortex, Re = 1600",
      .x = {"t V_{0} / L"},
      .y = {"−dE/dt L / V_{0}^{3}"},
      .series = {{.name = fmt::format("{}^{{3}}, central moments", cells), .x = curve.time, .y = curve.dissipation},
                 {.name = "spectral (Wang et al. 2013)",
                  .x = spectral.time,
                  .y = spectral.dissipation,
                  .dash = cases::Dash::dashed,
                  .colour = cases::ChartColour::black}}}
      .write_all(folder / "taylor_green_re1600.png");
}

std::vector<Row> run(const Context& context) {
  const int cells = context.quick ? 64 : 128;
  const double duration = context.quick ? 2.4 : kDuration;
  const Curve curve = context.precision == Precision::float32 ? dissipation_curve<float>(cells, duration)
                                                              : dissipation_curve<double>(cells, duration);
  const Curve spectral = spectral_curve();
  if (!context.plots.empty()) draw(curve, spectral, cells, context.plots);
  if (context.quick) {  // the vortices are still resolved by 64 cells at t = 2.3
    const auto at = std::lower_bound(curve.time.begin(), curve.time.end(), 2.25) - curve.time.begin();
    const auto known = std::lower_bound(spectral.time.begin(), spectral.time.end(), 2.25) - spectral.time.begin();
    return {relative_row(fmt::format("dissipation at t = 2.3, {}^3", cells),
                         curve.dissipation[static_cast<std::size_t>(at)],
                         spectral.dissipation[static_cast<std::size_t>(known)], 0.1)};
  }
  const std::size_t peak = peak_of(curve), known = peak_of(spectral);
  return {relative_row(fmt::format("peak of -dE/dt, {}^3", cells), curve.dissipation[peak], spectral.dissipation[known],
                       0.05),
          relative_row("its time", curve.time[peak], spectral.time[known], 0.03)};
}

}  // namespace

Entry taylor_green_re1600() {
  return {"fluid.taylor_green_re1600",
          {"Wang et al. 2013 (spectral), digitised in Lethe's examples", {"tgv_re1600_dissipation.csv"}},
          run};
}

}  // namespace lahar::validate

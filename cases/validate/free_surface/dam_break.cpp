#include "cases/validate/free_surface/dam_break.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/validate/fluid/flows.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/reference_table.h"
#include "core/worst.h"

namespace lahar::validate {
namespace {

constexpr double kGravity = 9.81;

lbm::FluidOptions options_of(const DamBreak& dam, const Vec3i& cells) {
  const double dx = dam.column / dam.width;
  const double dt = dam.lattice_velocity * dx / (kFrontSlope * std::sqrt(2 * kGravity * dam.column));
  lbm::FluidOptions o =
      open_tank(cells, dam.kinematic_viscosity * dt / (dx * dx), Vec3(0, 0, -kGravity * dt * dt / dx));
  o.smagorinsky = dam.smagorinsky;
  o.adaptive_time_step = dam.adaptive;
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  if (dam.slip) {
    o.domain.faces[0] = o.domain.faces[4] = lbm::FaceKind::open;
    o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
    o.domain.walls.add({"back", HalfSpace{Vec3::Zero(), Vec3::UnitX()}, WallSlip::free_slip});
  }
  return o;
}

double at(const DamBreakRun& run, const std::vector<double>& values, double t) {
  const std::vector<double>& time = run.time;
  const auto n = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin());
  if (n == 0) return values.front();
  if (n == time.size()) return values.back();
  return std::lerp(values[n - 1], values[n], (t - time[n - 1]) / (time[n] - time[n - 1]));
}

double rms(const DamBreakRun& run, const MeasuredColumn& measured, double shift) {
  double squares = 0;
  for (const auto& [t, z] : measured.front) squares += std::pow(run.front_at(t + shift) / z - 1, 2);
  return std::sqrt(squares / static_cast<double>(measured.front.size()));
}

}  // namespace

double DamBreakRun::front_at(double t) const { return at(*this, front, t); }

double DamBreakRun::time_at(double z) const {
  for (std::size_t n = 0; n < front.size(); ++n)
    if (front[n] >= z) return time[n];
  return std::numeric_limits<double>::quiet_NaN();
}

template <class Real>
DamBreakRun run_dam_break(const DamBreak& dam) {
  const Vec3i cells(dam.length * dam.width, 8, 2 * dam.width + dam.width / 2);
  lbm::Fluid<Real> fluid(options_of(dam, cells));
  fluid.fill({{Vec3::Zero(), Vec3(dam.width, cells.y() - 1e-9, 2.0 * dam.width)}});
  const double scale = std::sqrt(-2 * fluid.options().gravity.z() / dam.width);
  const auto energy = [&] {
    const Energies e = energies(fluid);
    return e.kinetic + e.potential + e.elastic;
  };
  const double initial = energy();
  EnergyRise rise;
  rise.note(initial);
  DamBreakRun run;
  for (double t = 0; t < dam.until || static_cast<double>(run.steps) < dam.steps; t = scale * fluid.time()) {
    if (t < dam.until) {
      run.time.push_back(t);
      run.front.push_back(front_in_bottom_layer(fluid, cells) / dam.width);
      run.height.push_back(height_at_back(fluid, cells) / (2.0 * dam.width));
    }
    fluid.step();
    keep_worst(run.fastest, fluid.max_speed_lu());
    if (++run.steps % 20 != 0) continue;
    rise.note(energy());
    keep_worst(run.drift, std::abs(fluid.mass_drift()));
  }
  run.energy_rise = rise.largest() / initial;
  run.limited_cells = fluid.limited_cells();
  run.rescaled = fluid.rescaled_mass() / fluid.liquid_mass();
  run.changes = fluid.time_step_record().changes;
  run.shortest_step = fluid.time_step_record().shortest;
  run.longest_step = fluid.time_step_record().longest;
  return run;
}

MeasuredColumn measured_column() {
  const ReferenceTable table = reference("martin_moyce1952.csv");
  return {table.where("set", "front_n2=2").points("T_or_tau", "Z_or_H"),
          table.where("set", "height_n2=2").points("T_or_tau", "Z_or_H")};
}

double measured_arrival(double z) {
  const auto front = measured_column().front;
  for (std::size_t n = 1; n < front.size(); ++n)
    if (front[n].second >= z)
      return std::lerp(front[n - 1].first, front[n].first,
                       (z - front[n - 1].second) / (front[n].second - front[n - 1].second));
  return std::numeric_limits<double>::quiet_NaN();
}

FrontErrors compare_front(const DamBreakRun& run) {
  const MeasuredColumn measured = measured_column();
  FrontErrors e;
  double n = 0, st = 0, sz = 0, stt = 0, stz = 0;
  for (const auto& [t, unused] : measured.front) {
    if (t < kSlopeFrom) continue;
    const double z = run.front_at(t);
    n += 1, st += t, sz += z, stt += t * t, stz += t * z;
  }
  e.slope = (n * stz - st * sz) / (n * stt - st * st);
  e.rms = e.shifted_rms = rms(run, measured, 0);
  double squares = 0, heights = 0;
  for (const auto& [tau, h] : measured.height) {
    const double t = std::sqrt(2.0) * tau;
    if (t > run.time.back()) break;  // the table goes on
    squares += std::pow(at(run, run.height, t) / h - 1, 2), heights += 1;
  }
  e.height_rms = std::sqrt(squares / heights);
  for (double shift = -0.4; shift <= 0.4; shift += 0.005)
    if (const double r = rms(run, measured, shift); r < e.shifted_rms) e.shifted_rms = r, e.shift = shift;
  return e;
}

template DamBreakRun run_dam_break<float>(const DamBreak&);
template DamBreakRun run_dam_break<double>(const DamBreak&);

}  // namespace lahar::validate

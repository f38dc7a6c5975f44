// Plane Couette flow started by a belt (moving wall) at z = 0:
//   u / U = 1 - z/H - 2/pi sum_n sin(n pi z / H) exp(-n^2 pi^2 nu t / H^2) / n
// The steady profile is linear: half-way bounce-back carries it all but exactly, so the order is that of the start-up.
#include <fmt/format.h>

#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"

namespace lahar::validate {

namespace {

using lbm::CollisionOperator;

constexpr double kViscosity = 0.06;  // lu
constexpr double kEarly = 0.1;       // t nu / H^2 of the start-up profile
constexpr double kLate = 2;          // t nu / H^2 when it is steady: exp(-2 pi^2) = 3e-9
constexpr double kBeltSpeed = 0.08;  // lu, on 8 cells; falls with the cell size

/// u / U at a height in 0..1 and a time t nu / H^2.
double exact_speed(double height, double time) {
  using std::numbers::pi;
  double sum = 0;
  for (int n = 1; n < 60; ++n) sum += std::sin(n * pi * height) * std::exp(-n * n * pi * pi * time) / n;
  return 1 - height - 2 / pi * sum;
}

/// t nu / H^2 at which the exact profile has a given discharge Q / (U H); it rises from 0 to 1/2.
double time_of_discharge(double discharge) {
  using std::numbers::pi;
  const auto exact = [](double time) {
    double sum = 0;
    for (int n = 1; n < 60; n += 2) sum += std::exp(-n * n * pi * pi * time) / (n * n);
    return 0.5 - 4 / (pi * pi) * sum;
  };
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) (exact(0.5 * (low + high)) < discharge ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

struct Gap {
  int cells = 16;
  CollisionOperator collision = lbm::CentralMoments{};
  int across = 2;              ///< axis from wall to wall
  Vec3 along = Vec3::UnitX();  ///< unit vector of the belt's motion
  double frame = 0;            ///< velocity along the belt added to fluid and walls, in belt speeds
};

struct StartUp {
  double early_error, late_error;  ///< of the velocity
  double viscosity;                ///< from how far the early discharge has come, as a fraction of what was asked for
  double middle;                   ///< early speed half-way less the frame's, in belt speeds
};

StartUp start_up(const Gap& gap) {
  const double height = gap.cells, belt = kBeltSpeed * 8 / height;
  Vec3i cells = Vec3i::Constant(8);
  cells[gap.across] = gap.cells;
  lbm::FluidOptions o = lattice_box(cells, kViscosity);
  const auto face = static_cast<std::size_t>(2 * gap.across);
  o.domain.faces[face] = o.domain.faces[face + 1] = lbm::FaceKind::closed;
  o.collision = gap.collision;
  const Vec3 frame = gap.frame * belt * gap.along, normal = Vec3::Unit(gap.across);
  Wall lower{"belt", HalfSpace{Vec3::Zero(), normal}}, upper{"bed", HalfSpace{height * normal, -normal}};
  lower.velocity = frame + belt * gap.along;
  upper.velocity = frame;
  o.domain.walls.add(lower);
  o.domain.walls.add(upper);
  lbm::Fluid<double> fluid(o);
  fluid.fill_everything([&](const Vec3&) { return frame; }, no_pressure);
  const auto exact = [&](double time) {
    return
        [&, time](const Vec3& p) { return Vec3(frame + belt * exact_speed(p[gap.across] / height, time) * gap.along); };
  };
  StartUp result{};
  const int early = diffusive_steps(kEarly, gap.cells, kViscosity);
  const double early_time = early * kViscosity / (height * height);
  advance(fluid, early);
  result.early_error = velocity_error(fluid, exact(early_time), frame);
  double discharge = 0, middle = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const double u = (c.velocity - frame).dot(gap.along) / belt;
    discharge += u / (64 * height);
    if (std::abs(c.centre[gap.across] - height / 2) < 1) middle += u / 128;
  });
  result.middle = middle;
  result.viscosity = time_of_discharge(discharge) / early_time;
  advance(fluid, diffusive_steps(kLate, gap.cells, kViscosity) - early);
  result.late_error = velocity_error(fluid, exact(kLate), frame);
  return result;
}

/// The same flow along every lattice axis and every diagonal between two of them, walls across each axis; and seen from
/// a frame that moves.
void add_frames(std::vector<Row>& rows, CollisionOperator collision, int cells) {
  const std::string name(lbm::name(collision));
  const double straight = start_up({.cells = cells, .collision = collision}).middle;
  double spread = 0;
  for (int across = 0; across < 3; ++across) {
    const Vec3 first = Vec3::Unit((across + 1) % 3), second = Vec3::Unit((across + 2) % 3);
    for (const Vec3& along : {first, second, Vec3((first + second).normalized())}) {
      const StartUp s = start_up({.cells = cells, .collision = collision, .across = across, .along = along});
      spread = std::max(spread, std::abs(s.middle / straight - 1));
    }
  }
  rows.push_back(at_most_row(name + ": spread of the speed half-way over 9 directions", spread, 1e-6));
  const StartUp moving = start_up({.cells = cells, .collision = collision, .frame = 1});
  rows.push_back(
      relative_row(name + ": speed half-way in a frame as fast as the belt", moving.middle, straight, 0.005));
}

std::vector<Row> run(const Context& context) {
  const std::vector<int> cells = context.quick ? std::vector{6, 8, 14} : std::vector{8, 16, 32};
  std::vector<Row> rows;
  for (const CollisionOperator collision : kOperators) {
    const std::string name(lbm::name(collision));
    std::vector<double> errors;
    StartUp finest{};
    for (const int n : cells) {
      finest = start_up({.cells = n, .collision = collision});
      errors.push_back(finest.early_error);
    }
    rows.push_back(at_least_row(order_label(name + " start-up", cells), lowest_order(cells, errors), 1.9));
    rows.push_back(relative_row(fmt::format("{}: viscosity / nu, {} cells", name, cells.back()), finest.viscosity, 1,
                                context.quick ? 0.03 : 0.005));
    // Belts pull by the liquid's density, which shear by central moments changes near them (on liquid taken to have
    // density 1 the error was 1e-8; deep liquid was slow by per cents).
    rows.push_back(
        at_most_row(fmt::format("{}: steady velocity error, {} cells", name, cells.back()), finest.late_error, 1e-5));
    if (!context.quick || collision == kOperators.front()) add_frames(rows, collision, 8);
  }
  return rows;
}

}  // namespace

Entry order_couette() {
  return {"fluid.order_couette", {"exact solution of the Navier-Stokes equations (series)"}, run};
}

}  // namespace lahar::validate

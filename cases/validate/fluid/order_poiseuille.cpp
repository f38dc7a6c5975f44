// Plane Poiseuille flow between half-way walls, driven by a body force from rest: u = g z (H - z) / (2 nu).
#include <fmt/format.h>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"

namespace lahar::validate {

namespace {

using lbm::CollisionOperator;

constexpr double kViscosity = 0.06;  // lu; the two relaxation times of each operator differ from those with exact walls
constexpr double kDuration = 2;      // t nu / H^2: what is left of the start is exp(-2 pi^2) = 3e-9
constexpr double kPeakSpeed = 0.08;  // lu, on 8 cells; falls with the cell size

struct Channel {
  int cells = 16;
  CollisionOperator collision = lbm::CentralMoments{};
  int across = 2;              ///< axis from wall to wall
  Vec3 along = Vec3::UnitX();  ///< unit vector of the flow
};

struct Profile {
  double error;      ///< of the velocity
  double viscosity;  ///< from the discharge, as a fraction of what was asked for
  double sideways;   ///< largest velocity that is not along the force, as a fraction of the peak
  double peak;       ///< as a fraction of the exact one
};

Profile profile_of(const Channel& channel) {
  const double height = channel.cells, peak = kPeakSpeed * 8 / height, g = 8 * kViscosity * peak / (height * height);
  Vec3i cells = Vec3i::Constant(8);
  cells[channel.across] = channel.cells;
  lbm::FluidOptions o = lattice_box(cells, kViscosity);
  const auto face = static_cast<std::size_t>(2 * channel.across);
  o.domain.faces[face] = o.domain.faces[face + 1] = lbm::FaceKind::closed;
  o.collision = channel.collision;
  o.gravity = g * channel.along;
  lbm::Fluid<double> fluid(o);
  fluid.fill_everything(at_rest, no_pressure);
  advance(fluid, diffusive_steps(kDuration, channel.cells, kViscosity));
  const auto exact = [&](const Vec3& p) {
    const double z = p[channel.across];
    return Vec3(g * z * (height - z) / (2 * kViscosity) * channel.along);
  };
  double discharge = 0, exact_discharge = 0, highest = 0, exact_highest = 0, sideways = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const double u = c.velocity.dot(channel.along), exact_u = exact(c.centre).dot(channel.along);
    discharge += u, exact_discharge += exact_u;
    highest = std::max(highest, u), exact_highest = std::max(exact_highest, exact_u);
    sideways = std::max(sideways, (c.velocity - u * channel.along).norm());
  });
  return {velocity_error(fluid, exact), exact_discharge / discharge, sideways / peak, highest / exact_highest};
}

void add_convergence(std::vector<Row>& rows, CollisionOperator collision, std::span<const int> cells,
                     double tolerance) {
  const std::string name(lbm::name(collision));
  std::vector<double> errors;
  Profile finest{};
  for (const int n : cells) {
    finest = profile_of({.cells = n, .collision = collision});
    errors.push_back(finest.error);
  }
  // The magic parameter 3/16 of trt puts the wall where it is, to rounding: there is no error left to fall.
  if (std::holds_alternative<lbm::Trt>(collision))
    rows.push_back(at_most_row(fmt::format("{}: velocity error, {} cells", name, cells.back()), finest.error, 1e-7));
  else
    rows.push_back(at_least_row(order_label(name, cells), lowest_order(cells, errors), 1.9));
  rows.push_back(
      relative_row(fmt::format("{}: viscosity / nu, {} cells", name, cells.back()), finest.viscosity, 1, tolerance));
}

/// The same flow along every lattice axis and every diagonal between two of them, walls across each axis.
void add_directions(std::vector<Row>& rows, CollisionOperator collision, int cells) {
  const std::string name(lbm::name(collision));
  const double straight = profile_of({.cells = cells, .collision = collision}).peak;
  double spread = 0, sideways = 0;
  for (int across = 0; across < 3; ++across) {
    const Vec3 first = Vec3::Unit((across + 1) % 3), second = Vec3::Unit((across + 2) % 3);
    for (const Vec3& along : {first, second, Vec3((first + second).normalized())}) {
      const Profile p = profile_of({.cells = cells, .collision = collision, .across = across, .along = along});
      spread = std::max(spread, std::abs(p.peak / straight - 1));
      sideways = std::max(sideways, p.sideways);
    }
  }
  // Rounding alone for bgk and trt. The default operator puts right what D3Q19 lacks along each axis, not along
  // diagonals (collision/central_moments.h): of the order of the fourth power of the speed, 2.6e-8 here.
  const bool corrected = std::holds_alternative<lbm::CentralMoments>(collision);
  rows.push_back(at_most_row(name + ": spread of the peak over 9 directions", spread, corrected ? 1e-7 : 1e-9));
  rows.push_back(at_most_row(name + ": largest speed across the flow / peak", sideways, 1e-12));
}

std::vector<Row> run(const Context& context) {
  const std::vector<int> cells = context.quick ? std::vector{6, 8, 14} : std::vector{8, 16, 32};
  std::vector<Row> rows;
  for (const CollisionOperator collision : kOperators) {
    add_convergence(rows, collision, cells, context.quick ? 0.02 : 0.005);
    if (!context.quick || collision == kOperators.front()) add_directions(rows, collision, 8);
  }
  return rows;
}

}  // namespace

Entry order_poiseuille() { return {"fluid.order_poiseuille", {"exact solution of the Navier-Stokes equations"}, run}; }

}  // namespace lahar::validate

// Hard cases H4, H13 and H20: films and slopes of 35 degrees.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/fluid/surface_entries.h"
#include "cases/validate/fluid/surface_flows.h"

namespace lahar::validate {
namespace {

constexpr double kAngle = 35 * std::numbers::pi / 180;

Vec3 down_slope(double gravity) { return gravity * Vec3(std::sin(kAngle), 0, -std::cos(kAngle)); }

/// Mass of wet cells without a wet cell around, of all liquid; and the lowest mass of an interface cell, lu.
struct Scraps {
  double isolated = 0, lowest = 0;
};

template <class Real>
Scraps scraps_of(const lbm::Fluid<Real>& fluid) {
  Scraps s;
  double all = 0;
  const auto& grid = fluid.grid();
  for (const lbm::BlockIndex b : grid.active()) {
    const auto& block = grid.block(b);
    for (int n = 0; n < lbm::kBlockCells; ++n) {
      const lbm::CellType type = block.type[static_cast<std::size_t>(n)];
      if (!lbm::is_wet(type)) continue;
      const double mass = type == lbm::CellType::interface ? static_cast<double>(block.surface->mass[n]) : 1.0;
      all += mass;
      s.lowest = std::min(s.lowest, mass);
      bool alone = true;
      for (int i = 1; i < lbm::D3Q19::q; ++i) alone = alone && !lbm::is_wet(grid.type(grid.neighbour({b, n}, i)));
      if (alone) s.isolated += mass;
    }
  }
  s.isolated /= all;
  return s;
}

/// Front of a slab 40 cells long and of given height after `steps` on a dry no-slip bed.
template <class Real>
double advance_film(double height, int steps, Scraps& worst) {
  const Vec3i cells(160, 8, 12);
  lbm::FluidOptions o = open_tank(cells, 0.02, down_slope(1e-4));
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  lbm::Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(40, cells.y() - 1e-9, height)}});
  for (int s = 1; s <= steps; ++s) {
    fluid.step();
    if (s % 100 != 0) continue;
    const Scraps now = scraps_of(fluid);
    worst.isolated = std::max(worst.isolated, now.isolated);
    worst.lowest = std::min(worst.lowest, now.lowest);
  }
  double front = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { front = std::max(front, c.centre.x() + c.fill_level - 0.5); });
  return front;
}

/// Arrival of water at 60 cells down a slope from the toe of a block of 40 x 12 cells, in steps.
template <class Real>
double arrival_on_slope(bool lattice_tilted) {
  const double length = 40, height = 12, way = 60, gravity = 1e-4;
  const Vec3 along = lattice_tilted ? Vec3(std::cos(kAngle), 0, -std::sin(kAngle)) : Vec3::UnitX().eval();
  const Vec3 up = lattice_tilted ? Vec3(std::sin(kAngle), 0, std::cos(kAngle)) : Vec3::UnitZ().eval();
  const Vec3i cells = lattice_tilted ? Vec3i(112, 8, 96) : Vec3i(112, 8, 24);
  const Vec3 heel = lattice_tilted ? Vec3(2, 0, 80) : Vec3(2, 0, 0);  // where bed and back wall meet
  lbm::FluidOptions o = open_tank(cells, 2e-4, lattice_tilted ? Vec3(0, 0, -gravity) : down_slope(gravity));
  o.domain.faces.fill(lbm::FaceKind::open);
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  o.domain.walls.add({"bed", HalfSpace{heel, up}, WallSlip::free_slip});
  o.domain.walls.add({"back", HalfSpace{heel, along}, WallSlip::free_slip});
  lbm::Fluid<Real> fluid(o);
  std::vector<lbm::LiquidRegion> slices;  // of a sixteenth of a cell along x
  for (double x = 0; x < cells.x(); x += 1.0 / 16) {
    const double mid = x + 1.0 / 32;
    // z of the block's four sides above x: 0 <= (p - heel).up <= height, 0 <= (p - heel).along <= length
    double low = heel.z() - (mid - heel.x()) * up.x() / up.z(), high = low + height / up.z();
    if (lattice_tilted) {
      const double upper_end = heel.z() + (mid - heel.x()) * along.x() / -along.z();
      high = std::min(high, upper_end);
      low = std::max(low, upper_end - length / -along.z());
    } else if (mid < heel.x() || mid > heel.x() + length) {
      continue;
    }
    if (high <= low) continue;
    slices.push_back({Vec3(x + 1e-9, 0, low), Vec3(x + 1.0 / 16 - 1e-9, cells.y() - 1e-9, high)});
  }
  fluid.fill(slices);
  double front = 0;
  while (front < length + way && fluid.steps() < 20000) {
    fluid.step();
    if (fluid.steps() % 10 != 0) continue;
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
      if (c.fill_level > 0.5) front = std::max(front, (c.centre - heel).dot(along));
    });
  }
  return static_cast<double>(fluid.steps());
}

/// Water behind a wall of 12 cells with a slot of 3 at its foot overtops it, drains through the slot and off an open
/// end; then the tank is filled again.
struct Vessel {
  bool slip;  ///< of bed and wall; then the upper end is open too: nothing holds the last drops
  lbm::LiquidRegion reservoir{Vec3::Zero(), Vec3(30, 8 - 1e-9, 24)};

  [[nodiscard]] lbm::FluidOptions options() const {
    const WallSlip sliding = slip ? WallSlip::free_slip : WallSlip::no_slip;
    lbm::FluidOptions o = open_tank({64, 8, 40}, 1e-3, down_slope(2e-4));
    o.domain.faces[1] = lbm::FaceKind::open;
    o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
    if (slip) {
      o.domain.faces[0] = o.domain.faces[4] = lbm::FaceKind::open;
      o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, sliding});
    }
    o.domain.walls.add({"weir", SolidBox{Vec3(30, -8, 3), Vec3(33, 16, 12)}, sliding});
    return o;
  }
};

/// Steps, and the worst ledger of them, of the liquid put in.
template <class Real>
void drain(lbm::Fluid<Real>& fluid, int steps, double& worst) {
  for (int s = 0; s < steps && fluid.wet_cells() > 0; ++s) {
    fluid.step();
    if (s % 10 == 0) worst = std::max(worst, std::abs(fluid.mass_drift()));
  }
  worst = std::max(worst, std::abs(fluid.mass_drift()));
}

/// What a film that drains off a bed of 64 x 8 cells leaves by then: thickness sqrt(nu x / (g t)), Jeffreys 1930.
double draining_film(const lbm::FluidOptions& o, double steps) {
  return 8 * 2.0 / 3.0 * std::pow(64, 1.5) * std::sqrt(o.kinematic_viscosity / (o.gravity.x() * steps));
}

}  // namespace

std::vector<Row> hard_h4(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    Scraps worst;
    double before = 0;
    for (const double height : {0.5, 1.0, 2.0, 3.0}) {
      const double front = advance_film<Real>(height, context.quick ? 500 : 4000, worst);
      char label[64];
      std::snprintf(label, sizeof label, "front of %.1f cells, no less than of the thinner, cells", height);
      rows.push_back(at_least_row(label, front, before));
      before = front;
    }
    rows.push_back(at_most_row("liquid in isolated cells, of all", worst.isolated, 1e-3));
    rows.push_back(at_least_row("lowest mass of a cell, of a cell", worst.lowest, -0.01));
    return rows;
  });
}

std::vector<Row> hard_h13(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    for (const bool slip : {true, false}) {
      const Vessel vessel{slip};
      const std::string name = slip ? "slipping walls: " : "no-slip walls: ";
      const int steps = slip ? 8000 : context.quick ? 4000 : 30000;
      lbm::Fluid<Real> fluid(vessel.options());
      fluid.fill({vessel.reservoir});
      const double start = fluid.liquid_mass();
      double worst = 0;
      drain(fluid, steps, worst);
      if (slip) {
        rows.push_back(at_most_row(name + "wet cells left", static_cast<double>(fluid.wet_cells()), 0));
        rows.push_back(at_most_row(name + "liquid left, of all", std::abs(fluid.liquid_mass()) / start, 1e-9));
        for (int s = 0; s < 100; ++s) fluid.step();  // of nothing
        rows.push_back(at_most_row(name + "blocks left", static_cast<double>(fluid.grid().active().size()), 0));
      } else if (!context.quick) {
        rows.push_back(at_most_row(name + "liquid left over what a draining film leaves",
                                   fluid.liquid_mass() / draining_film(fluid.options(), steps), 2));
      }
      fluid.fill({vessel.reservoir});
      drain(fluid, context.quick ? 500 : 3000, worst);
      rows.push_back(
          at_least_row(name + "wet cells after the second filling", static_cast<double>(fluid.wet_cells()), 100));
      rows.push_back(at_most_row(name + "in - out - left, of in, with the second filling", worst, 1e-4));
    }
    return rows;
  });
}

std::vector<Row> hard_h20(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    return std::vector<Row>{relative_row("steps to 60 cells down a slope, lattice tilted against gravity tilted",
                                         arrival_on_slope<Real>(true), arrival_on_slope<Real>(false), 0.05)};
  });
}

}  // namespace lahar::validate

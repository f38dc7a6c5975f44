// Films of half a cell to three cells run down a dry slope of 35 degrees, until a kinematic wave has gone four cells at
// least: as such a wave, a thicker one faster than a thinner one. None leaves scraps behind, no cell holds less than a
// hundredth less than nothing (what a cell may lack before it is converted).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/slope.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

/// Mass of wet cells without a wet cell around, of all liquid; and the lowest mass of an interface cell, lu.
struct Scraps {
  double isolated = 0, lowest = 0;
};

template <class Real>
Scraps scraps_of(const lbm::Fluid<Real>& fluid) {
  Scraps s;
  double all = 0;
  const auto& grid = fluid.grid();
  for (const lbm::BlockIndex b : grid.owned()) {
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

constexpr double kLength = 40, kViscosity = 0.02, kGravity = 1e-4;  // lu
constexpr double kLeastWay = 4;                                     // cells, of a kinematic wave

/// Front of a slab of that length and of given height after `steps` on a dry no-slip bed.
template <class Real>
double advance_film(double height, int steps, Scraps& worst) {
  const Vec3i cells(160, 8, 12);
  lbm::FluidOptions o = open_tank(cells, kViscosity, down_slope(kGravity));
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  lbm::Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(kLength, cells.y() - 1e-9, height)}});
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

/// Speed of the front of a kinematic wave until its tail is there, u = g h^2/(3 nu), lu.
double wave_speed(double height) { return down_slope(kGravity).x() / kViscosity * height * height / 3; }

/// The front of the same slab as a kinematic wave: it runs with that speed until the tail, which is three times as
/// fast, is there, then as (9 A^2 g t/(4 nu))^(1/3) for a volume A per width (Huppert 1982, Nature 300:427).
double kinematic_front(double height, double time) {
  const double run = wave_speed(height) * time;
  if (run < kLength / 2) return kLength + run;
  return std::cbrt(27.0 / 4 * std::pow(kLength, 2) * wave_speed(height) * time);
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    Scraps worst;
    double thinner = 0, least_gain = std::numeric_limits<double>::infinity();  // mean speeds of fronts, lu
    for (const double height : {0.5, 1.0, 2.0, 3.0}) {
      const int steps =
          std::max(context.quick ? 1500 : 4000, static_cast<int>(std::ceil(kLeastWay / wave_speed(height))));
      const double way = advance_film<Real>(height, steps, worst) - kLength;
      const double wave = kinematic_front(height, steps) - kLength;
      const std::string label = fmt::format("way of the front of {:.1f} cells, kinematic wave, cells", height);
      // Thin films go four cells. What is thicker is ahead of the wave: by a third in the end.
      rows.push_back(height < 2 ? absolute_row(label, way, wave, 1) : relative_row(label, way, wave, 0.4));
      least_gain = std::min(least_gain, way / steps - thinner), thinner = way / steps;
    }
    rows.push_back(at_least_row("mean speed of a front less that of the next thinner film, least, lu", least_gain, 0));
    rows.push_back(at_most_row("liquid in isolated cells, of all", worst.isolated, 1e-3));
    rows.push_back(at_least_row("lowest mass of a cell, of a cell (converted from -0.01 on)", worst.lowest, -0.01));
    return rows;
  });
}

}  // namespace

Entry thin_films() {
  return {"free_surface.thin_films", {"case H4 of the hard cases: thin films on a dry slope", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate

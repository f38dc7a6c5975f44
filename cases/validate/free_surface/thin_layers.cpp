// Layers of a few cells that rest, and sheets that slide down a slope of 35 degrees: what their bed bears in each step
// is their weight. (Sound between bed and surface fed itself where the level lies in the lower half of a cell:
// docs/decisions/0089.)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "core/worst.h"
#include "lbm/step/fluid.h"

namespace lahar::validate {
namespace {

constexpr double kGravity = 9.81, kCell = 0.02;  // m/s^2, m

struct Borne {
  double worst = 0;  ///< of a step, off the weight, as a share of it
  double mean = 0;   ///< over the weight
};

/// Water on 8 x 8 cells between mirrors, from 0.3 s to 0.5 s.
template <class Real>
Borne rest(double cells, double slope, double largest_speed) {
  lbm::FluidOptions o;
  o.domain.cell_size = kCell;
  o.domain.upper = kCell * Vec3(8, 8, std::ceil(cells) + 6);
  o.domain.faces.fill(slope > 0 ? lbm::FaceKind::periodic : lbm::FaceKind::closed);
  o.domain.faces[4] = lbm::FaceKind::closed, o.domain.faces[5] = lbm::FaceKind::open;
  o.domain.slip = WallSlip::free_slip;
  o.density = 1000, o.kinematic_viscosity = 1e-6;
  o.time_step = 0.1 * kCell / largest_speed;
  o.gravity = kGravity * Vec3(std::sin(slope), 0, -std::cos(slope));
  lbm::Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), kCell * Vec3(8, 8, cells)}});
  fluid.measure_walls();
  const double weight = -o.gravity.z() * fluid.liquid_mass() * o.time_step;
  const auto impulse = [&] {
    double sum = 0;
    for (const lbm::WallLoad& load : fluid.wall_loads()) sum -= load.impulse.z();
    return sum;
  };
  Borne borne;
  int steps = 0;
  for (double before = 0; fluid.time() < 0.5; before = impulse()) {
    fluid.step();
    if (fluid.time() < 0.3) continue;
    const double share = (impulse() - before) / weight;
    keep_worst(borne.worst, std::abs(share - 1));
    borne.mean += share, ++steps;
  }
  borne.mean /= steps;
  return borne;
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    for (const double cells : {1.02, 1.3, 2.02, 2.3, 3.02, 3.3, 4.05, 6.05}) {
      if (context.quick && cells > 3.2) continue;
      const Borne borne = rest<Real>(cells, 0, 2);
      rows.push_back(at_most_row(fmt::format("{} cells at rest: worst step, of the weight", cells), borne.worst, 0.01));
      if (cells == 1.02 || cells == 2.02)
        rows.push_back(
            relative_row(fmt::format("{} cells at rest: mean over the weight", cells), borne.mean, 1, 0.002));
    }
    for (const double cells : {1.5, 2.2, 3.05, 4.1}) {
      if (context.quick && cells > 2) continue;
      const Borne borne = rest<Real>(cells, 35 * std::numbers::pi / 180, 7);
      rows.push_back(
          at_most_row(fmt::format("{} cells that slide: worst step, of the weight", cells), borne.worst, 1e-3));
    }
    return rows;
  });
}

}  // namespace

Entry thin_layers() { return {"free_surface.thin_layers", {"statics; a bed without friction"}, run}; }

}  // namespace lahar::validate

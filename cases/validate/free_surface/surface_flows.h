#pragma once
// What the entries with a free surface share. They work in lattice units: cell, time step and density are 1.
#include <utility>
#include <vector>

#include "cases/validate/entry.h"
#include "lbm/step/fluid.h"

namespace lahar::validate {

/// A box of cells with closed faces all round but for an open top, in lattice units.
lbm::FluidOptions open_tank(const Vec3i& cells, double viscosity, const Vec3& gravity);

/// Columns of liquid, one cell wide along x, filled from the bottom to surface(x of the column's centre).
std::vector<lbm::LiquidRegion> liquid_under(const Vec3i& cells, const std::function<double(double)>& surface);

/// The same in slices of a sixteenth of a cell, for surfaces that rise or fall by much of a cell from column to column.
std::vector<lbm::LiquidRegion> liquid_under_slope(const Vec3i& cells, const std::function<double(double)>& surface);

/// Fastest wet cell, lu.
template <class Real>
double fastest(const lbm::Fluid<Real>& fluid);

/// End along x of the liquid in the bottom layer of cells, in cells, averaged across.
template <class Real>
double front_in_bottom_layer(const lbm::Fluid<Real>& fluid, const Vec3i& cells);

/// Depth of the liquid in the first layer of cells along x, in cells, averaged across.
template <class Real>
double height_at_back(const lbm::Fluid<Real>& fluid, const Vec3i& cells);

/// Energies of the liquid, lu: the potential one from the corner of the domain, the elastic one, p^2 / (2 rho c_s^2),
/// of the compressed lattice fluid.
struct Energies {
  double kinetic = 0, potential = 0, elastic = 0;
};
template <class Real>
Energies energies(const lbm::Fluid<Real>& fluid);

}  // namespace lahar::validate

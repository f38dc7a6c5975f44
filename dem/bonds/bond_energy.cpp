#include "dem/bonds/bond_energy.h"

#include "core/triple.h"
#include "dem/bonds/lane_sum.h"

namespace lahar::dem {

namespace {

double sum_of_squares(const std::vector<double>& v, std::size_t first, std::size_t last) {
  const double* p = v.data();
  return lane_sum(first, last, [p](std::size_t k) { return p[k] * p[k]; });
}
double sum_of_squares(const Vec3Field& v, std::size_t first, std::size_t last) {
  const double *x = v.x.data(), *y = v.y.data(), *z = v.z.data();
  return lane_sum(first, last, [=](std::size_t k) {
    const Triple t{x[k], y[k], z[k]};
    return dot(t, t);
  });
}
/// Energy of linear springs whose forces' squares add up to `squares`.
double spring_energy(double squares, double stiffness) { return stiffness > 0 ? 0.5 * squares / stiffness : 0.0; }

double axial_energy(const Bonds& bonds, const BondConstants& c, std::size_t first, std::size_t last) {
  if (c.axial.linear() || c.plastic) return spring_energy(sum_of_squares(bonds.axial_force, first, last), c.axial.k1);
  const double* e = bonds.elongation.data();
  const std::uint8_t* intact = bonds.intact.data();
  const AxialCurve curve = c.axial;
  return lane_sum(first, last, [=](std::size_t k) { return intact[k] != 0 ? curve_energy(curve, e[k]) : 0.0; });
}

}  // namespace

BondEnergy& BondEnergy::operator+=(const BondEnergy& o) {
  axial += o.axial, shear += o.shear, bending += o.bending, torsion += o.torsion;
  damping += o.damping, plastic += o.plastic, breakage += o.breakage;
  return *this;
}

BondEnergy energy_of(const Bonds& bonds, const BondConstants& c, std::size_t first, std::size_t last) {
  BondEnergy e;
  e.axial = axial_energy(bonds, c, first, last);
  e.shear = spring_energy(sum_of_squares(bonds.shear_force, first, last), c.shear_stiffness);
  e.bending = spring_energy(sum_of_squares(bonds.moment, first, last), c.bending_stiffness);
  e.torsion = spring_energy(sum_of_squares(bonds.torsion_moment, first, last), c.torsion_stiffness);
  if (c.plastic)
    for (std::size_t b = first; b < last; ++b) e.plastic += plastic_work(c.axial, bonds.plastic_elongation[b]);
  return e;
}

}  // namespace lahar::dem

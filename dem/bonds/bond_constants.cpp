#include "dem/bonds/bond_constants.h"

#include <cmath>
#include <numbers>

#include "core/check.h"

namespace lahar::dem {

BondConstants constants_of(const BondSort& s) {
  require(s.bond_radius > 0 && s.shear_stiffness >= 0, "a bond needs a positive radius and no negative stiffness");
  require(s.tensile_strength > 0 && s.shear_strength > 0, "bond strengths must be positive");
  require(s.damping_ratio >= 0, "a bond's damping ratio must not be negative");
  const double r = s.bond_radius;
  const double area = std::numbers::pi * r * r;
  const double inertia = 0.25 * area * r * r;  // second moment of area; the polar one is twice that
  BondConstants c;
  c.axial = axial_curve(s.axial, area);
  c.shear_stiffness = s.shear_stiffness * area;
  // A wire that goes slack does not bend. (Its rim stress would count all turns of its ends as tension.)
  c.bending_stiffness = s.axial.tension_only ? 0 : s.axial.stiffness[0] * inertia;
  c.torsion_stiffness = s.shear_stiffness * 2 * inertia;
  // Stresses at the rim, Potyondy & Cundall (2004), Eq. 18, multiplied by the area.
  c.tension_limit = s.tensile_strength * area;
  c.bending_to_tension = r * area / inertia;
  c.shear_limit = s.shear_strength * area;
  c.torsion_to_shear = r * area / (2 * inertia);
  const double twice_ratio = 2 * s.damping_ratio;
  c.axial_damping = twice_ratio * std::sqrt(c.axial.k1);
  c.shear_damping = twice_ratio * std::sqrt(c.shear_stiffness);
  c.bending_damping = twice_ratio * std::sqrt(c.bending_stiffness);
  c.torsion_damping = twice_ratio * std::sqrt(c.torsion_stiffness);
  c.plastic = s.axial.plastic_unloading && !c.axial.linear();
  c.damped = s.damping_ratio > 0;
  c.breakable = std::isfinite(s.tensile_strength) || std::isfinite(s.shear_strength);
  return c;
}

}  // namespace lahar::dem

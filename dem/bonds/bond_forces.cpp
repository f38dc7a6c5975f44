#include "dem/bonds/bond_forces.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/bonds/bond_tile.h"
#include "dem/bonds/lane_sum.h"
#include "dem/bonds/parallel_bond.h"

namespace lahar::dem {

namespace {

enum class Axial { linear, curve, plastic };

/// All arrays of bonds that the loop reads and writes.
struct Arrays {
  Columns<double> direction, shear_force, moment;
  const double *rest_length, *axial_mass, *shear_mass, *inertia;
  double *elongation, *plastic_elongation, *axial_force, *torsion_moment;

  Arrays(Bonds& b, const BondForces::EffectiveMasses& m)
      : direction(b.direction),
        shear_force(b.shear_force),
        moment(b.moment),
        rest_length(b.rest_length.data()),
        axial_mass(m.axial.data()),
        shear_mass(m.shear.data()),
        inertia(m.inertia.data()),
        elongation(b.elongation.data()),
        plastic_elongation(b.plastic_elongation.data()),
        axial_force(b.axial_force.data()),
        torsion_moment(b.torsion_moment.data()) {}
};

template <Axial axial>
inline double axial_force(const BondConstants& c, double elongation, double& plastic_elongation) {
  if constexpr (axial == Axial::linear) return c.axial.k1 * elongation;
  if constexpr (axial == Axial::curve) return curve_force(c.axial, elongation);
  const PlasticStep step = plastic_step(c.axial, elongation, plastic_elongation);
  plastic_elongation = step.plastic_elongation;
  return step.force;
}

/// Root of a bond's effective mass in shear, see build_effective_masses. A wire hardly changes its length; a dissipator
/// may be drawn out to a hundred times its own, and with it grows the lever by which its shear turns the ends: with the
/// mass of the short bond its damper would be forty times too strong, and unstable.
template <Axial axial>
inline double shear_mass(const Arrays& a, std::size_t bond, double length) {
  if constexpr (axial == Axial::linear) return a.shear_mass[bond];
  const double mass = a.axial_mass[bond], inertia = a.inertia[bond], lever = 0.5 * length;
  return mass * inertia / std::sqrt(std::max(inertia * inertia + lever * lever * mass * mass, kTinySquare));
}

/// The breakage criterion, with |a| + |b| > limit written as a^2 > (limit - |b|)^2 to need no square root.
inline bool too_much(const BondConstants& c, double axial, const Triple& shear, const Triple& bending, double torsion) {
  const double tension_left = c.tension_limit - std::max(axial, 0.0);
  const double shear_left = c.shear_limit - c.torsion_to_shear * std::abs(torsion);
  const double bent = c.bending_to_tension * c.bending_to_tension * dot(bending, bending);
  return (tension_left < 0) | (shear_left < 0) | (bent > tension_left * tension_left) |
         (dot(shear, shear) > shear_left * shear_left);
}

/// The loop over consecutive bonds of one sort. What a sort does not have costs nothing.
template <Axial axial, bool damped, bool breakable>
void advance(const Arrays& arrays, const BondConstants& constants, double dt, std::size_t first, std::size_t last,
             BondTile& w) {
  const Arrays a = arrays;  // copies, so that stores through the pointers cannot change them
  const BondConstants c = constants;
  const double rate = dt > 0 ? 1 / dt : 0;
  LAHAR_INDEPENDENT
  for (std::size_t b = first; b < last; ++b) {
    const std::size_t t = b - first;
    const double on = w.on[t], old_elongation = a.elongation[b];
    const Triple arm = w.arm[t];
    const BondMotion m = bond_motion(arm, w.length[t], w.mean_turn[t], w.relative_turn[t], a.direction[b],
                                     a.rest_length[b] + old_elongation);
    const double elongation = w.length[t] - a.rest_length[b];
    double plastic_elongation = axial == Axial::plastic ? a.plastic_elongation[b] : 0.0;
    const double f = on * axial_force<axial>(c, elongation, plastic_elongation);
    const Triple s = on * grown_shear(a.shear_force[b], c.shear_stiffness, m);
    const Triple bending = on * grown_bending(a.moment[b], c.bending_stiffness, m);
    const double torsion = on * (a.torsion_moment[b] + c.torsion_stiffness * m.twist);
    a.elongation[b] = elongation;
    a.direction.set(b, m.direction);
    a.axial_force[b] = f;
    a.shear_force.set(b, s);
    a.moment.set(b, bending);
    a.torsion_moment[b] = torsion;
    if constexpr (axial == Axial::plastic)
      a.plastic_elongation[b] = on > 0 ? plastic_elongation : a.plastic_elongation[b];
    if constexpr (breakable) w.broke[t] = too_much(c, f, s, bending, torsion);

    double axial_total = f, torsion_total = torsion;
    Triple shear_total = s, bending_total = bending;
    if constexpr (damped) {
      const double stretch = elongation - old_elongation;
      const double acting = on * rate;
      const double taut = (axial == Axial::linear) | (c.axial.lowest < 0) | (f > 0) ? 1.0 : 0.0;  // slack: none
      const double ca = taut * acting * c.axial_damping * a.axial_mass[b];
      const double cs = acting * c.shear_damping * shear_mass<axial>(a, b, w.length[t]);
      const double cb = acting * c.bending_damping * a.inertia[b], ct = acting * c.torsion_damping * a.inertia[b];
      if constexpr (axial == Axial::linear)
        axial_total += ca * stretch;
      else
        axial_total = std::max(f + ca * stretch, c.axial.lowest);  // what only pulls is not made to push by its damper
      shear_total = shear_total + cs * m.shear;
      bending_total = bending_total + cb * m.bend;
      torsion_total += ct * m.twist;
      w.loss[t] =
          (axial_total - f) * stretch + cs * dot(m.shear, m.shear) + cb * dot(m.bend, m.bend) + ct * m.twist * m.twist;
    }
    // Force and moment on i; j gets the opposite. The shear force acts in the middle of the bond, so that both ends
    // feel its lever in the same sense and angular momentum is kept.
    const Triple force = axial_total * m.direction + shear_total;
    const Triple moment = torsion_total * m.direction + bending_total, lever = 0.5 * cross(arm, shear_total);
    w.force.set(t, force);
    w.reaction.set(t, -1.0 * force);
    w.moment_i.set(t, lever + moment);
    w.moment_j.set(t, lever - moment);
  }
}

using Advance = decltype(&advance<Axial::linear, false, false>);

template <Axial axial>
Advance advance_for(bool damped, bool breakable) {
  if (damped) return breakable ? advance<axial, true, true> : advance<axial, true, false>;
  return breakable ? advance<axial, false, true> : advance<axial, false, false>;
}

/// The loop that does what this sort needs and no more.
Advance advance_for(const BondConstants& c) {
  if (c.plastic) return advance_for<Axial::plastic>(c.damped, c.breakable);
  if (c.axial.linear()) return advance_for<Axial::linear>(c.damped, c.breakable);
  return advance_for<Axial::curve>(c.damped, c.breakable);
}

/// Cuts the bonds that asked for it: their energy is booked, their forces act for the half of the kick that ends this
/// step, so that the ends have given what the bond held.
double break_bonds(const BondConstants& c, std::size_t first, std::size_t last, Bonds& bonds, BondTile& work) {
  double released = 0;
  for (std::size_t b = first; b < last; ++b) {
    const std::size_t t = b - first;
    if (work.broke[t] == 0) continue;
    released += energy_of(bonds, c, b, b + 1).elastic();
    bonds.intact[b] = 0;
    bonds.axial_force[b] = bonds.torsion_moment[b] = 0;
    work.loss[t] *= 0.5;
    for (Vec3Field* f : {&bonds.shear_force, &bonds.moment}) f->set(b, Vec3::Zero());
    for (BondTile::Rows* f : {&work.force, &work.reaction, &work.moment_i, &work.moment_j}) f->set(t, 0.5 * (*f)[t]);
  }
  return released;
}

}  // namespace

void BondForces::build(const Bonds& bonds, const Particles& particles) {
  constants_.clear();
  for (const BondSort& s : bonds.sorts) constants_.push_back(constants_of(s));
  size_ = bonds.size();
  for (std::size_t b = 0; b < size_; ++b) {
    require(std::max(bonds.i[b], bonds.j[b]) < particles.size(), "a bond's end does not exist");
    require(static_cast<std::size_t>(bonds.sort[b]) < constants_.size(), "a bond's sort does not exist");
  }
  build_effective_masses(bonds, particles);
  layout_ = BondLayout(bonds, particles.size());
  losses_.assign(layout_.chunks.size(), {});
}

/// Effective mass of a mode of two free ends; a fixed end counts as infinitely heavy. Shear moves the ends sideways and
/// turns them: 1/m_s = 1/m_i + 1/m_j + (l/2)^2 (1/I_i + 1/I_j).
void BondForces::build_effective_masses(const Bonds& bonds, const Particles& particles) {
  const auto root_of_inverse = [](double v) { return v > 0 ? 1 / std::sqrt(v) : 0.0; };
  masses_ = EffectiveMasses{};
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const double mass = particles.inverse_mass[bonds.i[b]] + particles.inverse_mass[bonds.j[b]];
    const double inertia = particles.inverse_inertia(bonds.i[b]) + particles.inverse_inertia(bonds.j[b]);
    const double lever = 0.5 * bonds.rest_length[b];
    masses_.axial.push_back(root_of_inverse(mass));
    masses_.shear.push_back(root_of_inverse(mass + lever * lever * inertia));
    masses_.inertia.push_back(root_of_inverse(inertia));
  }
}

void BondForces::add_forces(Bonds& bonds, Particles& particles, double dt) {
  require(bonds.size() == size_, "bonds were added after BondForces::build");
  for (const auto& colour : layout_.colours)
    parallel_for(0, colour.size(), 1, [&](std::size_t c) { advance_chunk(colour[c], bonds, particles, dt); });
  for (const Loss& loss : losses_) {
    bonds.damping_loss += loss.damping;
    bonds.breakage_loss += loss.breakage;
  }
}

void BondForces::advance_chunk(std::size_t chunk, Bonds& bonds, Particles& particles, double dt) {
  const Arrays arrays(bonds, masses_);
  Loss loss;
  BondTile work;
  for (std::size_t t = layout_.chunks[chunk].first_tile; t < layout_.chunks[chunk].last_tile; ++t) {
    const BondLayout::Tile& tile = layout_.tiles[t];
    const BondConstants& c = constants_[static_cast<std::size_t>(tile.sort)];
    const BondLayout::Link *link = &layout_.links[tile.first_link], *end = link + (tile.last_link - tile.first_link);
    gather(link, end, bonds, particles, dt, work);
    advance_for(c)(arrays, c, dt, tile.first, tile.last, work);
    if (c.breakable) loss.breakage += break_bonds(c, tile.first, tile.last, bonds, work);
    scatter(link, end, bonds, work, particles);
    if (c.damped) loss.damping += lane_sum(0, tile.last - tile.first, [&](std::size_t k) { return work.loss[k]; });
  }
  losses_[chunk] = loss;
}

BondEnergy BondForces::energy(const Bonds& bonds) const {
  BondEnergy sum;
  for (const BondLayout::Tile& tile : layout_.tiles)
    sum += energy_of(bonds, constants_[static_cast<std::size_t>(tile.sort)], tile.first, tile.last);
  sum.damping = bonds.damping_loss;
  sum.breakage = bonds.breakage_loss;
  return sum;
}

}  // namespace lahar::dem

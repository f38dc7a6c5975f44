#include "dem/bonds/bond_forces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/bonds/parallel_bond.h"

// The rounds of the loop that follows do not depend on each other, whatever the compiler can prove.
#if defined(__GNUC__) && !defined(__clang__)
#define LAHAR_INDEPENDENT _Pragma("GCC ivdep")
#else
#define LAHAR_INDEPENDENT
#endif

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 1024;  // bonds that one thread takes at a time, at most; fixes the order of sums
constexpr std::size_t kTile = 128;    // bonds whose intermediate results stay in the first-level cache

constexpr double kTiny = 1e-300;  // m^2, keeps broken bonds finite when their ends meet

enum class Axial { linear, curve, plastic };

BondForces::Constants constants_of(const BondSort& s) {
  require(s.bond_radius > 0 && s.shear_stiffness >= 0, "a bond needs a positive radius and no negative stiffness");
  require(s.tensile_strength > 0 && s.shear_strength > 0, "bond strengths must be positive");
  require(s.damping_ratio >= 0, "a bond's damping ratio must not be negative");
  const double r = s.bond_radius;
  const double area = std::numbers::pi * r * r;
  const double inertia = 0.25 * area * r * r;  // second moment of area; the polar one is twice that
  BondForces::Constants c;
  c.axial = axial_curve(s.axial, area);
  c.shear_stiffness = s.shear_stiffness * area;
  c.bending_stiffness = s.axial.stiffness[0] * inertia;
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

/// Bare pointers to the three components of a field.
template <class Number>
struct Columns {
  Number *x, *y, *z;
  template <class Field>
  explicit Columns(Field& f) : x(f.x.data()), y(f.y.data()), z(f.z.data()) {}
  void advance(std::size_t n) { x += n, y += n, z += n; }
  Triple operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, const Triple& v) const { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
};

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

/// Intermediate results of a tile of bonds.
struct Work {
  using Row = std::array<double, kTile>;
  struct Rows {
    alignas(64) Row x, y, z;
    Triple operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
    void set(std::size_t k, const Triple& v) { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
  };
  Rows arm, mean_turn, relative_turn;  // in: of the ends, see bond_motion
  Rows force, reaction;                // out: force on i, the opposite on j
  Rows moment_i, moment_j;             // out: torques, with that of the shear
  alignas(64) Row length, on, loss;    // m; 1 or 0 for broken; J, damping in this step
  alignas(64) std::array<std::uint8_t, kTile> broke;
};

template <Axial axial>
inline double axial_force(const BondForces::Constants& c, double elongation, double& plastic_elongation) {
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
  return mass * inertia / std::sqrt(std::max(inertia * inertia + lever * lever * mass * mass, kTiny));
}

/// The breakage criterion, with |a| + |b| > limit written as a^2 > (limit - |b|)^2 to need no square root.
inline bool too_much(const BondForces::Constants& c, double axial, const Triple& shear, const Triple& bending,
                     double torsion) {
  const double tension_left = c.tension_limit - std::max(axial, 0.0);
  const double shear_left = c.shear_limit - c.torsion_to_shear * std::abs(torsion);
  const double bent = c.bending_to_tension * c.bending_to_tension * dot(bending, bending);
  return (tension_left < 0) | (shear_left < 0) | (bent > tension_left * tension_left) |
         (dot(shear, shear) > shear_left * shear_left);
}

/// Positions (m) and spins (rad/s) of the ends of a link's bonds.
struct Ends {
  Columns<const double> x_i, x_j, spin_i, spin_j;
};

Ends ends_in_line(const BondForces::Link& link, const Particles& p) {
  Ends e{Columns<const double>(p.position), Columns<const double>(p.position),
         Columns<const double>(p.angular_velocity), Columns<const double>(p.angular_velocity)};
  e.x_i.advance(link.i), e.x_j.advance(link.j), e.spin_i.advance(link.i), e.spin_j.advance(link.j);
  return e;
}

/// Copies from where the ends stand into the rows of forces and moments, which are not needed yet.
Ends fetched_ends(const BondForces::Link& link, const Bonds& bonds, const Particles& p, Work& work) {
  for (std::size_t k = 0; k < link.last - link.first; ++k) {
    const ParticleIndex i = bonds.i[link.first + k], j = bonds.j[link.first + k];
    work.force.set(k, {p.position.x[i], p.position.y[i], p.position.z[i]});
    work.reaction.set(k, {p.position.x[j], p.position.y[j], p.position.z[j]});
    work.moment_i.set(k, {p.angular_velocity.x[i], p.angular_velocity.y[i], p.angular_velocity.z[i]});
    work.moment_j.set(k, {p.angular_velocity.x[j], p.angular_velocity.y[j], p.angular_velocity.z[j]});
  }
  return {Columns<const double>(work.force), Columns<const double>(work.reaction), Columns<const double>(work.moment_i),
          Columns<const double>(work.moment_j)};
}

/// Fetches what the ends of a tile's bonds do.
void gather(const BondForces::Link* link, const BondForces::Link* end, const Bonds& bonds, const Particles& particles,
            double dt, Work& work) {
  const std::size_t base = link->first;
  std::size_t size = 0;
  for (; link != end; ++link) {
    const std::size_t count = link->last - link->first, w = link->first - base;
    const Ends ends = link->in_line ? ends_in_line(*link, particles) : fetched_ends(*link, bonds, particles, work);
    LAHAR_INDEPENDENT
    for (std::size_t k = 0; k < count; ++k) {
      const Triple arm = ends.x_j[k] - ends.x_i[k];
      const Triple turn_i = ends.spin_i[k], turn_j = ends.spin_j[k];
      work.arm.set(w + k, arm);
      work.length[w + k] = dot(arm, arm);
      work.mean_turn.set(w + k, (0.5 * dt) * (turn_i + turn_j));
      work.relative_turn.set(w + k, dt * (turn_j - turn_i));
    }
    size = w + count;
  }
  for (std::size_t k = 0; k < size; ++k) work.on[k] = bonds.intact[base + k] != 0 ? 1.0 : 0.0;
  // A loop of its own: a square root that may set errno keeps a loop from being vectorized.
  for (std::size_t k = 0; k < size; ++k) work.length[k] = std::sqrt(std::max(work.length[k], kTiny));
}

/// Adds what a link's bonds give to ends that stand anywhere, with the same sums as `add_rows`.
void add_scattered(std::vector<double>& to, const BondForces::Link& link, const Bonds& bonds, const double* on_i,
                   const double* on_j) {
  const std::size_t count = link.last - link.first;
  const ParticleIndex *i = &bonds.i[link.first], *j = &bonds.j[link.first];
  if (link.chain) {
    to[i[0]] += on_i[0];
    for (std::size_t k = 1; k < count; ++k) to[i[k]] += on_i[k] + on_j[k - 1];
    to[j[count - 1]] += on_j[count - 1];
    return;
  }
  for (std::size_t k = 0; k < count; ++k) to[i[k]] += on_i[k];
  for (std::size_t k = 0; k < count; ++k) to[j[k]] += on_j[k];
}

/// Adds what a link's bonds give to their first ends and to their second ones.
void add_rows(std::vector<double>& to, const BondForces::Link& link, const Bonds& bonds, const double* on_i,
              const double* on_j) {
  if (!link.in_line) return add_scattered(to, link, bonds, on_i, on_j);
  const std::size_t count = link.last - link.first;
  double *i = to.data() + link.i, *j = to.data() + link.j;
  if (link.chain) {  // bead k is the first end of bond k and the second one of bond k - 1
    i[0] += on_i[0];
    LAHAR_INDEPENDENT
    for (std::size_t k = 1; k < count; ++k) i[k] += on_i[k] + on_j[k - 1];
    i[count] += on_j[count - 1];
    return;
  }
  LAHAR_INDEPENDENT
  for (std::size_t k = 0; k < count; ++k) i[k] += on_i[k];
  LAHAR_INDEPENDENT
  for (std::size_t k = 0; k < count; ++k) j[k] += on_j[k];
}

/// Adds a tile's forces and torques to its particles.
void scatter(const BondForces::Link* link, const BondForces::Link* end, const Bonds& bonds, const Work& work,
             Particles& particles) {
  const std::size_t base = link->first;
  for (; link != end; ++link) {
    const std::size_t w = link->first - base;
    add_rows(particles.force.x, *link, bonds, &work.force.x[w], &work.reaction.x[w]);
    add_rows(particles.force.y, *link, bonds, &work.force.y[w], &work.reaction.y[w]);
    add_rows(particles.force.z, *link, bonds, &work.force.z[w], &work.reaction.z[w]);
    add_rows(particles.torque.x, *link, bonds, &work.moment_i.x[w], &work.moment_j.x[w]);
    add_rows(particles.torque.y, *link, bonds, &work.moment_i.y[w], &work.moment_j.y[w]);
    add_rows(particles.torque.z, *link, bonds, &work.moment_i.z[w], &work.moment_j.z[w]);
  }
}

/// The loop over consecutive bonds of one sort. What a sort does not have costs nothing.
template <Axial axial, bool damped, bool breakable>
void advance(const Arrays& arrays, const BondForces::Constants& constants, double dt, std::size_t first,
             std::size_t last, Work& w) {
  const Arrays a = arrays;  // copies, so that stores through the pointers cannot change them
  const BondForces::Constants c = constants;
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
      axial_total += ca * stretch;
      shear_total = shear_total + cs * m.shear;
      bending_total = bending_total + cb * m.bend;
      torsion_total += ct * m.twist;
      w.loss[t] =
          ca * stretch * stretch + cs * dot(m.shear, m.shear) + cb * dot(m.bend, m.bend) + ct * m.twist * m.twist;
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
Advance advance_for(const BondForces::Constants& c) {
  if (c.plastic) return advance_for<Axial::plastic>(c.damped, c.breakable);
  if (c.axial.linear()) return advance_for<Axial::linear>(c.damped, c.breakable);
  return advance_for<Axial::curve>(c.damped, c.breakable);
}

/// Sum of term(k) in eight lanes, so that it vectorizes in an order that the source fixes.
template <class Term>
double lane_sum(std::size_t first, std::size_t last, const Term& term) {
  std::array<double, 8> lane{};
  std::size_t k = first;
  for (; k + 8 <= last; k += 8)
    for (std::size_t l = 0; l < 8; ++l) lane[l] += term(k + l);
  for (std::size_t l = 0; k < last; ++k, ++l) lane[l] += term(k);
  double sum = 0;
  for (const double v : lane) sum += v;
  return sum;
}

double sum_of_squares(const std::vector<double>& v, std::size_t first, std::size_t last) {
  const double* p = v.data();
  return lane_sum(first, last, [p](std::size_t k) { return p[k] * p[k]; });
}
double sum_of_squares(const Vec3Field& v, std::size_t first, std::size_t last) {
  const Columns<const double> p(v);
  return lane_sum(first, last, [p](std::size_t k) { return dot(p[k], p[k]); });
}
/// Energy of linear springs whose forces' squares add up to `squares`.
double spring_energy(double squares, double stiffness) { return stiffness > 0 ? 0.5 * squares / stiffness : 0.0; }

double axial_energy(const Bonds& bonds, const BondForces::Constants& c, std::size_t first, std::size_t last) {
  if (c.axial.linear() || c.plastic) return spring_energy(sum_of_squares(bonds.axial_force, first, last), c.axial.k1);
  const double* e = bonds.elongation.data();
  const std::uint8_t* intact = bonds.intact.data();
  const AxialCurve curve = c.axial;
  return lane_sum(first, last, [=](std::size_t k) { return intact[k] != 0 ? curve_energy(curve, e[k]) : 0.0; });
}

/// Energies of consecutive bonds of one sort (all but what broke). Broken bonds hold no forces.
BondEnergy energy_of(const Bonds& bonds, const BondForces::Constants& c, std::size_t first, std::size_t last) {
  BondEnergy e;
  e.axial = axial_energy(bonds, c, first, last);
  e.shear = spring_energy(sum_of_squares(bonds.shear_force, first, last), c.shear_stiffness);
  e.bending = spring_energy(sum_of_squares(bonds.moment, first, last), c.bending_stiffness);
  e.torsion = spring_energy(sum_of_squares(bonds.torsion_moment, first, last), c.torsion_stiffness);
  if (c.plastic)
    for (std::size_t b = first; b < last; ++b) e.plastic += plastic_work(c.axial, bonds.plastic_elongation[b]);
  return e;
}

/// Cuts the bonds that asked for it: their energy is booked, their forces act for the half of the kick that ends this
/// step, so that the ends have given what the bond held.
double break_bonds(const BondForces::Constants& c, std::size_t first, std::size_t last, Bonds& bonds, Work& work) {
  double released = 0;
  for (std::size_t b = first; b < last; ++b) {
    const std::size_t t = b - first;
    if (work.broke[t] == 0) continue;
    released += energy_of(bonds, c, b, b + 1).elastic();
    bonds.intact[b] = 0;
    bonds.axial_force[b] = bonds.torsion_moment[b] = 0;
    work.loss[t] *= 0.5;
    for (Vec3Field* f : {&bonds.shear_force, &bonds.moment}) f->set(b, Vec3::Zero());
    for (Work::Rows* f : {&work.force, &work.reaction, &work.moment_i, &work.moment_j}) f->set(t, 0.5 * (*f)[t]);
  }
  return released;
}

}  // namespace

BondEnergy& BondEnergy::operator+=(const BondEnergy& o) {
  axial += o.axial, shear += o.shear, bending += o.bending, torsion += o.torsion;
  damping += o.damping, plastic += o.plastic, breakage += o.breakage;
  return *this;
}

void BondForces::build(const Bonds& bonds, const Particles& particles) {
  constants_.clear();
  for (const BondSort& s : bonds.sorts) constants_.push_back(constants_of(s));
  size_ = bonds.size();
  for (std::size_t b = 0; b < size_; ++b) {
    require(std::max(bonds.i[b], bonds.j[b]) < particles.size(), "a bond's end does not exist");
    require(static_cast<std::size_t>(bonds.sort[b]) < constants_.size(), "a bond's sort does not exist");
  }
  build_effective_masses(bonds, particles);
  build_chunks(bonds, particles.size());
  build_tiles(bonds);
  build_colours(bonds, particles.size());
}

/// Effective mass of a mode of two free ends; a fixed end counts as infinitely heavy. Shear moves the ends sideways and
/// turns them: 1/m_s = 1/m_i + 1/m_j + (l/2)^2 (1/I_i + 1/I_j).
void BondForces::build_effective_masses(const Bonds& bonds, const Particles& particles) {
  const auto root_of_inverse = [](double v) { return v > 0 ? 1 / std::sqrt(v) : 0.0; };
  const auto inverse_inertia = [&](ParticleIndex p) {
    return particles.inverse_mass[p] > 0 ? 1 / particles.inertia[p] : 0.0;
  };
  masses_ = EffectiveMasses{};
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const double mass = particles.inverse_mass[bonds.i[b]] + particles.inverse_mass[bonds.j[b]];
    const double inertia = inverse_inertia(bonds.i[b]) + inverse_inertia(bonds.j[b]);
    const double lever = 0.5 * bonds.rest_length[b];
    masses_.axial.push_back(root_of_inverse(mass));
    masses_.shear.push_back(root_of_inverse(mass + lever * lever * inertia));
    masses_.inertia.push_back(root_of_inverse(inertia));
  }
}

/// Cuts the bonds into chunks, where possible between bonds that share no particle (between two rings).
void BondForces::build_chunks(const Bonds& bonds, std::size_t particles) {
  std::vector<std::size_t> last_bond(particles, 0);
  for (std::size_t b = 0; b < bonds.size(); ++b) last_bond[bonds.i[b]] = last_bond[bonds.j[b]] = b;
  chunks_.clear();
  std::size_t first = 0, clean_cut = 0, reach = 0;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (reach < b) clean_cut = b;  // nothing before b shares a particle with b or later
    if (b - first == kChunk) {
      const std::size_t cut = clean_cut > first ? clean_cut : b;
      chunks_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(cut), 0, 0, 0, 0});
      first = cut;
    }
    reach = std::max({reach, last_bond[bonds.i[b]], last_bond[bonds.j[b]]});
  }
  if (first < bonds.size())
    chunks_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(bonds.size()), 0, 0, 0, 0});
}

void BondForces::build_tiles(const Bonds& bonds) {
  links_.clear();
  tiles_.clear();
  for (Chunk& chunk : chunks_) {
    chunk.first_tile = static_cast<std::uint32_t>(tiles_.size());
    for (std::uint32_t b = chunk.first; b < chunk.last; ++b) {
      const bool new_tile = b == chunk.first || bonds.sort[b] != bonds.sort[b - 1] || b - tiles_.back().first == kTile;
      const bool new_link =
          new_tile || bonds.id_i[b] != bonds.id_i[b - 1] + 1 || bonds.id_j[b] != bonds.id_j[b - 1] + 1;
      const auto links = static_cast<std::uint32_t>(links_.size());
      if (new_tile) tiles_.push_back({b, b, links, links, bonds.sort[b]});
      if (new_link) links_.push_back({b, b, bonds.i[b], bonds.j[b], bonds.id_j[b] == bonds.id_i[b] + 1, true});
      links_.back().last = tiles_.back().last = b + 1;
      tiles_.back().last_link = static_cast<std::uint32_t>(links_.size());
    }
    chunk.last_tile = static_cast<std::uint32_t>(tiles_.size());
  }
  find_ends(bonds);
}

void BondForces::find_ends(const Bonds& bonds) {
  for (Link& link : links_) {
    link.i = bonds.i[link.first], link.j = bonds.j[link.first];
    link.in_line = true;
    for (std::uint32_t b = link.first; b < link.last; ++b)
      link.in_line = link.in_line && bonds.i[b] == link.i + (b - link.first) && bonds.j[b] == link.j + (b - link.first);
  }
}

/// Gives each chunk the first colour that no earlier chunk with a common particle has.
void BondForces::build_colours(const Bonds& bonds, std::size_t particles) {
  std::vector<std::uint64_t> taken(particles, 0);  // bit per colour
  colours_.clear();
  for (std::uint32_t c = 0; c < chunks_.size(); ++c) {
    std::uint64_t near = 0;
    for (std::size_t b = chunks_[c].first; b < chunks_[c].last; ++b) near |= taken[bonds.i[b]] | taken[bonds.j[b]];
    require(~near != 0, "too many chunks of bonds meet at one particle");
    const auto colour = static_cast<std::size_t>(std::countr_one(near));
    if (colour == colours_.size()) colours_.emplace_back();
    colours_[colour].push_back(c);
    for (std::size_t b = chunks_[c].first; b < chunks_[c].last; ++b)
      for (const ParticleIndex p : {bonds.i[b], bonds.j[b]}) taken[p] |= std::uint64_t{1} << colour;
  }
}

void BondForces::add_forces(Bonds& bonds, Particles& particles, double dt) {
  require(bonds.size() == size_, "bonds were added after BondForces::build");
  for (const auto& colour : colours_)
    parallel_for(0, colour.size(), 1, [&](std::size_t c) { advance_chunk(chunks_[colour[c]], bonds, particles, dt); });
  for (const Chunk& chunk : chunks_) {
    bonds.damping_loss += chunk.damping_loss;
    bonds.breakage_loss += chunk.breakage_loss;
  }
}

void BondForces::advance_chunk(Chunk& chunk, Bonds& bonds, Particles& particles, double dt) const {
  const Arrays arrays(bonds, masses_);
  chunk.damping_loss = chunk.breakage_loss = 0;
  Work work;
  for (std::size_t t = chunk.first_tile; t < chunk.last_tile; ++t) {
    const Tile& tile = tiles_[t];
    const Constants& c = constants_[static_cast<std::size_t>(tile.sort)];
    const Link *link = &links_[tile.first_link], *end = link + (tile.last_link - tile.first_link);
    gather(link, end, bonds, particles, dt, work);
    advance_for(c)(arrays, c, dt, tile.first, tile.last, work);
    if (c.breakable) chunk.breakage_loss += break_bonds(c, tile.first, tile.last, bonds, work);
    scatter(link, end, bonds, work, particles);
    if (c.damped)
      chunk.damping_loss += lane_sum(0, tile.last - tile.first, [&](std::size_t k) { return work.loss[k]; });
  }
}

BondEnergy BondForces::energy(const Bonds& bonds) const {
  BondEnergy sum;
  for (const Tile& tile : tiles_)
    sum += energy_of(bonds, constants_[static_cast<std::size_t>(tile.sort)], tile.first, tile.last);
  sum.damping = bonds.damping_loss;
  sum.breakage = bonds.breakage_loss;
  return sum;
}

}  // namespace lahar::dem

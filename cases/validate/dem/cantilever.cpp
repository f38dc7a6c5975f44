// A cantilever of bonded beads against beam theory: deflection under a load at its end, first frequency.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "cases/validate/dem/beam.h"
#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/entry.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

// bonded_beam.csv: the paper's bonds (Li, Zhao & Kwan 2020, Table 4 and section 3.1; stiffness per unit area, bond
// radius = bead radius), computed with EI of the bond's section. Frequencies: 1.8751^2 / (2 pi L^2) sqrt(EI / (m / l)).
const BeamSpec kRing{"ring bond, Table 4", 20, 0.00305, 7800, 3e11, 3e11, 4e-6};
const BeamSpec kCable{"cable bond, Table 4", 20, 0.00305, 7800, 8e11, 8e11, 2.4e-6};
const BeamSpec kThick{"ring bond, section 3.1", 20, 0.00785, 7800, 1.3e12, 8e8, 1.6e-6};

// Quantities of bonded_beam.csv; a bond is 6.1 mm long.
constexpr const char* kTip10 = "cantilever tip k=3EI/L^3 N/m, L=0.0610 (needs k_s large)";
constexpr const char* kTip20 = "cantilever tip k=3EI/L^3 N/m, L=0.1220 (needs k_s large)";
constexpr const char* kFrequency = "first cantilever freq Hz, L=20l";

struct Section {
  double area, second_moment;
};
Section section_of(const BeamSpec& s) {
  const double r = s.bead_radius;
  return {std::numbers::pi * r * r, 0.25 * std::numbers::pi * r * r * r * r};
}
double length_of(const BeamSpec& s) { return 2 * s.bead_radius * s.bonds; }
double bending_stiffness(const BeamSpec& s) {
  return s.normal_stiffness * 2 * s.bead_radius * section_of(s).second_moment;
}

/// N/m: bending 3 E I / L^3 in series with the shear of all bonds, k_s A / n (Timoshenko's beam).
double tip_stiffness(const BeamSpec& s) {
  const double bending = 3 * bending_stiffness(s) / std::pow(length_of(s), 3);
  return 1 / (1 / bending + s.bonds / (s.shear_stiffness * section_of(s).area));
}

double first_frequency(const BeamSpec& s) {
  const double per_length = sphere_mass(s.bead_radius, s.density) / (2 * s.bead_radius);
  return std::pow(1.87510407, 2) / (2 * std::numbers::pi * std::pow(length_of(s), 2)) *
         std::sqrt(bending_stiffness(s) / per_length);
}

/// Deflection over load, m/N, once a drag has brought the loaded beam to rest.
double compliance(const BeamSpec& s, double frequency) {
  dem::Solids solids = cantilever_of(s);
  const auto tip = static_cast<std::size_t>(s.bonds);
  const double load = 1e-3 * length_of(s) * tip_stiffness(s), rate = 4 * std::numbers::pi * frequency;
  const int pieces = static_cast<int>(3 / frequency / s.time_step / 10);
  for (int k = 0; k < pieces; ++k) {
    set_drag(solids.particles(), rate);
    solids.particles().external_force.add(tip, Vec3(0, 0, load));
    solids.advance(10);
  }
  return solids.particles().position.z[tip] / load;
}

/// Swings freely from the shape of the first mode; the last bead stands for half a cell of the beam.
double swing(const BeamSpec& s, double expected, std::vector<Row>& rows) {
  dem::Solids solids = cantilever_of(s);
  dem::Particles& p = solids.particles();
  const auto n = static_cast<std::size_t>(s.bonds);
  p.mass[n] /= 2, p.inverse_mass[n] *= 2, p.inertia[n] /= 2;
  const double speed = 1e-3 * length_of(s) * 2 * std::numbers::pi * expected;
  for (std::size_t k = 1; k <= n; ++k) {
    const double x = static_cast<double>(k) / static_cast<double>(n);
    p.velocity.set(k, {0, 0, speed * x * x * (3 - x) / 2});
    p.angular_velocity.set(k, {0, -speed * (6 * x - 3 * x * x) / 2 / length_of(s), 0});
  }
  LedgerWatch watch(solids);
  double first = 0, last_time = 0, last = 0;
  int crossings = 0;
  while (crossings < 9 && solids.time() < 10 / expected) {
    solids.step();
    watch.look();
    const double z = solids.particles().position.z[n];
    if (last * z < 0) {
      const double t = solids.time() - s.time_step * z / (z - last);
      if (crossings++ == 0) first = t;
      last_time = t;
    }
    last = z;
  }
  rows.push_back(watch.row(s.name));
  return 0.5 * (crossings - 1) / (last_time - first);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const ReferenceTable table = reference("bonded_beam.csv");
  for (const auto& [object, beam] : {std::pair{"ring bond Table4", kRing}, std::pair{"cable bond Table4", kCable}}) {
    const ReferenceTable bond = table.where("object", object);
    const double stiffness = bond.where("quantity", kTip20).number("value");      // N/m, bending alone
    const double frequency = bond.where("quantity", kFrequency).number("value");  // Hz
    if (context.quick && beam.normal_stiffness > 5e11) continue;
    rows.push_back(relative_row(fmt::format("{}, {} beads: load / deflection, N/m", beam.name, beam.bonds),
                                1 / compliance(beam, frequency), stiffness, 0.01));
    rows.push_back(relative_row(fmt::format("{}, {} beads: first frequency, Hz", beam.name, beam.bonds),
                                swing(beam, frequency, rows), frequency, 0.01));
  }
  BeamSpec half = kRing;
  half.bonds = 10;
  rows.push_back(
      relative_row("ring bond, Table 4, 10 beads: load / deflection, N/m", 1 / compliance(half, first_frequency(half)),
                   table.where("object", "ring bond Table4").where("quantity", kTip10).number("value"), 0.01));
  rows.push_back(relative_row("ring bond, section 3.1, mostly shear: load / deflection, N/m",
                              1 / compliance(kThick, 40), tip_stiffness(kThick), 0.01));
  return rows;
}

}  // namespace

Entry cantilever() { return {"dem.cantilever", {"beam theory (Timoshenko)", {"bonded_beam.csv"}}, run}; }

}  // namespace lahar::validate

// A chain of beads of given length between two points, let go from a V: it must come to rest on a catenary.
#include <fmt/format.h>

#include <cmath>

#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr double kSpan = 1.8;  // m

/// Inextensible cable (catenary.csv). Length, H / w and T_end / w in m.
struct Catenary {
  double sag_over_span, length, horizontal, end;
};
constexpr double kBead = 0.01, kDensity = 2500;  // m, radius; kg/m^3
constexpr double kStrain = 2e-3;                 // of the chain under its tension, over its slack: nearly inextensible
constexpr double kBondRadius = 1e-4;             // m, so thin that the chain does not mind bending

struct Chain {
  dem::Solids solids;
  double weight;  // N/m
};

/// Hangs in a V: two straight halves.
Chain chain_of(const Catenary& c, int bonds) {
  const double spacing = c.length / bonds, mass = sphere_mass(kBead, kDensity), weight = mass * kGravity / spacing;
  const double stiffness = c.end * weight / (kStrain * (c.length / kSpan - 1)) / spacing;  // N/m, of a bond
  dem::BondSort sort;
  sort.bond_radius = kBondRadius;
  const double per_area = stiffness / (std::numbers::pi * kBondRadius * kBondRadius);
  sort.axial.stiffness = {per_area, per_area, per_area};
  sort.damping_ratio = 0.1;  // for the ringing of single bonds; a drag below stills the chain as a whole
  dem::Particles p;
  dem::Bonds b;
  b.add_sort(sort);
  const double depth = std::sqrt(c.length * c.length - kSpan * kSpan) / 2;
  for (int k = 0; k <= bonds; ++k) {
    const double s = 2.0 * k / bonds, side = s < 1 ? s : 2 - s;
    dem::ParticleSpec bead;
    bead.position = Vec3(0.5 * kSpan * s, 0, -depth * side);
    bead.radius = kBead;
    bead.density = kDensity;
    bead.kind = dem::ParticleKind::bead;
    bead.body = 0;
    bead.state = k == 0 || k == bonds ? dem::ParticleState::fixed : dem::ParticleState::free;
    const dem::ParticleIndex i = p.add(bead);
    if (k > 0) b.add({i - 1, i, 0}, p);
  }
  const double step = 0.6 * std::sqrt(mass / stiffness);
  return {{p, b, one_material(1e8, 0.3, 0, 1), {}, solids_options(step, Vec3(0, 0, -kGravity))}, weight};
}

void ask(std::vector<Row>& rows, const Catenary& c, int bonds) {
  Chain chain = chain_of(c, bonds);
  dem::Solids& solids = chain.solids;
  const double frequency = 0.5 / kSpan * std::sqrt(kGravity * c.horizontal);  // of its first wave
  const double time = 5 / frequency;
  LedgerWatch watch(solids);
  for (int k = 0; solids.time() < time; ++k) {
    set_drag(solids.particles(), 4 * frequency);
    solids.advance(50);
    if (k % 10 == 0) watch.look();
  }
  const dem::Particles& p = solids.particles();
  const auto middle = static_cast<std::size_t>(bonds / 2);
  // The anchor carries its bond and half a bead's share of the chain.
  const Vec3 pull = solids.bonds().axial_force[0] * solids.bonds().direction[0];
  const double horizontal = pull.x(), vertical = -pull.z() + 0.5 * chain.weight * c.length / bonds;
  const std::string name = fmt::format("sag {:.2f} spans", c.sag_over_span);
  rows.push_back(relative_row(name + ": sag / span", -p.position.z[middle] / kSpan, c.sag_over_span, 0.01));
  rows.push_back(relative_row(name + ": H / w, m", horizontal / chain.weight, c.horizontal, 0.01));
  rows.push_back(
      relative_row(name + ": tension at the end / w, m", std::hypot(horizontal, vertical) / chain.weight, c.end, 0.01));
  rows.push_back(watch.row(name));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const ReferenceTable table = reference("catenary.csv");
  const std::vector<double> sag = table.numbers("sag_over_span"), length = table.numbers("S_m"),
                            horizontal = table.numbers("H_over_w"), end = table.numbers("Tend_over_w");
  for (std::size_t k = 0; k < table.size(); ++k)
    if (!context.quick || sag[k] > 0.08) ask(rows, {sag[k], length[k], horizontal[k], end[k]}, context.quick ? 30 : 60);
  return rows;
}

}  // namespace

Entry catenary() { return {"dem.catenary", {"closed form of the catenary", {"catenary.csv"}}, run}; }

}  // namespace lahar::validate

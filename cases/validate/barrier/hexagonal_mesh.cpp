// A panel of hexagonal mesh stretched in its plane against its truss by hand, and a wire that breaks.
#include "barrier/hexagonal_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "dem/bonds/axial_law.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

/// A mesh of 80 mm in 2.7 mm wire. Mesh, wire and the stress over strain of the single wire as in the check of YADE's
/// wire model (checkWirePM.py, after Thoeni et al. 2013): 250 MPa at 0.0019, 383 MPa at 0.05, 566 MPa at 0.35. A twist
/// is two wires, with strains beyond the first point times 0.4 (lambda_eps there).
barrier::HexagonalMesh mesh_80() {
  barrier::HexagonalMesh m;
  m.mesh_width = 0.08, m.mesh_height = 0.12, m.twist_length = 0.04;
  m.wire_diameter = 0.0027, m.wire_density = 7850, m.node_diameter = 0.0216;
  m.single = {{0.00192, 0.05, 0.35}, {1431, 2192, 3240}};
  m.twist = {{0.00192, 0.02, 0.14}, {2862, 4384, 6480}};
  m.plastic_unloading = false;
  m.damping_ratio = 0.02;
  return m;
}

/// On the straight pieces through the law's points.
double force_of(const barrier::WireLaw& law, double strain) {
  double at = 0, force = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (strain <= law.strain[k]) return force + (law.force[k] - force) * (strain - at) / (law.strain[k] - at);
    at = law.strain[k], force = law.force[k];
  }
  return std::nan("");
}

/// The stretched panel, the same in every mesh. Twists and single wires share the height of a row: the twist's length
/// is the one at which it pulls as much as two single wires do along it.
struct Truss {
  double twist_length = 0, row = 0, width = 0;  ///< m
  double twist_force = 0, single_force = 0;     ///< N
};

Truss solve(const barrier::HexagonalMesh& m, double across, double up) {
  Truss t;
  t.width = m.mesh_width * (1 + across), t.row = m.row_distance() * (1 + up);
  double low = 0.5 * m.twist_length, high = t.row;
  const auto excess = [&](double length) {  // of the twist's pull
    const double rise = t.row - length, single = std::hypot(0.5 * t.width, rise);
    t.twist_force = length > m.twist_length ? force_of(m.twist, length / m.twist_length - 1) : 0.0;
    t.single_force = single > m.single_length() ? force_of(m.single, single / m.single_length() - 1) : 0.0;
    return t.twist_force - 2 * t.single_force * rise / single;
  };
  high = m.twist_length * (1 + m.twist.strain[2]);
  for (int k = 0; k < 200; ++k) {
    t.twist_length = 0.5 * (low + high);
    const double e = excess(t.twist_length);
    (e > 0 || !std::isfinite(e) ? high : low) = t.twist_length;
  }
  return t;
}

struct Panel {
  barrier::HexagonalMesh mesh;
  barrier::MeshPart part;
  dem::Particles particles;
  dem::Bonds bonds;
};

Panel panel_of(const barrier::HexagonalMesh& mesh, int columns, int rows) {
  Panel p{mesh, {}, {}, {}};
  p.part = add_hexagonal_mesh(mesh, columns, rows, {}, 0, 0, p.particles, p.bonds);
  return p;
}

dem::Solids solids_of(Panel& p, double share = 1) {
  const double step = share * 0.5 * dem::bond_time_step(p.bonds, p.particles);
  return {p.particles, p.bonds, one_material(1e9, 0.3, 0, 1), {}, solids_options(step, Vec3::Zero())};
}

void hold(dem::Particles& p, dem::ParticleIndex i) {
  p.state[i] = dem::ParticleState::fixed;
  p.inverse_mass[i] = 0;
}

/// Holds the edge where the truss has it, lets the rest find its place from an even stretch of the panel.
void ask_stretched(double across, double up, int columns, int rows, std::vector<Row>& rows_out) {
  Panel p = panel_of(mesh_80(), columns, rows);
  const Truss truss = solve(p.mesh, across, up);
  for (const auto* edge : {&p.part.left, &p.part.right, &p.part.lower, &p.part.upper})
    for (const dem::ParticleIndex i : *edge) hold(p.particles, i);
  for (dem::ParticleIndex i = 0; i < p.particles.size(); ++i) {
    const Vec3 x = p.particles.position[i];
    const double row = std::floor(x.z() / p.mesh.row_distance() + 1e-6);
    const bool top = x.z() - row * p.mesh.row_distance() > 0.5 * p.mesh.twist_length;
    const bool held = p.particles.inverse_mass[i] == 0;
    const double z = held ? row * truss.row + (top ? truss.twist_length : 0.0) : x.z() * (1 + up);
    p.particles.position.set(i, {0, x.y() * (1 + across), z});
  }
  dem::Solids solids = solids_of(p, 0.05);  // the energy exchanged is all in the fastest mode
  LedgerWatch watch(solids);
  while (solids.time() < 0.02) {
    set_drag(solids.particles(), 1500);
    solids.advance(10);
    watch.look();
  }
  const std::string name = fmt::format("stretched by {:g} across and {:g} up", across, up);
  double twist = 0, single = 0;  // the farthest from the truss
  for (std::size_t b = 0; b < solids.bonds().size(); ++b) {
    const bool twisted = solids.bonds().rest_length[b] < 1.001 * p.mesh.twist_length;
    double& worst = twisted ? twist : single;
    const double wanted = twisted ? truss.twist_force : truss.single_force, f = solids.bonds().axial_force[b];
    if (worst == 0 || std::abs(f - wanted) > std::abs(worst - wanted)) worst = f;
  }
  rows_out.push_back(relative_row(name + ": twist farthest from its force, N", twist, truss.twist_force, 1e-6));
  rows_out.push_back(relative_row(name + ": single wire farthest from its force, N", single, truss.single_force, 1e-6));
  double pull = 0;
  for (const dem::ParticleIndex i : p.part.upper)
    if (i != p.part.upper.front() && i != p.part.upper.back()) pull -= solids.particles().force.z[i];
  rows_out.push_back(relative_row(name + ": pull on the upper edge, N", pull,
                                  static_cast<double>(p.part.upper.size() - 2) * truss.twist_force, 1e-6));
  rows_out.push_back(watch.row(name));
}

/// A twist on two single wires, one of them weaker, under a slowly growing load until that one breaks.
void ask_broken(std::vector<Row>& rows) {
  barrier::HexagonalMesh mesh = mesh_80();
  mesh.plastic_unloading = true;
  Panel p = panel_of(mesh, 1, 2);
  for (const auto* edge : {&p.part.left, &p.part.right})
    for (const dem::ParticleIndex i : *edge) hold(p.particles, i);
  barrier::WireLaw weak = mesh.single;
  weak.strain[2] = 0.2, weak.force[2] = force_of(mesh.single, 0.2);
  const std::size_t weakest = p.bonds.size() - 1;
  p.bonds.sort[weakest] = p.bonds.add_sort(wire_law_bond(weak, mesh.single_length(), mesh));
  const dem::ParticleIndex end = p.part.upper.front();
  dem::Solids solids = solids_of(p);
  LedgerWatch watch(solids);
  double largest = 0, plastic = 0;
  const double faster = 3 * weak.force[2] / 0.3;  // N/s: breaks after 0.2 s
  while (solids.bonds().intact[weakest] && solids.time() < 0.4) {
    set_drag(solids.particles(), 1000);
    solids.particles().external_force.add(end, Vec3(0, 0, faster * solids.time()));
    solids.advance(5);
    watch.look();
    largest = std::max(largest, solids.bonds().axial_force[weakest]);
    if (solids.bonds().intact[weakest]) plastic = solids.bonds().plastic_elongation[weakest];
  }
  const auto intact = std::ranges::count(solids.bonds().intact, std::uint8_t{1});
  const double length = mesh.single_length(), first = weak.force[0] / weak.strain[0] / length;  // N/m
  rows.push_back(at_most_row("wires broken but the weakest",
                             static_cast<double>(solids.bonds().size() - 1) - static_cast<double>(intact), 0));
  rows.push_back(relative_row("the weakest wire breaks at, N", largest, weak.force[2], 0.01));
  rows.push_back(relative_row("energy booked as breakage, J", solids.ledger().bonds.breakage,
                              0.5 * weak.force[2] * weak.force[2] / first, 0.01));
  rows.push_back(
      relative_row("its plastic elongation, m", plastic, weak.strain[2] * length - weak.force[2] / first, 0.01));
  for (int k = 0; k < 200; ++k) {
    solids.advance(5);
    watch.look();
  }
  rows.push_back(watch.row("through the break"));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const int n = context.quick ? 4 : 12;
  ask_stretched(0.0015, 0.0015, n, n - 1, rows);  // all on the first piece of their laws
  if (!context.quick) ask_stretched(0.02, 0.03, n, n - 1, rows);
  ask_stretched(0.05, 0.1, n, n - 1, rows);  // beyond the second point
  ask_broken(rows);
  return rows;
}

}  // namespace

Entry hexagonal_mesh() {
  return {"barrier.hexagonal_mesh", {"truss of a stretched hexagonal mesh by hand; the wire's own law"}, run};
}

}  // namespace lahar::validate

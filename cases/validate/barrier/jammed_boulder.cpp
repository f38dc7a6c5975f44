// Case H15 of reference/hard_cases.csv: an 80 mm boulder jammed in a ring, a 40 mm boulder driven between two rings; no
// damping anywhere, so that nothing hides what the time step does to the energy.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "barrier/dissipator.h"
#include "barrier/ring.h"
#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

constexpr double kRing = 0.07, kWire = 0.0061;  // m: centre-line and wire of the paper's net
constexpr int kBeads = 36;
constexpr double kLargestStep = 0.3 * 3.4e-6;  // s, the bar of H15

struct Scene {
  dem::Particles particles;
  dem::Bonds bonds;

  Scene() { bonds.add_sort(barrier::wire_bond(3e11, 0.5 * kWire)); }

  /// A flat ring in the plane z = 0, held by its four beads at 0, 90, 180 and 270 degrees, as its neighbours would.
  void add_ring(const Vec3& centre, std::int32_t body) {
    const barrier::Wire ring =
        barrier::add_ring({kRing, kBeads, 0, 0}, {.centre = centre}, {kWire, 7800, 0}, 0, body, particles, bonds);
    for (dem::ParticleIndex k = 0; k < 4; ++k) {
      const dem::ParticleIndex i = ring.first_bead + k * (kBeads / 4);
      particles.state[i] = dem::ParticleState::fixed;
      particles.inverse_mass[i] = 0;
    }
  }
  void add_boulder(const Vec3& position, double diameter, const Vec3& velocity) {
    dem::ParticleSpec s;
    s.position = position;
    s.velocity = velocity;
    s.radius = 0.5 * diameter;
    s.density = 2650;
    s.material = 1;
    particles.add(s);
  }
};

/// Elastic contacts of steel (the paper's 10 GPa for the barrier) and rock (70 GPa), with friction.
dem::Materials elastic_materials() {
  dem::Materials m;
  m.add({"steel", 10e9, 0.3});
  m.add({"rock", 70e9, 0.3});
  for (const auto& [a, b] : {std::pair{0, 0}, {0, 1}, {1, 1}}) m.set_pair(a, b, 0.1, 1);
  return m;
}

/// Presses the boulder in with a constant force of `thrust` N, as a flow would, and lets it work in the ring.
void ask(std::vector<Row>& rows, const std::string& name, Scene scene, double thrust, int steps) {
  const double step = std::min(kLargestStep, 0.3 * dem::bond_time_step(scene.bonds, scene.particles));
  dem::Solids solids(std::move(scene.particles), std::move(scene.bonds), elastic_materials(), {},
                     solids_options(step, Vec3(0, 0, -kGravity)));
  const std::size_t boulder = solids.particles().size() - 1;
  solids.particles().external_force.set(boulder, Vec3(0, 0, -thrust));
  LedgerWatch watch(solids);
  double lowest = 1, deepest = 0;
  for (int done = 0; done < steps; done += 20) {
    solids.advance(20);
    watch.look();
    lowest = std::min(lowest, solids.particles().position.z[boulder]);
    deepest = std::max(deepest, solids.worst_overlap().ratio);
  }
  rows.push_back(watch.row(name));
  rows.push_back(at_least_row(name + ": lowest place of the boulder, m (it does not pass)", lowest, -0.5 * kRing));
  rows.push_back(at_most_row(name + ": deepest overlap / radius", deepest, 0.2));  // twice what is found
}

std::vector<Row> run(const Context& context) {
  const int steps = context.quick ? 10000 : 100000;
  std::vector<Row> rows;
  Scene jammed;
  jammed.add_ring(Vec3::Zero(), 0);
  jammed.add_boulder(Vec3(0, 0, 0.03), 0.08, Vec3(0, 0, -2));
  ask(rows, "80 mm in a ring", jammed, 200, steps);
  Scene squeezed;  // the gap between the wires is 25 mm wide
  const double apart = 0.5 * (kRing + kWire + 0.025);
  squeezed.add_ring(Vec3(-apart, 0, 0), 0);
  squeezed.add_ring(Vec3(apart, 0, 0), 1);
  squeezed.add_boulder(Vec3(0, 0, 0.025), 0.04, Vec3(0, 0, -2));
  ask(rows, "40 mm between two rings", squeezed, 50, steps);
  return rows;
}

}  // namespace

Entry jammed_boulder() {
  return {"barrier.jammed_boulder",
          {"case H15 of the hard cases: jammed boulders without damping", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate

// A program outside Lahar that uses all of its libraries: a ring that falls towards water, one coupled step.
#include <barrier/ring.h>
#include <core/geometry.h>
#include <coupling/coupled_step.h>
#include <dem/solids.h>
#include <dem/time_step.h>
#include <lbm/step/fluid.h>

#include <cstdio>
#include <optional>
#include <utility>

namespace {

lahar::dem::Solids falling_ring() {
  using namespace lahar;
  dem::Materials materials;
  const int steel = materials.add({"steel", 10e9, 0.3});
  dem::Particles particles;
  dem::Bonds bonds;
  dem::BondSort wire;
  wire.axial.stiffness = {3e11, 3e11, 3e11};
  wire.shear_stiffness = 3e11;
  wire.bond_radius = 0.003;
  const int sort = bonds.add_sort(wire);
  barrier::RingShape shape;
  shape.diameter = 0.07;
  shape.beads = 36;
  barrier::RingPose pose;
  pose.centre = {0.04, 0.04, 0.06};
  barrier::add_ring(shape, pose, {0.0061, 7800, steel}, sort, 0, particles, bonds);
  dem::SolidsOptions options;
  options.time_step = 0.2 * dem::bond_time_step(bonds, particles);
  return {std::move(particles), std::move(bonds), std::move(materials), Walls(), options};
}

lahar::lbm::FluidOptions water() {
  lahar::lbm::FluidOptions options;
  options.domain.upper = {0.08, 0.08, 0.08};
  options.domain.cell_size = 0.01;
  options.time_step = 1e-4;
  options.gravity = {0, 0, -9.81};
  return options;
}

}  // namespace

int main() {
  lahar::coupling::CouplingOptions options;
  options.substeps = 200;
  lahar::coupling::CoupledStep<float> coupled(water(), falling_ring(), options);
  coupled.fluid()->fill({{{0, 0, 0}, {0.08, 0.08, 0.04}}});
  coupled.advance();

  const lahar::SolidSphere sphere{{0, 0, 0}, 1};
  const double fall = coupled.solids()->particles().velocity.z[0] / coupled.time_step();
  std::printf("wet cells %zu, acceleration of the ring %.3f m/s^2\n", coupled.fluid()->wet_cells(), fall);
  const bool good = coupled.fluid()->wet_cells() > 0 && fall < -9 && fall > -10 && sphere.distance({0, 0, 2}) == 1;
  return good ? 0 : 1;
}

#include "coupling/wires/wire_drag.h"

#include <algorithm>
#include <numbers>

#include "core/parallel.h"
#include "coupling/wires/drag_law.h"
#include "coupling/wires/wire_bonds.h"
#include "coupling/wires/wire_crowding.h"
#include "coupling/wires/wire_kernel.h"

namespace lahar::coupling {

using lbm::Block;
using lbm::BlockIndex;
using lbm::kNoBlock;

namespace {

constexpr std::int64_t kCrowdingEvery = 16;  // fluid steps between looks at the neighbours

int cell_in_block(const Vec3i& cell) { return lbm::cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7); }

/// Share of a wet cell that is liquid.
template <class Real>
double liquid_share(const Block<Real>& block, int cell) {
  const double fill = block.surface ? static_cast<double>(block.surface->fill_level[cell]) : 1.0;
  const double eps = block.body ? static_cast<double>(block.body->solid_fraction[cell]) : 0.0;
  return std::max(0.0, fill - std::min(1.0, eps));
}

/// Drag on a piece of wire, SI: normal and tangential parts by their own laws.
Vec3 wire_force(const Vec3& relative, const Vec3& tangent, double length, double density, const WireInCells& wire) {
  const Vec3 along = relative.dot(tangent) * tangent, across = relative - along;
  const double sampled = across.norm(), d = wire.diameter;
  const double speed = undisturbed_speed(sampled, wire);
  const double re = speed * d / wire.kinematic_viscosity;
  const Vec3 normal_velocity = sampled > 0 ? Vec3(across * (speed / sampled)) : Vec3(Vec3::Zero());
  return 0.5 * density * d * length *
         (normal_drag_coefficient(re) * screen_factor(wire.screen) * speed * normal_velocity +
          tangential_drag_coefficient(re) * along.norm() * along);
}

}  // namespace

template <class Real>
WireDrag<Real>::WireDrag(const dem::Particles& particles, const dem::Bonds& bonds) {
  place_.assign(particles.size(), -1);
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    if (particles.kind[particles.index(id)] != dem::ParticleKind::bead) continue;
    place_[id] = static_cast<std::int32_t>(beads_.size());
    beads_.push_back({.id = id, .before = id, .after = id, .length = 0.0});
  }
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    if (!is_wire(particles, bonds, k)) continue;
    wire_bonds_.push_back(static_cast<std::uint32_t>(k));
    beads_[static_cast<std::size_t>(place_[bonds.id_i[k]])].after = bonds.id_j[k];
    beads_[static_cast<std::size_t>(place_[bonds.id_j[k]])].before = bonds.id_i[k];
  }
  leave_out(bonds, {});
  samples_.resize(beads_.size());
}

template <class Real>
void WireDrag<Real>::leave_out(const dem::Bonds& bonds, const std::vector<std::uint8_t>& is_mapped) {
  for (Bead& bead : beads_) bead.length = 0;
  for (const std::uint32_t k : wire_bonds_) {
    if (!is_mapped.empty() && is_mapped[k]) continue;
    for (const dem::ParticleId id : {bonds.id_i[k], bonds.id_j[k]})
      beads_[static_cast<std::size_t>(place_[id])].length += bonds.rest_length[k] / 2;
  }
  applied_ = 0;  // other neighbours
}

template <class Real>
std::size_t WireDrag<Real>::beads() const {
  return static_cast<std::size_t>(
      std::count_if(beads_.begin(), beads_.end(), [](const Bead& bead) { return bead.length > 0; }));
}

template <class Real>
ExchangedMomentum WireDrag<Real>::apply(lbm::Fluid<Real>& fluid, dem::Particles& particles, SolidFields<Real>& fields) {
  if (applied_++ % kCrowdingEvery == 0) look_at_neighbours(fluid, particles);
  allocate_fields(fluid, particles, fields);
  parallel_for(0, beads_.size(), 128,
               [&](std::size_t k) { samples_[k] = beads_[k].near ? sample(fluid, particles, beads_[k]) : Sample{}; });
  auto& grid = fluid.grid();
  ExchangedMomentum total;
  wet_beads_ = 0;
  for (std::size_t k = 0; k < beads_.size(); ++k) {
    const Sample& s = samples_[k];
    if (s.weight <= 0) continue;
    const dem::ParticleIndex i = particles.index(beads_[k].id);
    ++wet_beads_;
    total.to_solids += s.force;
    particles.external_force.add(i, s.force * fluid.units().force_to_si(1.0));
    kernel_at(fluid, particles, i).for_cells([&](const Vec3i& cell, double w) {
      const BlockIndex b = block_at(beads_[k], cell);
      const int n = cell_in_block(cell);
      if (b == kNoBlock || !lbm::is_wet(grid.block(b).type[static_cast<std::size_t>(n)])) return;
      const Vec3 part = -s.force * (w * liquid_share(grid.block(b), n) / s.weight);
      lbm::ImpulseFields<Real>& impulse = *grid.block(b).impulse;
      impulse.x[n] += static_cast<Real>(part.x());
      impulse.y[n] += static_cast<Real>(part.y());
      impulse.z[n] += static_cast<Real>(part.z());
      total.from_fluid -= part;
    });
  }
  return total;
}

template <class Real>
WireKernel WireDrag<Real>::kernel_at(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                     dem::ParticleIndex i) {
  const double dx = fluid.units().cell_size;
  return {(particles.position[i] - fluid.grid().domain().origin()) / dx, kernel_scale(2 * particles.radius[i] / dx)};
}

template <class Real>
void WireDrag<Real>::look_at_neighbours(const lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  std::vector<WireSegment> pieces(beads_.size());
  for (std::size_t k = 0; k < beads_.size(); ++k) {
    const Bead& bead = beads_[k];
    const dem::ParticleIndex i = particles.index(bead.id);
    pieces[k] = {particles.position[i], tangent_of(particles, bead), 2 * particles.radius[i], bead.length};
  }
  const Vec3 period =
      lbm::kBlockWidth * fluid.units().cell_size * fluid.grid().domain().period().template cast<double>();
  const std::vector<Crowding> crowding = wire_crowding(pieces, period);
  for (std::size_t k = 0; k < beads_.size(); ++k) beads_[k].crowding = crowding[k];
}

/// Along the wire: from the bead before to the one after.
template <class Real>
Vec3 WireDrag<Real>::tangent_of(const dem::Particles& particles, const Bead& bead) {
  const Vec3 chord = particles.position[particles.index(bead.after)] - particles.position[particles.index(bead.before)];
  return chord.squaredNorm() > 0 ? Vec3(chord.normalized()) : Vec3(Vec3::UnitX());
}

template <class Real>
BlockIndex WireDrag<Real>::block_at(const Bead& bead, const Vec3i& cell) {
  const Vec3i d = lbm::block_of(cell) - bead.lowest;
  return bead.blocks[static_cast<std::size_t>(9 * d.x() + 3 * d.y() + d.z())];
}

/// Blocks in reach of a bead are looked up once, and get fields, so that impulses can be written and velocities sampled
/// there.
template <class Real>
void WireDrag<Real>::allocate_fields(lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                     SolidFields<Real>& fields) {
  auto& grid = fluid.grid();
  parallel_for(0, beads_.size(), 128, [&](std::size_t k) { look_up_blocks(fluid, particles, beads_[k]); });
  for (const Bead& bead : beads_) {
    if (!bead.near) continue;
    for (const BlockIndex b : bead.blocks) {
      if (b == kNoBlock) continue;
      fields.reach(grid, b);
      grid.require_impulse(b);
    }
  }
}

template <class Real>
void WireDrag<Real>::look_up_blocks(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, Bead& bead) {
  const auto& grid = fluid.grid();
  bead.near = false;
  if (bead.length <= 0) return;
  const WireKernel kernel = kernel_at(fluid, particles, particles.index(bead.id));
  bead.lowest = lbm::block_of(kernel.lowest());
  const Vec3i more = lbm::block_of(kernel.highest()) - bead.lowest;
  bead.blocks.fill(kNoBlock);
  for (int x = 0; x <= more.x(); ++x)
    for (int y = 0; y <= more.y(); ++y)
      for (int z = 0; z <= more.z(); ++z) {
        const BlockIndex b = grid.topology().find(bead.lowest + Vec3i(x, y, z));
        if (b == kNoBlock || grid.block(b).wet_cells == 0) continue;
        bead.blocks[static_cast<std::size_t>(9 * x + 3 * y + z)] = b;
        bead.near = true;
      }
}

template <class Real>
typename WireDrag<Real>::Sample WireDrag<Real>::sample(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                                       const Bead& bead) const {
  const auto& grid = fluid.grid();
  const auto& units = fluid.units();
  const dem::ParticleIndex i = particles.index(bead.id);
  Sample s;
  Vec3 velocity = Vec3::Zero();
  kernel_at(fluid, particles, i).for_cells([&](const Vec3i& cell, double w) {
    const BlockIndex b = block_at(bead, cell);
    if (b == kNoBlock) return;
    const int n = cell_in_block(cell);
    const Block<Real>& block = grid.block(b);
    if (!lbm::is_wet(block.type[static_cast<std::size_t>(n)])) return;
    const double share = w * liquid_share(block, n);
    s.weight += share;
    velocity +=
        share * Vec3(static_cast<double>(block.body->velocity_x[n]), static_cast<double>(block.body->velocity_y[n]),
                     static_cast<double>(block.body->velocity_z[n]));
  });
  if (s.weight < 1e-6) return {};
  const Vec3 relative = units.velocity_to_si(1.0) * (velocity / s.weight) - particles.velocity[i];
  const double d = 2 * particles.radius[i], rho = fluid.options().density;
  const WireInCells wire{.diameter = d,
                         .diameter_cells = d / units.cell_size,
                         .kinematic_viscosity = fluid.options().kinematic_viscosity,
                         .screen = bead.crowding};
  const Vec3 drag = wire_force(relative, tangent_of(particles, bead), bead.length, rho, wire);
  const Vec3 buoyancy = -rho * std::numbers::pi / 4 * d * d * bead.length * fluid.options().gravity;
  s.force = std::min(1.0, s.weight) * (drag + buoyancy) * units.force_to_lu(1.0);
  return s;
}

/// The neighbours of the beads are looked at once in many steps.
template <class Real>
void WireDrag<Real>::transfer(Archive& archive) {
  archive.value("wet_beads", wet_beads_);
  archive.value("applied", applied_);
  archive.pieces<double>("crowding", beads_.size(), 3, [&](std::size_t k, double* stored) {
    Crowding& c = beads_[k].crowding;
    double* const own[] = {&c.area, &c.parallel, &c.solidity};
    for (std::size_t a = 0; a < 3; ++a) {
      if (archive.loading())
        *own[a] = stored[a];
      else
        stored[a] = *own[a];
    }
  });
}

template class WireDrag<float>;
template class WireDrag<double>;

}  // namespace lahar::coupling

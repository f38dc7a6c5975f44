#include "coupling/wires/wire_map.h"

#include <cstring>

#include "core/check.h"
#include "core/parallel.h"
#include "coupling/transfer_vectors.h"

namespace lahar::coupling {

using lbm::BlockIndex;
using lbm::kNoBlock;

namespace {

template <class Real>
void assign(Real (&to)[3], const Vec3& from) {
  for (int a = 0; a < 3; ++a) to[a] = static_cast<Real>(from[a]);
}

template <class Real>
GridMotion<Real> motion_of(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, dem::ParticleIndex i) {
  GridMotion<Real> m;
  assign(m.velocity, particles.velocity[i] * fluid.units().velocity_to_lu(1.0));
  assign(m.spin, particles.angular_velocity[i] * fluid.units().time_step);
  return m;
}

}  // namespace

template <class Real>
void WireMap<Real>::update(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds,
                           SolidFields<Real>& fields) {
  map(fluid, particles, bonds, fields);
  book_displacement(fluid);
}

template <class Real>
void WireMap<Real>::embed(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds,
                          SolidFields<Real>& fields) {
  require(states_.empty(), "WireMap::embed: wires are mapped already");
  map(fluid, particles, bonds, fields);
  for (std::size_t b = 0; b < wires_.beads().size(); ++b) {
    double& wet = states_[wires_.beads()[b]].wet;
    for_pairs_of(b, [&](std::size_t p, std::size_t end) { wet += shares_[p][end].wet; });
  }
}

template <class Real>
void WireMap<Real>::map(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds,
                        SolidFields<Real>& fields) {
  remember(fluid, particles);
  place_pieces(fluid, particles, bonds);
  collect_pairs(fluid);
  by_block_.sort(pairs_, fluid.grid().topology().capacity());
  choose_blocks(fluid.grid(), fields);
  by_block_.for_each_block([&](std::size_t b) { write_block(fluid, b); });
}

/// The mean acceleration of the beads over the last step.
template <class Real>
void WireMap<Real>::remember(const lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  states_.resize(particles.size());
  time_step_ = fluid.units().time_step;
  parallel_for(0, wires_.beads().size(), 256, [&](std::size_t b) {
    const dem::ParticleId id = wires_.beads()[b];
    const dem::ParticleIndex i = particles.index(id);
    State& s = states_[id];
    s.acceleration = s.known ? Vec3((particles.velocity[i] - s.velocity) / time_step_) : Vec3(Vec3::Zero());
    s.spin_up = s.known ? Vec3((particles.angular_velocity[i] - s.spin) / time_step_) : Vec3(Vec3::Zero());
    s.velocity = particles.velocity[i], s.spin = particles.angular_velocity[i];
    s.known = true;
  });
}

template <class Real>
void WireMap<Real>::place_pieces(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                 const dem::Bonds& bonds) {
  const double dx = fluid.units().cell_size;
  const lbm::Domain& domain = fluid.grid().domain();
  wires_.find_ends(particles, bonds, lbm::kBlockWidth * dx * domain.period().template cast<double>(), ends_);
  former_pieces_.swap(pieces_);
  pieces_.resize(wires_.bonds().size()), same_.resize(pieces_.size());
  const bool comparable = former_pieces_.size() == pieces_.size();
  parallel_for(0, pieces_.size(), 64, [&](std::size_t k) {
    const std::uint32_t bond = wires_.bonds()[k];
    const dem::ParticleIndex beads[2] = {bonds.i[bond], bonds.j[bond]};
    GridCylinder<Real>& piece = pieces_[k];
    std::memset(static_cast<void*>(&piece), 0, sizeof piece);  // so that it can be compared by bits
    Vec3 place[2];
    for (int e = 0; e < 2; ++e) {
      place[e] = (particles.position[beads[e]] - domain.origin()) / dx;
      const WireEnd& end = ends_[2 * k + static_cast<std::size_t>(e)];
      assign(piece.cuts[e].place, place[e]);
      assign(piece.cuts[e].normal, end.normal);
      piece.cuts[e].side = end.side;
      piece.motion[e] = motion_of(fluid, particles, beads[e]);
    }
    const Vec3 arm = place[1] - place[0];
    const double radius = wire_diameter(particles, bonds, bond) / (2 * dx);
    assign(piece.start, place[0]), assign(piece.end, place[1]);
    assign(piece.along, arm.normalized());
    piece.length = static_cast<Real>(arm.norm());
    piece.radius = static_cast<Real>(cylinder_mapping_radius(radius));
    piece.surface = lbm::by_wall_distance(fluid.options().weighting)
                        ? static_cast<Real>(std::max(0.0, radius + radius_shift_))
                        : Real(-2);
    same_[k] = comparable && std::memcmp(&piece, &former_pieces_[k], sizeof piece) == 0;
  });
}

template <class Real>
void WireMap<Real>::collect_pairs(const lbm::Fluid<Real>& fluid) {
  pairs_.clear();
  first_pair_.resize(pieces_.size() + 1);
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    first_pair_[k] = pairs_.size();
    if (!(pieces_[k].length > 0)) continue;
    const CylinderBox<Real> box = box_of(pieces_[k], reach_of(pieces_[k]));
    Vec3i low, high;
    for (int a = 0; a < 3; ++a) {
      low[a] = static_cast<int>(std::floor(box.low[a])) >> 3;
      high[a] = static_cast<int>(std::floor(box.high[a])) >> 3;
    }
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) {
          const BlockIndex b = fluid.grid().topology().find(Vec3i(x, y, z));
          if (b == kNoBlock) continue;
          pairs_.push_back(
              {b, static_cast<std::uint32_t>(k), fluid.grid().block(b).birth, lbm::kBlockWidth * Vec3i(x, y, z)});
        }
  }
  first_pair_[pieces_.size()] = pairs_.size();
  shares_.assign(pairs_.size(), {});
}

template <class Real>
Vec3 WireMap<Real>::lent() const {
  Vec3 sum = Vec3::Zero();
  for (const State& s : states_) sum += s.lent_impulse;
  return sum;
}

template <class Real>
double WireMap<Real>::wet_volume() const {
  double sum = 0;
  for (const auto& share : shares_) sum += share[0].wet + share[1].wet;
  return sum;
}

template <class Real>
bool WireMap<Real>::is_unchanged(std::size_t block) const {
  if (!by_block_.as_many_as_before(block)) return false;
  const auto pairs = by_block_.in(block);
  return std::all_of(pairs.begin(), pairs.end(), [&](std::uint32_t p) { return same_[pairs_[p].piece] != 0; });
}

/// Together with grains all of a block is written again in the next step.
template <class Real>
void WireMap<Real>::choose_blocks(lbm::FluidGrid<Real>& grid, SolidFields<Real>& fields) {
  using Writer = typename SolidFields<Real>::Writer;
  tasks_.assign(by_block_.blocks(), Task::none);
  for (const BlockIndex b : grid.owned()) {
    const auto at = static_cast<std::size_t>(b);
    if (by_block_.any_in(at)) {
      fields.reach(grid, b);
      const Writer writer = fields.writer(b);
      const bool with_grains = writer == Writer::grains;
      tasks_[at] = with_grains ? Task::add : writer == Writer::wires && is_unchanged(at) ? Task::keep : Task::write;
      fields.set_writer(b, with_grains ? Writer::several : Writer::wires);
    } else if (fields.writer(b) == Writer::wires) {
      clear_solids(*grid.block(b).body);
      fields.set_writer(b, Writer::none);
    }
  }
}

/// Where the pieces are follows from the beads; what was displaced and felt does not.
template <class Real>
void WireMap<Real>::transfer(Archive& archive) {
  archive.part("wires", wires_);
  std::size_t particles = states_.size();
  archive.value("particles", particles);
  states_.resize(particles);
  archive.pieces<double>("bead", particles, 20, [&](std::size_t k, double* stored) {
    State& s = states_[k];
    transfer_vectors(archive, {&s.velocity, &s.spin, &s.felt_force, &s.felt_torque, &s.lent_impulse, &s.lent_spin},
                     stored);
    if (archive.loading())
      s.wet = stored[18], s.known = stored[19] != 0;
    else
      stored[18] = s.wet, stored[19] = s.known ? 1 : 0;
  });
}

template class WireMap<float>;
template class WireMap<double>;

}  // namespace lahar::coupling

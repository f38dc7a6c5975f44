#include "coupling/grains/body_map.h"

#include <cstring>
#include <numbers>

#include "core/check.h"
#include "core/parallel.h"
#include "coupling/grains/body_map_parts.h"
#include "coupling/grains/sphere_fraction.h"

namespace lahar::coupling {

using lbm::BlockIndex;
using lbm::kNoBlock;

namespace {

constexpr std::uint32_t kNoBody = ~std::uint32_t{0};
constexpr std::size_t kBodiesPerTask = 64;

template <class T, std::size_t n>
bool same_bits(const T (&a)[n], const T (&b)[n]) {
  return std::memcmp(a, b, sizeof a) == 0;
}

}  // namespace

template <class Real>
void BodyMap<Real>::update(lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  measure_old(fluid);
  map(fluid, particles);
  book_displacement(fluid);
}

template <class Real>
void BodyMap<Real>::embed(lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  require(bodies_.empty(), "BodyMap::embed: bodies are mapped already");
  map(fluid, particles);
}

template <class Real>
void BodyMap<Real>::map(lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  collect(fluid, particles);
  sort_by_block(fluid);
  normalize();
  write_fields(fluid);
  forgotten_ = false;
}

template <class Real>
void BodyMap<Real>::collect(lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  old_wet_.resize(particles.size(), 0.0);
  last_velocity_.resize(particles.size(), Vec3::Zero());
  last_spin_.resize(particles.size(), Vec3::Zero());
  felt_force_.resize(particles.size(), Vec3::Zero());
  felt_torque_.resize(particles.size(), Vec3::Zero());
  known_.resize(particles.size(), 0);
  radii_.resize(particles.size());
  former_.swap(bodies_), former_spheres_.swap(spheres_), former_pairs_.swap(pairs_);
  former_body_.assign(particles.size(), kNoBody);
  for (std::size_t k = 0; k < former_.size(); ++k) former_body_[former_[k].particle] = static_cast<std::uint32_t>(k);
  bodies_.clear();
  for (dem::ParticleIndex i = 0; i < particles.size(); ++i)
    if (particles.kind[i] == dem::ParticleKind::grain && particles.state[i] != dem::ParticleState::removed)
      bodies_.push_back({.particle = i});
  spheres_.resize(bodies_.size()), reaches_.resize(bodies_.size());
  parallel_for(0, bodies_.size(), kBodiesPerTask, [&](std::size_t k) { place_body(fluid, particles, k); });
  std::size_t pairs = 0;
  for (Body& b : bodies_) b.first_pair = pairs, pairs += b.pairs;
  pairs_.resize(pairs);
  parallel_for(0, bodies_.size(), kBodiesPerTask, [&](std::size_t k) { write_pairs(fluid, k); });
  // A grain that was removed while in the liquid leaves a void: its volume is drawn from the pool.
  for (const Body& b : former_)
    if (old_wet_[b.particle] != 0) {
      fluid.account().pool -= old_wet_[b.particle];
      old_wet_[b.particle] = 0;
    }
}

/// The sphere as the grid sees it, its blocks, and whether they are the former ones.
template <class Real>
void BodyMap<Real>::place_body(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, std::size_t k) {
  const auto& units = fluid.units();
  Body& b = bodies_[k];
  GridSphere<Real>& s = spheres_[k];
  const dem::ParticleIndex i = b.particle;
  const Vec3 place = (particles.position[i] - fluid.grid().domain().origin()) / units.cell_size;
  const double r = particles.radius[i] / units.cell_size;
  const Vec3 v = particles.velocity[i] * units.velocity_to_lu(1.0), w = particles.angular_velocity[i] * units.time_step;
  for (int a = 0; a < 3; ++a) {
    s.centre[a] = static_cast<Real>(place[a]);
    s.velocity[a] = static_cast<Real>(v[a]);
    s.spin[a] = static_cast<Real>(w[a]);
  }
  if (radii_[i].cells != r) radii_[i] = {r, mapping_radius(r)};
  s.radius = static_cast<Real>(radii_[i].mapped);
  s.surface = fluid.options().weighting == lbm::BodyWeighting::wall_distance
                  ? static_cast<Real>(std::max(0.0, r + radius_shift_))
                  : Real(-2);
  s.factor = 1;
  b.volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  if (known_[i]) {
    b.acceleration = (particles.velocity[i] - last_velocity_[i]) / units.time_step;
    b.spin_up = (particles.angular_velocity[i] - last_spin_[i]) / units.time_step;
  }
  b.old_wet_volume = old_wet_[i];
  old_wet_[i] = 0;
  last_velocity_[i] = particles.velocity[i];
  last_spin_[i] = particles.angular_velocity[i];
  known_[i] = 1;
  const std::uint32_t former = former_body_[i];
  const bool seen = former != kNoBody && former_[former].pairs > 0;
  look_up_blocks(fluid, k, seen ? former_pairs_.data() + former_[former].first_pair : nullptr);
  b.change = former == kNoBody || forgotten_ ? Change::place : compare(fluid, k, former);
  if (b.change != Change::place) s.factor = former_spheres_[former].factor;
}

/// `hint`: the first pair of the former mapping, whose block mostly is the first one still.
template <class Real>
void BodyMap<Real>::look_up_blocks(const lbm::Fluid<Real>& fluid, std::size_t k, const Pair* hint) {
  const GridSphere<Real>& s = spheres_[k];
  const auto block_at = [&](int a, Real offset) { return static_cast<int>(std::floor(s.centre[a] + offset)) >> 3; };
  const Real far = reach_of(s), inner = covered_reach(s);
  Reach& reach = reaches_[k];
  Vec3i inner_low, inner_high;
  for (int a = 0; a < 3; ++a) {
    reach.low[a] = block_at(a, -far), reach.high[a] = block_at(a, far);
    inner_low[a] = block_at(a, -inner), inner_high[a] = block_at(a, inner);
  }
  const auto& topology = fluid.grid().topology();
  const Vec3i more = reach.high - reach.low;
  if (more.maxCoeff() <= 1) {
    const bool known = hint && hint->lowest == reach.low * lbm::kBlockWidth && is_alive(fluid, *hint);
    const BlockIndex first = known ? hint->block : topology.find(reach.low);
    std::size_t n = 0;
    for (int x = 0; x <= more.x(); ++x)
      for (int y = 0; y <= more.y(); ++y)
        for (int z = 0; z <= more.z(); ++z)
          reach.blocks[n++] = first == kNoBlock
                                  ? topology.find(reach.low + Vec3i(x, y, z))
                                  : topology.neighbours(first)[static_cast<std::size_t>(lbm::neighbour_slot(x, y, z))];
  }
  Body& b = bodies_[k];
  for_blocks(fluid, reach, [&](const Vec3i& place, BlockIndex block) {
    if (block != kNoBlock)
      ++b.pairs;
    else if ((place.array() >= inner_low.array()).all() && (place.array() <= inner_high.array()).all())
      b.all_blocks = false;
  });
}

/// Calls visit(block coordinate, index or kNoBlock).
template <class Real>
template <class Visit>
void BodyMap<Real>::for_blocks(const lbm::Fluid<Real>& fluid, const Reach& reach, const Visit& visit) const {
  const bool looked_up = (reach.high - reach.low).maxCoeff() <= 1;
  std::size_t n = 0;
  for (int x = reach.low.x(); x <= reach.high.x(); ++x)
    for (int y = reach.low.y(); y <= reach.high.y(); ++y)
      for (int z = reach.low.z(); z <= reach.high.z(); ++z) {
        const Vec3i place(x, y, z);
        visit(place, looked_up ? reach.blocks[n++] : fluid.grid().topology().find(place));
      }
}

template <class Real>
typename BodyMap<Real>::Change BodyMap<Real>::compare(const lbm::Fluid<Real>& fluid, std::size_t k,
                                                      std::size_t former) const {
  const Body &now = bodies_[k], &then = former_[former];
  const GridSphere<Real>&s = spheres_[k], &t = former_spheres_[former];
  if (!same_bits(s.centre, t.centre) || s.radius != t.radius || s.surface != t.surface || now.pairs != then.pairs)
    return Change::place;
  const Pair* pair = former_pairs_.data() + then.first_pair;
  bool same = true;
  for_blocks(fluid, reaches_[k], [&](const Vec3i& place, BlockIndex block) {
    if (block == kNoBlock) return;
    same = same && pair->block == block && pair->lowest == place * lbm::kBlockWidth &&
           fluid.grid().block(block).birth == pair->birth;
    ++pair;
  });
  if (!same) return Change::place;
  return same_bits(s.velocity, t.velocity) && same_bits(s.spin, t.spin) ? Change::none : Change::motion;
}

template <class Real>
void BodyMap<Real>::write_pairs(const lbm::Fluid<Real>& fluid, std::size_t k) {
  const Body& b = bodies_[k];
  const auto body = static_cast<std::uint32_t>(k);
  Pair* pair = pairs_.data() + b.first_pair;
  if (b.change != Change::place) {
    const Pair* const former = former_pairs_.data() + former_[former_body_[b.particle]].first_pair;
    for (std::size_t p = 0; p < b.pairs; ++p) pair[p] = former[p], pair[p].body = body;
    return;
  }
  for_blocks(fluid, reaches_[k], [&](const Vec3i& place, BlockIndex block) {
    if (block != kNoBlock) *pair++ = {block, body, fluid.grid().block(block).birth, place * lbm::kBlockWidth};
  });
}

/// Counting sort; within a block the pairs stay in the order of the bodies.
template <class Real>
void BodyMap<Real>::sort_by_block(const lbm::Fluid<Real>& fluid) {
  former_start_.swap(block_start_);
  block_start_.assign(fluid.grid().topology().capacity() + 1, 0);
  for (const Pair& p : pairs_) ++block_start_[static_cast<std::size_t>(p.block) + 1];
  for (std::size_t b = 1; b < block_start_.size(); ++b) block_start_[b] += block_start_[b - 1];
  by_block_.resize(pairs_.size());
  next_.assign(block_start_.begin(), block_start_.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) by_block_[next_[static_cast<std::size_t>(pairs_[k].block)]++] = k;
}

template class BodyMap<float>;
template class BodyMap<double>;

}  // namespace lahar::coupling

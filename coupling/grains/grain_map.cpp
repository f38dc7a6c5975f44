#include "coupling/grains/grain_map.h"

#include <cstring>

#include "core/parallel.h"
#include "core/sphere.h"
#include "coupling/grains/sphere_fraction.h"

namespace lahar::coupling {

using lbm::BlockIndex;
using lbm::kNoBlock;

namespace {

constexpr std::uint32_t kNoGrain = ~std::uint32_t{0};
constexpr std::size_t kGrainsPerTask = 64;

template <class T, std::size_t n>
bool same_bits(const T (&a)[n], const T (&b)[n]) {
  return std::memcmp(a, b, sizeof a) == 0;
}

}  // namespace

template <class Real>
void GrainMap<Real>::update(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                            const ShapeSphere<Real>& shape) {
  collect(fluid, particles, shape);
  by_block_.sort(pairs_, fluid.grid().topology().capacity());
  normalize(fluid);
  forgotten_ = false;
}

template <class Real>
bool GrainMap<Real>::is_unchanged(std::size_t block) const {
  if (!by_block_.as_many_as_before(block)) return false;
  const auto pairs = by_block_.in(block);
  return std::all_of(pairs.begin(), pairs.end(),
                     [&](std::uint32_t p) { return grains_[pairs_[p].grain].change == GrainChange::none; });
}

template <class Real>
void GrainMap<Real>::collect(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                             const ShapeSphere<Real>& shape) {
  radii_.resize(particles.size());
  former_.swap(grains_), former_spheres_.swap(spheres_), former_pairs_.swap(pairs_);
  former_grain_.assign(particles.size(), kNoGrain);
  for (std::size_t k = 0; k < former_.size(); ++k) former_grain_[former_[k].id] = static_cast<std::uint32_t>(k);
  grains_.clear();
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    const dem::ParticleIndex i = particles.index(id);
    if (particles.kind[i] == dem::ParticleKind::grain && particles.state[i] != dem::ParticleState::removed)
      grains_.push_back({.id = id});
  }
  spheres_.resize(grains_.size()), reaches_.resize(grains_.size());
  parallel_for(0, grains_.size(), kGrainsPerTask, [&](std::size_t k) { place_grain(fluid, particles, shape, k); });
  std::size_t pairs = 0;
  for (MappedGrain& g : grains_) g.first_pair = pairs, pairs += g.pairs;
  pairs_.resize(pairs);
  parallel_for(0, grains_.size(), kGrainsPerTask, [&](std::size_t k) { write_pairs(fluid, k); });
}

/// The sphere as the grid sees it, its blocks, and whether they are the former ones.
template <class Real>
void GrainMap<Real>::place_grain(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                 const ShapeSphere<Real>& shape, std::size_t k) {
  const auto& units = fluid.units();
  MappedGrain& g = grains_[k];
  GridSphere<Real>& s = spheres_[k];
  const dem::ParticleIndex i = particles.index(g.id);
  const Vec3 place = (particles.position[i] - fluid.grid().domain().origin()) / units.cell_size;
  const double r = particles.radius[i] / units.cell_size;
  const Vec3 v = particles.velocity[i] * units.velocity_to_lu(1.0), w = particles.angular_velocity[i] * units.time_step;
  for (int a = 0; a < 3; ++a) {
    s.centre[a] = static_cast<Real>(place[a]);
    s.velocity[a] = static_cast<Real>(v[a]);
    s.spin[a] = static_cast<Real>(w[a]);
  }
  Radius& radius = radii_[g.id];
  if (radius.cells != r) radius = {r, mapping_radius(r)};
  s.radius = static_cast<Real>(radius.mapped);
  shape(r, s);
  s.factor = 1;
  g.volume = sphere_volume(r);
  const std::uint32_t former = former_grain_[g.id];
  const bool seen = former != kNoGrain && former_[former].pairs > 0;
  look_up_blocks(fluid, k, seen ? former_pairs_.data() + former_[former].first_pair : nullptr);
  g.change = former == kNoGrain || forgotten_ ? GrainChange::place : compare(fluid, k, former);
  if (g.change != GrainChange::place) s.factor = former_spheres_[former].factor;
}

/// `hint`: the first pair of the former mapping, whose block mostly is the first one still.
template <class Real>
void GrainMap<Real>::look_up_blocks(const lbm::Fluid<Real>& fluid, std::size_t k, const GrainInBlock* hint) {
  const GridSphere<Real>& s = spheres_[k];
  const auto block_at = [&](int a, Real offset) { return static_cast<int>(std::floor(s.centre[a] + offset)) >> 3; };
  const Real far = s.reach;
  Reach& reach = reaches_[k];
  for (int a = 0; a < 3; ++a) {
    reach.low[a] = block_at(a, -far), reach.high[a] = block_at(a, far);
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
  MappedGrain& g = grains_[k];
  for_blocks(fluid, reach, [&](const Vec3i& /*place*/, BlockIndex block) { g.pairs += block != kNoBlock ? 1 : 0; });
}

/// Calls visit(block coordinate, index or kNoBlock).
template <class Real>
template <class Visit>
void GrainMap<Real>::for_blocks(const lbm::Fluid<Real>& fluid, const Reach& reach, const Visit& visit) const {
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
GrainChange GrainMap<Real>::compare(const lbm::Fluid<Real>& fluid, std::size_t k, std::size_t former) const {
  const MappedGrain &now = grains_[k], &then = former_[former];
  const GridSphere<Real>&s = spheres_[k], &t = former_spheres_[former];
  if (!same_bits(s.centre, t.centre) || s.radius != t.radius || s.surface != t.surface || s.reach != t.reach ||
      now.pairs != then.pairs)
    return GrainChange::place;
  const GrainInBlock* pair = former_pairs_.data() + then.first_pair;
  bool same = true;
  for_blocks(fluid, reaches_[k], [&](const Vec3i& place, BlockIndex block) {
    if (block == kNoBlock) return;
    same = same && pair->block == block && pair->lowest == place * lbm::kBlockWidth &&
           fluid.grid().block(block).birth == pair->birth;
    ++pair;
  });
  if (!same) return GrainChange::place;
  return same_bits(s.velocity, t.velocity) && same_bits(s.spin, t.spin) ? GrainChange::none : GrainChange::motion;
}

template <class Real>
void GrainMap<Real>::write_pairs(const lbm::Fluid<Real>& fluid, std::size_t k) {
  const MappedGrain& g = grains_[k];
  const auto grain = static_cast<std::uint32_t>(k);
  GrainInBlock* pair = pairs_.data() + g.first_pair;
  if (g.change != GrainChange::place) {
    const GrainInBlock* const former = former_pairs_.data() + former_[former_grain_[g.id]].first_pair;
    for (std::size_t p = 0; p < g.pairs; ++p) pair[p] = former[p], pair[p].grain = grain;
    return;
  }
  for_blocks(fluid, reaches_[k], [&](const Vec3i& place, BlockIndex block) {
    if (block != kNoBlock) *pair++ = {block, grain, fluid.grid().block(block).birth, place * lbm::kBlockWidth};
  });
}

/// Of the last mapping: which sphere reached which block with which volume. What the next mapping overwrites is left
/// out.
template <class Real>
void GrainMap<Real>::transfer(Archive& archive) {
  std::size_t grains = grains_.size(), pairs = pairs_.size();
  archive.value("grains", grains);
  archive.value("pairs", pairs);
  archive.value("forgotten", forgotten_);
  grains_.resize(grains), spheres_.resize(grains), pairs_.resize(pairs);
  const bool loading = archive.loading();
  const auto carry = [loading](auto& own, auto& stored) {
    if (loading)
      own = static_cast<std::remove_reference_t<decltype(own)>>(stored);
    else
      stored = static_cast<std::remove_reference_t<decltype(stored)>>(own);
  };
  archive.pieces<std::uint64_t>("grain", grains, 3, [&](std::size_t k, std::uint64_t* at) {
    carry(grains_[k].id, at[0]), carry(grains_[k].first_pair, at[1]), carry(grains_[k].pairs, at[2]);
    if (loading && (at[1] > pairs || at[2] > pairs - at[1])) archive.refuse("grain", "does not fit the pairs");
    if (loading && k > 0 && grains_[k].id <= grains_[k - 1].id) archive.refuse("grain", "is out of order");
  });
  archive.pieces<Real>("sphere", grains, 13, [&](std::size_t k, Real* at) {
    GridSphere<Real>& s = spheres_[k];
    for (int a = 0; a < 3; ++a) carry(s.centre[a], at[a]), carry(s.velocity[a], at[3 + a]), carry(s.spin[a], at[6 + a]);
    carry(s.radius, at[9]), carry(s.factor, at[10]), carry(s.surface, at[11]), carry(s.reach, at[12]);
  });
  archive.pieces<std::uint64_t>("pair", pairs, 3, [&](std::size_t k, std::uint64_t* at) {
    carry(pairs_[k].block, at[0]), carry(pairs_[k].grain, at[1]), carry(pairs_[k].birth, at[2]);
    if (loading && at[1] >= grains) archive.refuse("pair", "does not fit the grains");
  });
  archive.pieces<double>("pair_volume", pairs, 1, [&](std::size_t k, double* at) { carry(pairs_[k].volume, at[0]); });
  archive.pieces<std::int32_t>("pair_lowest", pairs, 3, [&](std::size_t k, std::int32_t* at) {
    for (int a = 0; a < 3; ++a) carry(pairs_[k].lowest[a], at[a]);
  });
  if (!loading) return;
  std::size_t blocks = 0;
  for (const GrainInBlock& pair : pairs_) blocks = std::max(blocks, static_cast<std::size_t>(pair.block) + 1);
  by_block_.sort(pairs_, blocks);
}

template class GrainMap<float>;
template class GrainMap<double>;

}  // namespace lahar::coupling

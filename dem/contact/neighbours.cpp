#include "dem/contact/neighbours.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 256;

template <class Iterator>
void sort_by_id(Iterator first, Iterator last, const Numbering& numbering) {
  if (numbering.by_id()) return std::sort(first, last);
  std::sort(first, last, [&](ParticleIndex a, ParticleIndex b) { return numbering.precedes(a, b); });
}

/// Mean distance of the particles from their mean along one axis, times four: the extent of a uniform crowd, and little
/// moved by a few that ran away.
double extent(const std::vector<double>& x, const std::vector<ParticleIndex>& particles) {
  const auto n = static_cast<double>(particles.size());
  double mean = 0, spread = 0;
  for (const ParticleIndex i : particles) mean += x[i] / n;
  for (const ParticleIndex i : particles) spread += std::abs(x[i] - mean) / n;
  return 4 * spread;
}

}  // namespace

void PairSet::assign(std::size_t particles, const std::vector<ParticleIndex>& first,
                     const std::vector<ParticleIndex>& second, const std::vector<std::uint8_t>& active) {
  offset_.assign(particles + 1, 0);
  for (std::size_t k = 0; k < first.size(); ++k)
    if (active[k]) ++offset_[first[k]], ++offset_[second[k]];
  std::uint32_t sum = 0;
  for (auto& o : offset_) sum += o, o = sum;  // end of each row; filling walks back to its start
  partner_.resize(sum);
  for (std::size_t k = 0; k < first.size(); ++k)
    if (active[k]) partner_[--offset_[first[k]]] = second[k], partner_[--offset_[second[k]]] = first[k];
}

bool PairSet::contains(ParticleIndex a, ParticleIndex b) const {
  if (static_cast<std::size_t>(a) + 1 >= offset_.size()) return false;
  const auto begin = partner_.begin() + offset_[a], end = partner_.begin() + offset_[a + 1];
  return std::find(begin, end, b) != end;
}

double NeighbourList::skin(const Particles& particles, std::size_t i) const {
  return std::max(options_.relative_skin * particles.radius[i], options_.minimum_skin);
}

bool any_moved(const Vec3Field& now, const Vec3Field& then, const std::vector<double>& limit2, double share) {
  const double *x = now.x.data(), *y = now.y.data(), *z = now.z.data();
  const double *x0 = then.x.data(), *y0 = then.y.data(), *z0 = then.z.data(), *limit = limit2.data();
  const double share2 = share * share;
  std::atomic<bool> moved{false};
  parallel_for_even_chunks(now.size(), 2048, [&](std::size_t first, std::size_t last) {
    long long any = 0;
    for (std::size_t i = first; i < last; ++i) {
      const double dx = x[i] - x0[i], dy = y[i] - y0[i], dz = z[i] - z0[i];
      any |= dx * dx + dy * dy + dz * dz <= share2 * limit[i] ? 0 : 1;  // 1 also for a position that is not a number
    }
    if (any != 0) moved = true;
  });
  return moved;
}

bool NeighbourList::outdated(const Particles& particles, double share) const {
  return builds_ == 0 || particles.size() != built_at_.size() ||
         any_moved(particles.position, built_at_, move_limit2_, share);
}

void NeighbourList::build(const Particles& particles, const PairSet& excluded, const RateShare& share) {
  const std::size_t n = particles.size();
  sort_into_levels(particles, share);

  chunk_rows_.resize((n + kChunk - 1) / kChunk);
  offset_.assign(n + 1, 0);
  parallel_for_chunks(n, kChunk, [&](std::size_t first, std::size_t last) {
    auto& rows = chunk_rows_[first / kChunk];
    rows.clear();
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t before = rows.size();
      if (particles.state[i] != ParticleState::removed && share.paired(i)) search(particles, excluded, share, i, rows);
      sort_by_id(rows.begin() + static_cast<std::ptrdiff_t>(before), rows.end(), particles.numbering);
      offset_[i + 1] = static_cast<std::uint32_t>(rows.size() - before);
    }
  });
  for (std::size_t i = 0; i < n; ++i) offset_[i + 1] += offset_[i];

  neighbour_.resize(offset_[n]);
  parallel_for_chunks(n, kChunk, [&](std::size_t first, std::size_t) {
    std::copy(chunk_rows_[first / kChunk].begin(), chunk_rows_[first / kChunk].end(),
              neighbour_.begin() + offset_[first]);
  });
  remember_positions(particles, share);
  ++builds_;
}

void NeighbourList::renumber(const Renumbering& change) {
  reorder(neighbour_, change.move_rows(offset_));
  for (ParticleIndex& j : neighbour_) j = change.to(j);
  change.move(built_at_);
  change.move(move_limit2_);
}

void NeighbourList::remember_positions(const Particles& particles, const RateShare& share) {
  built_at_ = particles.position;
  set_move_limits(particles, share);
}

void NeighbourList::set_move_limits(const Particles& particles, const RateShare& share) {
  move_limit2_.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double limit = share.listed(i) ? 0.5 * skin(particles, i) : std::numeric_limits<double>::infinity();
    move_limit2_[i] = limit * limit;
  }
}

void NeighbourList::sort_into_levels(const Particles& particles, const RateShare& share) {
  for (auto& level : levels_)
    level.particles.clear(), level.largest_reach = 0, level.only_slow = share.rate == Rate::fast;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.state[i] == ParticleState::removed || !share.paired(i)) continue;
    const double reach = particles.radius[i] + 0.5 * skin(particles, i);
    const int exponent = std::ilogb(reach);
    auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.exponent >= exponent; });
    if (level == levels_.end() || level->exponent != exponent) {
      level = levels_.insert(level, Level{});
      level->exponent = exponent;
      level->only_slow = share.rate == Rate::fast;
    }
    level->particles.push_back(static_cast<ParticleIndex>(i));
    level->largest_reach = std::max(level->largest_reach, reach);
    if (share.single(i)) level->only_slow = false;
  }
  for (auto& level : levels_) fill_level(level, particles, share);
}

/// Cell coordinate before wrapping.
std::int64_t NeighbourList::Level::coordinate(double x) const {
  return static_cast<std::int64_t>(std::clamp(std::floor(x / cell_size), -1e15, 1e15));
}

std::size_t NeighbourList::Level::row(std::int64_t iy, std::int64_t iz) const {
  const auto y = static_cast<std::size_t>(iy) & ((std::size_t{1} << bits[1]) - 1);
  const auto z = static_cast<std::size_t>(iz) & ((std::size_t{1} << bits[2]) - 1);
  return ((z << bits[1]) + y) << bits[0];
}

std::size_t NeighbourList::Level::wrapped_x(std::int64_t ix) const {
  return static_cast<std::size_t>(ix) & ((std::size_t{1} << bits[0]) - 1);
}

/// Lengthens the axis that wraps most often until the grid does not wrap, or has four cells a particle.
void NeighbourList::Level::choose_period(const Particles& p) {
  const std::array<double, 3> cells{extent(p.position.x, particles) / cell_size,
                                    extent(p.position.y, particles) / cell_size,
                                    extent(p.position.z, particles) / cell_size};
  bits = {2, 2, 2};
  while ((std::size_t{1} << (bits[0] + bits[1] + bits[2])) < 4 * particles.size()) {
    const auto wraps = [&](std::size_t axis) { return cells[axis] / std::ldexp(1.0, bits[axis]); };
    std::size_t axis = wraps(1) > wraps(0) ? 1 : 0;
    if (wraps(2) > wraps(axis)) axis = 2;
    if (wraps(axis) < 1) return;
    ++bits[axis];
  }
}

void NeighbourList::fill_level(Level& level, const Particles& particles, const RateShare& share) {
  const std::size_t n = level.particles.size();
  if (n == 0) return;
  level.cell_size = 2 * level.largest_reach;
  level.choose_period(particles);
  level.start.assign((std::size_t{1} << (level.bits[0] + level.bits[1] + level.bits[2])) + 1, 0);
  level.members.resize(n);

  const auto cell = [&](ParticleIndex i) {
    const Vec3 p = particles.position[i];
    return level.row(level.coordinate(p.y()), level.coordinate(p.z())) + level.wrapped_x(level.coordinate(p.x()));
  };
  for (const ParticleIndex i : level.particles) ++level.start[cell(i)];
  std::uint32_t sum = 0;
  for (auto& s : level.start) sum += s, s = sum;
  for (std::size_t k = n; k-- > 0;) {  // backwards: the members of a cell end up in ascending order
    const ParticleIndex i = level.particles[k];
    level.members[--level.start[cell(i)]] = {particles.position.x[i],
                                             particles.position.y[i],
                                             particles.position.z[i],
                                             particles.radius[i] + 0.5 * skin(particles, i),
                                             i,
                                             particles.state[i] == ParticleState::free,
                                             share.rate == Rate::fast && !share.single(i)};
  }
}

void NeighbourList::search(const Particles& particles, const PairSet& excluded, const RateShare& share, std::size_t i,
                           std::vector<ParticleIndex>& row) const {
  const double reach = particles.radius[i] + 0.5 * skin(particles, i);
  const Vec3 p = particles.position[i];
  const Member me{p.x(),
                  p.y(),
                  p.z(),
                  reach,
                  static_cast<ParticleIndex>(i),
                  particles.state[i] == ParticleState::free,
                  share.rate == Rate::fast && !share.single(i)};
  const int own = std::ilogb(reach);
  for (const auto& level : levels_)  // small looks for large, never the other way round: few cells, few candidates
    if (level.exponent >= own && !level.particles.empty() && !(me.slow && level.only_slow))
      search_level(level, me, level.exponent == own, particles.numbering, excluded, row);
}

void NeighbourList::search_level(const Level& level, const Member& me, bool same_level, const Numbering& numbering,
                                 const PairSet& excluded, std::vector<ParticleIndex>& row) {
  const auto consider = [&](const Member& other) {
    const double dx = other.x - me.x, dy = other.y - me.y, dz = other.z - me.z, sum = other.reach + me.reach;
    if (dx * dx + dy * dy + dz * dz >= sum * sum) return;
    if (same_level && !numbering.precedes(me.index, other.index)) return;
    if ((!me.free && !other.free) || (me.slow && other.slow)) return;
    if (!excluded.contains(me.index, other.index)) row.push_back(other.index);
  };
  const auto consider_cells = [&](std::size_t first, std::size_t last) {
    for (std::uint32_t m = level.start[first]; m < level.start[last + 1]; ++m) consider(level.members[m]);
  };
  const double range = me.reach + level.largest_reach;  // at most a cell: three cells along each axis
  const auto y0 = level.coordinate(me.y - range), y1 = level.coordinate(me.y + range);
  const auto z0 = level.coordinate(me.z - range), z1 = level.coordinate(me.z + range);
  const std::size_t x0 = level.wrapped_x(level.coordinate(me.x - range));
  const std::size_t x1 = level.wrapped_x(level.coordinate(me.x + range));
  const std::size_t period = std::size_t{1} << level.bits[0];
  for (auto iz = z0; iz <= z1; ++iz)
    for (auto iy = y0; iy <= y1; ++iy) {
      const std::size_t cells = level.row(iy, iz);
      if (x0 <= x1) {
        consider_cells(cells + x0, cells + x1);
      } else {  // around the end of the torus
        consider_cells(cells, cells + x1);
        consider_cells(cells + x0, cells + period - 1);
      }
    }
}

}  // namespace lahar::dem

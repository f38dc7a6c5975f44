#include "coupling/body_map.h"

#include <cstdio>
#include <numbers>

#include "core/check.h"
#include "core/parallel.h"

namespace lahar::coupling {

using lbm::Block;
using lbm::BlockIndex;
using lbm::CellType;
using lbm::kNoBlock;

namespace {

/// Calls visit(first cell of the row, y, z, eps[8]) for the rows of a block that a sphere reaches.
template <class Real, class Visit>
void for_rows(const GridSphere<Real>& s, const Vec3i& lowest, const Visit& visit) {
  const RowRange rows = rows_in_reach(s, lowest, s.radius + Real(0.5));
  Real eps[lbm::kBlockWidth];
  for (int z = rows.low[1]; z < rows.high[1]; ++z)
    for (int y = rows.low[0]; y < rows.high[0]; ++y) {
      sphere_row(s, lowest.x(), lowest.y() + y, lowest.z() + z, eps);
      visit(lbm::cell_index(0, y, z), y, z, eps);
    }
}

/// Calls visit(first cell of the row, y, z, eps[8], coverage[8]) for the rows that a sphere's coverage reaches.
template <class Real, class Visit>
void for_covered_rows(const GridSphere<Real>& s, const Vec3i& lowest, const Visit& visit) {
  const RowRange rows = rows_in_reach(s, lowest, reach_of(s));
  Real eps[lbm::kBlockWidth], coverage[lbm::kBlockWidth];
  for (int z = rows.low[1]; z < rows.high[1]; ++z)
    for (int y = rows.low[0]; y < rows.high[0]; ++y) {
      sphere_coverage_row(s, lowest.x(), lowest.y() + y, lowest.z() + z, eps, coverage);
      visit(lbm::cell_index(0, y, z), y, z, eps, coverage);
    }
}

/// Volume of a sphere in a block, in cells.
template <class Real>
double volume_in(const GridSphere<Real>& s, const Vec3i& lowest) {
  Real lane[lbm::kBlockWidth] = {};
  for_rows(s, lowest, [&](int, int, int, const Real* eps) {
    for (int c = 0; c < lbm::kBlockWidth; ++c) lane[c] += eps[c];
  });
  double sum = 0;
  for (const Real v : lane) sum += static_cast<double>(v);
  return sum;
}

/// Volume of a sphere in the wet cells of a block, in cells.
template <class Real>
double wet_volume_in(const GridSphere<Real>& s, const Block<Real>& block, const Vec3i& lowest) {
  double sum = 0;
  for_rows(s, lowest, [&](int row, int, int, const Real* eps) {
    for (int k = 0; k < lbm::kBlockWidth; ++k)
      if (lbm::is_wet(block.type[static_cast<std::size_t>(row + k)])) sum += static_cast<double>(eps[k]);
  });
  return sum;
}

/// Share of a new force in what a body feels. The liquid that a body holds answers a change of its velocity a step
/// late, and the liquid that it pushes aside within a few: m a_n = -M a_n-1 with M up to twice what it holds would grow
/// without bound for a light body. A force that follows the fluid's, F_n = F_n-1 + share (fluid - F_n-1), goes through
/// the factor 1 - share (1 + M / m) a step instead, here never below -1/2. It is the virtual mass m (1 / share - 1) of
/// Schwarz, Kempe & Froehlich 2015 (J. Comput. Phys. 281, 591): smooth motions lag by 1 / share steps, no inertia is
/// added. Bodies of four times the liquid they hold and more feel the force itself.
double followed_share(double own, double held) { return std::min(1.0, 1.5 * own / (own + 2 * held)); }

/// A body that holds no liquid forgets.
void follow(Vec3& felt, const Vec3& fluid, double share, bool wet) {
  felt = wet ? Vec3(felt + share * (fluid - felt)) : fluid;
}

[[noreturn]] void report_bad_force(const dem::Particles& particles, dem::ParticleIndex i, std::int64_t step) {
  const Vec3 p = particles.position[i];
  char where[112];
  std::snprintf(where, sizeof where, "grain %u at (%.4g, %.4g, %.4g) m", i, p.x(), p.y(), p.z());
  throw NumericalFailure(where, step, "the force of the fluid on it is not finite");
}

}  // namespace

template <class Real>
template <class Visit>
void BodyMap<Real>::for_each_block(const Visit& visit) const {
  const std::size_t blocks = block_start_.empty() ? 0 : block_start_.size() - 1;
  parallel_for(0, blocks, 8, [&](std::size_t b) {
    if (block_start_[b] < block_start_[b + 1]) visit(static_cast<BlockIndex>(b));
  });
}

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
}

/// Dry blocks may have been released since the pair was made, and their index used again.
template <class Real>
bool BodyMap<Real>::is_alive(const lbm::Fluid<Real>& fluid, const Pair& p) const {
  return fluid.grid().exists(p.block) && fluid.grid().block(p.block).birth == p.birth;
}

/// The wet volume of the former mapping under the cell types of now: conversions have booked their part already.
template <class Real>
void BodyMap<Real>::measure_old(lbm::Fluid<Real>& fluid) {
  parallel_for(0, pairs_.size(), 256, [&](std::size_t k) {
    Pair& p = pairs_[k];
    if (!is_alive(fluid, p)) {
      p.wet_volume = 0;
      return;
    }
    const Block<Real>& block = fluid.grid().block(p.block);
    p.wet_volume = block.wet_cells == lbm::kBlockCells ? p.volume : wet_volume_in(spheres_[p.body], block, p.lowest);
  });
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Body& b = bodies_[k];
    double sum = 0;
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) sum += pairs_[p].wet_volume;
    old_wet_[b.particle] = sum;
  }
}

template <class Real>
void BodyMap<Real>::collect(lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  const auto& units = fluid.units();
  const bool by_distance = fluid.options().weighting == lbm::BodyWeighting::wall_distance;
  old_wet_.resize(particles.size(), 0.0);
  last_velocity_.resize(particles.size(), Vec3::Zero());
  last_spin_.resize(particles.size(), Vec3::Zero());
  felt_force_.resize(particles.size(), Vec3::Zero());
  felt_torque_.resize(particles.size(), Vec3::Zero());
  known_.resize(particles.size(), 0);
  former_.swap(bodies_);
  bodies_.clear(), spheres_.clear(), pairs_.clear();
  for (dem::ParticleIndex i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] != dem::ParticleKind::grain || particles.state[i] == dem::ParticleState::removed) continue;
    const Vec3 place = (particles.position[i] - fluid.grid().domain().origin()) / units.cell_size;
    const double r = particles.radius[i] / units.cell_size;
    GridSphere<Real> s;
    const Vec3 v = particles.velocity[i] * units.velocity_to_lu(1.0),
               w = particles.angular_velocity[i] * units.time_step;
    for (int a = 0; a < 3; ++a) {
      s.centre[a] = static_cast<Real>(place[a]);
      s.velocity[a] = static_cast<Real>(v[a]);
      s.spin[a] = static_cast<Real>(w[a]);
    }
    s.radius = static_cast<Real>(mapping_radius(r));
    s.surface = by_distance ? static_cast<Real>(std::max(0.0, r + radius_shift_)) : Real(-2);
    Body b;
    b.particle = i;
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
    bodies_.push_back(b);
    spheres_.push_back(s);
    add_pairs(fluid, static_cast<std::uint32_t>(bodies_.size() - 1));
  }
  // A grain that was removed while in the liquid leaves a void: its volume is drawn from the pool.
  for (const Body& b : former_)
    if (old_wet_[b.particle] != 0) {
      fluid.account().pool -= old_wet_[b.particle];
      old_wet_[b.particle] = 0;
    }
}

template <class Real>
void BodyMap<Real>::add_pairs(const lbm::Fluid<Real>& fluid, std::uint32_t body) {
  const GridSphere<Real>& s = spheres_[body];
  const auto block_at = [&](int a, Real offset) { return static_cast<int>(std::floor(s.centre[a] + offset)) >> 3; };
  const Real reach = reach_of(s), inner = s.radius + Real(0.5);
  Vec3i low, high, inner_low, inner_high;
  for (int a = 0; a < 3; ++a) {
    low[a] = block_at(a, -reach), high[a] = block_at(a, reach);
    inner_low[a] = block_at(a, -inner), inner_high[a] = block_at(a, inner);
  }
  Body& b = bodies_[body];
  b.first_pair = pairs_.size();
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z) {
        const Vec3i place(x, y, z);
        const BlockIndex block = fluid.grid().topology().find(place);
        if (block != kNoBlock)
          pairs_.push_back({block, body, fluid.grid().block(block).birth, place * lbm::kBlockWidth});
        else if ((place.array() >= inner_low.array()).all() && (place.array() <= inner_high.array()).all())
          b.all_blocks = false;
      }
  b.pairs = pairs_.size() - b.first_pair;
}

/// Counting sort; within a block the pairs stay in the order of the bodies.
template <class Real>
void BodyMap<Real>::sort_by_block(const lbm::Fluid<Real>& fluid) {
  block_start_.assign(fluid.grid().topology().capacity() + 1, 0);
  for (const Pair& p : pairs_) ++block_start_[static_cast<std::size_t>(p.block) + 1];
  for (std::size_t b = 1; b < block_start_.size(); ++b) block_start_[b] += block_start_[b - 1];
  by_block_.resize(pairs_.size());
  next_.assign(block_start_.begin(), block_start_.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) by_block_[next_[static_cast<std::size_t>(pairs_[k].block)]++] = k;
}

/// Scales each sphere to its exact volume, where all blocks that it reaches exist.
template <class Real>
void BodyMap<Real>::normalize() {
  parallel_for(0, bodies_.size(), 64, [&](std::size_t k) {
    Body& b = bodies_[k];
    double sum = 0;
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) {
      pairs_[p].volume = volume_in(spheres_[k], pairs_[p].lowest);
      sum += pairs_[p].volume;
    }
    const double factor = b.all_blocks && sum > 0 ? b.volume / sum : 1.0;
    spheres_[k].factor = static_cast<Real>(factor);
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) pairs_[p].volume *= factor;
  });
}

template <class Real>
void BodyMap<Real>::write_fields(lbm::Fluid<Real>& fluid) {
  auto& grid = fluid.grid();
  for (const BlockIndex b : grid.active()) {
    const auto at = static_cast<std::size_t>(b);
    if (block_start_[at] < block_start_[at + 1]) grid.require_body(b).used = true;
  }
  for_each_block([&](BlockIndex b) { write_block(fluid, b); });
  wet_volume_ = 0;
  for (const Pair& p : pairs_) wet_volume_ += p.wet_volume;
}

template <class Real>
void BodyMap<Real>::write_block(lbm::Fluid<Real>& fluid, BlockIndex index) {
  auto& grid = fluid.grid();
  Block<Real>& block = grid.block(index);
  lbm::BodyFields<Real>& f = *block.body;
  const auto at = static_cast<std::size_t>(index);
  const bool by_distance = fluid.options().weighting == lbm::BodyWeighting::wall_distance;
  const Real gap = by_distance ? Real(kGapResistance) : Real(0);
  const bool mixed = block.wet_cells < lbm::kBlockCells || block.surface;
  for (std::uint32_t k = block_start_[at]; k < block_start_[at + 1]; ++k) {
    Pair& pair = pairs_[by_block_[k]];
    const GridSphere<Real>& s = spheres_[pair.body];
    pair.wet_volume = mixed ? 0 : pair.volume;
    pair.surface_weight = 0;
    const Vec3i lowest = pair.lowest;
    for_covered_rows(s, lowest, [&](int row, int y, int z, const Real* eps, const Real* coverage) {
      const Real ry = static_cast<Real>(lowest.y() + y) + Real(0.5) - s.centre[1];
      const Real rz = static_cast<Real>(lowest.z() + z) + Real(0.5) - s.centre[2];
      for (int c = 0; c < lbm::kBlockWidth; ++c) {
        const Real rx = static_cast<Real>(lowest.x() + c) + Real(0.5) - s.centre[0];
        f.solid_fraction[row + c] += eps[c];
        f.coverage[row + c] += coverage[c];
        f.resistance[row + c] = joined_resistance(f.resistance[row + c], coverage[c], gap);
        f.momentum_x[row + c] += coverage[c] * (s.velocity[0] + s.spin[1] * rz - s.spin[2] * ry);
        f.momentum_y[row + c] += coverage[c] * (s.velocity[1] + s.spin[2] * rx - s.spin[0] * rz);
        f.momentum_z[row + c] += coverage[c] * (s.velocity[2] + s.spin[0] * ry - s.spin[1] * rx);
      }
      for (int c = 0; mixed && c < lbm::kBlockWidth; ++c) {
        const CellType t = block.type[static_cast<std::size_t>(row + c)];
        if (lbm::is_wet(t)) pair.wet_volume += static_cast<double>(eps[c]);
        if (t == CellType::interface) pair.surface_weight += static_cast<double>(eps[c]);
      }
    });
  }
}

/// Adds each body's change of wet volume to the interface cells that it covers; the pool takes it where there are none.
template <class Real>
void BodyMap<Real>::book_displacement(lbm::Fluid<Real>& fluid) {
  displaced_.assign(bodies_.size(), 0.0);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& b = bodies_[k];
    double now = 0, weight = 0;
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) {
      now += pairs_[p].wet_volume;
      weight += pairs_[p].surface_weight;
    }
    const double change = now - b.old_wet_volume;
    if (change == 0) continue;
    if (weight > std::abs(change))
      displaced_[k] = change / weight;
    else
      fluid.account().pool += change;
  }
  for_each_block([&](BlockIndex index) {
    Block<Real>& block = fluid.grid().block(index);
    if (!block.surface) return;
    const auto at = static_cast<std::size_t>(index);
    for (std::uint32_t k = block_start_[at]; k < block_start_[at + 1]; ++k) {
      const Pair& pair = pairs_[by_block_[k]];
      const std::uint32_t body = pair.body;
      if (displaced_[body] == 0) continue;
      for_rows(spheres_[body], pair.lowest, [&](int row, int, int, const Real* eps) {
        for (int c = 0; c < lbm::kBlockWidth; ++c)
          if (block.type[static_cast<std::size_t>(row + c)] == CellType::interface)
            block.surface->mass[row + c] += static_cast<Real>(displaced_[body]) * eps[c];
      });
    }
  });
}

template <class Real>
Vec3 BodyMap<Real>::add_forces(lbm::Fluid<Real>& fluid, dem::Particles& particles) {
  auto& grid = fluid.grid();
  const lbm::CoverageLaw& law = fluid.coverage_law();
  const bool by_distance = fluid.options().weighting == lbm::BodyWeighting::wall_distance;
  parallel_for(0, pairs_.size(), 128, [&](std::size_t k) {
    Pair& pair = pairs_[k];
    pair.force = pair.torque = Vec3::Zero();
    pair.inside = pair.inside_inertia = pair.held = pair.held_inertia = 0;
    if (!is_alive(fluid, pair)) return;
    const Block<Real>& block = grid.block(pair.block);
    const lbm::BodyFields<Real>& f = *block.body;
    const GridSphere<Real>& s = spheres_[pair.body];
    const Vec3i lowest = pair.lowest;
    for_covered_rows(s, lowest, [&](int row, int y, int z, const Real* eps, const Real* coverage) {
      for (int c = 0; c < lbm::kBlockWidth; ++c) {
        if (coverage[c] == 0 || f.coverage[row + c] == 0) continue;
        const double share = static_cast<double>(coverage[c]) / static_cast<double>(f.coverage[row + c]);
        const Vec3 force =
            share * Vec3(static_cast<double>(f.exchange_x[row + c]), static_cast<double>(f.exchange_y[row + c]),
                         static_cast<double>(f.exchange_z[row + c]));
        const Vec3 arm =
            (lowest + Vec3i(c, y, z)).cast<double>() + Vec3::Constant(0.5) -
            Vec3(static_cast<double>(s.centre[0]), static_cast<double>(s.centre[1]), static_cast<double>(s.centre[2]));
        pair.force += force;
        pair.torque += arm.cross(force);
        if (!lbm::is_wet(block.type[static_cast<std::size_t>(row + c)])) continue;
        const double held = share * lbm::coverage_weight(static_cast<double>(f.resistance[row + c]), law);
        const double inside = by_distance ? static_cast<double>(eps[c]) : held, square = 2.0 / 3.0 * arm.squaredNorm();
        pair.inside += inside, pair.inside_inertia += inside * square;
        pair.held += held, pair.held_inertia += held * square;
      }
    });
  });
  const auto& units = fluid.units();
  const Vec3 gravity = fluid.options().gravity * units.acceleration_to_lu(1.0);
  Vec3 total = Vec3::Zero();
  for (const Body& b : bodies_) {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    double wet = 0, inside = 0, inside_inertia = 0, held = 0, held_inertia = 0;
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) {
      force += pairs_[p].force;
      torque += pairs_[p].torque;
      wet += pairs_[p].wet_volume;
      inside += pairs_[p].inside, inside_inertia += pairs_[p].inside_inertia;
      held += pairs_[p].held, held_inertia += pairs_[p].held_inertia;
    }
    total += force;
    // The exchange also accelerates the liquid that stands in the body's place; that part is no load on the body
    // (Feng & Michaelides 2009; Uhlmann 2005). The weight of that liquid is carried by the fluid: the body's buoyancy.
    const dem::ParticleIndex i = b.particle;
    const double to_kg = units.mass(), to_kg_m2 = to_kg * units.cell_size * units.cell_size;
    force += inside * units.acceleration_to_lu(1.0) * b.acceleration - wet * gravity;
    torque += inside_inertia * units.time_step * units.time_step * b.spin_up;
    force *= units.force_to_si(1.0), torque *= units.torque_to_si(1.0);
    follow(felt_force_[i], force, followed_share(particles.mass[i], to_kg * held), held > 0);
    follow(felt_torque_[i], torque, followed_share(particles.inertia[i], to_kg_m2 * held_inertia), held > 0);
    if (!force.allFinite()) report_bad_force(particles, i, fluid.steps());
    particles.external_force.add(i, felt_force_[i]);
    particles.external_torque.add(i, felt_torque_[i]);
  }
  return total;
}

template class BodyMap<float>;
template class BodyMap<double>;

}  // namespace lahar::coupling

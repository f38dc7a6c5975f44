// What the fluid hands to a checkpoint and takes from it.
//
// Blocks keep their indices, since others hold them. Populations are stored as they lie, all cells, since in
// Esoteric Pull a cell's numbers lie with its neighbours too, also in dry ones. Walls, rims and links come from the
// domain again; lists of interface cells and counts from the types.
#include <algorithm>
#include <cstdio>

#include "core/check.h"
#include "lbm/boundary/row_reflection.h"
#include "lbm/step/fluid.h"

namespace lahar::lbm {

namespace {

bool holds_interface(const std::array<CellType, kBlockCells>& types) {
  return std::find(types.begin(), types.end(), CellType::interface) != types.end();
}

/// One field of some blocks: field(b) is where its 512 numbers lie.
template <class Real, class Field>
void transfer_field(Archive& archive, const char* name, const std::vector<BlockIndex>& blocks, const Field& field) {
  archive.pieces<Real>(name, blocks.size(), kBlockCells, [&](std::size_t k, Real* buffer) {
    Real* const own = field(blocks[k]);
    if (archive.loading())
      std::copy_n(buffer, kBlockCells, own);
    else
      std::copy_n(own, kBlockCells, buffer);
  });
}

/// The blocks of `all` that `holds` is true for, also known when loading.
template <class Holds>
std::vector<BlockIndex> transfer_chosen(Archive& archive, const char* name, const std::vector<BlockIndex>& all,
                                        const Holds& holds) {
  std::vector<std::uint8_t> chosen(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) chosen[k] = holds(all[k]);
  archive.list_of(name, chosen, all.size());
  std::vector<BlockIndex> blocks;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (chosen[k]) blocks.push_back(all[k]);
  return blocks;
}

}  // namespace

template <class Real>
void FluidGrid<Real>::transfer(Archive& archive) {
  archive.part("domain", domain_);
  archive.part("topology", topology_);
  if (archive.loading()) make_blocks(owned());
  archive.value("births", births_);
  archive.pieces<std::uint64_t>("birth", owned().size(), 1, [&](std::size_t k, std::uint64_t* birth) {
    if (archive.loading())
      block(owned()[k]).birth = *birth;
    else
      *birth = block(owned()[k]).birth;
  });
  transfer_types(archive);
  constexpr std::size_t size = std::size_t{D3Q19::q} * kBlockCells;
  archive.pieces<Real>("populations", owned().size(), size, [&](std::size_t k, Real* buffer) {
    for (int i = 0; i < D3Q19::q; ++i) {
      Real* const own = block(owned()[k]).f(i);
      Real* const stored = buffer + i * kBlockCells;
      if (archive.loading())
        std::copy_n(stored, kBlockCells, own);
      else
        std::copy_n(own, kBlockCells, stored);
    }
  });
  transfer_surfaces(archive);
  transfer_bodies(archive);
  transfer_wall_links(archive);
}

/// Walls and sinks are those of the domain: a scene whose walls have changed is noticed here.
template <class Real>
void FluidGrid<Real>::transfer_types(Archive& archive) {
  const auto fixed = [](CellType t) { return t == CellType::wall || t == CellType::sink; };
  archive.pieces<CellType>("type", owned().size(), kBlockCells, [&](std::size_t k, CellType* stored) {
    auto& own = block(owned()[k]).type;
    if (!archive.loading()) return std::copy(own.begin(), own.end(), stored), void();
    for (std::size_t n = 0; n < kBlockCells; ++n) {
      if (stored[n] > CellType::sink || ((fixed(own[n]) || fixed(stored[n])) && own[n] != stored[n]))
        archive.refuse("type", "does not fit the walls of the scene");
      own[n] = stored[n];
    }
  });
}

template <class Real>
void FluidGrid<Real>::transfer_surfaces(Archive& archive) {
  const auto blocks =
      transfer_chosen(archive, "has_surface", owned(), [&](BlockIndex b) { return block(b).surface != nullptr; });
  if (archive.loading()) {
    for (const BlockIndex b : blocks) require_surface(b);
    for (const BlockIndex b : owned()) {
      if (holds_interface(block(b).type) != (block(b).surface != nullptr))
        archive.refuse("has_surface", "does not fit the types of the cells");
      relist(b);
    }
  }
  transfer_field<Real>(archive, "mass", blocks, [&](BlockIndex b) { return block(b).surface->mass; });
  transfer_field<Real>(archive, "fill_level", blocks, [&](BlockIndex b) { return block(b).surface->fill_level; });
  transfer_field<Real>(archive, "density", blocks, [&](BlockIndex b) { return block(b).surface->density; });
}

template <class Real>
void FluidGrid<Real>::transfer_bodies(Archive& archive) {
  const auto blocks =
      transfer_chosen(archive, "has_body", owned(), [&](BlockIndex b) { return block(b).body != nullptr; });
  if (archive.loading())
    for (const BlockIndex b : blocks) require_body(b);
  const auto field = [&](const char* name, Real(BodyFields<Real>::*member)[kBlockCells]) {
    transfer_field<Real>(archive, name, blocks, [&](BlockIndex b) -> Real* { return block(b).body->*member; });
  };
  using Fields = BodyFields<Real>;
  field("solid_fraction", &Fields::solid_fraction);
  field("exchange_weight", &Fields::exchange_weight);
  field("drag", &Fields::drag);
  field("weighted_velocity_x", &Fields::weighted_velocity_x);
  field("weighted_velocity_y", &Fields::weighted_velocity_y);
  field("weighted_velocity_z", &Fields::weighted_velocity_z);
  field("momentum_exchange_x", &Fields::momentum_exchange_x);
  field("momentum_exchange_y", &Fields::momentum_exchange_y);
  field("momentum_exchange_z", &Fields::momentum_exchange_z);
  field("velocity_x", &Fields::velocity_x);
  field("velocity_y", &Fields::velocity_y);
  field("velocity_z", &Fields::velocity_z);
  constexpr std::size_t rows = kBlockCells / kBlockWidth;
  archive.pieces<std::uint8_t>("covered", blocks.size(), rows, [&](std::size_t k, std::uint8_t* stored) {
    auto& own = block(blocks[k]).body->covered;
    if (archive.loading())
      std::copy_n(stored, rows, own.begin());
    else
      std::copy_n(own.begin(), rows, stored);
  });
}

/// What the last reflection noted. A block that was never reflected has no gains yet: zeros stand for them.
template <class Real>
void FluidGrid<Real>::transfer_wall_links(Archive& archive) {
  std::vector<double> gains;
  std::vector<std::uint32_t> mirrored;
  std::size_t size = 0;
  for (const BlockIndex b : owned()) {
    const WallLinks& walls = block(b).walls;
    size += walls.cells.size();
    if (archive.loading()) continue;
    gains.insert(gains.end(), walls.gains.begin(), walls.gains.end());
    gains.resize(size, 0);
    const MirroredLinks links(walls);
    for (const WallCell& wall : walls.cells) mirrored.push_back(links.of(wall, walls.directions.data()));
  }
  archive.list_of("wall_gains", gains, size);
  archive.list_of("wall_mirrored", mirrored, size);
  if (!archive.loading()) return;
  auto gain = gains.begin();
  const std::uint32_t* of_cells = mirrored.data();
  for (const BlockIndex b : owned()) {
    WallLinks& walls = block(b).walls;
    const auto last = gain + static_cast<std::ptrdiff_t>(walls.cells.size());
    walls.gains.assign(gain, last);
    gain = last;
    MirroredLinks::restore(walls, of_cells);
    of_cells += walls.cells.size();
  }
}

/// A checkpoint that holds a number that is none would be of no use, and would take the place of a good one.
template <class Real>
void Fluid<Real>::check_finite() const {
  for (const BlockIndex b : level_.grid.owned()) {
    const Block<Real>& block = level_.grid.block(b);
    Real defect = 0;  // 0 unless a number is infinite or none
    for (int i = 0; i < D3Q19::q; ++i)
      for (int n = 0; n < kBlockCells; ++n) defect += block.f(i)[n] - block.f(i)[n];
    if (defect == 0) continue;
    const Vec3 p = level_.grid.centre(b, 0);
    char where[96];
    std::snprintf(where, sizeof where, "fluid block at (%.4g, %.4g, %.4g) m", p.x(), p.y(), p.z());
    throw NumericalFailure(where, steps(), "not a number");
  }
}

/// The step may have changed since the start, and the units with it.
template <class Real>
void Fluid<Real>::transfer_time(Archive& archive) {
  archive.part("clock", clock_);
  double time_step = level_.units.time_step;
  archive.value("time_step", time_step);
  if (archive.loading()) take_time_step(time_step);
  archive.value("coming_time_step", coming_time_step_);
  archive.value("looked_at", looked_at_);
  archive.part("time_steps", time_steps_);
  if (control_) archive.part("time_step_control", *control_);
}

template <class Real>
void Fluid<Real>::transfer(Archive& archive) {
  if (!archive.loading()) check_finite();
  transfer_time(archive);
  archive.value("odd_step", level_.parameters.parity.odd);
  archive.value("initial_mass", initial_mass_);
  archive.value("cell_updates", cell_updates_);
  archive.part("survey", survey_);
  archive.value("limited_cells", limited_cells_);
  archive.part("account", account_);
  archive.part("conversion", conversion_);
  for (std::size_t k = 0; k < inflows_.size(); ++k) archive.part("inflow_" + std::to_string(k), inflows_[k]);
  walls_.transfer(archive, level_.grid.domain());
  archive.part("grid", level_.grid);
  if (archive.loading())  // with the walls that are open
    for (Inflow<Real>& inflow : inflows_) inflow.find_columns(level_.grid.domain());
}

// The classes are instantiated elsewhere, without what is defined here.
#define LAHAR_INSTANTIATE(Real)                                 \
  template void FluidGrid<Real>::transfer(Archive&);            \
  template void FluidGrid<Real>::transfer_types(Archive&);      \
  template void FluidGrid<Real>::transfer_surfaces(Archive&);   \
  template void FluidGrid<Real>::transfer_bodies(Archive&);     \
  template void FluidGrid<Real>::transfer_wall_links(Archive&); \
  template void Fluid<Real>::check_finite() const;              \
  template void Fluid<Real>::transfer_time(Archive&);           \
  template void Fluid<Real>::transfer(Archive&);
LAHAR_INSTANTIATE(float)
LAHAR_INSTANTIATE(double)
#undef LAHAR_INSTANTIATE

}  // namespace lahar::lbm

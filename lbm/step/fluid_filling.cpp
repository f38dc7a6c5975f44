// How liquid gets into the fluid before the first step.
#include "lbm/step/fluid_filling.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "lbm/collision/equilibrium.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/free_surface/touching.h"
#include "lbm/step/fluid.h"

namespace lahar::lbm {

namespace {

/// The part of population i that carries a stress (second moments less their equilibrium): w_i 9/2 (c c - 1/3) : S.
double stress_part(int i, const Mat3& stress) {
  const Vec3 c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
  return 4.5 * D3Q19::w(i) * (c.dot(stress * c) - stress.trace() / 3);
}

}  // namespace

template <class Real>
void Fluid<Real>::initialize(CellPlace place, double drho, const Vec3& u, const Mat3& stress) {
  const auto r = static_cast<Real>(drho), x = static_cast<Real>(u.x()), y = static_cast<Real>(u.y()),
             z = static_cast<Real>(u.z());
  const EquilibriumOrder order = equilibrium_order(options_.collision);
  const auto population = [&](int i) {
    return equilibrium(order, i, r, x, y, z) + static_cast<Real>(stress_part(i, stress));
  };
  level_.grid.block(place.block).f(0)[place.cell] = population(0);
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto pair = level_.grid.access(place, a, level_.parity());
    const Real fa = population(a), fb = population(a + 1);
    // What the cell sends out is what its neighbours receive; from neighbours that send nothing it receives its own.
    *pair.outgoing_a = fa;
    *pair.outgoing_b = fb;
    if (!is_wet(level_.grid.type(level_.grid.neighbour(place, a)))) *pair.incoming_b = fb;
    if (!is_wet(level_.grid.type(level_.grid.neighbour(place, a + 1)))) *pair.incoming_a = fa;
  }
}

namespace {

/// Top of the liquid over a point of a region, m: boxes that stand on each other, or overlap, are one body of liquid.
double top_over(const Vec3& p, const LiquidRegion& own, const std::vector<LiquidRegion>& all, double cell_size) {
  double top = own.upper.z();
  const auto carries_on = [&](const LiquidRegion& r) {
    return !r.body && p.x() >= r.lower.x() && p.x() < r.upper.x() && p.y() >= r.lower.y() && p.y() < r.upper.y() &&
           r.lower.z() <= top + 1e-6 * cell_size && r.upper.z() > top;
  };
  for (auto next = all.begin(); !own.body && next != all.end();) {
    next = std::find_if(all.begin(), all.end(), carries_on);
    if (next != all.end()) top = next->upper.z();
  }
  return top;
}

/// rho - 1 of liquid at rest under its top (z is the direction of depth): dp = rho g dh with p = cs^2 rho, so rho =
/// exp(3 g h).
double resting_density(double z, double top, double gravity_z, const LatticeUnits& units) {
  const double depth_lu = std::max(0.0, top - z) / units.cell_size;
  return std::max(0.0, std::expm1(-3 * units.acceleration_to_lu(gravity_z) * depth_lu));
}

/// Of a cell, the volume that lies in a region that is a box and in none of the boxes before it, as a fraction.
double fraction_in_box(const Vec3& centre, double dx, std::span<const LiquidRegion> before, const LiquidRegion& own) {
  const Vec3 low = (centre.array() - dx / 2).max(own.lower.array()),
             high = (centre.array() + dx / 2).min(own.upper.array());
  if ((high - low).minCoeff() <= 0) return 0;
  std::vector<const LiquidRegion*> others;
  for (const LiquidRegion& r : before)
    if (!r.body && (high.cwiseMin(r.upper) - low.cwiseMax(r.lower)).minCoeff() > 0) others.push_back(&r);
  if (others.empty()) return (high - low).prod() / (dx * dx * dx);
  std::array<std::vector<double>, 3> cuts;  // by the faces of all boxes
  for (int a = 0; a < 3; ++a) {
    auto& c = cuts[static_cast<std::size_t>(a)];
    c = {low[a], high[a]};
    for (const LiquidRegion* r : others)
      for (const double face : {r->lower[a], r->upper[a]})
        if (face > low[a] && face < high[a]) c.push_back(face);
    std::sort(c.begin(), c.end());
  }
  double volume = 0;
  for (std::size_t x = 1; x < cuts[0].size(); ++x)
    for (std::size_t y = 1; y < cuts[1].size(); ++y)
      for (std::size_t z = 1; z < cuts[2].size(); ++z) {
        const Vec3 from(cuts[0][x - 1], cuts[1][y - 1], cuts[2][z - 1]), to(cuts[0][x], cuts[1][y], cuts[2][z]);
        const Vec3 middle = (from + to) / 2;
        const bool counted = std::any_of(others.begin(), others.end(), [&](const LiquidRegion* r) {
          return ((middle - r->lower).array() > 0).all() && ((r->upper - middle).array() > 0).all();
        });
        if (!counted) volume += (to - from).prod();
      }
  return volume / (dx * dx * dx);
}

/// Where a body is looked at for what it has of an eighth of a cell: at the middle of that, but not within a quarter of
/// a cell of walls. So what ends at a wall fills the cells that the wall cuts.
Vec3 off_walls(const Walls& walls, Vec3 part, double dx) {
  constexpr int several = 3;  // walls of an edge or a corner
  for (int k = 0; k < several; ++k) {
    const WallPoint wall = walls.nearest(part);
    if (wall.distance > (0.25 - 1e-4) * dx) break;
    part += (dx / 4 - wall.distance) * wall.normal;
  }
  return part;
}

/// The same of a body, from its signed distance in eight parts of the cell: exact where the surface is flat and lies
/// along the lattice. Whole where it lacks less than 1e-4: sampled surfaces are lifted by some 1e-5.
double body_fraction(const Domain& domain, const Vec3& centre, const Shape& body) {
  const double dx = domain.cell_size();
  const bool is_near_walls = domain.walls().nearest(centre).distance < dx;
  double fraction = 0;
  for (int k = 0; k < 8; ++k) {
    const Vec3 part = centre + dx / 4 * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    const Vec3 at = is_near_walls ? off_walls(domain.walls(), part, dx) : part;
    const double d = std::visit([&](const auto& s) { return s.distance(at); }, body);
    fraction += std::clamp(0.5 - d / (dx / 2), 0.0, 1.0) / 8;
  }
  return fraction > 1 - 1e-4 ? 1 : fraction;
}

constexpr double kNegligible = 1e-6;  // fraction of a cell

/// Of a cell, the part that a region fills; of a box, without what the boxes before it fill.
double fraction_in(const Domain& domain, const Vec3& centre, std::span<const LiquidRegion> before,
                   const LiquidRegion& region) {
  return region.body ? body_fraction(domain, centre, *region.body)
                     : fraction_in_box(centre, domain.cell_size(), before, region);
}

/// Whether a region fills a cell right above a wall, of a box of cells.
bool stands_on_wall_in(const Domain& domain, const LiquidRegion& region, const Vec3i& low, const Vec3i& high) {
  const double reach = 0.5 * (high - low).cast<double>().norm() + 1.5;  // cells: from the middle to those below
  if (domain.wall_distance(0.5 * (domain.centre(low) + domain.centre(high))) > reach * domain.cell_size()) return false;
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x) {
        const Vec3i cell(x, y, z);
        if (domain.classify(cell - Vec3i::UnitZ()) == CellType::wall && domain.classify(cell) == CellType::gas &&
            fraction_in(domain, domain.centre(cell), {}, region) >= kNegligible)
          return true;
      }
  return false;
}

bool stands_on_wall(const Domain& domain, const LiquidRegion& region) {
  const Vec3i first = domain.cell_at(region.lower), last = domain.cell_at(region.upper);
  constexpr int many = 16;
  for (int z = first.z(); z <= last.z(); z += many)
    for (int y = first.y(); y <= last.y(); y += many)
      for (int x = first.x(); x <= last.x(); x += many) {
        const Vec3i low(x, y, z);
        if (stands_on_wall_in(domain, region, low, last.cwiseMin(low + Vec3i::Constant(many - 1)))) return true;
      }
  return false;
}

/// Whether the boxes around two regions share space, or a face.
bool touch(const LiquidRegion& a, const LiquidRegion& b, double cell_size) {
  return (a.lower.cwiseMax(b.lower) - a.upper.cwiseMin(b.upper)).maxCoeff() <= 1e-6 * cell_size;
}

}  // namespace

std::vector<bool> borne_regions(const Domain& domain, const std::vector<LiquidRegion>& regions) {
  std::vector<bool> borne(regions.size(), false);
  if (domain.period().z() > 0) return borne;
  std::vector<std::size_t> found;  // those whose neighbours have still to be looked at
  for (std::size_t k = 0; k < regions.size(); ++k)
    if (stands_on_wall(domain, regions[k])) borne[k] = true, found.push_back(k);
  while (!found.empty()) {
    const LiquidRegion& region = regions[found.back()];
    found.pop_back();
    for (std::size_t k = 0; k < regions.size(); ++k)
      if (!borne[k] && touch(region, regions[k], domain.cell_size())) borne[k] = true, found.push_back(k);
  }
  return borne;
}

namespace {

/// A cell that a body fills in part.
struct PartOfBody {
  CellPlace place;
  double top;   ///< m, of the body
  double drho;  ///< rho - 1 at its centre
};

/// Fills cells at walls, below the top of a body, that gas cannot reach and that lack less than a quarter: the body
/// ends at the walls, and what distances that are interpolated, or walls that its surface does not quite follow, have
/// left would be a void under the pressure of the liquid. Where it ends farther off there is gas, as where it ends
/// below a lid.
template <class Real>
void fill_up_at_walls(FluidGrid<Real>& grid, const std::vector<PartOfBody>& parts) {
  const double half = (0.5 - 1e-6) * grid.domain().cell_size();
  const auto is_wall = [](CellType t) { return t == CellType::wall; };
  for (const auto& [place, top, drho] : parts) {
    SurfaceFields<Real>& surface = *grid.block(place.block).surface;
    if (surface.fill_level[place.cell] < Real(0.75) || grid.centre(place.block, place.cell).z() + half > top ||
        touches_gas(grid, place) || !touches(grid, place, is_wall))
      continue;
    surface.fill_level[place.cell] = 1;
    surface.mass[place.cell] = static_cast<Real>(1 + drho);
  }
}

}  // namespace

/// The blocks of a box of block coordinates.
template <class Real>
void Fluid<Real>::require_box(const Vec3i& low, const Vec3i& high) {
  std::vector<Vec3i> blocks;
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z) blocks.emplace_back(x, y, z);
  level_.grid.require_blocks(blocks);
}

template <class Real>
void Fluid<Real>::require_neighbours(const std::vector<CellPlace>& cells) {
  std::vector<Vec3i> blocks;
  std::vector<std::uint32_t> missing(level_.grid.topology().capacity(), 0);
  for (const CellPlace& p : cells) missing[static_cast<std::size_t>(p.block)] |= level_.grid.missing_around(p);
  for (const BlockIndex b : level_.grid.owned())
    level_.grid.add_coordinates(b, missing[static_cast<std::size_t>(b)], blocks);
  level_.grid.require_blocks(blocks);
}

template <class Real>
void Fluid<Real>::fill(const std::vector<LiquidRegion>& regions) {
  const double dx = level_.units.cell_size;
  std::vector<BlockIndex> touched;
  std::vector<CellPlace> wet;
  std::vector<const LiquidRegion*> regions_of_wet;
  std::vector<PartOfBody> parts;
  const std::vector<bool> borne = borne_regions(level_.grid.domain(), regions);
  const auto density_at = [&](CellPlace place, const LiquidRegion& region) {
    if (!borne[static_cast<std::size_t>(&region - regions.data())]) return 0.0;
    const Vec3 p = level_.grid.centre(place.block, place.cell);
    return resting_density(p.z(), top_over(p, region, regions, dx), options_.gravity.z(), level_.units);
  };
  for (const auto& region : regions) {
    const std::span<const LiquidRegion> before(regions.data(), &region);
    std::set<BlockIndex> filled;  // along a periodic axis the block beyond the end is the first one again
    const Vec3i low = block_of(level_.grid.domain().cell_at(region.lower)),
                high = block_of(level_.grid.domain().cell_at(region.upper));
    require_box(low, high);
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) {
          const BlockIndex b = level_.grid.topology().find({x, y, z});
          if (!filled.insert(b).second) continue;
          touched.push_back(b);
          for (int n = 0; n < kBlockCells; ++n) {
            Block<Real>& block = level_.grid.block(b);
            CellType& type = block.type[static_cast<std::size_t>(n)];
            if (type == CellType::wall || type == CellType::sink) continue;
            const double fraction = fraction_in(level_.grid.domain(), level_.grid.centre(b, n), before, region);
            if (fraction < kNegligible) continue;
            SurfaceFields<Real>& surface = level_.grid.require_surface(b);
            if (type == CellType::gas) wet.push_back({b, n}), regions_of_wet.push_back(&region);
            type = CellType::interface;
            surface.fill_level[n] = std::min(Real(1), surface.fill_level[n] + static_cast<Real>(fraction));
            const double drho = density_at({b, n}, region);
            surface.mass[n] = surface.fill_level[n] * static_cast<Real>(1 + drho);
            if (region.body && surface.fill_level[n] < 1) parts.push_back({{b, n}, region.upper.z(), drho});
          }
        }
  }
  // Between two steps cells send out what half of a step's weight has been added to: without it water at rest would
  // start with a jolt of g/2 and ring.
  const Vec3 half_force =
      0.5 * Vec3(level_.parameters.gravity[0], level_.parameters.gravity[1], level_.parameters.gravity[2]);
  require_neighbours(wet);
  fill_up_at_walls(level_.grid, parts);
  for (std::size_t k = 0; k < wet.size(); ++k) {
    const CellPlace place = wet[k];
    const LiquidRegion& region = *regions_of_wet[k];
    const double drho = density_at(place, region);
    initialize(place, drho, level_.units.velocity_to_lu(1.0) * region.velocity + half_force);
    SurfaceFields<Real>& surface = *level_.grid.block(place.block).surface;
    surface.density[place.cell] = static_cast<Real>(drho);
  }
  classify_filled(touched);
  for (const BlockIndex b : touched)
    if (level_.grid.block(b).surface) note_densities(level_.grid, b, level_.parity());
  reflect();  // what is on its way into a wall at the start comes back: without it the mass would change
  open_ledger();
}

/// Full cells without a gas neighbour are liquid; all lists are made.
template <class Real>
void Fluid<Real>::classify_filled(std::vector<BlockIndex>& touched) {
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  std::vector<CellPlace> full;
  for (const BlockIndex b : touched) {
    const Block<Real>& block = level_.grid.block(b);
    for (int n = 0; n < kBlockCells; ++n) {
      const auto at = static_cast<std::size_t>(n);
      if (block.type[at] != CellType::interface || block.at_rim[at] || block.surface->fill_level[n] < Real(0.999999))
        continue;
      if (!touches_gas(level_.grid, {b, n})) full.push_back({b, n});
    }
  }
  for (const CellPlace& p : full) {
    level_.grid.block(p.block).type[static_cast<std::size_t>(p.cell)] = CellType::liquid;
    level_.grid.block(p.block).surface->mass[p.cell] = 0;
  }
  for (const BlockIndex b : touched) level_.grid.relist(b);
}

/// Stress after a collision that a velocity field keeps up: (1 - 1/tau) S with S = -2/3 tau D (Chapman-Enskog) and D
/// the deviator of the strain rate, from differences over one cell.
template <class Real>
Mat3 Fluid<Real>::flow_stress(const std::function<Vec3(const Vec3&)>& velocity_lu, const Vec3& centre) const {
  Mat3 gradient;
  for (int a = 0; a < 3; ++a) {
    const Vec3 half = 0.5 * level_.units.cell_size * Vec3::Unit(a);
    gradient.col(a) = velocity_lu(centre + half) - velocity_lu(centre - half);
  }
  const Mat3 strain = 0.5 * (gradient + gradient.transpose());
  return -2.0 / 3.0 * (level_.parameters.tau - 1) * (strain - strain.trace() / 3 * Mat3::Identity());
}

template <class Real>
void Fluid<Real>::fill_everything(const std::function<Vec3(const Vec3&)>& velocity_lu,
                                  const std::function<double(const Vec3&)>& drho, Start start) {
  const Vec3i first = level_.grid.domain().first(), last = first + level_.grid.domain().cells() - Vec3i::Ones();
  const Vec3i low = block_of(first), high = block_of(last);
  std::vector<CellPlace> wet;
  std::vector<BlockIndex> touched;
  require_box(low, high);
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z) {
        const BlockIndex b = level_.grid.topology().find({x, y, z});
        touched.push_back(b);
        for (int n = 0; n < kBlockCells; ++n) {
          CellType& type = level_.grid.block(b).type[static_cast<std::size_t>(n)];
          if (type != CellType::gas) continue;
          type = CellType::liquid;
          wet.push_back({b, n});
        }
      }
  require_neighbours(wet);
  for (const CellPlace& p : wet) {
    const Vec3 centre = level_.grid.centre(p.block, p.cell);
    initialize(p, drho(centre), velocity_lu(centre),
               start == Start::with_stress ? flow_stress(velocity_lu, centre) : Mat3(Mat3::Zero()));
  }
  for (const BlockIndex b : touched) level_.grid.relist(b);
  reflect();
  open_ledger();
}

#define LAHAR_INSTANTIATE(Real)                                                                       \
  template void Fluid<Real>::initialize(CellPlace, double, const Vec3&, const Mat3&);                 \
  template void Fluid<Real>::classify_filled(std::vector<BlockIndex>&);                               \
  template void Fluid<Real>::require_box(const Vec3i&, const Vec3i&);                                 \
  template void Fluid<Real>::require_neighbours(const std::vector<CellPlace>&);                       \
  template Mat3 Fluid<Real>::flow_stress(const std::function<Vec3(const Vec3&)>&, const Vec3&) const; \
  template void Fluid<Real>::fill(const std::vector<LiquidRegion>&);                                  \
  template void Fluid<Real>::fill_everything(const std::function<Vec3(const Vec3&)>&,                 \
                                             const std::function<double(const Vec3&)>&, Start);
LAHAR_INSTANTIATE(float)
LAHAR_INSTANTIATE(double)
#undef LAHAR_INSTANTIATE

}  // namespace lahar::lbm

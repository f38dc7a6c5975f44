#include "lbm/grid/block_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lbm/boundary/row_reflection.h"
#include "lbm/boundary/slip_wall.h"
#include "lbm/grid/mirror_geometry.h"

namespace lahar::lbm {

namespace {

/// Types of a block's cells and of one cell around it; cell (x, y, z) at 100 (x + 1) + 10 (y + 1) + z + 1.
using TypesAround = std::array<CellType, 1000>;

std::size_t link_along(int x, int y, int z) {
  for (std::size_t i = 0; i < D3Q19::q; ++i)
    if (D3Q19::c[i][0] == x && D3Q19::c[i][1] == y && D3Q19::c[i][2] == z) return i;
  return 0;
}

/// The walls that the links of a cell lead into.
struct LinkWalls {
  std::array<int, D3Q19::q> wall_of{};      ///< -1: into none
  std::array<int, D3Q19::q> mirror_axis{};  ///< across which a mirror leads the link to the cell beside, else -1
  std::array<Vec3i, D3Q19::q> stands_at;    ///< the cell as each link sees it
};

/// A slanted link over a mirror is that of the wall below the cell itself, whichever wall it leads into.
void join_mirrors(const Domain& domain, const Vec3i& place, LinkWalls& links) {
  links.mirror_axis.fill(-1);
  for (std::size_t i = 7; i < D3Q19::q; ++i)
    for (int axis = 0; axis < 3 && links.wall_of[i] >= 0; ++axis) {
      const auto* c = D3Q19::c[i];
      if (c[axis] == 0) continue;
      Vec3i into = Vec3i::Zero(), along(c[0], c[1], c[2]);
      into[axis] = c[axis], along[axis] = 0;
      const int below = links.wall_of[link_along(into.x(), into.y(), into.z())];
      if (below < 0 || domain.walls().all()[static_cast<std::size_t>(below)].slip == WallSlip::no_slip ||
          !is_mirror_between(domain, place, along, into))
        continue;
      links.wall_of[i] = below, links.mirror_axis[i] = axis;
    }
}

/// A link into the edge where a no-slip wall meets another one hits both of them there, and liquid may cross neither.
/// The push of a moving wall over its diagonal links is the liquid that it carries along from cell to cell; over the
/// link into the edge it would carry that through the other wall, u/6 a step in at one end and out at the other, which
/// takes as much from the circulation that the wall drives: an error of first order in the cell (docs/decisions/0038).
/// So such a link is the wall's that moves less along it; among walls at rest nothing changes.
void give_corner_links(const Domain& domain, const Vec3i& place, std::array<int, D3Q19::q>& wall_of) {
  const auto& walls = domain.walls().all();
  for (std::size_t i = 1; i < D3Q19::q; ++i) {
    const auto* c = D3Q19::c[i];
    if (wall_of[i] < 0 || std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) < 2) continue;
    const Vec3 way(c[0], c[1], c[2]), hit = domain.centre(place) + 0.5 * domain.cell_size() * way;
    const auto pace = [&](int wall) {
      return std::abs(walls[static_cast<std::size_t>(wall)].surface_velocity(hit).dot(way));
    };
    const int sides[3] = {wall_of[link_along(c[0], 0, 0)], wall_of[link_along(0, c[1], 0)],
                          wall_of[link_along(0, 0, c[2])]};
    int meeting[2] = {-1, -1}, n = 0;
    for (int a = 0; a < 3; ++a)
      if (c[a] != 0) meeting[n++] = sides[a];
    if (meeting[0] < 0 || meeting[1] < 0 || meeting[0] == meeting[1]) continue;
    for (const int wall : meeting)
      if (walls[static_cast<std::size_t>(wall)].slip != WallSlip::wall_model &&
          walls[static_cast<std::size_t>(wall_of[i])].slip == WallSlip::no_slip && pace(wall) < pace(wall_of[i]))
        wall_of[i] = wall;
  }
}

WallHit wall_hit(const Domain& domain, const Wall& wall, const Vec3& from, int i) {
  const Vec3 c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
  const double share = domain.wall_share(from, from + domain.cell_size() * c);
  const Vec3 velocity = wall.surface_velocity(from + share * domain.cell_size() * c);
  return {static_cast<float>(share), static_cast<float>(c.dot(velocity)), 0};
}

/// Among the walls of one cell, one that holds the liquid does so for those in steps along which it would slip: in the
/// seam of the two a cell has few ways out, and a wall that follows its velocity feeds noise there.
void hold_seam(WallLinks& block_links, std::size_t first_of_cell) {
  const auto begin = block_links.cells.begin() + static_cast<std::ptrdiff_t>(first_of_cell);
  if (std::none_of(begin, block_links.cells.end(), [](const WallCell& w) { return w.slip == WallSlip::no_slip; }))
    return;
  std::for_each(begin, block_links.cells.end(), [](WallCell& wall) {
    if (slips_along_steps(wall)) wall.slip = WallSlip::no_slip;
  });
}

/// The walls around a cell; `types` are those of its block.
LinkWalls walls_of_links(const Domain& domain, int cell, const Vec3i& place, const TypesAround& types) {
  const auto p = cell_position(cell);
  LinkWalls links;
  links.wall_of[0] = -1;
  for (std::size_t i = 1; i < D3Q19::q; ++i) {
    const auto* c = D3Q19::c[i];
    const bool solid =
        types[static_cast<std::size_t>(100 * (p[0] + 1 + c[0]) + 10 * (p[1] + 1 + c[1]) + p[2] + 1 + c[2])] ==
        CellType::wall;
    const Vec3i way(c[0], c[1], c[2]), beyond = image_of(domain, place + way);
    links.wall_of[i] = solid ? domain.wall_of(domain.centre(beyond)) : -1;
    links.stands_at[i] = beyond - way;
  }
  give_corner_links(domain, place, links.wall_of);
  join_mirrors(domain, place, links);
  return links;
}

/// Where a cell stands beside a wall. One that is reached only beyond a periodic face is looked at from there.
Vec3i standing_place(const LinkWalls& links, const Vec3i& place, int wall) {
  Vec3i seen_at = place;
  for (std::size_t i = 1; i < D3Q19::q; ++i) {
    if (links.wall_of[i] != wall) continue;
    if (links.stands_at[i] == place) return place;
    seen_at = links.stands_at[i];
  }
  return seen_at;
}

/// Lists those links of a cell into a wall that `chosen(i)` names, as one entry, if there are any.
template <class Chosen>
void add_entry(WallLinks& block_links, const Domain& domain, int cell, int wall, const Vec3& centre, const Vec3& normal,
               const Chosen& chosen) {
  const Wall& w = domain.walls().all()[static_cast<std::size_t>(wall)];
  const Vec3 velocity = w.surface_velocity(centre);
  WallCell entry{
      static_cast<std::uint16_t>(cell),
      static_cast<std::uint16_t>(block_links.directions.size()),
      0,
      w.slip,
      {},
      {},
      {},
      static_cast<float>(domain.walls().distance(static_cast<std::size_t>(wall), centre) / domain.cell_size()),
      static_cast<float>(w.roughness / domain.cell_size()),
      static_cast<std::int16_t>(wall)};
  for (int a = 0; a < 3; ++a) {
    entry.normal[static_cast<std::size_t>(a)] = static_cast<float>(normal[a]);
    entry.surface_velocity[static_cast<std::size_t>(a)] = static_cast<float>(velocity[a]);
  }
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i < D3Q19::q; ++i) {
    if (!chosen(i)) continue;
    ++entry.links;
    sum += D3Q19::w(static_cast<int>(i)) * Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
    block_links.directions.push_back(static_cast<std::uint8_t>(i));
    if (domain.placement() == WallPlacement::interpolated)
      block_links.hits.push_back(wall_hit(domain, w, centre, static_cast<int>(i)));
  }
  if (entry.links == 0) return;
  entry.even = (sum - sum.dot(normal) * normal).norm() < 1e-6;
  block_links.cells.push_back(entry);
}

/// Axis that a wall's normal lies along, -1 if along none.
int axis_along(const Vec3& normal) {
  for (int axis = 0; axis < 3; ++axis)
    if (is_along_axis(static_cast<float>(normal[axis]))) return axis;
  return -1;
}

/// Lists the links of a cell into walls, wall by wall; those that mirrors lead to the cell beside, across another axis
/// than that of the wall's normal at the cell, are entries of their own.
void add_wall_links(WallLinks& block_links, const Domain& domain, int cell, const Vec3i& place,
                    const TypesAround& types) {
  const LinkWalls links = walls_of_links(domain, cell, place, types);
  const std::size_t first_of_cell = block_links.cells.size();
  for (int wall = 0; wall < static_cast<int>(domain.walls().all().size()); ++wall) {
    if (std::count(links.wall_of.begin(), links.wall_of.end(), wall) == 0) continue;
    const Vec3 centre = domain.centre(standing_place(links, place, wall)),
               normal = domain.walls().gradient(static_cast<std::size_t>(wall), centre);
    const int own = axis_along(normal);
    add_entry(block_links, domain, cell, wall, centre, normal, [&](std::size_t i) {
      return links.wall_of[i] == wall && (links.mirror_axis[i] < 0 || links.mirror_axis[i] == own);
    });
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1})
        add_entry(block_links, domain, cell, wall, centre, Vec3(-way * Vec3::Unit(axis)), [&](std::size_t i) {
          return axis != own && links.wall_of[i] == wall && links.mirror_axis[i] == axis && D3Q19::c[i][axis] == way;
        });
  }
  hold_seam(block_links, first_of_cell);
}

}  // namespace

Vec3i image_of(const Domain& domain, Vec3i cell) {
  for (int a = 0; a < 3; ++a)
    if (const int n = kBlockWidth * domain.period()[a]; n > 0) cell[a] = (cell[a] % n + n) % n;
  return cell;
}

template <class Real>
void cut_geometry(Block<Real>& fresh, const Domain& domain, const Vec3i& lowest, double velocity_to_lu) {
  fresh.walls.clear();
  TypesAround types;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y)
      for (int z = 0; z < 10; ++z)
        types[static_cast<std::size_t>(100 * x + 10 * y + z)] =
            domain.classify(image_of(domain, lowest + Vec3i(x - 1, y - 1, z - 1)));
  for (int n = 0; n < kBlockCells; ++n) {
    const auto p = cell_position(n);
    const auto at = [&](int i) {
      return types[static_cast<std::size_t>(100 * (p[0] + 1 + D3Q19::c[i][0]) + 10 * (p[1] + 1 + D3Q19::c[i][1]) +
                                            p[2] + 1 + D3Q19::c[i][2])];
    };
    const auto cell = static_cast<std::size_t>(n);
    fresh.type[cell] = at(0);
    fresh.at_rim[cell] = false;
    if (at(0) != CellType::gas) continue;
    for (int i = 1; i < D3Q19::q; ++i) fresh.at_rim[cell] = fresh.at_rim[cell] || at(i) == CellType::sink;
    add_wall_links(fresh.walls, domain, n, lowest + Vec3i(p[0], p[1], p[2]), types);
  }
  fresh.walls.set_velocities(velocity_to_lu);
  list_row_links(fresh.walls, domain, lowest);
}

template void cut_geometry<float>(Block<float>&, const Domain&, const Vec3i&, double);
template void cut_geometry<double>(Block<double>&, const Domain&, const Vec3i&, double);

}  // namespace lahar::lbm

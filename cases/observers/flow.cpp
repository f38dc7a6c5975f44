#include "cases/observers/flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/parallel.h"

namespace lahar::cases {

namespace {

constexpr std::size_t kWidth = lbm::FluidSnapshot::block_width;

/// Sums over the wet cells of a block, or over columns of them across the flow: by x, from the block's first cell.
struct BlockFigures {
  double kinetic = 0, potential = 0, outflow_power = 0, outflow_kinetic_power = 0, outflow_rate = 0, beyond_outflow = 0;
  Vec3 momentum = Vec3::Zero();
  std::size_t x = 0, y = 0;  ///< of the block's first cell
  /// m^3 of mixture and of liquid, m^4/s of the liquid's volume times velocity.
  std::array<double, kWidth> volume{}, liquid{}, flow{};
  std::array<double, kWidth> foremost{};               ///< m from the domain's end: bed cells more than half full, by y
  std::array<std::array<bool, kWidth>, kWidth> wet{};  ///< columns that hold liquid, by x and y
};

/// The same along the whole channel.
struct Profiles {
  std::vector<double> volume, liquid, flow, foremost;
  std::vector<std::vector<bool>> wet;  ///< columns that hold liquid, by x and y
};

decltype(auto) at(auto& v, std::size_t k) {
  if (k >= v.size()) v.resize(k + 1);
  return v[k];
}

/// What does not change from cell to cell.
struct Look {
  Look(const Observed& observed, const Bed& bed_of_domain)
      : run(observed),
        bed(bed_of_domain),
        dx(observed.scene.fluid.cell_size),
        rho(observed.scene.fluid.density),
        g(observed.scene.gravity.magnitude),
        lower(observed.scene.domain.lower),
        outflow_x(observed.section.value_or(0.0) + observed.scene.measure.outflow_distance),
        outflow_cell(cell_of(run.simulation.fluid()->domain(), outflow_x)) {}

  /// Along x: at the end of the domain the last one.
  static int cell_of(const lbm::Domain& domain, double x) {
    const int last = domain.first().x() + domain.cells().x() - 1;
    return std::min(last, domain.cell_at(Vec3(x, domain.origin().y(), domain.origin().z())).x());
  }

  const Observed& run;
  const Bed& bed;
  double dx, rho, g;
  Vec3 lower;
  double outflow_x;
  int outflow_cell;  ///< of the cells that the outflow section is in

  [[nodiscard]] BlockFigures at_block(std::span<const lbm::WetCell> cells) const {
    BlockFigures f;
    const Vec3i first = run.simulation.fluid()->domain().cell_at(cells.front().centre);
    f.x = static_cast<std::size_t>(first.x()) / kWidth * kWidth;
    f.y = static_cast<std::size_t>(first.y()) / kWidth * kWidth;
    for (const lbm::WetCell& c : cells) add(c, f);
    return f;
  }

  void add(const lbm::WetCell& c, BlockFigures& f) const {
    const Vec3 velocity = run.simulation.liquid_velocity(c);
    const double mass = rho * c.liquid_volume, square = velocity.squaredNorm(), height = run.height(c.centre);
    f.kinetic += 0.5 * mass * square;
    f.potential += mass * g * height;
    f.momentum += mass * velocity;
    const Vec3i cell = run.simulation.fluid()->domain().cell_at(c.centre);
    const std::size_t x = static_cast<std::size_t>(cell.x()) % kWidth, y = static_cast<std::size_t>(cell.y()) % kWidth;
    f.wet[x][y] = true;
    f.volume[x] += c.fill_level * dx * dx * dx;
    f.liquid[x] += c.liquid_volume;
    f.flow[x] += c.liquid_volume * velocity.x();
    if (c.fill_level > 0.5 && bed.holds(cell))
      f.foremost[y] = std::max(f.foremost[y], c.centre.x() + dx / 2 - lower.x());
    if (!run.section) return;
    f.beyond_outflow += mass * std::clamp((c.centre.x() - outflow_x) / dx + 0.5, 0.0, 1.0);
    if (cell.x() == outflow_cell) {
      f.outflow_rate += mass * velocity.x() / dx;
      f.outflow_power += mass * (0.5 * square + g * height) * velocity.x() / dx;
      f.outflow_kinetic_power += mass * 0.5 * square * velocity.x() / dx;
    }
  }
};

/// Over the rows whose bed is wet, or all that hold liquid there where these are more: drops, a heap that falls.
void find_deepest(const Profiles& profile, double dx, std::ptrdiff_t wet_rows, FlowFigures& f) {
  for (std::size_t x = 0; x < profile.volume.size(); ++x) {
    const auto rows = std::max(wet_rows, std::count(profile.wet[x].begin(), profile.wet[x].end(), true));
    const double depth = profile.volume[x] / (dx * dx * static_cast<double>(rows));
    if (depth <= f.deepest || profile.liquid[x] <= 0) continue;
    f.deepest = depth;
    f.deepest_speed = profile.flow[x] / profile.liquid[x];
  }
}

}  // namespace

Bed::Bed(const lbm::Domain& domain) : first_(domain.first()), row_(static_cast<std::size_t>(domain.cells().x())) {
  const Vec3i end = first_ + domain.cells();
  lowest_.resize(row_ * static_cast<std::size_t>(domain.cells().y()));
  parallel_for(0, lowest_.size(), 1024, [&](std::size_t k) {
    Vec3i cell = first_ + Vec3i(static_cast<int>(k % row_), static_cast<int>(k / row_), 0);
    while (cell.z() < end.z() && domain.classify(cell) == lbm::CellType::wall) ++cell.z();
    lowest_[k] = cell.z();
  });
}

FlowFigures look_at_flow(const Observed& run, const Bed& bed) {
  const Look look(run, bed);
  const FluidView& fluid = *run.simulation.fluid();
  std::vector<BlockFigures> blocks(fluid.wet_block_count());
  fluid.for_each_wet_block(
      [&](std::size_t k, std::span<const lbm::WetCell> cells) { blocks[k] = look.at_block(cells); });
  FlowFigures f;
  Profiles profile;
  for (const BlockFigures& block : blocks) {
    f.kinetic += block.kinetic, f.potential += block.potential, f.momentum += block.momentum;
    f.outflow_rate += block.outflow_rate, f.outflow_power += block.outflow_power;
    f.outflow_kinetic_power += block.outflow_kinetic_power, f.beyond_outflow += block.beyond_outflow;
    for (std::size_t k = 0; k < kWidth; ++k) {
      at(profile.volume, block.x + k) += block.volume[k];
      at(profile.liquid, block.x + k) += block.liquid[k];
      at(profile.flow, block.x + k) += block.flow[k];
      std::vector<bool>& wet = at(profile.wet, block.x + k);
      for (std::size_t y = 0; y < kWidth; ++y)
        if (block.wet[k][y]) at(wet, block.y + y) = true;
      double& foremost = at(profile.foremost, block.y + k);
      foremost = std::max(foremost, block.foremost[k]);
    }
  }
  const auto wet_rows = std::count_if(profile.foremost.begin(), profile.foremost.end(), [](double x) { return x > 0; });
  f.front = look.lower.x();
  if (wet_rows == 0) return f;
  for (const double x : profile.foremost) f.front += x / static_cast<double>(wet_rows);
  f.front = std::min(f.front, run.scene.domain.upper.x());  // where that is no whole cell the last one ends beyond it
  find_deepest(profile, look.dx, wet_rows, f);
  return f;
}

Flow::Flow(const Observed& run) : Observer(run), bed_(run.simulation.fluid()->domain()) {
  column("fluid_kinetic_J", "J", "kinetic energy of the liquid", [this] { return now_.kinetic; });
  column("fluid_potential_J", "J",
         "potential energy of the liquid about `measure.energy_datum_z_m` on the measured section",
         [this] { return now_.potential; });
  column("front_x_m", "m", "front of the fluid: mean over the wet width of the foremost bed cell more than half full",
         [this] { return now_.front; });
  if (run.section)
    event("front_arrival_s", "s", "first row with `front_x_m` at the measured section or beyond",
          [this] { return now_.front >= *run_.section ? run_.simulation.time() : kUnknown; });
}

void Flow::sample(double) {
  const lbm::Domain& domain = run_.simulation.fluid()->domain();
  const auto& walls = domain.walls().all();
  const auto open = std::count_if(walls.begin(), walls.end(), [](const Wall& wall) { return wall.open; });
  if (open != open_walls_) bed_ = Bed(domain), open_walls_ = open;
  now_ = look_at_flow(run_, bed_);
}

}  // namespace lahar::cases

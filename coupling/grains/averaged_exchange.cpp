#include "coupling/grains/averaged_exchange.h"

#include <algorithm>
#include <numbers>

#include "core/sphere.h"
#include "coupling/grains/bed_drag.h"
#include "coupling/grains/block_nodes.h"
#include "coupling/grains/sphere_rows.h"
#include "coupling/solid_fields.h"
#include "coupling/transfer_vectors.h"
#include "coupling/yield_drag.h"

namespace lahar::coupling {

using lbm::BlockIndex;
using lbm::kBlockCells;
using lbm::kBlockWidth;

namespace {

/// Spheres do not pack denser; a thin sheet of water around grains has no room for more.
constexpr double kDensest = 0.74;

}  // namespace

template <class Real>
AveragedExchange<Real>::AveragedExchange(const AveragedGrains& options, const lbm::FluidOptions& fluid)
    : options_(options),
      nodes_at_(lbm::Domain(fluid.domain), std::max(options.averaging_length, fluid.domain.cell_size)),
      half_way_(0.5 * nodes_at_.spacing().minCoeff()),
      // Sound takes as long from node to node; what is faster the cells do not know.
      smoothing_(2 * std::numbers::sqrt3 * half_way_) {
  nodes_.resize(nodes_at_.size());
}

template <class Real>
void AveragedExchange<Real>::shape_sphere(double /*radius*/, GridSphere<Real>& sphere) const {
  sphere.surface = -2;
  sphere.reach = covered_reach(sphere);
}

template <class Real>
void AveragedExchange<Real>::prepare(const lbm::Fluid<Real>& /*fluid*/, const dem::Particles& particles,
                                     const GrainMap<Real>& /*map*/) {
  states_.resize(particles.size());
}

template <class Real>
void AveragedExchange<Real>::write_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block) const {
  const lbm::Block<Real>& cells = fluid.grid().block(static_cast<BlockIndex>(block));
  Real* const solid_fraction = cells.body->solid_fraction;
  for (const std::uint32_t k : map.by_block().in(block)) {
    const GrainInBlock& pair = map.pairs()[k];
    for_covered_rows(map.sphere(pair.grain), pair.lowest,
                     [&](int row, const Row<Real>& eps) { add_to_row(solid_fraction + row, eps); });
  }
  cells.body->fills_with_level = true;
  if (cells.wet_cells == kBlockCells && !cells.surface) return;
  for (int row = 0; row < kBlockCells / kBlockWidth; ++row)
    update_row(solid_fraction + kBlockWidth * row, [&](const Row<Real>& eps) { return eps * water_in(cells, row); });
}

template <class Real>
void AveragedExchange<Real>::look(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map,
                                  const DisplacedVolume<Real>& displaced, const dem::Particles& particles) {
  grains_.clear();
  find_wet_grains(fluid, map, displaced, particles);
  if (options_.beads_as_grains) find_wet_beads(fluid, particles);
  parallel_for(0, grains_.size(), 16, [&](std::size_t k) { share_among_nodes(fluid, map, grains_[k]); });
  std::erase_if(grains_, [&](const WetGrain& grain) {  // of none is the wet share but rounding
    if (grain.shares.empty()) states_[grain.id].known = false;
    return grain.shares.empty();
  });
  wet_beads_ = static_cast<std::size_t>(
      std::count_if(grains_.begin(), grains_.end(), [](const WetGrain& grain) { return !grain.in_cells; }));
  velocity_unit_ = fluid.units().velocity_to_si(1.0);
  choose_nodes(fluid);
  average_fluid(fluid);
  average_grains(fluid, particles);
}

template <class Real>
ExchangedMomentum AveragedExchange<Real>::give_impulses(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map,
                                                        const DisplacedVolume<Real>& displaced,
                                                        dem::Particles& particles, SolidFields<Real>& fields) {
  look(fluid, map, displaced, particles);
  const double stretch = fluid.plan_time_step() / fluid.units().time_step;
  parallel_for(0, grains_.size(), 64, [&](std::size_t k) { act_on(fluid, stretch, grains_[k], particles); });
  ExchangedMomentum sum;
  for (const WetGrain& grain : grains_) {
    for (const AveragingGrid::Share& s : grain.answers) nodes_[s.node].impulse += s.weight * grain.impulse;
    sum.to_solids += grain.taken;
  }
  sum.from_fluid = -push_cells(fluid, fields);
  return sum;
}

template <class Real>
void AveragedExchange<Real>::find_wet_grains(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map,
                                             const DisplacedVolume<Real>& displaced, const dem::Particles& particles) {
  for (std::size_t k = 0; k < map.grains().size(); ++k) {
    const MappedGrain& g = map.grains()[k];
    const double wet = displaced.wet_volume_of(g);
    State& state = states_[g.id];
    if (wet <= 0) {
      state.known = false;
      continue;
    }
    const Vec3 place =
        (particles.position[particles.index(g.id)] - fluid.grid().domain().origin()) / fluid.units().cell_size;
    grains_.push_back(
        {.id = g.id, .place = place, .wet = wet, .in_cells = true, .handed = displaced.handed_by(g), .mapped = k});
  }
}

/// A bead is as wet as the cell that it is in.
template <class Real>
void AveragedExchange<Real>::find_wet_beads(const lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  const auto& grid = fluid.grid();
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    const dem::ParticleIndex i = particles.index(id);
    if (particles.kind[i] != dem::ParticleKind::bead) continue;
    const Vec3 place = (particles.position[i] - grid.domain().origin()) / fluid.units().cell_size;
    const Vec3i cell = place.array().floor().cast<int>();
    const BlockIndex b = grid.topology().find(lbm::block_of(cell));
    double share = 0;
    if (b != lbm::kNoBlock && grid.block(b).wet_cells > 0) {
      const Row<Real> water = water_in(grid.block(b), (cell.y() & 7) + 8 * (cell.z() & 7));
      share = static_cast<double>(static_cast<Real>(water[static_cast<std::size_t>(cell.x() & 7)]));
    }
    if (share <= 0) {
      states_[id].known = false;
      continue;
    }
    const double volume = sphere_volume(particles.radius[i] / fluid.units().cell_size);
    grains_.push_back({.id = id, .place = place, .wet = share * volume, .in_cells = false});
  }
}

/// A grain is where the water in its place is; a bead, in the cell that it is in.
template <class Real>
void AveragedExchange<Real>::share_among_nodes(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map,
                                               WetGrain& grain) const {
  const auto add = [&](std::size_t node, double weight) {
    if (weight <= 0) return;
    const auto known =
        std::find_if(grain.shares.begin(), grain.shares.end(), [&](const auto& s) { return s.node == node; });
    if (known == grain.shares.end())
      grain.shares.push_back({node, weight});
    else
      known->weight += weight;
  };
  if (!grain.in_cells) {
    const Vec3 centre = grain.place.array().floor() + 0.5;
    return nodes_at_.around(centre, add);
  }
  const MappedGrain& mapped = map.grains()[grain.mapped];
  for (std::size_t p = mapped.first_pair; p < mapped.first_pair + mapped.pairs; ++p) {
    const GrainInBlock& pair = map.pairs()[p];
    const lbm::Block<Real>& block = fluid.grid().block(pair.block);
    const BlockNodes<Real> nodes(nodes_at_, pair.lowest);
    std::vector<Row<Real>> rows(static_cast<std::size_t>(nodes.count.y() * nodes.count.z()), Row<Real>(0));
    for_covered_rows(map.sphere(pair.grain), pair.lowest, [&](int first, const Row<Real>& eps) {
      const int row = first / kBlockWidth;
      const Row<Real> water = eps * water_in(block, row);
      nodes.around_row(row & 7, row >> 3, [&](int j, int k, Real weight) {
        rows[static_cast<std::size_t>(j * nodes.count.z() + k)] += weight * water;
      });
    });
    nodes.for_nodes([&](int x, int y, int z) {
      double sum = 0;
      for (int c = 0; c < kBlockWidth; ++c) {
        const int up = x - nodes.below[0][c];
        if (up < 0 || up > 1) continue;
        sum += static_cast<double>(
            nodes.weight[0][up][c] *
            static_cast<Real>(rows[static_cast<std::size_t>(y * nodes.count.z() + z)][static_cast<std::size_t>(c)]));
      }
      add(nodes_at_.index(nodes.lowest + Vec3i(x, y, z)), sum);
    });
  }
  double sum = 0;
  for (const AveragingGrid::Share& s : grain.shares) sum += s.weight;
  for (AveragingGrid::Share& s : grain.shares) s.weight /= sum;
}

/// Nodes around wet grains, and the wet blocks that have a part in them.
template <class Real>
void AveragedExchange<Real>::choose_nodes(const lbm::Fluid<Real>& fluid) {
  std::fill(nodes_.begin(), nodes_.end(), Node{});
  for (WetGrain& grain : grains_) {
    std::size_t n = 0;
    nodes_at_.around(grain.place, [&](std::size_t node, double weight) { grain.answers[n++] = {node, weight}; });
    nodes_at_.within(grain.place, half_way_, [&](std::size_t node) { nodes_[node].used = true; });
    for (const AveragingGrid::Share& s : grain.shares) nodes_[s.node].used = true;
  }
  blocks_.clear();
  const auto& grid = fluid.grid();
  for (const BlockIndex b : grid.owned()) {
    if (grid.block(b).wet_cells == 0) continue;
    const BlockNodes<Real> nodes(nodes_at_, grid.lowest_cell(b));
    bool used = false;
    nodes.for_nodes(
        [&](int x, int y, int z) { used = used || nodes_[nodes_at_.index(nodes.lowest + Vec3i(x, y, z))].used; });
    if (used) blocks_.push_back(b);
  }
}

template <class Real>
void AveragedExchange<Real>::average_fluid(const lbm::Fluid<Real>& fluid) {
  const auto& grid = fluid.grid();
  std::vector<std::vector<WaterSum>> sums(blocks_.size());
  parallel_for(0, blocks_.size(), 4, [&](std::size_t k) {
    sums[k] = sum_water(grid, blocks_[k], fluid.parity(), BlockNodes<Real>(nodes_at_, grid.lowest_cell(blocks_[k])));
  });
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockNodes<Real> nodes(nodes_at_, grid.lowest_cell(blocks_[k]));
    nodes.for_nodes([&](int x, int y, int z) {
      Node& node = nodes_[nodes_at_.index(nodes.lowest + Vec3i(x, y, z))];
      const auto& s = sums[k][nodes.at(x, y, z)].sum;
      node.water += s[0], node.water_momentum += Vec3(s[1], s[2], s[3]);
    });
  }
}

/// What moves in the grains' place moves as they did one step ago, when the cells were last told. What cells get of a
/// grain goes by the water at the nodes, too: cells with little water keep less than their part of a large impulse (a
/// sheet that runs into a bed lost 3 % of its momentum).
template <class Real>
void AveragedExchange<Real>::average_grains(const lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  for (WetGrain& grain : grains_) {
    double sum = 0;
    for (AveragingGrid::Share& s : grain.answers) sum += s.weight *= nodes_[s.node].water;
    for (AveragingGrid::Share& s : grain.answers) s.weight = sum > 0 ? s.weight / sum : 0.0;
    if (!grain.in_cells) continue;
    const State& state = states_[grain.id];
    const Vec3 now = particles.velocity[particles.index(grain.id)];
    const Vec3 velocity = (state.known ? state.velocity : now) * fluid.units().velocity_to_lu(1.0);
    for (const AveragingGrid::Share& s : grain.shares) {
      nodes_[s.node].solid += s.weight * grain.wet;
      nodes_[s.node].solid_momentum += s.weight * grain.wet * velocity;
    }
  }
}

template <class Real>
auto AveragedExchange<Real>::look_around(const lbm::Fluid<Real>& fluid, const WetGrain& grain) const -> Surroundings {
  double phi = 0;
  Vec3 mixture = Vec3::Zero(), of_grains = Vec3::Zero();
  for (const AveragingGrid::Share& s : grain.shares) {
    const Node& node = nodes_[s.node];
    if (node.water <= 0) continue;
    phi += s.weight * node.solid / node.water;
    mixture += s.weight / node.water * node.water_momentum;
    of_grains += s.weight / node.water * node.solid_momentum;
  }
  const double held = phi > kDensest ? kDensest / phi : 1.0;
  const Vec3 liquid = (mixture - held * of_grains) / (1 - held * phi);
  return {held * phi, held, liquid * fluid.units().velocity_to_si(1.0)};
}

template <class Real>
std::optional<Vec3> AveragedExchange<Real>::liquid_at(const Vec3& place) const {
  double water = 0;
  Vec3 sum = Vec3::Zero();
  nodes_at_.around(place, [&](std::size_t n, double weight) {
    const Node& node = nodes_[n];
    if (node.water <= 0) return;
    const double held = node.solid > kDensest * node.water ? kDensest * node.water / node.solid : 1.0;
    const Vec3 liquid = (node.water_momentum - held * node.solid_momentum) / (node.water - held * node.solid);
    water += weight * node.water, sum += weight * node.water * liquid;
  });
  if (water <= 0) return std::nullopt;
  return Vec3(sum / water);
}

/// One-sided where there is no water on the other side.
template <class Real>
Vec3 AveragedExchange<Real>::convective_acceleration(const LatticeUnits& units, const Vec3& place,
                                                     const Vec3& slip) const {
  const double speed = slip.norm();
  if (speed <= 0) return Vec3::Zero();
  const Vec3 step = half_way_ / speed * slip;
  const std::optional<Vec3> ahead = liquid_at(place + step), behind = liquid_at(place - step);
  const std::optional<Vec3> here = ahead && behind ? std::nullopt : liquid_at(place);
  const auto change = [&](const std::optional<Vec3>& from, const std::optional<Vec3>& to, double way) {
    return from && to ? Vec3((*to - *from) * (speed * units.velocity_to_si(1.0) / (way * units.cell_size)))
                      : Vec3(Vec3::Zero());
  };
  if (ahead && behind) return change(behind, ahead, 2 * half_way_);
  return ahead ? change(here, ahead, half_way_) : change(behind, here, half_way_);
}

template <class Real>
Vec3 AveragedExchange<Real>::liquid_velocity(const Vec3& place, const Vec3& sampled) const {
  double near = 0, phi = 0;
  Vec3 of_grains = Vec3::Zero();
  nodes_at_.around(place, [&](std::size_t n, double weight) {
    const Node& node = nodes_[n];
    if (node.water <= 0) return;
    near += weight, phi += weight * node.solid / node.water;
    of_grains += weight / node.water * node.solid_momentum;
  });
  if (phi <= 0) return sampled;
  const double held = std::min(1.0, kDensest * near / phi) / near;
  return (sampled - held * of_grains) / (1 - held * phi);
}

/// The cells were last told of the grains' velocity before the solids' step. What was not wet then came with its own.
template <class Real>
Vec3 AveragedExchange<Real>::flow_in_cells(const GrainMap<Real>& map, const DisplacedVolume<Real>& displaced,
                                           const dem::Particles& particles) const {
  Vec3 sum = Vec3::Zero();
  for (const MappedGrain& g : map.grains()) {
    const State& state = states_[g.id];
    const Vec3 velocity = state.known ? state.velocity : particles.velocity[particles.index(g.id)];
    sum += displaced.wet_volume_of(g) * velocity;
  }
  return sum;
}

template <class Real>
void AveragedExchange<Real>::act_on(const lbm::Fluid<Real>& fluid, double stretch, WetGrain& grain,
                                    dem::Particles& particles) {
  const auto& units = fluid.units();
  const dem::ParticleIndex i = particles.index(grain.id);
  const Surroundings around = look_around(fluid, grain);
  const double rho = fluid.options().density, dt = units.time_step, radius = particles.radius[i];
  const double cell = units.cell_size * units.cell_size * units.cell_size;
  const double volume = around.held * grain.wet * cell;
  State& state = states_[grain.id];
  const Vec3 liquid_velocity = state.known ? Vec3(0.5 * (around.liquid + state.sampled)) : around.liquid;
  const Vec3 velocity = particles.velocity[i], slip = liquid_velocity - velocity;
  const double beta =
      std::min(1.0, volume / sphere_volume(radius)) *
      bed_drag(options_.drag, {.diameter = 2 * radius,
                               .solid_fraction = around.solid_fraction,
                               .speed = slip.norm(),
                               .density = rho,
                               .viscosity = viscosity_past_sphere(
                                   lbm::shear_law(fluid.options().rheology, fluid.options().kinematic_viscosity, rho),
                                   2 * radius, slip.norm())});
  const double liquid = rho * volume * (1 - around.solid_fraction) / std::max(around.solid_fraction, 1e-6);
  const double mass = 1 / (particles.inverse_mass[i] + 1 / liquid);  // that a change of the slip moves
  const double wet = grain.wet * cell;
  // Of the momentum in the grain's place: its wet volume has grown by what was handed out for it.
  const Vec3 before = state.known ? state.velocity : velocity;
  const double to_kg = units.mass();
  const Vec3 change = rho * wet * (velocity - before) + to_kg * grain.handed.mass * before;
  if (state.known) {
    const Vec3 along_its_way = (liquid_velocity - state.liquid) / dt,
               past_it = convective_acceleration(units, grain.place, slip);
    state.acceleration += (along_its_way + past_it - state.acceleration) / smoothing_;
  } else {
    state.acceleration = Vec3::Zero();
    state.slip.forget();
  }
  state.slip.begin(slip);
  const Vec3 drag = mass * state.slip.drag(beta * dt / mass);  // N s
  state.slip.stretch(stretch);
  state.velocity = velocity, state.sampled = around.liquid, state.liquid = liquid_velocity;
  state.known = true;

  const Vec3 accelerated = rho * volume * dt * state.acceleration;
  const Vec3 weight = rho * wet * dt * fluid.options().gravity;  // of the liquid in its place
  const Vec3 force = (drag + accelerated - weight) / dt;
  particles.external_force.add(i, force);
  // Forces act over the coming step, and the fluid stretches what cells get to it; what has changed has changed.
  const Vec3 own =
      grain.in_cells ? Vec3((change - to_kg * units.velocity_to_si(1.0) * grain.handed.momentum) / stretch) : weight;
  grain.impulse = (own - drag - accelerated) * (units.force_to_lu(1.0) / dt);
  grain.taken = (force + (weight - own) / dt) * units.force_to_lu(1.0);
}

template <class Real>
Vec3 AveragedExchange<Real>::push_cells(lbm::Fluid<Real>& fluid, SolidFields<Real>& fields) {
  auto& grid = fluid.grid();
  for (const BlockIndex b : blocks_) {
    fields.reach(grid, b);
    grid.require_impulse(b);
  }
  return ordered_sum<Vec3>(
      blocks_.size(),
      [&](std::size_t k) {
        const BlockNodes<Real> nodes(nodes_at_, grid.lowest_cell(blocks_[k]));
        std::vector<Vec3> acceleration(nodes.size());
        nodes.for_nodes([&](int x, int y, int z) {
          const Node& node = nodes_[nodes_at_.index(nodes.lowest + Vec3i(x, y, z))];
          acceleration[nodes.at(x, y, z)] = node.water > 0 ? Vec3(node.impulse / node.water) : Vec3(Vec3::Zero());
        });
        return add_impulses(grid.block(blocks_[k]), nodes, acceleration);
      },
      4, Vec3(Vec3::Zero()));
}

template <class Real>
void AveragedExchange<Real>::transfer(Archive& archive) {
  std::size_t particles = states_.size();
  archive.value("particles", particles);
  archive.value("velocity_unit", velocity_unit_);
  archive.value("wet_beads", wet_beads_);
  states_.resize(particles);
  constexpr std::size_t of_slip = DraggedSlip::kNumbers;
  archive.pieces<double>("grain", particles, 13 + of_slip, [&](std::size_t k, double* stored) {
    State& s = states_[k];
    transfer_vectors(archive, {&s.velocity, &s.sampled, &s.liquid, &s.acceleration}, stored);
    if (archive.loading())
      s.known = stored[12] != 0, s.slip.load(stored + 13);
    else
      stored[12] = s.known ? 1 : 0, s.slip.store(stored + 13);
  });
  archive.pieces<double>("node", nodes_.size(), 5, [&](std::size_t k, double* stored) {  // what liquid_velocity reads
    Node& node = nodes_[k];
    const std::array<double*, 5> numbers{&node.water, &node.solid, &node.solid_momentum.x(), &node.solid_momentum.y(),
                                         &node.solid_momentum.z()};
    for (std::size_t n = 0; n < numbers.size(); ++n)
      archive.loading() ? *numbers[n] = stored[n] : stored[n] = *numbers[n];
  });
}

template class AveragedExchange<float>;
template class AveragedExchange<double>;

}  // namespace lahar::coupling

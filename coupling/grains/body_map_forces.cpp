// Force and torque of the fluid on the bodies.
#include <cstdio>

#include "core/check.h"
#include "coupling/grains/body_map_parts.h"
#include "coupling/grains/body_rows.h"
#include "coupling/grains/followed_force.h"

namespace lahar::coupling {

using lbm::kBlockWidth;

namespace {

[[noreturn]] void report_bad_force(const dem::Particles& particles, dem::ParticleIndex i, std::int64_t step) {
  const Vec3 p = particles.position[i];
  char where[112];
  std::snprintf(where, sizeof where, "grain %u at (%.4g, %.4g, %.4g) m", i, p.x(), p.y(), p.z());
  throw NumericalFailure(where, step, "the force of the fluid on it is not finite");
}

/// Sums over the rows of a block, one for each of the 8 places in a row; arms from the body's centre.
template <class Real>
struct RowSums {
  using Row = lbm::Row<Real>;
  Row force[3]{Row(0), Row(0), Row(0)};
  Row y_fx{0}, z_fx{0}, z_fy{0}, y_fz{0};  ///< moments by the arms along y and z
  Row inside{0}, inside_arm{0};            ///< liquid in the body's place; times the squared arm across x
  Row held{0}, held_arm{0};                ///< liquid that a step brings to the body's velocity; the same

  [[gnu::always_inline]] void add(const Row& share, const lbm::BodyFields<Real>& f, int row, Real ry, Real rz) {
    const Row fx = share * Row(f.exchange_x + row, stdx::vector_aligned);
    const Row fy = share * Row(f.exchange_y + row, stdx::vector_aligned);
    const Row fz = share * Row(f.exchange_z + row, stdx::vector_aligned);
    force[0] += fx, force[1] += fy, force[2] += fz;
    y_fx += ry * fx, z_fx += rz * fx, z_fy += rz * fy, y_fz += ry * fz;
  }
  [[gnu::always_inline]] void hold(const Row& in_place, const Row& moved, Real ry, Real rz) {
    const Real square = ry * ry + rz * rz;
    inside += in_place, inside_arm += square * in_place;
    held += moved, held_arm += square * moved;
  }

  /// `rx`: arms along x. Sets force, torque, inside and held, and these times 2/3 of the squared arm.
  template <class Load>
  [[gnu::always_inline]] void reduce(const Row& rx, Load& load) const {
    const auto sum = [](const Row& row) { return static_cast<double>(stdx::reduce(row)); };
    load.force = Vec3(sum(force[0]), sum(force[1]), sum(force[2]));
    load.torque = Vec3(sum(y_fz - z_fy), sum(z_fx - rx * force[2]), sum(rx * force[1] - y_fx));
    load.inside = sum(inside), load.inside_inertia = 2.0 / 3.0 * sum(inside_arm + rx * rx * inside);
    load.held = sum(held), load.held_inertia = 2.0 / 3.0 * sum(held_arm + rx * rx * held);
  }
};

/// What all bodies of a block look at.
template <class Real>
struct BlockCover {
  const lbm::BodyFields<Real>& fields;
  const Real* wet;     ///< 1 or 0 for each cell; null where all of the block is wet
  const Real* weight;  ///< B of each cell
};

/// B of every cell of a block, once for all bodies that cover it.
template <class Real>
void coverage_weights(const lbm::BodyFields<Real>& f, const lbm::CoverageLaw& law, Real* weights) {
  using Row = lbm::Row<Real>;
  const auto row = [](double x) { return Row(static_cast<Real>(x)); };
  const Row alpha = row(law.alpha), beta = row(law.beta), gamma = row(law.gamma), cap = row(law.cap),
            largest = row(law.largest);
  for (int n = 0; n < lbm::kBlockCells; n += kBlockWidth)
    lbm::coverage_weight(Row(f.resistance + n, stdx::vector_aligned), alpha, beta, gamma, cap, largest)
        .copy_to(weights + n, stdx::vector_aligned);
}

/// Sums of a body over a block; s is its middle. With `kByDistance` eps of the liquid stands in the body's place, else
/// what a step brings to its velocity. `kMixed`: some cells are dry.
template <class Real, bool kByDistance, bool kMixed, class Body, class Load>
[[gnu::noinline]] void sum_rows(const Body body, const GridSphere<Real> s, const Vec3i lowest,
                                const BlockCover<Real> block, Load& load) {
  using Row = lbm::Row<Real>;
  RowSums<Real> sums;
  for_rows_near(
      body, lowest, reach_of(body), [&](int y, int z) __attribute__((always_inline)) {
        const RowCover<Real> cover = cover_row<kByDistance>(body, lowest.x(), lowest.y() + y, lowest.z() + z);
        const int row = lbm::cell_index(0, y, z);
        const Real ry = static_cast<Real>(lowest.y() + y) + Real(0.5) - s.centre[1];
        const Real rz = static_cast<Real>(lowest.z() + z) + Real(0.5) - s.centre[2];
        const Row all(block.fields.coverage + row, stdx::vector_aligned);
        const Row share = cover.coverage / stdx::max(all, Row(Real(1e-30)));
        sums.add(share, block.fields, row, ry, rz);
        Row held = share * Row(block.weight + row, stdx::vector_aligned), inside = held;
        if constexpr (kByDistance) inside = cover.fraction;
        if constexpr (kMixed) {
          const Row liquid(block.wet + row, stdx::vector_aligned);
          held *= liquid, inside *= liquid;
        }
        sums.hold(inside, held, ry, rz);
      });
  sums.reduce(static_cast<Real>(lowest.x()) + row_places<Real>() + Real(0.5) - s.centre[0], load);
}

template <class Real, bool kByDistance, class Load>
void sum_over(const GridSphere<Real>& s, const Vec3i& lowest, const BlockCover<Real>& block, Load& load) {
  if (block.wet)
    sum_rows<Real, kByDistance, true>(s, s, lowest, block, load);
  else
    sum_rows<Real, kByDistance, false>(s, s, lowest, block, load);
}

}  // namespace

template <class Real>
void BodyMap<Real>::add_loads(const lbm::Fluid<Real>& fluid, std::size_t index) {
  const auto pairs = pairs_of(block_start_, index);
  prefetch(pairs);
  if (!is_alive(fluid, pairs_[pairs.front()])) {
    for (const std::uint32_t k : pairs) loads_[k] = {};
    return;
  }
  const lbm::Block<Real>& block = fluid.grid().block(static_cast<lbm::BlockIndex>(index));
  alignas(64) Real mask[lbm::kBlockCells], weights[lbm::kBlockCells];
  const Real* const wet = block.wet_cells < lbm::kBlockCells ? mask : nullptr;
  for (std::size_t n = 0; wet && n < lbm::kBlockCells; ++n) mask[n] = lbm::is_wet(block.type[n]) ? Real(1) : Real(0);
  coverage_weights(*block.body, fluid.coverage_law(), weights);
  const BlockCover<Real> cover{*block.body, wet, weights};
  const bool by_distance = fluid.options().weighting == lbm::BodyWeighting::wall_distance;
  for (const std::uint32_t k : pairs) {
    const GridSphere<Real>& s = spheres_[pairs_[k].body];
    if (by_distance)
      sum_over<Real, true>(s, pairs_[k].lowest, cover, loads_[k]);
    else
      sum_over<Real, false>(s, pairs_[k].lowest, cover, loads_[k]);
  }
}

namespace {

/// Inertia of the liquid in a body's place that the body gets back, at most what the exchange holds: a body of a cell
/// or two holds less than its volume, and what it got back beyond that would drive itself. With other weightings than
/// wall_distance a light body gets back no more than a share of its own, and none has its spin driven by more than its
/// own inertia (docs/decisions/0034).
constexpr double kShareOfOwn = 0.7;

double liquid_given_back(double inside, double held, double own, lbm::BodyWeighting weighting) {
  const double most = weighting == lbm::BodyWeighting::wall_distance ? held : std::min(held, kShareOfOwn * own);
  return std::min(inside, most);
}

}  // namespace

/// The exchange also accelerates the liquid that stands in the body's place; that part is no load on the body (Feng &
/// Michaelides 2009; Uhlmann 2005). The weight of that liquid is carried by the fluid: the body's buoyancy.
template <class Real>
void BodyMap<Real>::hand_over(const lbm::Fluid<Real>& fluid, dem::Particles& particles, std::size_t k) {
  const auto& units = fluid.units();
  const Body& b = bodies_[k];
  Load sum;
  double wet = 0;
  for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) {
    sum.force += loads_[p].force;
    sum.torque += loads_[p].torque;
    sum.inside += loads_[p].inside, sum.inside_inertia += loads_[p].inside_inertia;
    sum.held += loads_[p].held, sum.held_inertia += loads_[p].held_inertia;
    wet += pairs_[p].wet_volume;
  }
  forces_[k] = sum.force;
  const Vec3 gravity = fluid.options().gravity * units.acceleration_to_lu(1.0);
  const dem::ParticleIndex i = b.particle;
  const double to_kg = units.mass(), to_kg_m2 = to_kg * units.cell_size * units.cell_size;
  const double given_back =
      liquid_given_back(sum.inside, sum.held, particles.mass[i] / to_kg, fluid.options().weighting);
  Vec3 force = sum.force + given_back * units.acceleration_to_lu(1.0) * b.acceleration - wet * gravity;
  const double spun = std::min({sum.inside_inertia, sum.held_inertia, particles.inertia[i] / to_kg_m2});
  Vec3 torque = sum.torque + spun * units.time_step * units.time_step * b.spin_up;
  force *= units.force_to_si(1.0), torque *= units.torque_to_si(1.0);
  follow(felt_force_[i], force, followed_share(particles.mass[i], to_kg * sum.held), sum.held > 0);
  // About any axis the liquid held has at most 3/2 of the mean over axes.
  follow(felt_torque_[i], torque, followed_share(particles.inertia[i], 1.5 * to_kg_m2 * sum.held_inertia),
         sum.held > 0);
  particles.external_force.add(i, felt_force_[i]);
  particles.external_torque.add(i, felt_torque_[i]);
}

template <class Real>
Vec3 BodyMap<Real>::add_forces(lbm::Fluid<Real>& fluid, dem::Particles& particles) {
  loads_.resize(pairs_.size()), forces_.resize(bodies_.size());
  for_each_block([&](std::size_t b) { add_loads(fluid, b); });
  parallel_for(0, bodies_.size(), 256, [&](std::size_t k) { hand_over(fluid, particles, k); });
  Vec3 total = Vec3::Zero();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (!particles.external_force[bodies_[k].particle].allFinite())
      report_bad_force(particles, bodies_[k].particle, fluid.steps());
    total += forces_[k];
  }
  return total;
}

template void BodyMap<float>::add_loads(const lbm::Fluid<float>&, std::size_t);
template void BodyMap<double>::add_loads(const lbm::Fluid<double>&, std::size_t);
template void BodyMap<float>::hand_over(const lbm::Fluid<float>&, dem::Particles&, std::size_t);
template void BodyMap<double>::hand_over(const lbm::Fluid<double>&, dem::Particles&, std::size_t);
template Vec3 BodyMap<float>::add_forces(lbm::Fluid<float>&, dem::Particles&);
template Vec3 BodyMap<double>::add_forces(lbm::Fluid<double>&, dem::Particles&);

}  // namespace lahar::coupling

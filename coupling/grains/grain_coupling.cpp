#include "coupling/grains/grain_coupling.h"

#include "core/check.h"
#include "coupling/bad_force.h"

namespace lahar::coupling {

template <class Real>
GrainCoupling<Real>::GrainCoupling(std::unique_ptr<GrainExchange<Real>> exchange)
    : exchange_(std::move(exchange)), displaced_(exchange_ && exchange_->fills_with_level()) {
  require(exchange_ != nullptr, "GrainCoupling: no exchange of momentum");
}

template <class Real>
void GrainCoupling<Real>::embed(lbm::Fluid<Real>& fluid, const dem::Particles& particles, SolidFields<Real>& fields) {
  require(map_.grains().empty(), "GrainCoupling::embed: grains are mapped already");
  write(fluid, particles, fields);
  exchange_->look(fluid, map_, displaced_, particles);
}

template <class Real>
void GrainCoupling<Real>::update(lbm::Fluid<Real>& fluid, const dem::Particles& particles, SolidFields<Real>& fields) {
  displaced_.measure_former(fluid, map_);
  write(fluid, particles, fields);
  displaced_.book(fluid, map_);
}

template <class Real>
void GrainCoupling<Real>::write(lbm::Fluid<Real>& fluid, const dem::Particles& particles, SolidFields<Real>& fields) {
  map_.update(fluid, particles,
              [&](double radius, GridSphere<Real>& sphere) { exchange_->shape_sphere(radius, sphere); });
  exchange_->prepare(fluid, particles, map_);
  displaced_.begin(map_);
  choose_blocks(fluid.grid(), fields);
  map_.by_block().for_each_block([&](std::size_t b) {
    map_.prefetch(map_.by_block().in(b));
    if (written_[b]) {
      clear_solids(*fluid.grid().block(static_cast<lbm::BlockIndex>(b)).body);
      exchange_->write_block(fluid, map_, b);
    }
    displaced_.measure_block(fluid, map_, b);
  });
}

/// Where grains are, and where they were and are no more; a block keeps what its grains would write again.
template <class Real>
void GrainCoupling<Real>::choose_blocks(lbm::FluidGrid<Real>& grid, SolidFields<Real>& fields) {
  using Writer = typename SolidFields<Real>::Writer;
  written_.assign(map_.by_block().blocks(), 0);
  for (const lbm::BlockIndex b : grid.owned()) {
    const auto at = static_cast<std::size_t>(b);
    if (map_.by_block().any_in(at)) {
      fields.reach(grid, b);
      written_[at] = fields.writer(b) != Writer::grains || exchange_->fills_with_level() || !map_.is_unchanged(at);
      fields.set_writer(b, Writer::grains);
    } else if (fields.writer(b) == Writer::grains) {
      clear_solids(*grid.block(b).body);
      fields.set_writer(b, Writer::none);
    }
  }
}

template <class Real>
Vec3 GrainCoupling<Real>::add_forces(const lbm::Fluid<Real>& fluid, dem::Particles& particles) {
  const auto& grains = map_.grains();
  taken_.resize(grains.size());
  map_.by_block().for_each_block([&](std::size_t b) {
    map_.prefetch(map_.by_block().in(b));
    exchange_->gather_block(fluid, map_, b);
  });
  parallel_for(0, grains.size(), 256, [&](std::size_t k) {
    taken_[k] = exchange_->finish(fluid, map_, k, displaced_.wet_volume_of(grains[k]), particles);
  });
  Vec3 total = Vec3::Zero();
  for (std::size_t k = 0; k < grains.size(); ++k) {
    require_finite_force(particles, particles.index(grains[k].id), "grain", fluid.steps());
    total += taken_[k];
  }
  return total;
}

template <class Real>
std::size_t GrainCoupling<Real>::written_blocks() const {
  return static_cast<std::size_t>(std::count(written_.begin(), written_.end(), std::uint8_t{1}));
}

template <class Real>
void GrainCoupling<Real>::transfer(Archive& archive) {
  archive.part("map", map_);
  archive.part("displaced", displaced_);
  archive.part("exchange", *exchange_);
}

template class GrainCoupling<float>;
template class GrainCoupling<double>;

}  // namespace lahar::coupling

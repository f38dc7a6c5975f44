#pragma once
// Grains in the fluid: their map, the ledger of what they displace, and the exchange of momentum that the scene chose.
#include "coupling/grains/displaced_volume.h"
#include "coupling/grains/grain_exchange.h"
#include "coupling/solid_fields.h"

namespace lahar::coupling {

template <class Real>
class GrainCoupling {
 public:
  explicit GrainCoupling(std::unique_ptr<GrainExchange<Real>> exchange);
  GrainCoupling(const GrainExchangeChoice& choice, const lbm::FluidOptions& fluid)
      : GrainCoupling(make_grain_exchange<Real>(choice, fluid)) {}

  /// Before the first step: maps grains into liquid that was filled around them. The fill is the total of both, so
  /// nothing is displaced; restart the fluid's mass ledger afterwards (Fluid::open_ledger).
  void embed(lbm::Fluid<Real>& fluid, const dem::Particles& particles, SolidFields<Real>& fields);

  /// Before the fluid step, after SolidFields::open: maps all grains at their present places, writes the fields of
  /// blocks where something changed, and books displaced volume.
  void update(lbm::Fluid<Real>& fluid, const dem::Particles& particles, SolidFields<Real>& fields);

  /// Then: forces that the exchange knows before the step, and the opposite impulses.
  ExchangedMomentum give_impulses(lbm::Fluid<Real>& fluid, dem::Particles& particles, SolidFields<Real>& fields) {
    return exchange_->give_impulses(fluid, map_, displaced_, particles, fields);
  }

  /// Velocity (lu) of the liquid at a place (cells from the corner of cell (0, 0, 0)) where `sampled` was found in the
  /// cells, after embed or give_impulses.
  [[nodiscard]] Vec3 liquid_velocity(const Vec3& place, const Vec3& sampled) const {
    return exchange_->liquid_velocity(place, sampled);
  }

  /// The same in m/s, between steps.
  [[nodiscard]] Vec3 liquid_velocity_si(const Vec3& place, const Vec3& sampled) const {
    const double unit = exchange_->velocity_unit();
    return unit > 0 ? Vec3(unit * exchange_->liquid_velocity(place, sampled / unit)) : sampled;
  }
  [[nodiscard]] std::size_t wet_beads() const { return exchange_->wet_beads(); }

  /// After the fluid step: adds force and torque (SI) of the fluid on each grain. Returns the momentum that they got
  /// from the cells' momentum exchange, lu, for the audit.
  Vec3 add_forces(const lbm::Fluid<Real>& fluid, dem::Particles& particles);

  /// As GrainExchange's.
  [[nodiscard]] bool fills_with_level() const { return exchange_->fills_with_level(); }
  [[nodiscard]] Vec3 flow_in_cells(const dem::Particles& particles) const {
    return exchange_->flow_in_cells(map_, displaced_, particles);
  }
  /// Blocks whose fields the last update wrote.
  [[nodiscard]] std::size_t written_blocks() const;

  /// The next update maps everything again, moved or not.
  void forget() { map_.forget(); }

  /// State of a checkpoint.
  void transfer(Archive& archive);

 private:
  void write(lbm::Fluid<Real>& fluid, const dem::Particles& particles, SolidFields<Real>& fields);
  void choose_blocks(lbm::FluidGrid<Real>& grid, SolidFields<Real>& fields);

  std::unique_ptr<GrainExchange<Real>> exchange_;
  GrainMap<Real> map_;
  DisplacedVolume<Real> displaced_;
  std::vector<std::uint8_t> written_;  // per block index: fields of the last update
  std::vector<Vec3> taken_;            // by grain, lu
};

extern template class GrainCoupling<float>;
extern template class GrainCoupling<double>;

}  // namespace lahar::coupling

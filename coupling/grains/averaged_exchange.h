#pragma once
// Averaged exchange: grains have no wall in the cells; they feel the mean flow by a drag law for beds and the pressure
// of that flow, and the cells feel the opposite.
//
// The fluid's velocity is that of the mixture by volume, U = (1 - phi) u + phi v: cells are full of liquid and grains
// together, so it has no divergence, and grains that come in raise the level (displaced_volume.h). phi, U and the
// grains' velocity v are averaged at the nodes of averaging_grid.h, weighted by the water there: a grain goes to the
// nodes as the water in its place does, so that a uniform mixture is one at each node, at its surface, too. With the
// force on a grain of bed_drag.h, the volume-averaged momentum of the liquid (Anderson & Jackson 1967; form of Zhou,
// Kuang, Chu & Yu 2010, J. Fluid Mech. 661:482) becomes that of the fluid with a force per volume
//   - n f_drag - phi rho (Du/Dt - Dv/Dt),
// n f_drag of the grains; the second part gives and takes the momentum of the liquid that the cells hold in the grains'
// place. Its weight is carried by the fluid: the grains' buoyancy.
//
// What grains feel is the mean of two steps: lattice fluids carry a velocity that changes its sign from cell to cell
// and step to step and dies slowly (staggered momentum; Zanetti 1989, Phys. Rev. A 40:1539). Answered at the next step,
// with its sign changed, it would grow.
//
// Du/Dt of the liquid at a grain is the change of u along the grain's way and, where the liquid moves past the grain,
// ((u - v) . grad) u, by u at the nodes half a spacing ahead and behind.
//
// Left out: what separate velocities of liquid and grains carry beyond that of the mixture, rho phi (1 - phi)
// (u - v)(u - v); added mass, lift, torque; a viscosity of the mixture.
#include <array>
#include <optional>
#include <vector>

#include "coupling/grains/averaging_grid.h"
#include "coupling/grains/drag_over_a_step.h"
#include "coupling/grains/grain_exchange.h"

namespace lahar::coupling {

template <class Real>
class AveragedExchange final : public GrainExchange<Real> {
 public:
  AveragedExchange(const AveragedGrains& options, const lbm::FluidOptions& fluid);

  void shape_sphere(double radius, GridSphere<Real>& sphere) const override;
  void prepare(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const GrainMap<Real>& map) override;
  [[nodiscard]] bool fills_with_level() const override { return true; }
  [[nodiscard]] Vec3 flow_in_cells(const GrainMap<Real>& map, const DisplacedVolume<Real>& displaced,
                                   const dem::Particles& particles) const override;
  void write_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block) const override;
  void look(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, const DisplacedVolume<Real>& displaced,
            const dem::Particles& particles) override;
  ExchangedMomentum give_impulses(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map,
                                  const DisplacedVolume<Real>& displaced, dem::Particles& particles,
                                  SolidFields<Real>& fields) override;
  [[nodiscard]] Vec3 liquid_velocity(const Vec3& place, const Vec3& sampled) const override;
  [[nodiscard]] double velocity_unit() const override { return velocity_unit_; }
  [[nodiscard]] std::size_t wet_beads() const override { return wet_beads_; }
  void gather_block(const lbm::Fluid<Real>& /*fluid*/, const GrainMap<Real>& /*map*/, std::size_t /*block*/) override {}
  Vec3 finish(const lbm::Fluid<Real>& /*fluid*/, const GrainMap<Real>& /*map*/, std::size_t /*grain*/,
              double /*wet_volume*/, dem::Particles& /*particles*/) override {
    return Vec3::Zero();
  }
  void transfer(Archive& archive) override;

 private:
  /// Sums over the cells and grains around a node, lu; then what the cells get.
  struct Node {
    bool used = false;  ///< a wet grain is near
    double water = 0;   ///< volume of liquid and wet grains, cells
    Vec3 water_momentum = Vec3::Zero();
    double solid = 0;  ///< volume of wet grains
    Vec3 solid_momentum = Vec3::Zero();
    Vec3 impulse = Vec3::Zero();
  };
  /// A wet grain, or a wet bead that feels the law of grains.
  struct WetGrain {
    dem::ParticleId id;
    Vec3 place;                                          ///< cells from the corner of cell (0, 0, 0)
    double wet = 0;                                      ///< of its volume, cells
    bool in_cells;                                       ///< the cells hold its volume: not of beads
    typename DisplacedVolume<Real>::Handed handed = {};  ///< for it to interface cells
    Vec3 impulse = Vec3::Zero();                         ///< on the cells, lu
    Vec3 taken = Vec3::Zero();                           ///< by itself, of what it exchanged with the cells, lu
    std::size_t mapped = 0;                              ///< index into GrainMap::grains(), if in_cells
    std::vector<AveragingGrid::Share> shares = {};       ///< of its wet volume, by node; their sum is 1
    std::array<AveragingGrid::Share, 8> answers{};       ///< of what the cells get of it; their sum is 1
  };
  /// What is kept of a grain from step to step.
  struct State {
    Vec3 velocity = Vec3::Zero();      ///< m/s, at the last step
    Vec3 sampled = Vec3::Zero();       ///< m/s, of the liquid around it, at the last step
    Vec3 liquid = Vec3::Zero();        ///< m/s, mean of that and of the one before
    Vec3 acceleration = Vec3::Zero();  ///< m/s^2, of that liquid as it flows, smoothed
    DraggedSlip slip = {};
    bool known = false;  ///< it was wet at the last step
  };
  /// Means around a grain, SI.
  struct Surroundings {
    double solid_fraction;  ///< at most kDensest
    double held;            ///< share of the wet volume that the water around has room for
    Vec3 liquid;            ///< velocity
  };

  void find_wet_grains(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, const DisplacedVolume<Real>& displaced,
                       const dem::Particles& particles);
  void find_wet_beads(const lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void share_among_nodes(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, WetGrain& grain) const;
  void choose_nodes(const lbm::Fluid<Real>& fluid);
  void average_fluid(const lbm::Fluid<Real>& fluid);
  void average_grains(const lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  [[nodiscard]] Surroundings look_around(const lbm::Fluid<Real>& fluid, const WetGrain& grain) const;
  /// Velocity (lu) of the liquid at a place between the nodes, by their water; none where they have no water.
  [[nodiscard]] std::optional<Vec3> liquid_at(const Vec3& place) const;
  /// ((u - v) . grad) u at a place, m/s^2, with the slip u - v in m/s.
  [[nodiscard]] Vec3 convective_acceleration(const LatticeUnits& units, const Vec3& place, const Vec3& slip) const;
  /// `stretch`: the coming step of the fluid over the last.
  void act_on(const lbm::Fluid<Real>& fluid, double stretch, WetGrain& grain, dem::Particles& particles);
  Vec3 push_cells(lbm::Fluid<Real>& fluid, SolidFields<Real>& fields);

  AveragedGrains options_;
  AveragingGrid nodes_at_;
  double half_way_;            // cells, from a grain to where the liquid ahead and behind is asked for
  double smoothing_;           // steps over which accelerations are smoothed
  double velocity_unit_ = 0;   // m/s, of the nodes' velocities
  std::size_t wet_beads_ = 0;  // at the last step
  std::vector<Node> nodes_;
  std::vector<WetGrain> grains_;         // of the step under way
  std::vector<lbm::BlockIndex> blocks_;  // wet, with used nodes around
  std::vector<State> states_;            // by id
};

extern template class AveragedExchange<float>;
extern template class AveragedExchange<double>;

}  // namespace lahar::coupling

#pragma once
// Resolved exchange: immersed moving boundary (Noble & Torczynski 1998). Each grain writes its solid fraction, weight,
// drag and velocity into the cells that it reaches; the collision brings them towards its velocity (lbm/collision/
// coverage_weight.h), and what they lose is its force.
//
// The exchange also accelerates the liquid that stands in the grain's place; that part is no load on the grain (Feng &
// Michaelides 2009; Uhlmann 2005). That liquid has the grain's velocity and, where the exchange is soft, some slip past
// it; the change of both counts. Its weight is carried by the fluid: the grain's buoyancy. The force on light grains is
// under-relaxed (under_relaxed_force.h).
#include "coupling/grains/grain_exchange.h"

namespace lahar::coupling {

template <class Real>
class ResolvedExchange final : public GrainExchange<Real> {
 public:
  ResolvedExchange(const ResolvedGrains& options, lbm::BodyWeighting weighting)
      : radius_shift_(options.radius_shift), weighting_(weighting) {}

  void shape_sphere(double radius, GridSphere<Real>& sphere) const override;
  void prepare(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const GrainMap<Real>& map) override;
  void write_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block) const override;
  void gather_block(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block) override;
  Vec3 finish(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t grain, double wet_volume,
              dem::Particles& particles) override;
  void transfer(Archive& archive) override;

 private:
  /// What the cells of a pair do to the grain, lu.
  struct Load {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    double interior = 0;          ///< liquid that stands in the grain's place in wet cells, cells
    double entrained = 0;         ///< liquid in wet cells that a step brings to the grain's velocity, cells
    double brought = 0;           ///< entrained, of covered cells all: what the grain brings along in the end
    double held = 0;              ///< interior that is brought along, of cells that the grain covers alone
    Vec3 slip = Vec3::Zero();     ///< momentum of the interior past the grain, after the step's collision
    Vec3 kept = Vec3::Zero();     ///< the same, of cells that are wet now
    double interior_inertia = 0;  ///< the same times 2/3 of the squared distance from the grain's centre
    double entrained_inertia = 0;
    Load& operator+=(const Load& o);
  };
  /// What is kept of a grain from step to step.
  struct State {
    Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();           ///< m/s, rad/s, at the last mapping
    Vec3 felt_force = Vec3::Zero(), felt_torque = Vec3::Zero();  ///< N, N m, under-relaxed
    Vec3 acceleration = Vec3::Zero(), spin_up = Vec3::Zero();    ///< m/s^2, rad/s^2, means over the step before that
    Vec3 slip = Vec3::Zero();        ///< N s, of the liquid in its place past the grain, after the last step
    double calm = 1, calm_spin = 1;  ///< 0 in a jolt of velocity or spin, 1 some steps after
    bool known = false;              ///< velocity and spin are set
  };

  double radius_shift_;
  lbm::BodyWeighting weighting_;
  double time_step_ = 0;       // s, that the solids advanced before the last mapping
  std::vector<Load> loads_;    // by pair
  std::vector<State> states_;  // by id
};

extern template class ResolvedExchange<float>;
extern template class ResolvedExchange<double>;

}  // namespace lahar::coupling

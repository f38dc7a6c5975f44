#pragma once
// A bed of spheres held in place in a chute whose bed and sides let water slip: the spheres alone take momentum from it
// along the chute. What they got, with what the water still has, is what it had and what its weight gave it.
#include <cmath>
#include <cstdint>

#include "coupling/coupled_step.h"

namespace lahar::validate {

struct BedInChute {
  static constexpr double radius = 0.03;  ///< of the spheres, m
  double length = 3.2, width = 0.32;      ///< of the chute, m; 0.8 m high, open above
  double start = 0;                       ///< of the bed along the chute, m
  Vec3i spheres{16, 5, 4};                ///< along the chute, across and up, in rows that touch each other
  double cell_size = 0.02;
  double speed = 6;  ///< that is to be 0.084 lu
  bool periodic = false;
  lbm::BodyWeighting weighting = lbm::BodyWeighting::wall_distance;
  coupling::GrainExchangeChoice grains = coupling::ResolvedGrains{.radius_shift = coupling::kRadiusShiftFast};
};

inline lbm::FluidOptions chute(const BedInChute& b) {
  lbm::FluidOptions o;
  o.domain.upper = Vec3(b.length, b.width, 0.8);
  o.domain.cell_size = b.cell_size;
  o.domain.faces[5] = lbm::FaceKind::open;
  if (b.periodic) o.domain.faces[0] = o.domain.faces[1] = lbm::FaceKind::periodic;
  o.domain.slip = WallSlip::free_slip;
  o.time_step = 0.084 * b.cell_size / b.speed;
  constexpr double slope = 35 * M_PI / 180;
  o.gravity = 9.81 * Vec3(std::sin(slope), 0, -std::cos(slope));
  o.kinematic_viscosity = 1e-6;
  o.smagorinsky = 0.16;
  o.weighting = b.weighting;
  return o;
}

inline dem::Solids bed(const BedInChute& b) {
  dem::Particles particles;
  constexpr double pitch = 2 * BedInChute::radius;
  for (int x = 0; x < b.spheres.x(); ++x)
    for (int y = 0; y < b.spheres.y(); ++y)
      for (int z = 0; z < b.spheres.z(); ++z) {
        dem::ParticleSpec sphere;
        sphere.position = Vec3(b.start, 0, 0) + pitch * Vec3(x + 0.5, y + 0.5, z + 0.5);
        sphere.radius = BedInChute::radius;
        sphere.density = 2650;
        sphere.state = dem::ParticleState::fixed;
        particles.add(sphere);
      }
  dem::Materials materials;
  materials.add({"stone", 1e8, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;  // set by the coupled step
  return {std::move(particles), dem::Bonds{}, std::move(materials), Walls{}, options};
}

/// Impulses along the chute, Ns.
class ChuteLedger {
 public:
  ChuteLedger(const BedInChute& b, const lbm::LiquidRegion& water)
      : step_(chute(b), bed(b), {.grains = b.grains, .thin_wires = coupling::ThinWires::uncoupled}) {
    step_.fill({water});
    open();
  }
  /// Sums start anew.
  void open() { weight_ = on_bed_ = 0, start_ = step_.liquid_momentum().x(); }
  void run_until(double time) {
    while (step_.time() < time) {
      if (steps_++ % 16 == 0) mass_ = step_.fluid()->liquid_mass();
      step_.advance();
      weight_ += step_.time_step() * step_.fluid()->options().gravity.x() * mass_;
      const dem::Particles& p = step_.solids()->particles();
      for (dem::ParticleIndex i = 0; i < p.size(); ++i) on_bed_ += step_.time_step() * p.external_force[i].x();
    }
  }
  [[nodiscard]] double start() const { return start_; }
  [[nodiscard]] double weight() const { return weight_; }
  /// What the spheres got.
  [[nodiscard]] double on_bed() const { return on_bed_; }
  [[nodiscard]] double made() const { return step_.liquid_momentum().x() + on_bed_ - weight_ - start_; }

 private:
  coupling::CoupledStep<float> step_;
  std::int64_t steps_ = 0;
  double start_ = 0, weight_ = 0, on_bed_ = 0, mass_ = 0;
};

}  // namespace lahar::validate

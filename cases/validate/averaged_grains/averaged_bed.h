#pragma once
// Beds of grains in fluids that do not resolve them (coupling/grains/averaged_exchange.h), and the same resolved.
#include <memory>
#include <vector>

#include "coupling/coupled_step.h"

namespace lahar::validate {

/// A vessel, its liquid and the grains in it; SI.
struct AveragedBed {
  Vec3 size;                          ///< m, whole cells
  double cell_size;                   ///< m
  bool periodic;                      ///< along all axes; else closed, without friction at the walls
  bool upright = false;               ///< with periodic: floor and lid are closed all the same
  double time_step;                   ///< s, of the fluid
  double viscosity;                   ///< m^2/s
  Vec3 fluid_gravity = Vec3::Zero();  ///< m/s^2
  Vec3 grain_gravity = Vec3::Zero();  ///< m/s^2
  double diameter;                    ///< m
  double density = 2500;              ///< kg/m^3, of grains; the liquid has 1000
  dem::ParticleState state = dem::ParticleState::free;
  coupling::GrainExchangeChoice exchange = coupling::AveragedGrains{};
  lbm::BodyWeighting weighting = lbm::kBodyWeighting;  ///< of resolved grains
  double youngs_modulus = 1e7;                         ///< Pa, of grains: soft where contacts do not matter
  double grate = 0;                                    ///< m above the floor: grains stand on it, water goes through
  double water_level = 0;                              ///< m; 0: full, without a surface; else the top is open
  std::vector<lbm::InflowOptions> inflows{};
};

inline constexpr double kLiquidDensity = 1000;  // kg/m^3

/// Filled with liquid at rest, grains at `centres` (m). Walls hold the grains where the vessel is not periodic.
std::unique_ptr<coupling::CoupledStep<float>> make_bed(const AveragedBed& bed, const std::vector<Vec3>& centres);

/// Centres of grains in a box on a cubic lattice of about this solid fraction, up to 0.5, each moved at random by a
/// part of the room that it has.
std::vector<Vec3> loose_lattice(const Vec3& size, double diameter, double fraction, unsigned seed);

/// Of liquid and grains by volume where drag and the fluid's gravity are in balance, m/s: readings of cells take half
/// of what gravity gave in the last step off, not knowing what the drag took.
Vec3 mean_velocity(coupling::CoupledStep<float>& step);

}  // namespace lahar::validate

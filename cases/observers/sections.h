#pragma once
// Discharge and energy through the sections of a scene.
#include <array>
#include <string>
#include <vector>

#include "cases/observers/fluid_samples.h"
#include "cases/observers/observer.h"

namespace lahar::cases {

/// A rectangle: centre, three unit vectors at right angles, half extents.
struct SectionFrame {
  Vec3 centre, normal, across, up;
  double half_width, half_height;  ///< m
  /// Whether a point of the plane lies in the rectangle.
  [[nodiscard]] bool holds(const Vec3& p) const;
};

/// The width runs along z x normal, the height along normal x width direction; where the normal is z or -z, the width
/// runs along x. Extents of 0 become the size of the domain.
SectionFrame frame_of(const scene::FluxSection& section, const scene::Domain& domain);

/// What passes a section at one moment, positive along the normal.
struct Flux {
  double area = 0;    ///< m^2 of liquid
  double volume = 0;  ///< m^3/s of liquid
  double energy = 0;  ///< W: kinetic and potential energy that passes, and the work of the pressure
};

/// Sums over the cells that the plane cuts, by its area in them; where it lies along the cells, over both layers beside
/// it. `up` is the unit vector against
/// gravity, heights count from `datum` (m) along it. The velocity U of a cell is that of all that it holds: with the
/// fill level F and the solid fraction eps, F U - eps v of liquid pass, v the velocity of the grains there (`grains`;
/// none: null). They carry the energy of `velocity`.
Flux liquid_flux(const FluidView& fluid, const LiquidVelocity& velocity, const dem::Particles* grains,
                 const SectionFrame& frame, const scene::Domain& domain, const Vec3& up, double datum);

/// m^2, the part of a disc of radius r around the origin that lies in a rectangle, from its least to its largest x and
/// y.
double disc_in_rectangle(double r, const std::array<double, 2>& x, const std::array<double, 2>& y);

/// m^2 that the grains cut out of a section.
double grain_area(const dem::Particles& particles, const SectionFrame& frame);

class Sections final : public Observer {
 public:
  explicit Sections(const Observed& run);
  static bool applies(const Observed& run) { return !run.scene.sections.empty(); }
  [[nodiscard]] std::string_view name() const override { return "sections"; }
  /// Follows the grains: what leaves the domain between two rows has passed on its way.
  void after_step() override;
  void sample(double interval) override;
  /// What the next row is compared with, and what has passed.
  void transfer(Archive& archive) override;

 private:
  struct Counter {
    std::string name;
    SectionFrame frame;
    Flux now;                                 ///< of the liquid at the last row
    double grain_area = 0;                    ///< m^2, at the last row
    double grain_rate = 0, grain_power = 0;   ///< kg/s and W since the row before
    std::vector<Vec3> places;                 ///< of the particles by id, when they were last looked at
    double mass_since = 0, energy_since = 0;  ///< kg and J of grains that passed since the row before
    double volume = 0, liquid_energy = 0;     ///< m^3 and kJ of liquid that passed
    double grain_mass = 0, grain_energy = 0;  ///< kg and kJ of grains that passed
  };
  void declare_liquid(std::size_t counter);
  void declare_grains(std::size_t counter);
  void sample_liquid(Counter& counter, double interval);
  void follow_grains(Counter& counter);
  void sample_grains(Counter& counter, double interval);

  std::vector<Counter> counters_;
};

}  // namespace lahar::cases

#pragma once
// Discharge and energy through the sections of a scene. Definitions in docs/outputs.md.
#include <map>
#include <string>
#include <vector>

#include "cases/files/series_writer.h"
#include "cases/scene/scene.h"
#include "coupling/coupled_step.h"

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
  double volume = 0;  ///< m^3/s of liquid
  double energy = 0;  ///< W: kinetic and potential energy that passes, and the work of the pressure
};

/// Sums over points half a cell apart, a quarter of a cell off the plane on both sides. `up` is the unit vector against
/// gravity, heights count from `datum` (m) along it.
template <class Real>
Flux liquid_flux(const lbm::Fluid<Real>& fluid, const SectionFrame& frame, const scene::Domain& domain, const Vec3& up,
                 double datum);

template <class Real>
class Sections {
 public:
  /// Declares a column per quantity. `up` and `datum` as in liquid_flux.
  Sections(const scene::Scene& scene, coupling::CoupledStep<Real>& step, SeriesWriter& series, const Vec3& up,
           double datum);
  /// What the next row is compared with, for a checkpoint.
  void transfer(Archive& archive);
  /// Appends the present values to a row, in the order of the columns; `interval` (s) is that since the last row.
  void sample(std::vector<double>& row, double interval, std::map<std::string, double>& metrics);

 private:
  struct Counter {
    std::string name;
    SectionFrame frame;
    Flux before;
    std::vector<Vec3> places;  ///< of the particles at the last row
  };
  void sample_liquid(Counter& counter, std::vector<double>& row, double interval,
                     std::map<std::string, double>& metrics);
  void sample_grains(Counter& counter, std::vector<double>& row, double interval,
                     std::map<std::string, double>& metrics);

  const scene::Scene& scene_;
  coupling::CoupledStep<Real>& step_;
  Vec3 up_;
  double datum_;
  std::vector<Counter> counters_;
};

extern template class Sections<float>;
extern template class Sections<double>;

}  // namespace lahar::cases

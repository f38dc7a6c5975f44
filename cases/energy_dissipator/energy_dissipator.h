#pragma once
// An energy dissipator in a cable, stretched and let go (Li, Zhao & Kwan 2020, section 3.2, Fig. 5, Table 2, after
// Grassl et al. 2003).
#include <cstdint>
#include <functional>
#include <vector>

#include "cases/scene/findings.h"
#include "dem/bonds/bonds.h"

namespace lahar::cases {

enum class BrakeUnloading { elastic, plastic };

/// The defaults are Table 2 of the paper; what it does not say is marked. Without a stiffening force the law is
/// bi-linear.
struct EnergyDissipator {
  std::vector<double> stiffness{3.7e10, 1.2e8, 1.9e9};  ///< N/m^3, two or three stages
  std::vector<double> force_limit{78e3, 98.2e3};        ///< N, at the ends of all stages but the last
  double last_force = 261e3;                            ///< N, up to which the last stage is followed
  BrakeUnloading unloading = BrakeUnloading::elastic;
  double bond_radius = 0.00785;   ///< m; not in the paper, taken from the ring of section 3.1
  double bead_diameter = 0.0157;  ///< m; not in the paper, likewise
  double density = 7800;          ///< kg/m^3; not in the paper
  std::int64_t cable_beads = 1;   ///< on either side of the dissipator; their bonds have the first stiffness
  double damping_ratio = 0.05;    ///< of the bonds; not in the paper
  double speed = 0.5;             ///< m/s, of the pulled end; not in the paper
  std::int64_t samples = 600;     ///< points of the curve while it is stretched
  double safety = 0.5;            ///< share of the critical time step
  bool operator==(const EnergyDissipator&) const = default;

  [[nodiscard]] dem::AxialLaw law() const;
  /// N/m of stage k: stiffness per area times the area of the bond.
  [[nodiscard]] double stage_stiffness(std::size_t k) const;
  /// N/m of the whole cable while the dissipator is in stage k: all bonds one after the other.
  [[nodiscard]] double cable_stiffness(std::size_t k) const;
  /// m, by which the dissipator alone is longer at `force` (on the curve).
  [[nodiscard]] double elongation_at(double force) const;
  /// m, of the whole cable.
  [[nodiscard]] double displacement_at(double force) const;
  /// J under the dissipator's curve up to `force`.
  [[nodiscard]] double energy_to(double force) const;
};

/// Notes a law that makes no sense, too few samples, and a speed at which a step passes more than one.
void check(const EnergyDissipator& brake, scene::Findings& findings);

/// One moment of the test.
struct BrakePoint {
  double time = 0;          ///< s
  double displacement = 0;  ///< m, of the pulled end
  double elongation = 0;    ///< m, of the dissipator
  double force = 0;         ///< N, in the dissipator
  double end_force = 0;     ///< N, at the pulled end
};

struct BrakeCurve {
  std::vector<BrakePoint> loading, unloading;
  double work_in = 0, work_out = 0;  ///< J, of the pulled end
  double stored = 0;                 ///< J, in the dissipator at the largest force
  double plastic = 0;                ///< J, dissipated by plastic elongation
  double damped = 0;                 ///< J, in all bonds
  double cable_energy = 0;           ///< J, in the other bonds at the largest force
  double time_step = 0;              ///< s
  double simulated = 0;              ///< s
  double largest_force = 0;          ///< N, in the dissipator when the pulled end stopped
  double largest_elongation = 0;     ///< m, then
  double ledger_gap = 0;             ///< J
  bool interrupted = false;
};

/// Stretches the cable until the dissipator carries last_force, then lets it go to no force. `go_on` is asked after
/// each point; it returns false to stop. Throws InputError for what `check` notes.
[[nodiscard]] BrakeCurve stretch(
    const EnergyDissipator& brake, const std::function<bool()>& go_on = [] { return true; });

/// Least squares slopes of the force at the pulled end over the dissipator's elongation and over the displacement of
/// that end, in the inner nine tenths of a stage's forces, N/m.
[[nodiscard]] double stage_slope(const EnergyDissipator& brake, const std::vector<BrakePoint>& points,
                                 std::size_t stage);
[[nodiscard]] double cable_slope(const EnergyDissipator& brake, const std::vector<BrakePoint>& points,
                                 std::size_t stage);

/// Force (N) at which the lines through two neighbouring stages, each fitted, cross.
[[nodiscard]] double knee(const EnergyDissipator& brake, const std::vector<BrakePoint>& points, std::size_t stage);

/// Trapezoidal area of the end force over the dissipator's elongation, J; negative on the way back.
[[nodiscard]] double area_under(const std::vector<BrakePoint>& points);

}  // namespace lahar::cases

#pragma once
// A ring pulled open between two beads (Li, Zhao & Kwan 2020, section 3.1, Fig. 4, after Volkwein 2004).
#include <cstdint>
#include <functional>
#include <vector>

#include "cases/scene/findings.h"

namespace lahar::cases {

/// The defaults are section 3.1 and Table 1 of the paper; what it does not say is marked.
struct RingPull {
  double perimeter = 0.9425;          ///< m, of the wire's centre-line
  std::int64_t beads = 60;            ///< even
  std::int64_t reference_beads = 60;  ///< number of beads that density and stiffnesses are given for, see scaled()
  double density = 1000;              ///< kg/m^3, of a bead
  double youngs_modulus = 5e6;        ///< Pa, of contacts between beads
  double poisson_ratio = 0.3;
  double bond_radius = 0.9425 / 120;  ///< m; not in the paper: that of a bead of the reference
  double normal_stiffness = 1.3e12;   ///< N/m^3
  double shear_stiffness = 8e8;       ///< N/m^3
  double damping_ratio = 0.05;        ///< of the bonds; not in the paper
  double stroke = 0.2;                ///< m
  double speed = 0.25;                ///< m/s; not in the paper, which calls it quasi-static
  std::int64_t samples = 400;         ///< points of the curve
  double safety = 0.6;                ///< share of the critical time step
  bool operator==(const RingPull&) const = default;

  /// The same ring for its number of beads: bond radius kept, stiffness per unit area divided by the bond length (so
  /// that axial, bending and shear stiffness of the wire stay), density such that the ring keeps its mass.
  [[nodiscard]] RingPull scaled() const;
  [[nodiscard]] double bead_diameter() const { return perimeter / static_cast<double>(beads); }
};

/// Stiffness of the wire that the bonds make up, bond stiffness times bond length.
struct WireStiffness {
  double axial = 0;    ///< EA, N
  double bending = 0;  ///< EI, N m^2
  double shear = 0;    ///< GA, N
};
[[nodiscard]] WireStiffness wire_stiffness(const RingPull& ring);

/// Stiffness against a small pull (N/m): a thin ring with shear under two opposite forces, F / d =
/// 1 / ((pi/4 - 2/pi) R^3 / EI + pi R / (4 GA) + pi R / (4 EA)) (Castigliano; Timoshenko 1955, Strength of Materials).
[[nodiscard]] double first_stiffness(const RingPull& ring);

/// Stiffness of the ring pulled straight (N/m): two strands of half the beads side by side.
[[nodiscard]] double last_stiffness(const RingPull& ring);

/// Displacement at which the ring is straight without being longer, m.
[[nodiscard]] double straight_displacement(const RingPull& ring);

/// Whether what the paper reports of its ring can be asked of this one: the paper's parameters, but for the length and
/// resolution of the curve.
[[nodiscard]] bool as_in_paper(const RingPull& ring);

/// What came out. Each point is the mean over its stretch of the stroke.
struct PullCurve {
  std::vector<double> time;                   ///< s, simulated
  std::vector<double> displacement, force;    ///< m, N: at the pulled bead
  std::vector<double> anchor_force;           ///< N, at the fixed bead
  std::vector<double> axial, shear, bending;  ///< J, in the bonds
  double time_step = 0;                       ///< s
  std::int64_t steps = 0;
  double ledger_gap = 0;  ///< J: work of the pull less what was stored and dissipated
  double work = 0;        ///< J
  bool interrupted = false;

  /// Interpolated, N.
  [[nodiscard]] double force_at(double displacement) const;
  /// Slope between two displacements, N/m.
  [[nodiscard]] double slope(double from, double to) const;
};

/// Notes what cannot be run.
void check(const RingPull& ring, scene::Findings& findings);

/// Pulls the ring. Deterministic. `go_on` is asked after each sample; it returns false to stop. Throws InputError for
/// what cannot be run.
[[nodiscard]] PullCurve pull_ring(
    const RingPull& ring, const std::function<bool()>& go_on = [] { return true; });

/// Where the curve turns, m: the displacement at which the tangent has ten times its first stiffness, the one at which
/// half of the stored energy is axial, and the one where the tangents of both ends cross.
struct Transition {
  double tenfold_tangent = 0, half_axial = 0, tangents_cross = 0;
};
[[nodiscard]] Transition transition_of(const PullCurve& curve, const RingPull& ring);

}  // namespace lahar::cases

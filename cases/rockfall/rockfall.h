#pragma once
// A ball falls onto a horizontal ring net that hangs on four braked cables (Li, Zhao & Kwan 2020, section 3.3, Fig. 6
// and 7, Table 3, after Volkwein 2004).
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/scene/findings.h"

namespace lahar::cases {

/// The defaults are section 3.3 and Table 3 of the paper; what it does not say is marked.
struct Rockfall {
  double net_width = 3.9;        ///< m, of the square net
  double ring_diameter = 0.3;    ///< m
  double ring_pitch = 3.9 / 14;  ///< m; not in the paper: the widest at which circular rings of this size interlock
  std::int64_t beads_per_ring = 60;
  double wire_diameter = 0.0157;                           ///< m
  double density = 7800;                                   ///< kg/m^3
  double cable_extension = 1.6;                            ///< m, of each cable beyond a corner; not in the paper
  std::int64_t dissipators_per_cable = 2;                  ///< 2: at both ends; 1: at one; not in the paper
  double guide_stiffness = 1e7;                            ///< N/m, sideways at the corners; not in the paper
  double ring_stiffness = 3e11;                            ///< N/m^3, normal and shear
  double cable_stiffness = 8e11;                           ///< N/m^3
  std::vector<double> dissipator_stiffness{3.5e8, 3.5e7};  ///< N/m^3
  double activation_force = 12e3;                          ///< N
  bool plastic_unloading = false;
  bool tied = false;                 ///< edge rings bonded to their cables instead of sliding
  double bond_damping_ratio = 0.02;  ///< not in the paper
  double youngs_modulus = 100e9;     ///< Pa, of the wires' contacts
  double poisson_ratio = 0.3;
  double friction = 0.1;        ///< between all
  double restitution = 0.5;     ///< between all; not in the paper: with 0.1 the ledger takes steps below 1e-6 s
  bool capsules = false;        ///< wires touch as smooth wires instead of bead by bead
  double ball_diameter = 0.82;  ///< m
  double ball_mass = 825;       ///< kg
  double ball_modulus = 30e9;   ///< Pa
  double ball_poisson_ratio = 0.15;
  double drop_height = 16;        ///< m, from which its speed at the net's plane comes
  double settling_time = 0.65;    ///< s, for which the net sags before the ball comes; not in the paper (1.8 s)
  double settling_drag = 12;      ///< 1/s, deceleration per velocity in the last third of it; not in the paper
  double duration = 0.45;         ///< s, from time zero: the bottom of the ball is in the net's plane
  double time_step = 3e-6;        ///< s; 0 for a share of the limits of bonds
  double sample_interval = 1e-3;  ///< s
  bool operator==(const Rockfall&) const = default;

  [[nodiscard]] double impact_speed() const;  ///< m/s
};

/// Whether what the paper reports can be asked of this rockfall: the paper's parameters, but for the time step and the
/// length and resolution of the series.
[[nodiscard]] bool as_in_paper(const Rockfall& rockfall);

/// Notes what cannot be run, such as a net that cannot be built or cables that end in their guides.
void check(const Rockfall& rockfall, scene::Findings& findings);

/// Everything over the time since time zero.
struct RockfallSeries {
  std::vector<double> time;               ///< s
  std::vector<double> ball_displacement;  ///< m, upwards
  std::vector<double> ball_energy;        ///< J, kinetic + potential about the net's plane
  std::vector<double> ball_force;         ///< N, of the net on the ball, upwards
  std::vector<double> brake_elongation;   ///< m, mean over the dissipators
  std::vector<double> brake_energy;       ///< J, stored and plastically dissipated in all dissipators
  std::vector<double> bond_energy;        ///< J, stored in all bonds
  std::vector<double> friction_loss, contact_loss, bond_loss;  ///< J
  std::vector<double> ledger_gap;                              ///< J: total energy less that at time zero
  std::vector<double> ring_travel;  ///< m, mean of the edge rings' sliding along their cables
};

struct RockfallResult {
  RockfallSeries series;                       ///< empty where the ball did not come: stopped while the net settled
  bool as_in_paper = false;                    ///< so that it can be held against the paper
  double settled_sag = 0;                      ///< m, of the net's lowest bead when the ball comes
  double settled_speed = 0;                    ///< m/s, root of the mean square of all beads then
  double lowest_time = 0;                      ///< s, of the ball's lowest point
  double depth = 0;                            ///< m, its displacement there
  double least_energy_time = 0;                ///< s, of the ball's least energy
  double lost_until_50_ms = 0;                 ///< share of the ball's kinetic energy at time zero
  double lost_until_50_ms_of_centre = 0;       ///< the same if time zero is when its centre is in the net's plane
  double rebound_energy = 0;                   ///< J, gained from the least to the end
  double largest_tension = 0;                  ///< N, in a cable, of all steps
  double brake_elongation = 0;                 ///< m, largest mean
  double largest_brake_elongation = 0;         ///< m, of a single one
  double brake_force = 0;                      ///< N, at that elongation
  double brake_energy = 0;                     ///< J, at the largest mean elongation
  std::int64_t active_brakes = 0;              ///< beyond their activation force
  double mean_travel = 0, largest_travel = 0;  ///< m, of edge rings along their cables, largest over time
  double largest_gap = 0;                      ///< share of the ball's kinetic energy at time zero
  std::string lost_links;                      ///< what passed through what, in words; empty if nothing did
  double worst_overlap = 0;                    ///< of the smaller radius, deepest of every 25th step
  std::int64_t beads = 0, rings = 0;
  std::int64_t steps = 0;  ///< settling included
  double simulated = 0;    ///< s, likewise
  double time_step = 0;    ///< s
  bool interrupted = false;
};

/// The net as it hangs when the ball comes; one settled net can be struck several times.
class SettledNet {
 public:
  /// Builds the net and lets it settle. `progress` is told the simulated time of the settling; it returns false to
  /// stop.
  SettledNet(const Rockfall& rockfall, const std::function<bool(double)>& progress);
  ~SettledNet();
  SettledNet(SettledNet&&) noexcept;

  /// Drops the ball onto a copy of it. Only tied and duration may differ from what it was built with.
  [[nodiscard]] RockfallResult strike(const Rockfall& rockfall, const std::function<bool(double)>& progress) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Both in one. Deterministic for any number of threads.
[[nodiscard]] RockfallResult run_rockfall(const Rockfall& rockfall, const std::function<bool(double)>& progress);

}  // namespace lahar::cases

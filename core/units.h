#pragma once
// The only conversion between SI and lattice units. Lattice units: cell size 1, fluid time step 1, reference density 1.

namespace lahar {

struct LatticeUnits {
  double cell_size = 1;  ///< m
  double time_step = 1;  ///< s
  double density = 1;    ///< kg/m^3

  /// Velocity, m/s <-> lu.
  [[nodiscard]] double velocity_to_lu(double v) const { return v * time_step / cell_size; }
  [[nodiscard]] double velocity_to_si(double v) const { return v * cell_size / time_step; }
  /// Acceleration, m/s^2 <-> lu.
  [[nodiscard]] double acceleration_to_lu(double a) const { return a * time_step * time_step / cell_size; }
  /// Kinematic viscosity, m^2/s <-> lu.
  [[nodiscard]] double viscosity_to_lu(double nu) const { return nu * time_step / (cell_size * cell_size); }
  [[nodiscard]] double viscosity_to_si(double nu) const { return nu * cell_size * cell_size / time_step; }
  /// Mass of one lattice mass unit (a full cell at reference density), kg.
  [[nodiscard]] double mass() const { return density * cell_size * cell_size * cell_size; }
  /// Momentum per step, lu -> force in N.
  [[nodiscard]] double force_to_si(double f) const { return f * mass() * cell_size / (time_step * time_step); }
  [[nodiscard]] double force_to_lu(double f) const { return f / (mass() * cell_size / (time_step * time_step)); }
  /// Torque, lu -> N m.
  [[nodiscard]] double torque_to_si(double t) const { return force_to_si(t) * cell_size; }
  /// Surface tension, N/m -> lu.
  [[nodiscard]] double surface_tension_to_lu(double sigma) const {
    return sigma * time_step * time_step / (density * cell_size * cell_size * cell_size);
  }
  /// Pressure above ambient, Pa: cs^2 (rho - 1).
  [[nodiscard]] double pressure_to_si(double p) const {
    return p * density * cell_size * cell_size / (time_step * time_step);
  }
};

}  // namespace lahar

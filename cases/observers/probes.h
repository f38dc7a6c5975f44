#pragma once
// The probes of a scene: depth, pressure and velocity at points, force and moment on walls, the way of a grain.
#include <string>
#include <vector>

#include "cases/observers/observer.h"

namespace lahar::cases {

class Probes final : public Observer {
 public:
  explicit Probes(const Observed& run);
  static bool applies(const Observed& run) { return !run.scene.probes.empty(); }
  [[nodiscard]] std::string_view name() const override { return "probes"; }
  /// What grains give walls is summed up; so are pressures where their mean is asked for.
  void after_step() override;
  void sample(double interval) override;
  /// Sums since the last row.
  void transfer(Archive& archive) override;

 private:
  /// Force and moment, or their sums over time.
  struct Load {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    void transfer(Archive& archive) {
      archive.value("force", force);
      archive.value("moment", moment);
    }
  };
  struct ForceProbe {
    std::string name;
    std::uint32_t wall;
    Vec3 point;
    Load fluid_before, grains_since;  // N s and N m s about the origin: at the last row, since the last row
    Load fluid, grains, both;         // N and N m about the point: means over the time since the last row
  };
  struct Level {
    Vec3 point;
    double depth;  ///< m, at the last row
  };
  struct Current {
    Vec3 point, velocity;  ///< m; m/s, at the last row
  };
  struct Sensor {
    std::string name;
    Vec3 point;
    double diameter;        ///< m
    bool time_mean;         ///< else the pressure of the row's moment
    double since, reading;  ///< Pa s since the last row; Pa
  };
  struct Followed {
    std::string name;
    dem::ParticleId grain;
    Vec3 position, velocity;  ///< m, m/s, at the last row; NaN once it is gone
  };
  void declare_level(const scene::Probe& probe);
  void declare_pressure(const scene::Probe& probe);
  void declare_velocity(const scene::Probe& probe);
  void declare_force(const scene::Probe& probe);
  void declare_grain(const scene::Probe& probe);
  [[nodiscard]] double pressure_on(const Sensor& sensor) const;
  void declare_load(std::size_t probe, const std::string& source, const std::string& who, Load ForceProbe::*load);
  [[nodiscard]] static Load mean_load(const Load& sum, double span, const Vec3& point);

  std::vector<Level> levels_;
  std::vector<Current> currents_;
  std::vector<ForceProbe> forces_;
  std::vector<Sensor> sensors_;
  std::vector<Followed> followed_;
  double looked_at_;       ///< s: when pressures were last summed
  double fluid_span_ = 0;  ///< s: in which walls got what the fluid has booked since the last row
};

}  // namespace lahar::cases

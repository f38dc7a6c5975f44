#pragma once
// The probes of a scene: depth and pressure at points, force and moment on walls. Definitions in docs/outputs.md.
#include <map>
#include <string>
#include <vector>

#include "cases/files/series_writer.h"
#include "cases/scene/scene.h"
#include "coupling/coupled_step.h"

namespace lahar::cases {

template <class Real>
class Probes {
 public:
  /// Declares a column per quantity.
  Probes(const scene::Scene& scene, coupling::CoupledStep<Real>& step, SeriesWriter& series);

  /// To be called after every step: grains push only while they touch.
  void after_step();
  /// Sums since the last row, for a checkpoint.
  void transfer(Archive& archive);
  /// Appends the present values to a row, in the order of the columns. Forces are means over the `interval` (s) since
  /// the last row.
  void sample(std::vector<double>& row, double interval, std::map<std::string, double>& metrics);

 private:
  struct Load {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< times time, about the origin
    void transfer(Archive& archive) {
      archive.value("force", force);
      archive.value("moment", moment);
    }
  };
  struct ForceProbe {
    std::string name;
    std::uint32_t wall;
    Vec3 point;
    Load fluid_before, grains;
  };
  void sample_force(ForceProbe& probe, std::vector<double>& row, double interval,
                    std::map<std::string, double>& metrics);

  const scene::Scene& scene_;
  coupling::CoupledStep<Real>& step_;
  std::vector<ForceProbe> forces_;
};

extern template class Probes<float>;
extern template class Probes<double>;

}  // namespace lahar::cases

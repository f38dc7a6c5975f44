#pragma once
// The files of a run beside series.h5: particles, fluid volumes, pictures.
#include <filesystem>
#include <optional>

#include "cases/files/particle_writer.h"
#include "cases/files/vdb_writer.h"
#include "cases/pictures/camera.h"
#include "cases/runner/schedule.h"
#include "cases/scene/scene.h"
#include "core/geometry.h"
#include "coupling/coupled_step.h"

namespace lahar::cases {

template <class Real>
class Outputs {
 public:
  Outputs(const scene::Scene& scene, std::filesystem::path folder);
  /// Writes whatever is due at the present time.
  void write_due(coupling::CoupledStep<Real>& step);
  /// Writes a last frame, if one is wanted and the last is older than the present time.
  void finish(coupling::CoupledStep<Real>& step);
  /// Frame numbers of a checkpoint. Loading drops frames that came later: they will be written again.
  void transfer(Archive& archive);

 private:
  void remove_later_files() const;
  void write_fields(coupling::CoupledStep<Real>& step);
  void write_picture(coupling::CoupledStep<Real>& step);

  const scene::Scene& scene_;
  std::filesystem::path folder_;
  Walls walls_;
  std::optional<ParticleWriter> particles_;
  std::optional<VdbWriter> volumes_;
  Schedule frames_, pictures_;
};

extern template class Outputs<float>;
extern template class Outputs<double>;

}  // namespace lahar::cases

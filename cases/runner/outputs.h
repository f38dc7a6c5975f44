#pragma once
// The files of a run beside series.h5: particles, fluid volumes, pictures, maps of forces.
#include <filesystem>
#include <optional>
#include <vector>

#include "cases/assembly/simulation.h"
#include "cases/files/particle_writer.h"
#include "cases/files/vdb_writer.h"
#include "cases/runner/schedule.h"
#include "cases/scene/scene.h"
#include "core/geometry.h"

namespace lahar::cases {

class Outputs {
 public:
  Outputs(const scene::Scene& scene, std::filesystem::path folder);
  /// Writes whatever is due at the present time.
  void write_due(Simulation& run);
  /// Writes a last frame, if one is wanted and the last is older than the present time, and closes the files.
  void finish(Simulation& run);
  /// Puts all that was written into the files. Throws FileError, CannotCopy as ParticleWriter::flush does.
  void flush() { particles_.flush(); }
  /// Why what others see of it could not be brought up to date; empty if it could.
  [[nodiscard]] const std::string& refusal() const { return particles_.refusal(); }
  /// Frame numbers of a checkpoint. Loading drops frames that came later, as they will be written again; of what is no
  /// longer asked for all are kept.
  void transfer(Archive& archive);
  /// What of an earlier part of the run could not be read; empty if all could.
  [[nodiscard]] std::string lost() const { return particles_.lost(); }

 private:
  void remove_later_files() const;
  void write_fields(Simulation& run);
  void write_picture(Simulation& run);
  void write_force_map(Simulation& run);

  const scene::Scene& scene_;
  std::filesystem::path folder_;
  Walls walls_;
  ParticleWriter particles_;
  std::optional<VdbWriter> volumes_;
  Schedule frames_, pictures_, force_maps_;
  std::vector<Vec3> first_places_;  ///< m, by id: of all particles in the first map of forces
};

}  // namespace lahar::cases

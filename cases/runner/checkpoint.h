#pragma once
// checkpoint.h5 in the folder of a run: whole, of one moment, or not there. Written under a temporary name, brought to
// the disk, renamed.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cases/scene/scene.h"
#include "core/archive.h"

namespace lahar::cases {

inline constexpr const char* kCheckpointFile = "checkpoint.h5";
/// To be raised whenever an owner of state stores something else than before.
inline constexpr int kCheckpointFormat = 32;

/// What a checkpoint says of itself.
struct CheckpointHead {
  double time = 0;      ///< s
  double last_row = 0;  ///< s, of series.h5: later rows do not belong to it
  std::string commit;   ///< of the program that wrote it; after those of others that came before it, "first, second"
};

/// Of all that a checkpoint says of itself; its lists of numbers have check sums of their own.
std::string check_sum(const CheckpointHead& head);

/// The scene without what may change in a resumed run (resume.h), and the check sums that the files it names had when
/// it was loaded.
std::string physics_of(const scene::Scene& scene);

/// Replaces the checkpoint. Throws FileError, and NumericalFailure if the state is not finite; the former checkpoint is
/// then still there.
void write_checkpoint(const std::filesystem::path& folder, const scene::Scene& scene, const CheckpointHead& head,
                      const std::function<void(Archive&)>& transfer);

/// Reads what stands at the front. Throws InputError where there is no checkpoint, or one that is damaged, of another
/// version or of another scene.
CheckpointHead read_head(const std::filesystem::path& folder, const scene::Scene& scene);

/// Loads the state. Throws InputError where the checkpoint is damaged or does not fit.
void load_checkpoint(const std::filesystem::path& folder, const std::function<void(Archive&)>& transfer);

/// Time of the checkpoint in a folder, s; nothing where there is none that can be read.
std::optional<double> last_checkpoint(const std::filesystem::path& folder);

}  // namespace lahar::cases

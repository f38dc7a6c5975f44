#include "cases/runner/checkpoint.h"

#include <fmt/format.h>

#include <sstream>
#include <vector>

#include "cases/files/checkpoint_file.h"
#include "cases/files/output_file.h"
#include "cases/runner/machine.h"
#include "cases/scene/writer.h"
#include "core/check.h"

namespace lahar::cases {

namespace {

namespace fs = std::filesystem;

constexpr const char* kExpected = ", expected a checkpoint that this version wrote for this scene";

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError(std::vector<InputMistake>{{file.string(), 1, 1, why}});
}

/// What cannot be read becomes a mistake of the input.
template <class Read>
auto guarded_read(const fs::path& file, const Read& read) {
  try {
    return read();
  } catch (const FileError& e) {
    const std::string text = e.what(), name = e.path().string() + ": ";
    const std::string cause = "(" + (text.starts_with(name) ? text.substr(name.size()) : text) + ")";
    if (e.path() != file) refuse(e.path(), "cannot be gone on with " + cause + ", expected the file of the run");
    refuse(file, "is damaged or not whole " + cause + kExpected);
  } catch (const ArchiveError& e) {
    refuse(file, std::string("is damaged or of another version (") + e.what() + ")" + kExpected);
  }
}

/// The first line in which two texts differ, as "[table] key = value" or "# file: check sum".
std::string first_difference(const std::string& now, const std::string& stored) {
  std::istringstream a(now), b(stored);
  std::string table, line, other;
  while (std::getline(a, line)) {
    if (line.starts_with("[")) table = line + " ";
    if (line.starts_with("#")) table.clear();
    if (!std::getline(b, other) || line != other)
      return table + line + " in place of " + (other.empty() ? "nothing" : other);
  }
  return "less than before";
}

/// Throws FileError, and ArchiveError where a bit of it was lost: what is cut off from the series hangs on it.
CheckpointHead head_of(const Hdf5File& file) {
  const CheckpointHead head{file.number_attribute("/", "time_s"), file.number_attribute("/", "last_row_s"),
                            file.text_attribute("/", "commit")};
  if (check_sum(head) != file.text_attribute("/", "check")) throw ArchiveError("its head does not have its check sum");
  return head;
}

}  // namespace

std::string check_sum(const CheckpointHead& head) {
  CheckSum sum;
  sum.add(&head.time, sizeof head.time);
  sum.add(&head.last_row, sizeof head.last_row);
  sum.add(head.commit.data(), head.commit.size());
  return sum.text();
}

std::string physics_of(const scene::Scene& scene) {
  scene::Scene copy = scene;
  scene::Run run;
  run.duration = 1;
  run.seed = scene.run.seed;
  run.precision = scene.run.precision;
  copy.run = run;
  copy.identity.title.clear();
  std::string text = scene::to_toml(copy);
  const auto add = [&](const scene::ShapeFile& shape) {
    if (!shape.file.empty()) text += fmt::format("# {}: {}\n", shape.file, shape.sampled.check_sum);
  };
  for (const auto& w : scene.walls) add(w.file);
  for (const auto& r : scene.fluid.regions) add(r.file);
  return text;
}

void write_checkpoint(const fs::path& folder, const scene::Scene& scene, const CheckpointHead& head,
                      const std::function<void(Archive&)>& transfer) {
  replace_file(folder / kCheckpointFile, [&](const fs::path& temporary) {
    {
      CheckpointWriter archive(temporary);
      std::string physics = physics_of(scene);
      archive.text("scene", physics);
      transfer(archive);
      Hdf5File& file = archive.file();
      file.set_attribute("/", "time_s", head.time);
      file.set_attribute("/", "last_row_s", head.last_row);
      file.set_attribute("/", "version", version());
      file.set_attribute("/", "commit", head.commit);
      file.set_attribute("/", "check", check_sum(head));
      file.set_attribute("/", "format", static_cast<double>(kCheckpointFormat));
      file.close();
    }
    sync_file(temporary);
  });
}

CheckpointHead read_head(const fs::path& folder, const scene::Scene& scene) {
  const fs::path path = folder / kCheckpointFile;
  if (!fs::is_regular_file(path)) refuse(path, "there is no such file, expected the checkpoint of a run");
  CheckpointHead head;
  std::string stored;
  double format = 0;
  std::string written_by;
  guarded_read(path, [&] {
    CheckpointReader archive(path);
    const Hdf5File& file = archive.file();
    format = file.number_attribute("/", "format");
    if (format != kCheckpointFormat) {
      written_by = fmt::format("{} ({})", file.text_attribute("/", "version"), file.text_attribute("/", "commit"));
      return;
    }
    head = head_of(file);
    archive.text("scene", stored);
  });
  if (format != kCheckpointFormat)
    refuse(path, fmt::format("is of format {:g}, written by Lahar {}, expected format {}", format, written_by,
                             kCheckpointFormat));
  if (const std::string now = physics_of(scene); now != stored)
    refuse(path, fmt::format("is of another scene ({}), expected the scene of the run", first_difference(now, stored)));
  return head;
}

void load_checkpoint(const fs::path& folder, const std::function<void(Archive&)>& transfer) {
  const fs::path path = folder / kCheckpointFile;
  guarded_read(path, [&] {
    CheckpointReader archive(path);
    transfer(archive);
  });
}

std::optional<double> last_checkpoint(const fs::path& folder) {
  try {
    if (!fs::is_regular_file(folder / kCheckpointFile)) return std::nullopt;
    return head_of(Hdf5File::open_for_reading(folder / kCheckpointFile)).time;
  } catch (const FileError&) {
    return std::nullopt;
  } catch (const ArchiveError&) {
    return std::nullopt;
  }
}

}  // namespace lahar::cases

#pragma once
// particles.h5 with particles.xmf and bonds.xmf: what ParaView needs to show grains, beads and bonds over time.
//   /frames/NNNNNN/       position, velocity, angular_velocity (N x 3), state (N); axial_force, elongation, intact (M);
//                         attribute time_s
//   /constant/NNNNNN/     id, radius, kind, body (N); connectivity (M x 2), sort (M): stored once, and again only when
//                         particles or bonds were added (NNNNNN is the first frame that they belong to)
// Numbers are float32 or integers in SI units; every dataset has the attribute `unit`. Groups of other names were added
// by others and stay.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/files/growing_file.h"
#include "cases/files/hdf5_file.h"
#include "cases/files/xdmf.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::cases {

/// Writes one frame at a time. particles.h5 is whole at any time (growing_file.h), and the .xmf files tell of the
/// frames that it holds: a killed run loses at most the frames since the last copy.
class ParticleWriter {
 public:
  /// For an existing directory.
  explicit ParticleWriter(const std::filesystem::path& directory);
  ParticleWriter(const ParticleWriter&) = delete;
  ParticleWriter& operator=(const ParticleWriter&) = delete;
  ~ParticleWriter();

  /// State of a checkpoint.
  void transfer(Archive& archive);
  /// After loading: goes on with the file in the directory. Frames that came later are dropped, constants are stored
  /// again with the next frame. If it cannot be read it is set aside, the frames begin anew, and lost() tells so.
  /// Throws FileError.
  void take_up();
  /// What of the earlier run could not be read; empty if all could.
  [[nodiscard]] const std::string& lost() const { return lost_; }

  /// Adds a frame. Throws FileError, after which others go on seeing the last whole file.
  void write(double time_s, const dem::Particles& particles, const dem::Bonds& bonds);
  /// Why write could not bring up to date what others see; empty if it could.
  [[nodiscard]] const std::string& refusal() const { return grown_.refusal(); }
  /// Puts all frames into the files. Throws FileError, CannotCopy if they are only in what grows (growing_file.h).
  void flush();
  /// The same, and closes; nothing may be written afterwards. Throws FileError.
  void close();

 private:
  template <class T>
  XdmfArray store(const std::string& name, const std::vector<T>& values, int width, const char* unit);
  XdmfArray store_vectors(const std::string& name, const Vec3Field& field, const char* unit);
  XdmfArray store_scalars(const std::string& name, const std::vector<double>& values, const char* unit);
  void write_constants(const dem::Particles& particles, const dem::Bonds& bonds);
  void write_particles(const std::string& group, XdmfGrid& grid, const dem::Particles& particles);
  void drop_later_frames();
  void write_xdmf() const;
  void write_bonds(const std::string& group, XdmfGrid& grid, const dem::Bonds& bonds);

  std::filesystem::path directory_;
  GrowingFile grown_;
  std::optional<Hdf5File> file_;                   ///< none until the first frame
  std::uint64_t frames_ = 0, constants_from_ = 0;  ///< written; the frame that needs constants whatever is known
  std::size_t particles_ = 0, bonds_ = 0;          // sizes that the constants belong to
  XdmfArray ids_, connectivity_;
  std::vector<XdmfField> particle_constants_, bond_constants_;
  std::string particle_grids_, bond_grids_, lost_;
  bool whole_ = true;  // the last frame was written in full
};

}  // namespace lahar::cases

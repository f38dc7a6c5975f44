#include "cases/files/particle_writer.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>

namespace lahar::cases {

namespace {

const std::string kFile = "particles.h5";

template <class T>
constexpr XdmfType xdmf_type() {
  if constexpr (std::is_same_v<T, float>) return XdmfType::float32;
  if constexpr (std::is_same_v<T, std::int32_t>) return XdmfType::int32;
  return XdmfType::uint8;
}

template <class Enum>
std::vector<std::uint8_t> as_bytes(const std::vector<Enum>& values) {
  std::vector<std::uint8_t> bytes(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) bytes[i] = static_cast<std::uint8_t>(values[i]);
  return bytes;
}

/// The number of a frame in the name of its group; nothing for groups that others have added.
std::optional<std::uint64_t> frame_number(const std::string& name) {
  std::uint64_t number = 0;
  const bool read = std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc();
  if (!read || name != fmt::format("{:06}", number)) return {};
  return number;
}

}  // namespace

ParticleWriter::ParticleWriter(const std::filesystem::path& directory)
    : directory_(directory), grown_(directory / kFile) {}

ParticleWriter::~ParticleWriter() {
  try {
    close();
  } catch (const std::exception&) {
    // Nobody left to tell: whoever wants to know calls close().
  }
}

template <class T>
XdmfArray ParticleWriter::store(const std::string& name, const std::vector<T>& values, int width, const char* unit) {
  XdmfArray array{kFile + ":" + name, values.size() / static_cast<std::size_t>(width), width, xdmf_type<T>()};
  std::vector<std::uint64_t> dimensions{array.rows};
  if (width > 1) dimensions.push_back(static_cast<std::uint64_t>(width));
  file_->write(name, std::span<const T>(values), dimensions);
  file_->set_attribute(name, "unit", std::string(unit));
  return array;
}

XdmfArray ParticleWriter::store_vectors(const std::string& name, const Vec3Field& field, const char* unit) {
  std::vector<float> values(3 * field.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    values[3 * i] = static_cast<float>(field.x[i]);
    values[3 * i + 1] = static_cast<float>(field.y[i]);
    values[3 * i + 2] = static_cast<float>(field.z[i]);
  }
  return store(name, values, 3, unit);
}

XdmfArray ParticleWriter::store_scalars(const std::string& name, const std::vector<double>& values, const char* unit) {
  return store(name, std::vector<float>(values.begin(), values.end()), 1, unit);
}

void ParticleWriter::write_constants(const dem::Particles& particles, const dem::Bonds& bonds) {
  const std::string group = fmt::format("/constant/{:06}/", frames_);
  std::vector<std::int32_t> ids(particles.size());
  std::iota(ids.begin(), ids.end(), 0);
  ids_ = store(group + "id", ids, 1, "");
  particle_constants_ = {
      {"id", XdmfCentre::node, ids_},
      {"radius", XdmfCentre::node, store_scalars(group + "radius", particles.radius, "m")},
      {"kind", XdmfCentre::node, store(group + "kind", as_bytes(particles.kind), 1, "0 grain, 1 bead")},
      {"body", XdmfCentre::node, store(group + "body", particles.body, 1, "")}};
  std::vector<std::int32_t> ends(2 * bonds.size());
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    ends[2 * b] = static_cast<std::int32_t>(bonds.id_i[b]);
    ends[2 * b + 1] = static_cast<std::int32_t>(bonds.id_j[b]);
  }
  connectivity_ = store(group + "connectivity", ends, 2, "");
  bond_constants_ = {{"sort", XdmfCentre::cell, store(group + "sort", bonds.sort, 1, "")}};
  particles_ = particles.size();
  bonds_ = bonds.size();
}

void ParticleWriter::write_particles(const std::string& group, XdmfGrid& grid, const dem::Particles& particles) {
  grid.connectivity = ids_;
  grid.fields = particle_constants_;
  grid.fields.push_back({"velocity", XdmfCentre::node, store_vectors(group + "velocity", particles.velocity, "m/s")});
  grid.fields.push_back({"angular_velocity", XdmfCentre::node,
                         store_vectors(group + "angular_velocity", particles.angular_velocity, "rad/s")});
  grid.fields.push_back(
      {"state", XdmfCentre::node, store(group + "state", as_bytes(particles.state), 1, "0 free, 1 fixed, 2 removed")});
}

void ParticleWriter::write_bonds(const std::string& group, XdmfGrid& grid, const dem::Bonds& bonds) {
  grid.topology = XdmfTopology::segments;
  grid.connectivity = connectivity_;
  grid.fields = bond_constants_;
  grid.fields.push_back(
      {"axial_force", XdmfCentre::cell, store_scalars(group + "axial_force", bonds.axial_force, "N")});
  grid.fields.push_back({"elongation", XdmfCentre::cell, store_scalars(group + "elongation", bonds.elongation, "m")});
  grid.fields.push_back({"intact", XdmfCentre::cell, store(group + "intact", bonds.intact, 1, "0 broken, 1 intact")});
}

void ParticleWriter::transfer(Archive& archive) {
  archive.value("frames", frames_);
  archive.text("particle_grids", particle_grids_);
  archive.text("bond_grids", bond_grids_);
}

void ParticleWriter::take_up() {
  constants_from_ = frames_;
  if (frames_ == 0) return;
  try {
    grown_.take_up();
    file_ = Hdf5File::open_for_appending(grown_.open_name());
    drop_later_frames();
  } catch (const CannotTakeUp&) {  // the frames are not lost
    throw;
  } catch (const FileError& e) {
    file_.reset();
    particle_grids_.clear(), bond_grids_.clear();
    lost_ = std::string(e.what()) + ": particles begin anew";
    if (const auto aside = grown_.set_aside(); !aside.empty()) lost_ += ", the former file is now " + aside.string();
  }
}

void ParticleWriter::drop_later_frames() {
  for (const char* group : {"/frames", "/constant"})
    for (const std::string& frame : file_->members(group))
      if (frame_number(frame) >= frames_) file_->remove(std::string(group) + "/" + frame);
}

void ParticleWriter::write(double time_s, const dem::Particles& particles, const dem::Bonds& bonds) {
  if (!particles.numbering.by_id()) {  // files are in the order of ids
    dem::Particles by_id = particles;
    by_id.renumber(by_id.numbering.to_ids(by_id.size()));
    return write(time_s, by_id, bonds);
  }
  if (!file_) file_ = Hdf5File::create(grown_.open_name());
  whole_ = false;
  if (frames_ == constants_from_ || particles.size() != particles_ || bonds.size() != bonds_)
    write_constants(particles, bonds);
  const std::string group = fmt::format("/frames/{:06}/", frames_);
  XdmfGrid grid;
  grid.time_s = time_s;
  grid.points = store_vectors(group + "position", particles.position, "m");
  file_->set_attribute(group, "time_s", time_s);
  XdmfGrid bond_grid = grid;
  grid.name = "particles", bond_grid.name = "bonds";
  write_particles(group, grid, particles);
  write_bonds(group, bond_grid, bonds);
  ++frames_;
  // A grid without elements upsets the readers: such a time is left out.
  if (particles.size() > 0) particle_grids_ += xdmf_grid(grid);
  if (bonds.size() > 0) bond_grids_ += xdmf_grid(bond_grid);
  whole_ = true;
  grown_.copy_if_due([this] { flush(); });
}

void ParticleWriter::write_xdmf() const {
  replace_text_file(directory_ / "particles.xmf", xdmf_document("particles", particle_grids_));
  if (!bond_grids_.empty()) replace_text_file(directory_ / "bonds.xmf", xdmf_document("bonds", bond_grids_));
}

void ParticleWriter::flush() {
  if (!file_) return;
  whole_ = false;
  file_->flush();
  whole_ = true;
  grown_.copy();
  write_xdmf();
}

void ParticleWriter::close() {
  if (!file_) return;
  if (whole_) file_->close();
  file_.reset();
  if (!whole_) return;
  grown_.finish();
  write_xdmf();
}

}  // namespace lahar::cases

// What the particles hand to a checkpoint and take from it.
//
// Beside positions, velocities and bonds, a restart needs the forces (the first half kick), what every touching contact
// remembers, and the contact lists as they are: a list built at the restart would hold a pair whose bond broke since
// the last build, and the two would touch some steps too early.
#include <algorithm>
#include <utility>

#include "core/check.h"
#include "dem/solids.h"
#include "dem/watchdog.h"

namespace lahar::dem {

void Particles::transfer(Archive& archive) {
  archive.list("radius", radius);
  const std::size_t n = size();
  const auto vectors = [&](const char* name, Vec3Field& field) {
    archive.list(name, field);
    if (field.size() != n) archive.refuse(name, "is not there for every particle");
  };
  vectors("position", position);
  vectors("velocity", velocity);
  vectors("angular_velocity", angular_velocity);
  vectors("force", force);
  vectors("torque", torque);
  vectors("external_force", external_force);
  vectors("external_torque", external_torque);
  archive.list_of("mass", mass, n);
  archive.list_of("inverse_mass", inverse_mass, n);
  archive.list_of("inertia", inertia, n);
  archive.list_of("material", material, n);
  archive.list_of("body", body, n);
  archive.list_of("kind", kind, n);
  archive.list_of("state", state, n);
}

void Bonds::transfer(Archive& archive) {
  archive.list("i", i);
  const std::size_t n = size();
  archive.list_of("j", j, n);
  archive.list_of("sort", sort, n);
  archive.list_of("intact", intact, n);
  archive.list_of("rest_length", rest_length, n);
  archive.list_of("elongation", elongation, n);
  archive.list_of("plastic_elongation", plastic_elongation, n);
  archive.list_of("axial_force", axial_force, n);
  archive.list_of("torsion_moment", torsion_moment, n);
  for (auto [name, field] : {std::pair{"shear_force", &shear_force}, {"moment", &moment}, {"direction", &direction}}) {
    archive.list(name, *field);
    if (field->size() != n) archive.refuse(name, "is not there for every bond");
  }
  archive.value("damping_loss", damping_loss);
  archive.value("breakage_loss", breakage_loss);
}

void NeighbourList::transfer(Archive& archive, const Particles& particles) {
  archive.value("builds", builds_);
  archive.list("offset", offset_);
  archive.list("neighbour", neighbour_);
  const std::size_t n = builds_ > 0 ? particles.size() : 0;
  archive.list_of("built_x", built_x_, n);
  archive.list_of("built_y", built_y_, n);
  archive.list_of("built_z", built_z_, n);
  if (!archive.loading()) return;
  if (n > 0) set_move_limits(particles);
  const auto bad = [&](std::uint32_t j) { return j >= particles.size(); };
  const bool rows = offset_.empty()
                        ? neighbour_.empty()
                        : offset_.size() == n + 1 && offset_.front() == 0 &&
                              std::is_sorted(offset_.begin(), offset_.end()) && offset_.back() == neighbour_.size();
  if (!rows || std::any_of(neighbour_.begin(), neighbour_.end(), bad))
    archive.refuse("offset", "is no list of neighbours");
}

void ContactSlots::transfer_histories(Archive& archive) {
  if (archive.loading()) touching.assign(size(), 0), history.assign(size(), {});
  archive.list_of("touching", touching, size());
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < size(); ++k)
    if (touching[k]) used.push_back(k);
  archive.pieces<double>("history", used.size(), 5, [&](std::size_t k, double* stored) {
    ContactHistory& h = history[used[k]];
    double* const own[] = {&h.tangential_displacement.x, &h.tangential_displacement.y, &h.tangential_displacement.z,
                           &h.tangential_stiffness, &h.normal_force};
    for (std::size_t a = 0; a < 5; ++a) {
      if (archive.loading())
        *own[a] = stored[a];
      else
        stored[a] = *own[a];
    }
  });
}

namespace {

struct PairHistories {
  ContactSlots& slots;
  void transfer(Archive& archive) { slots.transfer_histories(archive); }
};

/// Unlike pairs, wall contacts are listed nowhere else.
struct WallContacts {
  ContactSlots& slots;
  void transfer(Archive& archive) {
    archive.list("offset", slots.offset);
    archive.list("partner", slots.partner);
    const auto& offset = slots.offset;
    if (!offset.empty() &&
        (offset.front() != 0 || !std::is_sorted(offset.begin(), offset.end()) || offset.back() != slots.partner.size()))
      archive.refuse("offset", "is no list of contacts");
    slots.transfer_histories(archive);
  }
};

struct Neighbours {
  NeighbourList& list;
  const Particles& particles;
  void transfer(Archive& archive) { list.transfer(archive, particles); }
};

}  // namespace

void ContactDetection::transfer(Archive& archive, const Particles& particles) {
  Neighbours neighbours{neighbours_, particles};
  archive.part("neighbours", neighbours);
  if (archive.loading()) {
    pairs_.offset = neighbours_.offset();
    pairs_.partner = neighbours_.neighbour();
  }
  PairHistories pairs{pairs_};
  archive.part("pairs", pairs);
  WallContacts walls{walls_};
  archive.part("walls", walls);
  if (!archive.loading()) return;
  if (walls_.offset.size() != pairs_.offset.size()) archive.refuse("walls", "are not there for every particle");
  list_partners(particles.size());
}

namespace {

struct Contacts {
  ContactDetection& contacts;
  const Particles& particles;
  void transfer(Archive& archive) { contacts.transfer(archive, particles); }
};

}  // namespace

void Solids::transfer(Archive& archive) {
  if (!archive.loading()) check_motion(particles_, options_.watchdog, step_count_);
  archive.value("time", time_);
  archive.value("steps", step_count_);
  archive.value("time_step", options_.time_step);
  archive.value("external_work", external_work_);
  archive.value("removed_energy", removed_energy_);
  archive.value("external_acts", external_acts_);
  archive.value("prepared", prepared_);
  archive.part("particles", particles_);
  archive.part("bonds", bonds_);
  archive.part("contact_forces", contact_forces_);
  archive.list_of("known_intact", known_intact_, prepared_ ? bonds_.size() : 0);
  archive.value("known_breakage", known_breakage_);
  if (prepared_ && archive.loading()) {
    for (std::size_t k = 0; k < bonds_.size(); ++k)
      if (std::max(bonds_.i[k], bonds_.j[k]) >= particles_.size() ||
          static_cast<std::size_t>(bonds_.sort[k]) >= bonds_.sorts.size())
        archive.refuse("bonds", "do not fit the particles");
    build_bonds();
    known_particles_ = particles_.size();
    known_bonds_ = bonds_.size();
  }
  Contacts contacts{contacts_, particles_};
  archive.part("contacts", contacts);
  archive.list("applied_force", applied_force_);
  archive.list("applied_torque", applied_torque_);
  if (prepared_ && (contacts_.pairs().offset.size() != particles_.size() + 1 ||
                    applied_force_.size() != particles_.size() || applied_torque_.size() != particles_.size()))
    archive.refuse("contacts", "are not there for every particle");
}

}  // namespace lahar::dem

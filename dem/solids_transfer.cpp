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
  require(numbering.by_id(), "particles are stored in the order of their ids");
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
  archive.list_of("gravitational_mass", gravitational_mass, n);
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
  if (archive.loading()) id_i = i, id_j = j;  // particles are in the order of their ids
}

void NeighbourList::transfer(Archive& archive, const Particles& particles, const RateShare& share) {
  archive.value("builds", builds_);
  archive.list("offset", offset_);
  archive.list("neighbour", neighbour_);
  const std::size_t n = builds_ > 0 ? particles.size() : 0;
  archive.list("built_at", built_at_);
  if (built_at_.size() != n) archive.refuse("built_at", "is not there for every particle");
  if (!archive.loading()) return;
  if (n > 0) set_move_limits(particles, share);
  const auto bad = [&](std::uint32_t j) { return j >= particles.size(); };
  const bool rows = offset_.empty()
                        ? neighbour_.empty()
                        : offset_.size() == n + 1 && offset_.front() == 0 &&
                              std::is_sorted(offset_.begin(), offset_.end()) && offset_.back() == neighbour_.size();
  if (!rows || std::any_of(neighbour_.begin(), neighbour_.end(), bad))
    archive.refuse("offset", "is no list of neighbours");
}

void ContactSlots::transfer(Archive& archive, std::size_t particles, std::size_t partners) {
  archive.list("offset", offset);
  archive.list("partner", partner);
  const bool rows = offset.empty() ? partner.empty()
                                   : offset.size() == particles + 1 && offset.front() == 0 &&
                                         std::is_sorted(offset.begin(), offset.end()) && offset.back() == size();
  if (!rows || std::any_of(partner.begin(), partner.end(), [&](std::uint32_t j) { return j >= partners; }))
    archive.refuse("offset", "is no list of contacts");
  if (archive.loading()) {
    touching.assign(size(), 0), history.clear(size()), rolling.assign(rolls ? size() : 0, Triple{});
    owner.resize(size());
    for (std::size_t i = 0; i + 1 < offset.size(); ++i)
      std::fill(owner.begin() + offset[i], owner.begin() + offset[i + 1], static_cast<std::uint32_t>(i));
  }
  archive.list_of("touching", touching, size());
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < size(); ++k)
    if (touching[k]) used.push_back(k);
  archive.pieces<double>("history", used.size(), SlotHistories::kNumbers, [&](std::size_t k, double* stored) {
    double* own = history.row(used[k]);
    if (archive.loading())
      std::copy_n(stored, SlotHistories::kNumbers, own);
    else
      std::copy_n(own, SlotHistories::kNumbers, stored);
  });
  if (!rolls) return;
  archive.pieces<double>("rolling", used.size(), 3, [&](std::size_t k, double* stored) {
    Triple& angle = rolling[used[k]];
    if (archive.loading())
      angle = {stored[0], stored[1], stored[2]};
    else
      stored[0] = angle.x, stored[1] = angle.y, stored[2] = angle.z;
  });
}

namespace {

struct Slots {
  ContactSlots& slots;
  std::size_t particles, partners;
  void transfer(Archive& archive) { slots.transfer(archive, particles, partners); }
};

struct Neighbours {
  NeighbourList& list;
  const Particles& particles;
  const RateShare& share;
  void transfer(Archive& archive) { list.transfer(archive, particles, share); }
};

}  // namespace

void ContactDetection::transfer(Archive& archive, const Particles& particles, std::size_t walls,
                                const RateShare& share) {
  Neighbours neighbours{neighbours_, particles, share};
  archive.part("neighbours", neighbours);
  archive.value("refreshes", refreshes_);
  archive.value("asked", asked_);
  archive.value("narrow_share", narrow_share_);
  archive.list("listed_at", listed_at_);
  if (listed_at_.size() != (refreshes_ > 0 ? particles.size() : 0))
    archive.refuse("listed_at", "is not there for every particle");
  Slots pairs{pairs_, particles.size(), particles.size()};
  archive.part("pairs", pairs);
  Slots wall_slots{walls_, particles.size(), walls};
  archive.part("walls", wall_slots);
  if (walls_.offset.size() != pairs_.offset.size()) archive.refuse("walls", "are not there for every particle");
  if (!archive.loading() || refreshes_ == 0) return;
  set_move_limits(particles, share);
  list_parties(particles);
}

namespace {

struct Contacts {
  ContactDetection& contacts;
  const Particles& particles;
  std::size_t walls;
  RateShare share;
  void transfer(Archive& archive) { contacts.transfer(archive, particles, walls, share); }
};

/// Contacts of wires as they stand: those of the bonds that were whole when their lists were built. A bond that broke
/// in the last step is found by the next one.
struct Wires {
  WireForces& wires;
  const Particles& particles;
  Bonds& bonds;
  std::vector<std::uint8_t>& known_intact;
  void transfer(Archive& archive) {
    std::swap(bonds.intact, known_intact);
    wires.transfer(archive, particles, bonds);
    std::swap(bonds.intact, known_intact);
  }
};

}  // namespace

/// Files hold particles in the order of their ids. Storing therefore renumbers them, which changes nothing, and back.
void Solids::transfer(Archive& archive) {
  if (archive.loading()) {
    particles_.numbering = {};
    return transfer_by_id(archive);
  }
  check_motion(particles_, options_.watchdog, step_count_);
  if (particles_.numbering.by_id()) return transfer_by_id(archive);
  const Renumbering change = particles_.numbering.to_ids(particles_.size());
  renumber(change);
  transfer_by_id(archive);
  renumber(change.inverse());
}

void Solids::transfer_by_id(Archive& archive) {
  archive.part("walls", walls_);
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
  archive.list("checked_elongation", checked_elongation_);
  if (prepared_ && archive.loading()) {
    for (std::size_t k = 0; k < bonds_.size(); ++k)
      if (std::max(bonds_.i[k], bonds_.j[k]) >= particles_.size() ||
          static_cast<std::size_t>(bonds_.sort[k]) >= bonds_.sorts.size())
        archive.refuse("bonds", "do not fit the particles");
    build_bonds();
    bonded_.assign(particles_.size(), bonds_.i, bonds_.j, known_intact_);
    known_particles_ = particles_.size();
    known_bonds_ = bonds_.size();
    find_slow();
  }
  if (wires_ && prepared_) {
    Wires wires{*wires_, particles_, bonds_, known_intact_};
    archive.part("wires", wires);
  }
  Contacts contacts{contacts_, particles_, walls_.all().size(), share(Rate::fast)};
  archive.part("contacts", contacts);
  if (two_rates()) {
    Contacts slow_contacts{slow_contacts_, particles_, walls_.all().size(), share(Rate::slow)};
    archive.part("slow_contacts", slow_contacts);
    archive.part("slow_forces", slow_forces_);
    archive.value("slow_step", slow_step_);
    archive.list("slow_force", slow_force_);
    archive.list("slow_torque", slow_torque_);
    if (slow_force_.size() != particles_.size() || slow_torque_.size() != particles_.size())
      archive.refuse("slow_force", "is not there for every particle");
  }
  archive.list("applied_force", applied_force_);
  archive.list("applied_torque", applied_torque_);
  archive.list("bond_force", bond_force_);
  archive.list("bond_torque", bond_torque_);
  const auto complete = [&](const Vec3Field& f) { return f.size() == particles_.size(); };
  if (prepared_ && (contacts_.pairs().offset.size() != particles_.size() + 1 || !complete(applied_force_) ||
                    !complete(applied_torque_) || !complete(bond_force_) || !complete(bond_torque_)))
    archive.refuse("contacts", "are not there for every particle");
}

}  // namespace lahar::dem

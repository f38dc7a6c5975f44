// What contacts of wires hand to a checkpoint and take from it: the slots as they are, with all histories.
#include <algorithm>

#include "dem/wires/wire_forces.h"

namespace lahar::dem {

void WireDetection::transfer(Archive& archive, const Particles& particles, const WireChains& chains) {
  archive.list("built_at", built_at_);
  archive.list("move_limit2", move_limit2_);
  if (built_at_.size() != move_limit2_.size() || (!built_at_.x.empty() && built_at_.size() != particles.size()))
    archive.refuse("built_at", "is not there for every particle");
  std::vector<std::uint32_t> names;  // five of each slot
  for (const WireSlot& s : slots_)
    for (const std::uint32_t x : {s.wire, s.partner, s.count, s.last, static_cast<std::uint32_t>(s.touching)})
      names.push_back(x);
  archive.list("slots", names);
  if (archive.loading()) {
    slots_.assign(names.size() / 5, {});
    const auto bad = [&](std::uint32_t i) { return i >= particles.size(); };
    for (std::size_t k = 0; k < slots_.size(); ++k) {
      const std::uint32_t* n = &names[5 * k];
      slots_[k] = {n[0], n[1], n[2], n[3], {}, static_cast<std::uint8_t>(n[4])};
      if (bad(n[0]) || bad(n[1]) || bad(n[3]) || chains.covered()[n[0]] == 0)
        archive.refuse("slots", "is no list of contacts");
      ParticleIndex b = n[1];  // a run must lie on one wire
      for (std::uint32_t m = 0; m < n[2]; ++m, b = chains.behind(b))
        if (b == WireChains::none || chains.covered()[b] == 0 || m >= particles.size())
          archive.refuse("slots", "is no list of contacts");
    }
  }
  archive.pieces<double>("history", slots_.size(), 6, [&](std::size_t k, double* stored) {
    ContactHistory& h = slots_[k].history;
    double* const own[] = {&h.tangential_displacement.x,
                           &h.tangential_displacement.y,
                           &h.tangential_displacement.z,
                           &h.tangential_stiffness,
                           &h.normal_force,
                           &h.damping_force};
    for (std::size_t a = 0; a < 6; ++a) {
      if (archive.loading())
        *own[a] = stored[a];
      else
        stored[a] = *own[a];
    }
  });
}

namespace {

struct Slots {
  WireDetection& detection;
  const Particles& particles;
  const WireChains& chains;
  void transfer(Archive& archive) { detection.transfer(archive, particles, chains); }
};

}  // namespace

void WireForces::transfer(Archive& archive, const Particles& particles, const Bonds& bonds) {
  if (archive.loading()) chains_.build(bonds, particles);
  archive.part("energy", energy_);
  Slots slots{detection_, particles, chains_};
  archive.part("slots", slots);
  if (archive.loading()) note_slots(particles);
}

}  // namespace lahar::dem

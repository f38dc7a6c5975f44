// What the coupling hands to a checkpoint and takes from it.
#include "coupling/coupled_step.h"

namespace lahar::coupling {

/// Of the last mapping: which sphere reached which block with which volume, and the velocities of the grains. What the
/// next mapping overwrites is left out.
template <class Real>
void BodyMap<Real>::transfer(Archive& archive) {
  std::size_t bodies = bodies_.size(), pairs = pairs_.size();
  archive.value("bodies", bodies);
  archive.value("pairs", pairs);
  bodies_.resize(bodies), spheres_.resize(bodies), pairs_.resize(pairs);
  const bool loading = archive.loading();
  const auto carry = [loading](auto& own, auto& stored) {
    if (loading)
      own = static_cast<std::remove_reference_t<decltype(own)>>(stored);
    else
      stored = static_cast<std::remove_reference_t<decltype(stored)>>(own);
  };
  archive.pieces<std::uint64_t>("body", bodies, 3, [&](std::size_t k, std::uint64_t* at) {
    carry(bodies_[k].particle, at[0]), carry(bodies_[k].first_pair, at[1]), carry(bodies_[k].pairs, at[2]);
    if (loading && (at[1] > pairs || at[2] > pairs - at[1])) archive.refuse("body", "does not fit the pairs");
  });
  archive.pieces<Real>("sphere", bodies, 12, [&](std::size_t k, Real* at) {
    GridSphere<Real>& s = spheres_[k];
    for (int a = 0; a < 3; ++a) carry(s.centre[a], at[a]), carry(s.velocity[a], at[3 + a]), carry(s.spin[a], at[6 + a]);
    carry(s.radius, at[9]), carry(s.factor, at[10]), carry(s.surface, at[11]);
  });
  archive.pieces<std::uint64_t>("pair", pairs, 3, [&](std::size_t k, std::uint64_t* at) {
    carry(pairs_[k].block, at[0]), carry(pairs_[k].body, at[1]), carry(pairs_[k].birth, at[2]);
    if (loading && at[1] >= bodies) archive.refuse("pair", "does not fit the bodies");
  });
  archive.pieces<double>("pair_volume", pairs, 2, [&](std::size_t k, double* at) {
    carry(pairs_[k].volume, at[0]), carry(pairs_[k].wet_volume, at[1]);
  });
  archive.pieces<std::int32_t>("pair_lowest", pairs, 3, [&](std::size_t k, std::int32_t* at) {
    for (int a = 0; a < 3; ++a) carry(pairs_[k].lowest[a], at[a]);
  });
  archive.list("last_velocity", last_velocity_);
  archive.list_of("last_spin", last_spin_, last_velocity_.size());
  archive.list_of("felt_force", felt_force_, last_velocity_.size());
  archive.list_of("felt_torque", felt_torque_, last_velocity_.size());
  archive.list_of("known", known_, last_velocity_.size());
  archive.value("wet_volume", wet_volume_);
  if (!loading) return;
  old_wet_.assign(last_velocity_.size(), 0.0);
  for (const Body& b : bodies_)
    if (b.particle >= old_wet_.size()) archive.refuse("body", "is a particle that does not exist");
}

/// The neighbours of the beads are looked at once in many steps.
template <class Real>
void WireDrag<Real>::transfer(Archive& archive) {
  archive.value("wet_beads", wet_beads_);
  archive.value("applied", applied_);
  archive.pieces<double>("crowding", beads_.size(), 3, [&](std::size_t k, double* stored) {
    Crowding& c = beads_[k].crowding;
    double* const own[] = {&c.area, &c.parallel, &c.solidity};
    for (std::size_t a = 0; a < 3; ++a) {
      if (archive.loading())
        *own[a] = stored[a];
      else
        stored[a] = *own[a];
    }
  });
}

/// Where the pieces are follows from the beads; what was displaced and felt does not.
template <class Real>
void WireMap<Real>::transfer(Archive& archive) {
  std::size_t particles = states_.size();
  archive.value("particles", particles);
  states_.resize(particles);
  archive.pieces<double>("bead", particles, 14, [&](std::size_t k, double* stored) {
    State& s = states_[k];
    Vec3* const own[] = {&s.velocity, &s.spin, &s.felt_force, &s.felt_torque};
    for (std::size_t v = 0; v < 4; ++v)
      for (int a = 0; a < 3; ++a) {
        double& at = stored[3 * v + static_cast<std::size_t>(a)];
        if (archive.loading())
          (*own[v])[a] = at;
        else
          at = (*own[v])[a];
      }
    if (archive.loading())
      s.wet = stored[12], s.known = stored[13] != 0;
    else
      stored[12] = s.wet, stored[13] = s.known ? 1 : 0;
  });
}

template <class Real>
void CoupledStep<Real>::transfer(Archive& archive) {
  archive.part("clock", clock_);
  archive.value("substeps", options_.substeps);
  if (archive.loading() && fluid_ && solids_) solids_->set_time_step(clock_.time_step() / options_.substeps);
  archive.part("audit", audit_);
  if (fluid_) archive.part("fluid", *fluid_);
  if (solids_) archive.part("solids", *solids_);
  if (fluid_ && solids_) archive.part("bodies", bodies_);
  if (archive.loading() && resolved_wires_) {
    resolved_wires_->follow_breakage(solids_->particles(), solids_->bonds());
    choose_wires();
  }
  if (wires_) archive.part("wires", *wires_);
  if (resolved_wires_) archive.part("resolved_wires", *resolved_wires_);
}

template <class Real>
void CoupledStep<Real>::transfer_timers(Archive& archive) {
  archive.part("step", timers_);
  if (fluid_) archive.part("fluid", fluid_->timers());
  if (solids_) archive.part("solids", solids_->timers());
}

template void BodyMap<float>::transfer(Archive&);
template void BodyMap<double>::transfer(Archive&);
template void WireDrag<float>::transfer(Archive&);
template void WireDrag<double>::transfer(Archive&);
template void WireMap<float>::transfer(Archive&);
template void WireMap<double>::transfer(Archive&);
template void CoupledStep<float>::transfer(Archive&);
template void CoupledStep<double>::transfer(Archive&);
template void CoupledStep<float>::transfer_timers(Archive&);
template void CoupledStep<double>::transfer_timers(Archive&);

}  // namespace lahar::coupling

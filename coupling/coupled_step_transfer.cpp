// What the coupled step hands to a checkpoint and takes from it.
#include "coupling/coupled_step.h"

namespace lahar::coupling {

template <class Real>
void CoupledStep<Real>::transfer(Archive& archive) {
  archive.part("clock", clock_);
  archive.value("substeps", options_.substeps);
  if (archive.loading() && fluid_ && solids_) solids_->set_time_step(clock_.time_step() / options_.substeps);
  archive.part("audit", audit_);
  if (fluid_) archive.part("fluid", *fluid_);
  if (solids_) archive.part("solids", *solids_);
  if (grains_) archive.part("grains", *grains_);
  if (mapped_wires_) archive.part("mapped_wires", *mapped_wires_);
  if (archive.loading() && mapped_wires_) choose_wires();
  if (thin_wires_) archive.part("thin_wires", *thin_wires_);
}

template <class Real>
void CoupledStep<Real>::transfer_timers(Archive& archive) {
  archive.part("step", timers_);
  if (fluid_) archive.part("fluid", fluid_->timers());
  if (solids_) archive.part("solids", solids_->timers());
}

template void CoupledStep<float>::transfer(Archive&);
template void CoupledStep<double>::transfer(Archive&);
template void CoupledStep<float>::transfer_timers(Archive&);
template void CoupledStep<double>::transfer_timers(Archive&);

}  // namespace lahar::coupling

// A strip of the paper's debris flow, 0.36 m wide, onto a net 0.8 m down the slope: how far water and grains have come,
// how fast they are, and what the net bears.
#include "cases/speed_error/problems/problems.h"
#include "cases/speed_error/problems/strip_of_debris_flow.h"

namespace lahar::validate {

Problem debris_flow_problem(bool quick) {
  const Overrides near{"barrier.net.origin_m=[1.5, 0.0, 0.0]", "section[net].point_m=[1.5, 0.18, 0.3]"};
  const Overrides finest{quick ? "fluid.cell_size_m=0.015" : "fluid.cell_size_m=0.01"};
  std::vector<Overrides> turned{
      {"fluid.cell_size_m=0.03"}, {"solids.two_rates=true"}, {"solids.bond_stiffness_scale=0.5"}, {"run.seed=2"}};
  if (!quick)
    for (const Overrides& more : std::vector<Overrides>{{"fluid.max_speed_m_s=3.5"},
                                                        {"fluid.max_speed_m_s=14"},
                                                        {"fluid.adaptive_time_step=true"},
                                                        {"coupling.radius_shift_cells=-0.06"},
                                                        {"coupling.body_weighting=wall_distance"},
                                                        {"coupling.wire_drag=false"},
                                                        {"fluid.smagorinsky=0"},
                                                        {"solids.contact_safety=0.1"},
                                                        {"solids.contact_modulus_scale=0.1"},
                                                        {"solids.contact_modulus_scale=0.01"},
                                                        {"solids.bond_stiffness_scale=0.1"},
                                                        {"solids.wire_contacts=capsules"},
                                                        {"run.seed=3"},
                                                        {"run.precision=double"},
                                                        {"threads=1"}})
      turned.push_back(more);
  return {
      "debris_flow",
      "RMS of the errors of the ways and kinetic energies of water and grains, of the net's mean force and elongation",
      quick ? "finest-grid (1.5 cm)" : "finest-grid (1 cm)",
      "cells of 2 cm, 7 m/s at 0.1 lu, inertial with equilibrium_difference, radius shift -0.2, Cs 0.16, "
      "contact_safety 0.3, nothing softened, wires bead by bead and by the drag law, float, all threads",
      strip_trials(near, quick ? 0.45 : 0.7, finest, turned)};
}

}  // namespace lahar::validate

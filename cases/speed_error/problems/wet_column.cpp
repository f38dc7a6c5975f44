// The release of the paper's debris flow without the net, over 0.35 s, a strip 0.36 m wide: how far water and grains
// have come and how fast they are.
#include "cases/speed_error/problems/problems.h"
#include "cases/speed_error/problems/strip_of_debris_flow.h"

namespace lahar::validate {

Problem wet_column_problem(bool quick) {
  const Overrides alone{"barrier.enabled=false", "measure.section_x_m=2.0"};
  const Overrides finest{quick ? "fluid.cell_size_m=0.015" : "fluid.cell_size_m=0.0075"};
  std::vector<Overrides> turned{{"fluid.cell_size_m=0.03"},
                                {"fluid.max_speed_m_s=3.5"},
                                {"fluid.adaptive_time_step=true"},
                                {"coupling.radius_shift_cells=-0.06"},
                                {"coupling.body_weighting=wall_distance"},
                                {"coupling.body_weighting=noble_torczynski", "coupling.solid_operator=faded"},
                                {"fluid.smagorinsky=0"},
                                {"solids.contact_safety=0.1"},
                                {"solids.contact_modulus_scale=0.01"},
                                {"run.seed=2"}};
  if (!quick)
    for (const Overrides& more : std::vector<Overrides>{{"fluid.cell_size_m=0.01"},
                                                        {"fluid.max_speed_m_s=14"},
                                                        {"solids.contact_modulus_scale=0.1"},
                                                        {"coupling.lubrication=true"},
                                                        {"run.seed=3"},
                                                        {"run.precision=double"},
                                                        {"threads=1"}})
      turned.push_back(more);
  return {"wet_column", "RMS of the errors of the ways and kinetic energies of water and grains",
          quick ? "finest-grid (1.5 cm)" : "finest-grid (0.75 cm)",
          "cells of 2 cm, 7 m/s at 0.1 lu, inertial with equilibrium_difference, radius shift -0.2, Cs 0.16, "
          "contact_safety 0.3, nothing softened, float, all threads",
          strip_trials(alone, quick ? 0.1 : 0.35, finest, turned)};
}

}  // namespace lahar::validate

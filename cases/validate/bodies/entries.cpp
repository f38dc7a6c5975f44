#include "cases/validate/bodies/entries.h"

#include "cases/validate/bodies/wire_entries.h"

namespace lahar::validate {

std::vector<Entry> bodies_entries() {
  const char* const hard = "hard_cases.csv (thresholds proposed there)";
  return {
      sphere_array(),
      random_pack(),
      fixed_sphere(),
      settling_sphere(),
      {"bodies.wire", "Sucker & Brauer 1975, normal drag of a circular cylinder (cylinder_cd.csv)", wire},
      {"bodies.resolved_wire", "Sucker & Brauer 1975 (cylinder_cd.csv); Blevins 1984 (screen_net.csv), trusted to 20 %",
       resolved_wire},
      {"bodies.screen", "Blevins 1984, round wire screens (screen_net.csv), trusted to 20 %", screen},
      {"bodies.ring_net_drag", "Blevins 1984 at the net's solidity (screen_net.csv), trusted to 20 %", ring_net_drag},
      {"bodies.archimedes", "volume of the sphere; ledger", archimedes},
      {"bodies.floating_sphere", "floating_sphere.csv: 3 x^2 - 2 x^3 = s; heave by linear potential flow",
       floating_sphere},
      {"bodies.hard_h5", hard, hard_h5},
      {"bodies.hard_h6_ring", hard, hard_h6_ring},
      {"bodies.hard_h7", hard, hard_h7},
      {"bodies.hard_h8_sphere", hard, hard_h8_sphere},
      {"bodies.hard_h8_cavity",
       "hard_cases.csv; Truscott, Epps & Belden 2014, Duclaux et al. 2007 for the time and depth of the neck",
       hard_h8_cavity},
      {"bodies.hard_h10", hard, hard_h10},
      {"bodies.hard_h17", hard, hard_h17},
      {"bodies.momentum_audit", "conservation of momentum", momentum_audit},
  };
}

}  // namespace lahar::validate

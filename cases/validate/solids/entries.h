#pragma once
// Entries of the grains, rings, cables and brakes: one file per question, listed in solids_entries().
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Entry> chung_ooi();
Entry cantilever();
Entry catenary();
Entry column_collapse();
Entry energy_ledger();
Entry hard_h15();
Entry hard_h16();
Entry hard_h9();
Entry hexagonal_mesh();
Entry incline_35();
Entry post();
Entry restitution();
Entry rolling_incline();
Entry two_spans();
Entry wire_sliding();

std::vector<Entry> solids_entries();

}  // namespace lahar::validate

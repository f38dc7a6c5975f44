#pragma once
// Entries of the grains, rings, cables and brakes: one file per question, listed in solids_entries().
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Entry> chung_ooi();
Entry restitution();

std::vector<Entry> solids_entries();

}  // namespace lahar::validate

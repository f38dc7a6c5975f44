#pragma once
// Entries of the fluid: one file per question, listed in fluid_entries().
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries();

Entry bingham_channel();
Entry log_law_channel();

}  // namespace lahar::validate

#pragma once
// Entries of the fluid: one file per question, listed in fluid_entries().
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries();

// Flows without a surface.
Entry order_taylor_green();
Entry order_poiseuille();
Entry order_duct();
Entry order_couette();
Entry taylor_green_re1600();
Entry cavity_re1000();
Entry determinism();
Entry hard_h19();
Entry shear_layer();
Entry slipping_box();
Entry bingham_channel();
Entry log_law_channel();

// A restart.
Entry hard_h12();

}  // namespace lahar::validate

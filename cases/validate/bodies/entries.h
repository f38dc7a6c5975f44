#pragma once
// Entries of the bodies in water: one file per question, listed in bodies_entries().
#include "cases/validate/entry.h"

namespace lahar::validate {

Entry fixed_sphere();
Entry random_pack();
Entry settling_sphere();
Entry sphere_array();

std::vector<Entry> bodies_entries();

}  // namespace lahar::validate

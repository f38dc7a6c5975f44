#include "cases/validate/bodies/entries.h"

namespace lahar::validate {

std::vector<Entry> bodies_entries() { return {sphere_array(), random_pack(), fixed_sphere(), settling_sphere()}; }

}  // namespace lahar::validate

#pragma once
// The entries with a free surface, one function per file of the same name.
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Row> gravity_wave(const Context& context);
std::vector<Row> hydrostatic(const Context& context);
std::vector<Row> hydrostatic_tilted(const Context& context);
std::vector<Row> martin_moyce(const Context& context);
std::vector<Row> hard_h3(const Context& context);

}  // namespace lahar::validate

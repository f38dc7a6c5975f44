#pragma once
// The entries with a free surface. Bars of the hard cases are those of hard_cases.csv ("thresholds are judgement").
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Row> adaptive_time_step(const Context& context);
std::vector<Row> laplace_drop(const Context& context);
std::vector<Row> gravity_wave(const Context& context);
std::vector<Row> nusselt_film(const Context& context);
std::vector<Row> hydrostatic(const Context& context);
std::vector<Row> hydrostatic_tilted(const Context& context);
std::vector<Row> martin_moyce(const Context& context);
std::vector<Row> mass_ledger(const Context& context);
std::vector<Row> hard_h1(const Context& context);
std::vector<Row> hard_h2(const Context& context);
std::vector<Row> hard_h3(const Context& context);
std::vector<Row> hard_h4(const Context& context);
std::vector<Row> hard_h6(const Context& context);
std::vector<Row> hard_h8(const Context& context);
std::vector<Row> hard_h13(const Context& context);
std::vector<Row> hard_h14(const Context& context);
std::vector<Row> hard_h18(const Context& context);
std::vector<Row> hard_h19_splash(const Context& context);
std::vector<Row> hard_h20(const Context& context);

/// All of them, in the order of the ladder.
std::vector<Entry> surface_entries();

}  // namespace lahar::validate

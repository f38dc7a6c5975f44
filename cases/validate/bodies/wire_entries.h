#pragma once
// Entries on wires and nets, and on bodies at the surface.
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Row> wire(const Context& context);
std::vector<Row> resolved_wire(const Context& context);
std::vector<Row> screen(const Context& context);
std::vector<Row> ring_net_drag(const Context& context);
std::vector<Row> archimedes(const Context& context);
std::vector<Row> floating_sphere(const Context& context);
std::vector<Row> hard_h5(const Context& context);
std::vector<Row> hard_h6_ring(const Context& context);
std::vector<Row> hard_h7(const Context& context);
std::vector<Row> hard_h8_cavity(const Context& context);
std::vector<Row> hard_h8_sphere(const Context& context);
std::vector<Row> hard_h10(const Context& context);
std::vector<Row> hard_h17(const Context& context);
std::vector<Row> momentum_audit(const Context& context);

}  // namespace lahar::validate

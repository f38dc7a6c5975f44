#pragma once
// Charts of entries with a free surface, drawn where the context asks for plots.
#include <span>

#include "cases/validate/entry.h"

namespace lahar::validate {

/// Amplitude over time; `series` has a value per step, `reference` one per quarter of a period.
void draw_gravity_wave(const Context& context, double reynolds, double period, const std::vector<double>& series,
                       std::span<const double> reference);

/// Front over time against the measured points (times and places in the units of Martin & Moyce).
void draw_front(const Context& context, const std::string& name, const std::vector<double>& time,
                const std::vector<double>& front, std::span<const std::pair<double, double>> measured);

/// Depths along a stream, ours and the exact ones, over the depth upstream of it (as places are).
void draw_depths(const Context& context, const std::string& name, const std::string& title,
                 const std::vector<double>& place, const std::vector<double>& depth, const std::string& author,
                 const std::vector<double>& exact);

}  // namespace lahar::validate

#include "cases/compare_cfd_dem/compared_quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cases/compare_cfd_dem/published_flows.h"

namespace lahar::study {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double CaseRun::metric(const std::string& name) const {
  const auto found = metrics.find(name);
  return found == metrics.end() ? kNone : found->second;
}

namespace {

using Ours = std::function<double(const CaseRun&)>;
using Theirs = std::function<std::optional<double>(double)>;

Ours metric(const char* name, double factor = 1) {
  return [name, factor](const CaseRun& c) { return factor * c.metric(name); };
}
Theirs of_table(double Flow::*column) {
  return [column](double release) -> std::optional<double> {
    const Flow* flow = published(release);
    return flow ? std::optional(flow->*column) : std::nullopt;
  };
}
/// Of the flow that the paper describes, L = 4.10 m.
Theirs of_one(double value) {
  return [value](double release) { return std::abs(release - 4.1) < 1e-6 ? std::optional(value) : std::nullopt; };
}
/// Ends of the range over all flows, which rises or falls with the Froude number: of the first flow and the last.
Theirs of_ends(double first, double last) {
  return [first, last](double release) -> std::optional<double> {
    if (std::abs(release - release_distances().front()) < 1e-6 && std::isfinite(first)) return first;
    if (std::abs(release - release_distances().back()) < 1e-6 && std::isfinite(last)) return last;
    return std::nullopt;
  };
}
std::optional<double> not_given(double) { return std::nullopt; }

constexpr double kGravity = 9.81, kSin35 = 0.573576, kCos35 = 0.819152;  // m/s^2; of the slope
constexpr double kLowerDatum = 0.746;                                    // m: the bed 1.30 m downstream of the net

double e_in(const CaseRun& c) { return c.metric("e_in_kJ"); }
double e_out(const CaseRun& c) { return c.metric("e_out_kJ"); }
double e_d(const CaseRun& c) { return e_in(c) - e_out(c); }
double e_b(const CaseRun& c) { return (c.metric("barrier_energy_end_J") - c.metric("barrier_energy_start_J")) / 1000; }

/// The mass that is there while the flow arrives: liquid and grains, kg.
double mass(const CaseRun& c) { return c.metric("liquid_mass_start_kg") + c.grain_mass; }
/// Energies about the bed 1.30 m downstream, which the paper's numbers ask for: all mass that counts is higher.
double e_in_lower(const CaseRun& c) { return e_in(c) + mass(c) * kGravity * kLowerDatum / 1000; }
double potential_of_liquid_lower(const CaseRun& c) {
  return c.metric("e_out_liquid_potential_kJ") + c.metric("liquid_passed_kg") * kGravity * kLowerDatum / 1000;
}
double potential_of_grains_lower(const CaseRun& c) {
  const auto* passed = c.series.find("grains_passed_kg");
  const double grains = passed && !passed->values.empty() ? passed->values.back() : kNone;
  return c.metric("e_out_grains_potential_kJ") + grains * kGravity * kLowerDatum / 1000;
}
double e_out_liquid_lower(const CaseRun& c) {
  return c.metric("e_out_liquid_kinetic_kJ") + potential_of_liquid_lower(c);
}
double e_out_grains_lower(const CaseRun& c) {
  return c.metric("e_out_grains_kinetic_kJ") + potential_of_grains_lower(c);
}
double e_out_lower(const CaseRun& c) { return e_out_liquid_lower(c) + e_out_grains_lower(c); }
/// A part of it over what arrives, as Fig. 16 has them.
Ours over_e_in(Ours part) {
  return [part = std::move(part)](const CaseRun& c) { return part(c) / e_in_lower(c); };
}
double e_d_lower(const CaseRun& c) { return e_in_lower(c) - e_out_lower(c); }

/// s: the first row in which a column is at least `level`.
double first_at_least(const CaseRun& c, const char* column, double level) {
  const auto* values = c.series.find(column);
  for (std::size_t k = 0; values && k < values->values.size(); ++k)
    if (values->values[k] >= level) return c.series.time_s[k];
  return kNone;
}

/// m: the energy that arrives counts when the front is as far from the net.
constexpr double kInflowDistance = 0.15;

/// As if liquid filled the space of the grains too, at their velocity: the reading of a fluid solver whose energies
/// leave out the fraction of space that the fluid has.
double with_full_cells(const CaseRun& c, double energy, double grains) {
  constexpr double liquid_density = 1000;  // kg/m^3, Table 4
  return energy + liquid_density * c.grain_volume / c.grain_mass * grains;
}
double e_in_full_cells(const CaseRun& c) {
  const auto *kinetic = c.series.find("grains_kinetic_J"), *potential = c.series.find("grains_potential_J");
  const double t = first_at_least(c, "front_x_m", c.study_case.release - kInflowDistance);
  if (!kinetic || !potential || !std::isfinite(t)) return kNone;
  const auto row = std::lower_bound(c.series.time_s.begin(), c.series.time_s.end(), t) - c.series.time_s.begin();
  return with_full_cells(
      c, e_in(c),
      (kinetic->values[static_cast<std::size_t>(row)] + potential->values[static_cast<std::size_t>(row)]) / 1000);
}
double e_out_full_cells(const CaseRun& c) {
  return with_full_cells(c, e_out(c), c.metric("e_out_grains_kinetic_kJ") + c.metric("e_out_grains_potential_kJ"));
}

/// m/s: of the water's front over the last half metre before the net; unknown where it begins nearer.
double front_speed(const CaseRun& c) {
  const double end = first_at_least(c, "front_x_m", c.study_case.release - kInflowDistance);
  const double start = first_at_least(c, "front_x_m", c.study_case.release - 0.65);
  return start > 0 ? 0.5 / (end - start) : kNone;
}
double front_froude(const CaseRun& c) {
  return front_speed(c) / std::sqrt(kGravity * c.metric("depth_at_inflow_m") * kCos35);
}

/// kJ, what a column has grown by from the first row to the last.
Ours growth_of(const char* column) {
  return [column](const CaseRun& c) {
    const auto* values = c.series.find(column);
    return values && !values->values.empty() ? (values->values.back() - values->values.front()) / 1000 : kNone;
  };
}

/// Mean of a column over the last `seconds` of the run.
double final_mean(const CaseRun& c, const char* column, double seconds) {
  const auto* values = c.series.find(column);
  double sum = 0, count = 0;
  for (std::size_t k = 0; values && k < values->values.size(); ++k)
    if (c.series.time_s[k] > c.series.time_s.back() - seconds) sum += values->values[k], ++count;
  return count > 0 ? sum / count : kNone;
}

/// The largest mean of a column over so many seconds (from row to row as a straight line); NaN of a shorter run.
double largest_mean(const CaseRun& c, const char* column, double seconds) {
  const std::vector<double>& time = c.series.time_s;
  const auto* values = c.series.find(column);
  if (!values || time.empty() || time.back() - time.front() < seconds) return kNone;
  std::vector<double> sums(time.size(), 0.0);  // integrals from the first row on
  for (std::size_t k = 1; k < time.size(); ++k)
    sums[k] = sums[k - 1] + 0.5 * (values->values[k - 1] + values->values[k]) * (time[k] - time[k - 1]);
  const double least = seconds * (1 - 1e-9);
  double largest = -INFINITY;
  for (std::size_t begin = 0, end = 0; end < time.size(); ++end) {
    while (begin + 1 < end && time[end] - time[begin + 1] >= least) ++begin;
    if (const double length = time[end] - time[begin]; length >= least)
      largest = std::max(largest, (sums[end] - sums[begin]) / length);
  }
  return largest;
}

/// Sum of one column over that of another, of the rows in which at least a litre a second passes.
double ratio_of_sums(const CaseRun& c, const char* above, const char* below) {
  const auto *a = c.series.find(above), *b = c.series.find(below), *q = c.series.find("net_discharge_m3_s");
  double sum_a = 0, sum_b = 0;
  for (std::size_t k = 0; a && b && q && k < a->values.size(); ++k)
    if (q->values[k] > 1e-3) sum_a += a->values[k], sum_b += b->values[k];
  return sum_b > 0 ? sum_a / sum_b : kNone;
}

/// s: the first row in which a hundredth of the grains' mass has crossed the plane where the net was built. Single
/// grains run ahead, thrown out of the front; which, and how far, is chance.
double grains_arrival(const CaseRun& c) {
  const auto* rate = c.series.find("net_grains_kg_s");
  double crossed = 0;
  for (std::size_t k = 1; rate && k < rate->values.size(); ++k) {
    crossed += rate->values[k] * (c.series.time_s[k] - c.series.time_s[k - 1]);
    if (crossed >= 0.01 * c.grain_mass) return c.series.time_s[k];
  }
  return kNone;
}

/// How much a column has changed when water or grains arrive, whichever comes first; NaN if the run does not hold it.
double until_arrival(const CaseRun& c, const char* column) {
  const double arrival = std::fmin(c.metric("front_arrival_s"), grains_arrival(c));
  const auto* values = c.series.find(column);
  const auto row = std::lower_bound(c.series.time_s.begin(), c.series.time_s.end(), arrival) - c.series.time_s.begin();
  if (!values || !std::isfinite(arrival) || row >= std::ssize(values->values)) return kNone;
  return values->values[static_cast<std::size_t>(row)] - values->values.front();
}
/// Of the energy that the flow has won by then on its way down: what the grains have lost by friction and in impacts,
/// and what the water has lost by drag and shear; what it gave to the grains is not lost.
double grains_loss(const CaseRun& c) {
  const double won = until_arrival(c, "grains_potential_J") + until_arrival(c, "fluid_potential_J");
  return -(until_arrival(c, "solids_friction_J") + until_arrival(c, "solids_damping_J")) / won;
}
double water_loss(const CaseRun& c) {
  const double won = until_arrival(c, "grains_potential_J") + until_arrival(c, "fluid_potential_J");
  const double kept = until_arrival(c, "fluid_kinetic_J") + until_arrival(c, "solids_work_J");
  return (until_arrival(c, "fluid_potential_J") + kept) / won;
}

/// Integral of a column over the second after the grains' arrival, of means since the row before or by straight lines
/// between the rows; NaN if the run ends before.
double integral_after_arrival(const CaseRun& c, const char* column) {
  const std::vector<double>& time = c.series.time_s;
  const double begin = grains_arrival(c), end = begin + 1;
  const bool mean = is_mean(column);
  const auto* values = c.series.find(column);
  if (!values || !std::isfinite(begin) || time.empty() || time.back() < end) return kNone;
  double sum = 0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double from = std::clamp(begin, time[k - 1], time[k]), to = std::clamp(end, time[k - 1], time[k]);
    if (to <= from) continue;
    const double middle = (0.5 * (from + to) - time[k - 1]) / (time[k] - time[k - 1]);
    sum += (to - from) * (mean ? values->values[k] : std::lerp(values->values[k - 1], values->values[k], middle));
  }
  return sum;
}
/// kNs, of a force in N.
Ours impulse_of(const char* column) {
  return [column](const CaseRun& c) { return integral_after_arrival(c, column) / 1000; };
}

/// A column `later` seconds after the grains' arrival; NaN if the run ends before.
double after_arrival(const CaseRun& c, const char* column, double later) {
  const std::vector<double>& time = c.series.time_s;
  const double t = grains_arrival(c) + later;
  const auto* values = c.series.find(column);
  if (!values || !std::isfinite(t) || time.empty() || time.back() < t) return kNone;
  return values->values[static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin())];
}

// The water's momentum along the flow in that second, kNs. No wall stands across the stream there, and bed and sides
// let the water slip.
double momentum_at_arrival(const CaseRun& c) { return after_arrival(c, "fluid_momentum_x_Ns", 0) / 1000; }
double momentum_kept(const CaseRun& c) { return after_arrival(c, "fluid_momentum_x_Ns", 1) / 1000; }
double momentum_of_weight(const CaseRun& c) {
  return kGravity * kSin35 * integral_after_arrival(c, "liquid_mass_kg") / 1000;
}
double momentum_made(const CaseRun& c) {
  return (after_arrival(c, "fluid_momentum_gap_x_Ns", 1) - after_arrival(c, "fluid_momentum_gap_x_Ns", 0)) / 1000;
}
double momentum_taken_out(const CaseRun& c) {
  return momentum_at_arrival(c) + momentum_of_weight(c) + momentum_made(c) - momentum_kept(c) -
         (integral_after_arrival(c, "grains_fluid_force_x_N") + integral_after_arrival(c, "barrier_fluid_force_x_N")) /
             1000;
}

double water_share(const CaseRun& c) {
  const double water = integral_after_arrival(c, "barrier_fluid_force_x_N");
  return water / (water + integral_after_arrival(c, "barrier_contact_force_x_N"));
}

std::vector<Compared> make_quantities() {
  std::vector<Compared> q;
  const auto add = [&](const char* name, const char* unit, const char* meaning, Ours ours, Theirs theirs,
                       const char* where) {
    q.push_back({name, unit, meaning, std::move(ours), std::move(theirs), where});
  };
  add("front_arrival", "s", "water at the net", metric("front_arrival_s"), of_one(0.75), "4.3");
  add("grains_arrival", "s", "a hundredth of the grains' mass has crossed the plane of the net", grains_arrival,
      of_one(0.92), "4.3");
  add("first_grain", "s", "the first grain at the net", metric("particle_arrival_s"), not_given, "");
  add("froude_deepest", "1", "Froude number of the deepest section", metric("froude_deepest_section"),
      of_table(&Flow::froude), "Table 5");
  add("froude_mean", "1", "Froude number with the mean speed of the liquid", metric("froude_mean_speed"),
      of_table(&Flow::froude), "Table 5");
  add("froude_front", "1", "Froude number with the speed of the front", front_froude, of_table(&Flow::froude),
      "Table 5");
  add("depth", "m", "depth of the deepest section", metric("depth_at_inflow_m"), not_given, "");
  add("grains_loss", "1", "energy that grains lose until the net, of what the flow wins on its way", grains_loss,
      not_given, "");
  add("water_loss", "1", "energy that water loses until the net, of what the flow wins on its way", water_loss,
      not_given, "");
  add("e_in", "kJ", "energy that arrives, about the bed at the net", e_in, of_table(&Flow::e_in), "Table 5");
  add("e_in_lower", "kJ", "energy that arrives, about the bed 1.30 m downstream", e_in_lower, of_table(&Flow::e_in),
      "Table 5");
  add("e_in_full_cells", "kJ",
      "energy that arrives, about the bed at the net, as if liquid filled the space of the grains too", e_in_full_cells,
      of_table(&Flow::e_in), "Table 5");
  add("e_out", "kJ", "energy that leaves, about the bed at the net", e_out, of_table(&Flow::e_out), "Table 5");
  add("e_out_lower", "kJ", "energy that leaves, about the bed 1.30 m downstream", e_out_lower, of_table(&Flow::e_out),
      "Table 5");
  add("e_out_full_cells", "kJ",
      "energy that leaves, about the bed at the net, as if liquid filled the space of the grains too", e_out_full_cells,
      of_table(&Flow::e_out), "Table 5");
  add("solids_energy_gap", "J", "what the energy ledger of grains and barrier lacks at most",
      metric("solids_energy_gap_max_J"), not_given, "");
  add("e_d", "kJ", "energy that is dissipated or passed on, E_in - E_out", e_d, of_table(&Flow::e_d), "Table 5");
  add("e_d_lower", "kJ", "the same about the bed 1.30 m downstream", e_d_lower, of_table(&Flow::e_d), "Table 5");
  add("e_b", "kJ", "energy that the barrier holds at the end", e_b, of_table(&Flow::e_b), "Table 5");
  add("e_b_axial", "kJ", "of it elastic energy of bonds, axial", growth_of("barrier_axial_J"), not_given, "");
  add("e_b_shear", "kJ", "of it elastic energy of bonds, shear", growth_of("barrier_shear_J"), not_given, "");
  add("e_b_bending", "kJ", "of it elastic energy of bonds, bending", growth_of("barrier_bending_J"), not_given, "");
  add("e_b_torsion", "kJ", "of it elastic energy of bonds, torsion", growth_of("barrier_torsion_J"), not_given, "");
  add("e_b_potential", "kJ", "of it potential energy", growth_of("barrier_potential_J"), not_given, "");
  add(
      "eta", "1", "E_d / E_in", [](const CaseRun& c) { return e_d(c) / e_in(c); }, of_table(&Flow::eta), "Table 5");
  add(
      "eta_lower", "1", "E_d / E_in, about the bed 1.30 m downstream",
      [](const CaseRun& c) { return e_d_lower(c) / e_in_lower(c); }, of_table(&Flow::eta), "Table 5");
  add(
      "zeta", "1", "E_b / E_d", [](const CaseRun& c) { return e_b(c) / e_d(c); }, of_table(&Flow::zeta), "Table 5");
  add(
      "zeta_lower", "1", "E_b / E_d, about the bed 1.30 m downstream",
      [](const CaseRun& c) { return e_b(c) / e_d_lower(c); }, of_table(&Flow::zeta), "Table 5");
  add(
      "outflow_liquid_share", "1", "share of the liquid in E_out, about the bed 1.30 m downstream",
      [](const CaseRun& c) { return e_out_liquid_lower(c) / e_out_lower(c); }, not_given, "Fig. 16");
  add(
      "outflow_liquid_share_kinetic", "1", "share of the liquid in the kinetic energy that leaves",
      [](const CaseRun& c) {
        const double liquid = c.metric("e_out_liquid_kinetic_kJ");
        return liquid / (liquid + c.metric("e_out_grains_kinetic_kJ"));
      },
      not_given, "Fig. 16");
  add("out_liquid_kinetic", "1", "kinetic energy of the liquid that leaves, of E_in about the bed 1.30 m downstream",
      over_e_in(metric("e_out_liquid_kinetic_kJ")), not_given, "Fig. 16");
  add("out_liquid_potential", "1",
      "potential energy of the liquid that leaves, of E_in, about the bed 1.30 m downstream",
      over_e_in(potential_of_liquid_lower), not_given, "Fig. 16");
  add("out_grains_kinetic", "1", "kinetic energy of the grains that leave, of E_in about the bed 1.30 m downstream",
      over_e_in(metric("e_out_grains_kinetic_kJ")), not_given, "Fig. 16");
  add("out_grains_potential", "1",
      "potential energy of the grains that leave, of E_in, about the bed 1.30 m downstream",
      over_e_in(potential_of_grains_lower), not_given, "Fig. 16");
  add("retained_mass", "1", "share of the grains' mass that the barrier holds", metric("retained_mass_ratio"),
      of_ends(0.98, 0.90), "4.2: ends of the range");
  add("retained_large", "1", "share of the large grains that the barrier holds", metric("retained_large_grains_ratio"),
      of_ends(0.999, 0.965), "4.2: ends of the range");
  add("retained_small", "1", "share of the small grains that the barrier holds", metric("retained_small_grains_ratio"),
      of_ends(0.902, 0.649), "4.2: ends of the range");
  add("lower_cable_sum", "kN", "largest sum of bond forces in the lower cable", metric("peak_lower_cable_sum_kN"),
      of_one(517.54), "4.3");
  add("upper_cable_sum", "kN", "largest sum of bond forces in the upper cable", metric("peak_upper_cable_sum_kN"),
      not_given, "Fig. 14");
  add("left_cable_sum", "kN", "largest sum of bond forces in the left cable", metric("peak_left_cable_sum_kN"),
      not_given, "Fig. 14");
  add("right_cable_sum", "kN", "largest sum of bond forces in the right cable", metric("peak_right_cable_sum_kN"),
      not_given, "Fig. 14");
  for (auto cable = q.end() - 4; cable != q.end(); ++cable) cable->theirs_largest = 677.73;
  add("barrier_sum", "kN", "largest sum of bond forces in the whole barrier", metric("peak_barrier_sum_kN"),
      of_ends(kNone, 4131.31), "Fig. 14: the largest of all flows, which rise");
  add(
      "barrier_sum_mean", "kN", "largest mean over 0.2 s of the sum of bond forces in the whole barrier",
      [](const CaseRun& c) { return largest_mean(c, "barrier_force_sum_N", 0.2) / 1000; }, not_given, "");
  add("barrier_tension", "kN", "largest tension of a bond", metric("peak_barrier_tension_kN"), not_given, "");
  add("upper_cable_end", "kN", "largest force at an end of the upper cable", metric("peak_upper_cable_end_kN"),
      not_given, "");
  add("lower_cable_end", "kN", "largest force at an end of the lower cable", metric("peak_lower_cable_end_kN"),
      not_given, "");
  add("left_cable_end", "kN", "largest force at an end of the left cable", metric("peak_left_cable_end_kN"), not_given,
      "");
  add("right_cable_end", "kN", "largest force at an end of the right cable", metric("peak_right_cable_end_kN"),
      not_given, "");
  add(
      "barrier_sum_at_rest", "kN", "sum of bond forces in the barrier, mean of the last half second",
      [](const CaseRun& c) { return final_mean(c, "barrier_force_sum_N", 0.5) / 1000; }, not_given, "");
  add("elongation", "m", "largest way of a bead along the flow, from the flat net", metric("max_elongation_m"),
      not_given, "4.4: the largest of all flows");
  q.back().theirs_largest = 0.263;
  add("ring_travel", "m", "way that edge rings slide, largest mean", metric("max_mean_ring_travel_m"), not_given, "");
  add("net_impulse_grains", "kNs", "impulse of grains on the net along the flow, in the second after they arrive",
      impulse_of("barrier_contact_force_x_N"), not_given, "");
  add("net_impulse_water", "kNs",
      "impulse of water itself on the net along the flow, in the second after grains arrive",
      impulse_of("barrier_fluid_force_x_N"), not_given, "");
  add("grains_impulse_water", "kNs", "impulse of water on all grains along the flow, in the second after they arrive",
      impulse_of("grains_fluid_force_x_N"), not_given, "");
  add("water_momentum", "kNs", "momentum of the water along the flow when grains arrive", momentum_at_arrival,
      not_given, "");
  add("water_momentum_weight", "kNs", "momentum that its weight gives the water in the second after",
      momentum_of_weight, not_given, "");
  add("water_momentum_kept", "kNs", "momentum of the water after that second", momentum_kept, not_given, "");
  add("water_momentum_out", "kNs", "momentum that water takes out of the domain in it", momentum_taken_out, not_given,
      "");
  add("water_momentum_made", "kNs",
      "of what water gave grains and net in that second, what it never had: momentum that the cells at its surface "
      "made",
      momentum_made, not_given, "");
  add("water_share", "1", "share of the water itself in the impulse on the net along the flow, in that second",
      water_share, not_given, "");
  add(
      "velocity_through_net", "m/s", "velocity of the water in the plane where the net was built",
      [](const CaseRun& c) { return ratio_of_sums(c, "net_discharge_m3_s", "net_liquid_area_m2"); }, not_given, "");
  add(
      "clogging", "1", "area of grains over that of grains and water in the plane of the net",
      [](const CaseRun& c) { return 1 / (1 + 1 / ratio_of_sums(c, "net_grains_area_m2", "net_liquid_area_m2")); },
      not_given, "");
  add("water_left", "kg", "water that left the channel", metric("liquid_left_kg"), not_given, "");
  add(
      "water_inside", "kg", "water that is in the channel at the end",
      [](const CaseRun& c) { return final_mean(c, "liquid_mass_kg", 0.02); }, not_given, "");
  return q;
}

}  // namespace

const std::vector<Compared>& compared_quantities() {
  static const std::vector<Compared> all = make_quantities();
  return all;
}

std::optional<double> theirs_of(const Compared& quantity, const StudyCase& study_case) {
  return is_strip(study_case) ? std::nullopt : quantity.theirs(study_case.release);
}

double mass_by_energies(double e_in, double e_in_lower) {
  return 1000 * (e_in_lower - e_in) / (kGravity * kLowerDatum);
}

const std::vector<ShownColumn>& shown_columns() {
  static const std::vector<ShownColumn> all{
      {"lower_cable_force_sum_N", "sum of forces in the lower cable", "kN", 1e-3, " (as Fig. 13)"},
      {"upper_cable_force_sum_N", "sum of forces in the upper cable", "kN", 1e-3, " (as Fig. 13)"},
      {"left_cable_force_sum_N", "sum of forces in the left cable", "kN", 1e-3, " (as Fig. 13)"},
      {"right_cable_force_sum_N", "sum of forces in the right cable", "kN", 1e-3, " (as Fig. 13)"},
      {"barrier_force_sum_N", "sum of forces in the barrier", "kN", 1e-3},
      {"barrier_elongation_m", "elongation of the net", "m"},
      {"barrier_fluid_force_x_N", "force of water on the net", "kN", 1e-3, "", true},
      {"barrier_contact_force_x_N", "force of grains on the net", "kN", 1e-3, "", true},
      {"grains_fluid_force_x_N", "force of water on the grains", "kN", 1e-3, "", true},
      {"fluid_momentum_gap_x_Ns", "water's momentum from walls and surface", "kNs", 1e-3},
      {"net_discharge_m3_s", "discharge of water through the net", "m^3/s"},
      {"net_grains_area_m2", "area of grains in the plane of the net", "m^2"},
      {"grains_passed_kg", "grains that have passed", "kg"},
      {"grains_kinetic_J", "kinetic energy of the grains", "kJ", 1e-3}};
  return all;
}

bool is_mean(const std::string& column) {
  const auto& all = shown_columns();
  return std::any_of(all.begin(), all.end(), [&](const ShownColumn& c) { return c.name == column && c.mean; });
}

}  // namespace lahar::study

#include "cases/assembly/measured_names.h"

#include "barrier/response.h"

namespace lahar::scene {
namespace {

std::vector<std::string> after(const std::string& name, std::initializer_list<const char*> rests) {
  std::vector<std::string> names;
  for (const char* rest : rests) names.push_back(name + rest);
  return names;
}

}  // namespace

std::vector<std::string> own_names() {
  std::vector<std::string> names{"barrier_axial_J",
                                 "barrier_bending_J",
                                 "barrier_broken_bonds",
                                 "barrier_contact_impulse_Ns",
                                 "barrier_elastic_J",
                                 "barrier_elongation_m",
                                 "barrier_energy_end_J",
                                 "barrier_energy_start_J",
                                 "barrier_fluid_impulse_Ns",
                                 "barrier_kinetic_J",
                                 "barrier_potential_J",
                                 "barrier_shear_J",
                                 "barrier_torsion_J",
                                 "bonds_lost_J",
                                 "broken_bonds",
                                 "depth_at_inflow_m",
                                 "dissipator_elongation_m",
                                 "e_in_kJ",
                                 "e_out_grains_kinetic_kJ",
                                 "e_out_grains_potential_kJ",
                                 "e_out_kJ",
                                 "e_out_liquid_kinetic_kJ",
                                 "e_out_liquid_potential_kJ",
                                 "fluid_kinetic_J",
                                 "fluid_momentum_gap_x_Ns",
                                 "fluid_momentum_x_Ns",
                                 "fluid_potential_J",
                                 "fluid_steps",
                                 "fluid_time_step_changes",
                                 "fluid_time_step_max_s",
                                 "fluid_time_step_min_s",
                                 "fluid_time_step_s",
                                 "front_arrival_s",
                                 "front_x_m",
                                 "froude_deepest_section",
                                 "froude_mean_speed",
                                 "grains_at_start",
                                 "grains_behind_walls",
                                 "grains_front_x_m",
                                 "grains_gone",
                                 "grains_kinetic_J",
                                 "grains_passed_kg",
                                 "grains_potential_J",
                                 "liquid_inflow_kg",
                                 "liquid_left_kg",
                                 "liquid_mass_drift_rel",
                                 "liquid_mass_kg",
                                 "liquid_mass_start_kg",
                                 "liquid_passed_kg",
                                 "liquid_paid_nearby_kg",
                                 "liquid_pooled_kg",
                                 "liquid_rescaled_kg",
                                 "liquid_wall_balance_kg",
                                 "max_dissipator_elongation_m",
                                 "max_elongation_m",
                                 "max_mean_ring_travel_m",
                                 "max_ring_travel_m",
                                 "max_speed_lu",
                                 "momentum_audit_rel",
                                 "outflow_mass_kg",
                                 "particle_arrival_s",
                                 "peak_barrier_elastic_J",
                                 "peak_posts_foot_kN",
                                 "peak_posts_foot_kNm",
                                 "posts_foot_force_N",
                                 "posts_foot_moment_Nm",
                                 "retained_large_grains_ratio",
                                 "retained_mass_ratio",
                                 "retained_small_grains_ratio",
                                 "ring_links_changed",
                                 "ring_travel_furthest_m",
                                 "ring_travel_m",
                                 "section_power_W",
                                 "solids_damping_J",
                                 "solids_damping_kJ",
                                 "solids_energy_gap_J",
                                 "solids_energy_gap_max_J",
                                 "solids_energy_turned_over_max_J",
                                 "solids_friction_J",
                                 "solids_friction_kJ",
                                 "solids_work_J",
                                 "solids_work_kJ",
                                 "speed_limited_cells_max",
                                 "time_s",
                                 "wet_beads",
                                 "wet_cells"};
  for (const barrier::Component c : barrier::all_components) {
    const std::string part(barrier::name(c));
    for (const char* rest : {"_force_sum_N", "_max_tension_N"}) names.push_back(part + rest);
    for (const char* rest : {"_sum_kN", "_tension_kN"}) names.push_back("peak_" + part + rest);
  }
  for (const char* cable : {"lower_cable", "upper_cable", "left_cable", "right_cable"}) {
    names.push_back(std::string(cable) + "_end_force_N");
    names.push_back("peak_" + std::string(cable) + "_end_kN");
  }
  for (const std::string_view part : barrier::Elements::components) {
    names.push_back(std::string(part) + "_anchor_force_N");
    names.push_back("peak_" + std::string(part) + "_anchor_kN");
  }
  for (const char* load : {"barrier_fluid_force_", "barrier_contact_force_", "grains_fluid_force_"})
    for (const char* axis : {"x", "y", "z"}) names.push_back(std::string(load) + axis + "_N");
  return names;
}

std::vector<std::string> names_of(const Probe& probe) {
  if (probe.kind == ProbeKind::height) return after(probe.name, {"", "_peak_m", "_peak_time_s", "_arrival_s"});
  if (probe.kind == ProbeKind::velocity)
    return after(probe.name, {"_x_m_s", "_y_m_s", "_z_m_s", "_speed_peak_m_s", "_speed_peak_time_s"});
  if (probe.kind == ProbeKind::grain)
    return after(probe.name,
                 {"_x_m", "_y_m", "_z_m", "_x_m_s", "_y_m_s", "_z_m_s", "_speed_peak_m_s", "_speed_peak_time_s"});
  if (probe.kind == ProbeKind::pressure) return after(probe.name, {"", "_peak_Pa", "_peak_time_s"});
  std::vector<std::string> names =
      after(probe.name, {"_force_peak_N", "_force_peak_time_s", "_moment_peak_Nm", "_moment_peak_time_s"});
  for (const char* source : {"_fluid", "_grains"})
    for (const char* axis : {"x", "y", "z"}) {
      names.push_back(probe.name + source + "_force_" + axis + "_N");
      names.push_back(probe.name + source + "_moment_" + axis + "_Nm");
    }
  return names;
}

std::vector<std::string> names_of(const FluxSection& section) {
  return after(section.name, {"_discharge_m3_s", "_discharge_peak_m3_s", "_discharge_peak_time_s", "_liquid_area_m2",
                              "_liquid_power_W", "_volume_m3", "_liquid_energy_kJ", "_grains_kg_s", "_grains_area_m2",
                              "_grains_power_W", "_grains_kg", "_grains_energy_kJ"});
}

}  // namespace lahar::scene

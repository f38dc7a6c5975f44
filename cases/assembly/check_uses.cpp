// Cross checks of what refers to fluid and solids: the coupling, the measured section, memory.
#include <fmt/format.h>

#include <algorithm>

#include "cases/assembly/cross_checks.h"
#include "cases/assembly/estimates.h"
#include "cases/assembly/memory.h"

namespace lahar::scene {
namespace {

void check_memory_of_particles(const Scene& scene, Findings& findings) {
  if (!findings.sound({"barrier", "grains"})) return;
  const std::int64_t beads = scene.barrier.enabled ? cases::barrier_beads(scene) : 0,
                     grains = cases::grain_count(scene);
  const auto have = static_cast<double>(physical_memory());
  const double need = kBytesPerParticle * (static_cast<double>(beads) + static_cast<double>(grains));
  const std::string path = beads > grains ? "barrier.net" : "grains";
  if (need > have)
    findings.mistake(path,
                     fmt::format("{}: {} beads and {} grains need about {:.0f} GB, more than the {:.0f} GB of this "
                                 "machine, expected fewer",
                                 path, beads, grains, need * 1e-9, have * 1e-9));
}

void check_section(const Scene& scene, Findings& findings) {
  const Measure& m = scene.measure;
  const std::optional<double> section = section_of(scene);
  if (!section || !findings.sound({"measure", "domain", "barrier.net.origin_m"})) return;
  const double low = scene.domain.lower.x(), high = scene.domain.upper.x();
  const auto inside = [&](double x) { return x >= low && x <= high; };
  const auto refuse = [&](const std::string& key, double x) {  // of a default, what it counts from is to blame
    if (!inside(x))
      findings.mistake(key,
                       fmt::format("{} leads to x = {:g}, expected inside the domain, {:g} to {:g}", key, x, low, high),
                       {"measure.section_x_m", "barrier.net.origin_m", "rigid_barrier.origin_m", "domain.lower_m",
                        "domain.upper_m"});
  };
  refuse("measure.section_x_m", *section);
  if (!findings.sound({"measure"})) return;
  if (scene.fluid.enabled) refuse("measure.inflow_distance_m", *section - m.inflow_distance);
  refuse("measure.outflow_distance_m", *section + m.outflow_distance);
}

void check_averaged(const Scene& scene, Findings& findings) {
  const Coupling& c = scene.coupling;
  if (c.lubrication)
    findings.mistake("coupling.lubrication",
                     "coupling.lubrication is for what resolved grains miss between them, expected false with grains = "
                     "\"averaged\"");
  if (c.solid_operator != lbm::kSolidOperator)
    findings.mistake("coupling.solid_operator",
                     "coupling.solid_operator is what resolved bodies put in place of the fluid's collision, expected "
                     "none with grains = \"averaged\"");
  if (c.averaging_length < scene.fluid.cell_size)
    findings.mistake("coupling.averaging_length_m",
                     fmt::format("coupling.averaging_length_m is {:g}, expected at least a cell (fluid.cell_size_m = "
                                 "{:g})",
                                 c.averaging_length, scene.fluid.cell_size));
  else if (!findings.sound({"grains"}))
    return;
  else if (const double largest = cases::largest_grain(scene); c.averaging_length < largest * (1 - 1e-9))
    findings.mistake("coupling.averaging_length_m",
                     fmt::format("coupling.averaging_length_m is {:g}, expected at least the diameter of the largest "
                                 "grain, {:g}: averages around its centre do not see the water at its rim",
                                 c.averaging_length, largest));
  if (c.resolve_wires_from_cells)
    findings.mistake("coupling.resolve_wires_from_cells",
                     "coupling.resolve_wires_from_cells maps wires as bodies that cells hold whole, expected none with "
                     "grains = \"averaged\", which cells hold as far as they are filled");
}

void check_holdych(const Scene& scene, Findings& findings) {
  const auto& spheres = scene.grains.spheres;
  const bool free_wires = scene.barrier.enabled && scene.coupling.resolve_wires_from_cells;
  const bool all_held = !free_wires && scene.grains.packings.empty() &&
                        std::all_of(spheres.begin(), spheres.end(), [](const GrainSphere& s) { return s.fixed; });
  if (lbm::by_wall_distance(scene.coupling.body_weighting))
    findings.mistake(
        "coupling.solid_operator",
        "coupling.solid_operator = \"holdych\" turns the flow round by 2 B, which is stable for B up to 1, and "
        "wall_distance and inertial have B up to 1.25; expected another body_weighting or another solid operator");
  else if (!all_held)
    findings.mistake(
        "coupling.solid_operator",
        "coupling.solid_operator = \"holdych\" lets the liquid in free grains and mapped wires swing undamped, "
        "expected fixed grains and wires by the drag law, or another solid operator");
}

void check_solid_operator(const Scene& scene, Findings& findings) {
  const bool turns = lbm::bounces_back(scene.coupling.solid_operator);
  if (turns && findings.sound({"coupling", "fluid"}) &&
      (scene.fluid.smagorinsky > 0 || scene.fluid.rheology.law != FlowLaw::newtonian))
    findings.mistake("coupling.solid_operator",
                     "coupling.solid_operator turns populations, which is for a constant viscosity alone, expected "
                     "fluid.smagorinsky = 0 and a Newtonian fluid, or another solid operator");
  else if (scene.coupling.solid_operator == SolidOperator::nonequilibrium_bounce_back && findings.sound({"coupling"}) &&
           lbm::by_wall_distance(scene.coupling.body_weighting))
    findings.mistake(
        "coupling.solid_operator",
        "coupling.solid_operator = \"bounce_back\" turns the stress in bodies round by 2 B, which dies for B up to 1, "
        "and "
        "wall_distance and inertial have B up to 1.25; expected another body_weighting or another solid operator");
  if (scene.coupling.solid_operator == SolidOperator::wall_velocity_bounce_back &&
      findings.sound({"coupling", "grains"}))
    check_holdych(scene, findings);
}

void check_body_weighting(const Scene& scene, Findings& findings) {
  if (scene.coupling.resolve_wires_from_cells && scene.coupling.body_weighting == BodyWeighting::inertial &&
      findings.sound({"coupling"}))
    findings.mistake("coupling.body_weighting",
                     "coupling.body_weighting = \"inertial\" is for grains and lets too much through wires that are "
                     "resolved, expected \"wall_distance\", or no resolve_wires_from_cells");
  if (scene.coupling.grains == GrainFluid::resolved && scene.coupling.body_weighting == BodyWeighting::inertial &&
      findings.sound({"coupling", "fluid"}) && scene.fluid.rheology.law != FlowLaw::newtonian)
    findings.mistake(
        "coupling.body_weighting",
        "coupling.body_weighting = \"inertial\" lets the flow into bodies as far as its kinematic viscosity "
        "allows, which says little of mud, expected \"wall_distance\" with this fluid.rheology.law");
}

/// More is a slip of the pen: a run that takes years.
void check_substeps(const Scene& scene, Findings& findings) {
  constexpr double most = 1e6;
  if (!scene.fluid.enabled || !scene.has_solids() ||
      !findings.sound({"fluid", "solids", "grains", "barrier", "materials", "contact", "domain", "gravity", "run"}))
    return;
  const double fluid = cases::fluid_time_step(scene), solids = cases::solids_time_step(scene);
  if (fluid / solids <= most) return;
  const char* const key = scene.solids.time_step > 0 ? "solids.time_step_s" : "solids.contact_safety";
  findings.mistake(key, fmt::format("{}: a step of the fluid takes {:.2g} of the particles', of {:.2g} s each, "
                                    "expected at most {:g}",
                                    key, fluid / solids, solids, most));
}

}  // namespace

void check_uses(const Scene& scene, Findings& findings) {
  if (scene.coupling.enabled && findings.sound({"coupling", "fluid", "grains", "barrier"})) {
    if (!scene.fluid.enabled)
      findings.mistake("coupling.enabled",
                       "coupling.enabled is true without a fluid, expected fluid.enabled = true as well");
    if (!scene.has_solids())
      findings.mistake("coupling.enabled", "coupling.enabled is true without grains or barrier, expected some");
  }
  if (scene.coupling.enabled && scene.coupling.lubrication && scene.grains.packings.empty() &&
      scene.grains.spheres.empty() && findings.sound({"coupling", "grains"}))
    findings.mistake("coupling.lubrication",
                     "coupling.lubrication is for the film between grains, expected false without grains");
  if (scene.coupling.enabled && scene.coupling.grains == GrainFluid::averaged && findings.sound({"coupling", "fluid"}))
    check_averaged(scene, findings);
  check_substeps(scene, findings);
  if (scene.coupling.enabled && scene.coupling.grains == GrainFluid::resolved) check_solid_operator(scene, findings);
  if (scene.coupling.enabled) check_body_weighting(scene, findings);
  if (!scene.fluid.enabled && !scene.has_solids() && findings.sound({"fluid", "grains", "barrier"}))
    findings.mistake("scene", "the scene is empty, expected a fluid, grains or a barrier");
  check_section(scene, findings);
  check_memory_of_particles(scene, findings);
}

}  // namespace lahar::scene

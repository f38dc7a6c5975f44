#include <fmt/format.h>

#include <cmath>

#include "cases/assembly/estimates.h"
#include "cases/runner/warnings_by_part.h"
#include "cases/scene/names.h"
#include "coupling/coupling_options.h"

namespace lahar::cases {
namespace {

/// The domain is divided into equal lengths: where few have room each is much longer than was asked for.
void add_divided_lengths(const scene::Scene& s, const Vec3& lengths, Warnings& list) {
  constexpr double bearable = 1.15;  // of what was asked for
  const double asked = s.coupling.averaging_length;
  for (int a = 0; a < 3; ++a)
    if (lengths[a] < (1 - 1e-6) * asked)
      list.push_back(
          fmt::format("coupling.averaging_length_m is {:g}, more than the domain along {}: {:.3g} m is taken", asked,
                      "xyz"[a], lengths[a]));
    else if (lengths[a] > bearable * asked)
      list.push_back(
          fmt::format("coupling.averaging_length_m is {:g}, but along {} the domain is divided into lengths "
                      "of {:.3g} m: choose one that divides it",
                      asked, "xyz"[a], lengths[a]));
}

/// Resolved grains that fall faster than the time step was chosen for: liquid cannot follow them.
void add_fast_grains(const scene::Scene& s, Warnings& list) {
  constexpr double bearable = 0.3;  // cells a step; the liquid is held below 0.35, sound goes 0.58
  const double fastest = grain_drop_speed(s), step = fluid_time_step(s);
  if (const double paced = fastest * step / s.fluid.cell_size; paced > bearable)
    list.push_back(fmt::format(
        "grains that fall without loss to the lowest of the domain reach {:.3g} m/s, {:.2f} cells in a time "
        "step, and the liquid is held below 0.35: fluid.max_speed_m_s of as much bears them",
        fastest, paced));
}

/// Resolved grains of few cells that liquid at rest throws about (docs/decisions/0098, 0110).
void add_restless_grains(const scene::Scene& s, const SolidsFigures& f, Warnings& list) {
  if (s.coupling.grains != scene::GrainFluid::resolved || !f.cells_per_smallest_grain || !f.lightest_grain) return;
  const double cells = *f.cells_per_smallest_grain, density = *f.lightest_grain;
  const double calm = density < 1.1 ? 3 : density < 1.6 ? 2.5 : 1.5;  // cells
  if (lbm::by_wall_distance(s.coupling.body_weighting) && cells < calm)
    list.push_back(
        fmt::format("the smallest grain is {:.1f} cells across: below {:g}, with {:.2g} of the liquid's density, "
                    "grains may win energy from liquid that is viscous",
                    cells, calm, density));
}

/// Vibrations that turn round about once in the fluid's step are fed by mapped wires (docs/decisions/0105).
void add_shaken_wires(const scene::Scene& s, const SolidsFigures& f, Warnings& list) {
  constexpr double calm = 0.01;
  if (!f.cells_per_wire || !s.coupling.resolve_wires_from_cells || s.solids.bond_damping_ratio >= calm ||
      *f.cells_per_wire < *s.coupling.resolve_wires_from_cells || !lbm::by_wall_distance(s.coupling.body_weighting))
    return;
  list.push_back(fmt::format(
      "wires of {:.1f} cells are resolved (coupling.resolve_wires_from_cells), and solids.bond_damping_ratio "
      "is {:g}: stiff nets may shake themselves even in liquid at rest; {:g} bears it",
      *f.cells_per_wire, s.solids.bond_damping_ratio, calm));
}

/// Beads weigh as spheres; mapped wires displace cylinders.
void add_floating_wires(const scene::Scene& s, const SolidsFigures& f, Warnings& list) {
  constexpr double of_cylinder = 2.0 / 3;  // the sphere that it is around
  const double density = s.barrier.net.density, least = s.fluid.density / of_cylinder;
  if (!f.cells_per_wire || !s.coupling.resolve_wires_from_cells ||
      *f.cells_per_wire < *s.coupling.resolve_wires_from_cells || density >= least)
    return;
  list.push_back(fmt::format(
      "barrier.net.density_kg_m3 is {:g}: wires that are resolved (coupling.resolve_wires_from_cells) weigh as their "
      "spheres and displace cylinders: below {:g}, 1.5 times the liquid's, they float up",
      density, least));
}

}  // namespace

void warn_of_coupling(const scene::Scene& s, const SolidsFigures& f, Warnings& list) {
  if (!s.coupling.enabled) return list.push_back("fluid and particles do not feel each other: coupling is off");
  if (f.cells_per_smallest_grain && *f.cells_per_smallest_grain < 4)
    list.push_back(fmt::format("the smallest grain is {:.1f} cells across: its drag is uncertain below about 4",
                               *f.cells_per_smallest_grain));
  add_restless_grains(s, f, list);
  add_shaken_wires(s, f, list);
  add_floating_wires(s, f, list);
  constexpr double light = 0.2;  // docs/decisions/0034
  if (f.lightest_grain && *f.lightest_grain < light)
    list.push_back(
        fmt::format("the lightest grain has {:.2g} of the liquid's density: those below {:g} that touch each "
                    "other or a wall may be thrown about",
                    *f.lightest_grain, light));
  if (f.grains > 0 && s.coupling.grains == scene::GrainFluid::resolved && !s.fluid.adaptive_time_step)
    add_fast_grains(s, list);
  if (f.averaging_diameters && *f.averaging_diameters < 2)
    list.push_back(fmt::format(
        "coupling.averaging_length_m is {:.2g} diameters of the largest grain: averages swing with every grain below 2",
        *f.averaging_diameters));
  if (f.averaging_lengths) add_divided_lengths(s, *f.averaging_lengths, list);
  constexpr double shift_of_note = 0.05;  // cells: a fifth of the drag of grains of 4 cells
  if (f.cell_reynolds && lbm::by_wall_distance(s.coupling.body_weighting))
    if (const double shift = coupling::radius_shift_at(*f.cell_reynolds);
        std::abs(shift - s.coupling.radius_shift_cells) > shift_of_note)
      list.push_back(
          fmt::format("coupling.radius_shift_cells is {:g}: for grains that settle, with {:.3g} as the "
                      "Reynolds number of a cell, {:.2f} gives the drag",
                      s.coupling.radius_shift_cells, *f.cell_reynolds, shift));
  constexpr double fast = 25;  // cell Reynolds number: docs/decisions/0054
  if (f.cell_reynolds && *f.cell_reynolds > fast && !s.grains.packings.empty() &&
      s.coupling.body_weighting == scene::BodyWeighting::wall_distance)
    list.push_back(
        "coupling.body_weighting is \"wall_distance\": grains that run through the cells much faster than the liquid "
        "runs past them drag it up to 13 times too much at 30 times that speed; \"inertial\" twice");
  if (f.cells_per_wire && !s.coupling.wire_drag && !s.coupling.beads_as_grains &&
      *f.cells_per_wire < s.coupling.resolve_wires_from_cells.value_or(*f.cells_per_wire + 1))
    list.push_back(fmt::format(
        "wires are {:.1f} cells across and coupling.wire_drag is off: water does not feel the net", *f.cells_per_wire));
  constexpr double thick = 8;  // docs/decisions/0037: 3 to 7 % too little from there on, 23 to 36 % with 16
  if (f.cells_per_wire && s.coupling.wire_drag && !s.coupling.beads_as_grains && *f.cells_per_wire > thick &&
      *f.cells_per_wire < s.coupling.resolve_wires_from_cells.value_or(*f.cells_per_wire + 1))
    list.push_back(
        fmt::format("wires are {:.1f} cells across: the drag law drags them too little from 8 on", *f.cells_per_wire));
  if (s.barrier.enabled && s.barrier.net.kind == scene::NetKind::hexagonal)
    list.push_back("water feels the cables of a hexagonal mesh, but not its wires");
  if (const double post = s.barrier.posts.diameter / s.fluid.cell_size;
      s.coupling.wire_drag && !s.coupling.beads_as_grains && post > 4 &&
      post < s.coupling.resolve_wires_from_cells.value_or(post + 1))
    list.push_back(fmt::format("posts are {:.1f} cells across: their drag law is for wires up to about 4", post));
  const bool resolved = s.coupling.grains == scene::GrainFluid::resolved;
  if (resolved && !lbm::by_wall_distance(s.coupling.body_weighting) &&
      s.coupling.radius_shift_cells != coupling::kRadiusShift)
    list.push_back(fmt::format("coupling.radius_shift_cells changes nothing with body_weighting = \"{}\"",
                               scene::name_of(s.coupling.body_weighting)));
  if (s.coupling.beads_as_grains && !s.barrier.enabled)
    list.emplace_back("coupling.beads_as_grains changes nothing without a barrier");
  if (s.coupling.body_weighting == scene::BodyWeighting::noble_torczynski && resolved)
    list.push_back("coupling.body_weighting = \"noble_torczynski\" lets water through bodies at low viscosity");
}

}  // namespace lahar::cases

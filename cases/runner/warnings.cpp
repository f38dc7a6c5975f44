#include "cases/runner/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "cases/assembly/grain_sizes.h"
#include "cases/assembly/memory.h"

namespace lahar::cases {
namespace {

using List = std::vector<std::string>;

void add_times(const scene::Scene& s, List& list) {
  const auto longer = [&](double interval, const char* key) {
    if (interval > s.run.duration)
      list.push_back(fmt::format("run.{} ({:g} s) is longer than the run ({:g} s)", key, interval, s.run.duration));
  };
  longer(s.run.series_interval, "series_interval_s");
  longer(s.run.output_interval, "output_interval_s");
  longer(s.run.image_interval, "image_interval_s");
  longer(s.run.checkpoint_interval, "checkpoint_interval_s");
}

void add_fluid(const scene::Scene& s, const FluidFigures& f, List& list) {
  const bool fragile = !stable_without_eddies(s.fluid.collision) && s.fluid.smagorinsky == 0;
  if (fragile && f.tau - 0.5 < 1e-3)
    list.push_back(fmt::format("tau - 1/2 is {:.2g}: this collision operator is unstable there without smagorinsky > 0",
                               f.tau - 0.5));
  if (f.mach > 0.3)
    list.push_back(
        fmt::format("Ma = {:.2f}: errors of compressibility reach {:.0f} %", f.mach, 100 * f.compressibility_error));
  if (f.depth < 4 * s.fluid.cell_size)
    list.push_back(fmt::format("the liquid is only {:.1f} cells deep", f.depth / s.fluid.cell_size));
  const auto have = static_cast<double>(scene::physical_memory());
  if (f.expected_bytes > 0.8 * have)
    list.push_back(fmt::format("the fluid may need {:.1f} GB of the {:.1f} GB of this machine", f.expected_bytes * 1e-9,
                               have * 1e-9));
}

void add_solids(const scene::Scene& s, const SolidsFigures& f, List& list) {
  const double critical = std::min(
      {f.limits.grain_rayleigh, f.limits.bead_rayleigh, f.limits.ring_bond, f.limits.cable_bond, f.limits.post_bond});
  if (s.solids.time_step > critical)
    list.push_back(fmt::format("solids.time_step_s ({:.3g} s) is above the critical time step ({:.3g} s)",
                               s.solids.time_step, critical));
  if (s.solids.contact_modulus_scale < 1)
    list.push_back(fmt::format("contacts are softened: moduli times {:g}", s.solids.contact_modulus_scale));
  if (s.solids.bond_stiffness_scale < 1 && s.barrier.enabled)
    list.push_back(fmt::format("bonds are softened: stiffness times {:g}", s.solids.bond_stiffness_scale));
  if (s.walls.empty() && f.grains > 0) list.push_back("there are grains but no walls: nothing holds them");
}

void add_coupling(const scene::Scene& s, const SolidsFigures& f, List& list) {
  if (!s.coupling.enabled) return list.push_back("fluid and particles do not feel each other: coupling is off");
  if (f.cells_per_smallest_grain && *f.cells_per_smallest_grain < 4)
    list.push_back(fmt::format("the smallest grain is {:.1f} cells across: its drag is uncertain below about 4",
                               *f.cells_per_smallest_grain));
  if (f.cells_per_wire && !s.coupling.wire_drag &&
      *f.cells_per_wire < s.coupling.resolve_wires_from_cells.value_or(*f.cells_per_wire + 1))
    list.push_back(fmt::format(
        "wires are {:.1f} cells across and coupling.wire_drag is off: water does not feel the net", *f.cells_per_wire));
  if (s.barrier.enabled && s.barrier.net.kind == scene::NetKind::hexagonal)
    list.push_back("water feels the cables of a hexagonal mesh, but not its wires");
  if (const double post = s.barrier.posts.diameter / s.fluid.cell_size;
      s.coupling.wire_drag && post > 4 && post < s.coupling.resolve_wires_from_cells.value_or(post + 1))
    list.push_back(fmt::format("posts are {:.1f} cells across: their drag law is for wires up to about 4", post));
  if (s.coupling.body_weighting == scene::BodyWeighting::noble_torczynski)
    list.push_back("coupling.body_weighting = \"noble_torczynski\" lets water through bodies at low viscosity");
}

std::set<std::string> materials_in_use(const scene::Scene& s) {
  std::set<std::string> names;
  for (const auto& w : s.walls) names.insert(w.material);
  for (const auto& p : s.grains.packings) {
    for (const auto& g : p.sizes) names.insert(g.material);
    for (const auto& g : p.log_normal) names.insert(g.material);
    for (const auto& g : p.sieved) names.insert(g.material);
  }
  for (const auto& g : s.grains.spheres) names.insert(g.material);
  if (s.barrier.enabled) names.insert(s.barrier.net.material);
  return names;
}

/// Materials of things that move: walls do not touch each other.
bool only_walls(const scene::Scene& s, const std::string& a) {
  const auto is = [&](const auto& thing) { return thing.material == a; };
  for (const auto& p : s.grains.packings)
    if (std::any_of(p.sizes.begin(), p.sizes.end(), is) || std::any_of(p.log_normal.begin(), p.log_normal.end(), is) ||
        std::any_of(p.sieved.begin(), p.sieved.end(), is))
      return false;
  if (std::any_of(s.grains.spheres.begin(), s.grains.spheres.end(), is)) return false;
  return !(s.barrier.enabled && s.barrier.net.material == a);
}

void add_contacts(const scene::Scene& s, List& list) {
  const std::set<std::string> names = materials_in_use(s);
  for (auto a = names.begin(); a != names.end(); ++a)
    for (auto b = a; b != names.end(); ++b) {
      const bool listed = std::any_of(s.contacts.begin(), s.contacts.end(), [&](const scene::Contact& c) {
        return (c.materials[0] == *a && c.materials[1] == *b) || (c.materials[0] == *b && c.materials[1] == *a);
      });
      if (!listed && !(only_walls(s, *a) && only_walls(s, *b)))
        list.push_back(fmt::format("no [[contact]] for \"{}\" and \"{}\": they are smooth and elastic", *a, *b));
    }
}

void add_packings(const scene::Scene& s, List& list) {
  constexpr double random_close_packing = 0.64;
  for (std::size_t i = 0; i < s.grains.packings.size(); ++i) {
    const scene::Packing& p = s.grains.packings[i];
    double solid = 0;
    for (const scene::GrainSize& size : scene::grain_sizes(s, i))
      solid += static_cast<double>(size.count) * std::numbers::pi / 6 * std::pow(size.diameter, 3);
    Vec3 box = p.upper - p.lower;
    if (p.target_height > 0) box.z() = p.target_height;
    constexpr double rounding = 1e-3;  // of drawn grains
    if (solid > (random_close_packing + rounding) * box.prod())
      list.push_back(fmt::format("a packing is to fill {:.3f} of its space: more than random packings do (about {})",
                                 solid / box.prod(), random_close_packing));
  }
}

}  // namespace

std::vector<std::string> warnings(const scene::Scene& scene, const CheckReport& figures) {
  List list;
  add_times(scene, list);
  if (figures.fluid) add_fluid(scene, *figures.fluid, list);
  if (figures.solids) add_solids(scene, *figures.solids, list);
  if (figures.fluid && figures.solids) add_coupling(scene, *figures.solids, list);
  if (figures.solids) add_contacts(scene, list), add_packings(scene, list);
  return list;
}

}  // namespace lahar::cases

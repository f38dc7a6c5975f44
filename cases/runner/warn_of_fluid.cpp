#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "cases/assembly/estimates.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/memory.h"
#include "cases/runner/warnings_by_part.h"

namespace lahar::cases {
namespace {

/// m^3 of the domain, judged at the points of a lattice that has at most 64 an axis.
struct Room {
  double free = 0;    ///< outside walls
  double filled = 0;  ///< of it, by liquid at the start
};

Room room_of(const scene::Scene& s) {
  const Walls walls = scene::make_walls(s);
  std::vector<std::optional<Shape>> bodies;
  for (const scene::FluidRegion& r : s.fluid.regions) bodies.push_back(scene::make_body(r));
  const auto is_filled = [&](const Vec3& p) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const scene::FluidRegion& r = s.fluid.regions[i];
      const bool in_box = (p.array() >= r.lower.array()).all() && (p.array() < r.upper.array()).all();
      if (in_box && (!bodies[i] || std::visit([&](const auto& body) { return body.distance(p); }, *bodies[i]) < 0))
        return true;
    }
    return false;
  };
  const Vec3 extent = s.domain.upper - s.domain.lower;
  const Vec3i points = (extent / s.fluid.cell_size).array().round().max(1).min(64).cast<int>();
  const Vec3 apart = extent.cwiseQuotient(points.cast<double>());
  Room room;
  for (int x = 0; x < points.x(); ++x)
    for (int y = 0; y < points.y(); ++y)
      for (int z = 0; z < points.z(); ++z) {
        const Vec3 p = s.domain.lower + apart.cwiseProduct(Vec3(x + 0.5, y + 0.5, z + 0.5));
        if (walls.nearest(p).distance < 0) continue;
        room.free += apart.prod();
        if (is_filled(p)) room.filled += apart.prod();
      }
  return room;
}

/// A discharge in other units than the box and the velocity of its inflow are.
void add_rapid_inflows(const scene::Scene& s, Warnings& list) {
  constexpr double bearable = 2;           // of its velocity
  constexpr double without_velocity = 10;  // m/s
  for (const scene::Inflow& i : s.fluid.inflows) {
    const double own = i.velocity.norm(), speed = inflow_speed(i);
    if (speed > (own > 0 ? bearable * own : without_velocity))
      list.push_back(
          fmt::format("fluid.inflow \"{}\" comes with {:.3g} m/s, but its discharge_m3_s asks for {:.3g} m/s through "
                      "the face of its box across that",
                      i.name, own, speed));
  }
}

/// Sheets of a few cells whose weight counts beside their velocity.
void add_thin_inflows(const scene::Scene& s, Warnings& list) {
  constexpr double enough = 5, rapid = 2;  // cells; Froude number
  for (const scene::Inflow& i : s.fluid.inflows) {
    const Vec3 across = i.velocity.cross(s.gravity.vector());
    const double peak = peak_discharge(i);
    if (across.norm() <= 0 || peak <= 0) continue;
    const double width = (i.upper - i.lower).dot(across.normalized().cwiseAbs());
    const double depth = peak / (i.velocity.norm() * width), cells = depth / s.fluid.cell_size;
    const double froude = i.velocity.norm() / std::sqrt(s.gravity.vector().norm() * depth);
    if (cells < enough && froude < rapid)
      list.push_back(fmt::format(
          "fluid.inflow \"{}\": at its velocity its liquid is {:.2g} cells deep, with a Froude number of {:.2g}; "
          "sheets of less than {:g} cells make or lose up to a fifth of their momentum where that is less than {:g}",
          i.name, cells, froude, enough, rapid));
  }
}

/// Inflows into a domain that nothing leaves.
void add_overfilling(const scene::Scene& s, const FluidFigures& f, Warnings& list) {
  if (f.inflow_cells == 0 || !s.domain.open_faces.empty()) return;
  const Room room = room_of(s);
  const double comes_in = f.inflow_cells * std::pow(s.fluid.cell_size, 3);
  constexpr double rounding = 1e-9;
  if (room.filled + comes_in <= room.free * (1 + rounding)) return;
  std::string names;
  for (const scene::Inflow& i : s.fluid.inflows) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", i.name);
  list.push_back(
      fmt::format("fluid.inflow {}: {:.3g} m^3 in the time of the run and {:.3g} m^3 at the start are more than the "
                  "{:.3g} m^3 that the domain has room for, and no face is open",
                  names, comes_in, room.filled, room.free));
}

/// Bodies and lubrication know mud by its kinematic viscosity alone: a sphere of 8 cells in mud of 0.5 lu got 18 to 26
/// % too little drag with water's.
void add_viscosity_at_bodies(const scene::Scene& s, const FluidFigures& f, Warnings& list) {
  constexpr double bearable = 0.1;  // of that of the flow
  if (s.fluid.rheology.law != scene::FlowLaw::herschel_bulkley || !s.coupling.enabled || !s.has_solids()) return;
  if (s.coupling.grains != scene::GrainFluid::resolved && !s.coupling.lubrication) return;
  if (s.fluid.kinematic_viscosity < bearable * *f.least_limit_viscosity)
    list.push_back(fmt::format(
        "fluid.kinematic_viscosity_m2_s is {:g}, by which bodies and lubrication know the liquid; sheared at "
        "its largest speed over its depth it has {:.2g} m^2/s: give one of that size",
        s.fluid.kinematic_viscosity, *f.least_limit_viscosity));
}

}  // namespace

void warn_of_fluid(const scene::Scene& s, const FluidFigures& f, Warnings& list) {
  const bool fragile = !stable_without_eddies(s.fluid.collision) && s.fluid.smagorinsky == 0;
  // A film of 5 cells runs 2 % fast at 1, 36 % at 9.5; by trt as it should there, twice as fast at 95.
  const double large_tau = std::holds_alternative<lbm::Trt>(s.fluid.collision) ? 10 : 1;
  if (const double tau = std::max(f.tau, f.limit_tau); tau - 0.5 > large_tau)
    list.push_back(
        fmt::format("tau - 1/2 {}is {:.3g}: what is so viscous flows too fast where it is few cells thick; a "
                    "lower fluid.lattice_velocity shortens the step, and collision = \"trt\" bears 10",
                    tau > f.tau ? "at fluid.rheology.limit_viscosity_m2_s " : "", tau - 0.5));
  constexpr double firm = 1e-2;  // of tau - 1/2: at half of it TRT ran away in a dam break
  const LatticeUnits units{s.fluid.cell_size, f.time_step, s.fluid.density};
  const double flowing =  // a flow law's tau - 1/2 where the liquid shears fastest
      f.least_limit_viscosity ? 3 * units.viscosity_to_lu(*f.least_limit_viscosity) : f.tau - 0.5;
  if (fragile && flowing < firm)
    list.push_back(fmt::format("tau - 1/2 {}is {:.2g}: this collision operator may be unstable there{}",
                               f.least_limit_viscosity ? "of the liquid that shears fastest " : "", flowing,
                               f.least_limit_viscosity ? "" : " without smagorinsky > 0"));
  add_viscosity_at_bodies(s, f, list);
  if (f.mach > 0.3)
    list.push_back(
        fmt::format("Ma = {:.2f}: errors of compressibility reach {:.0f} %", f.mach, 100 * f.compressibility_error));
  if (const double drop = drop_speed(s);
      s.fluid.max_speed > 0 && s.fluid.max_speed < drop && !s.fluid.adaptive_time_step)
    list.push_back(
        fmt::format("fluid.max_speed_m_s is {:g} m/s; liquid that enters or falls without loss to the lowest of the "
                    "domain, a cell at least, reaches {:.3g} m/s: Ma would be {:.2f}",
                    s.fluid.max_speed, drop, f.mach * drop / s.fluid.max_speed));
  if (!s.fluid.adaptive_time_step && s.fluid.uncounted_share != scene::Fluid{}.uncounted_share)
    list.emplace_back("fluid.uncounted_share changes nothing without fluid.adaptive_time_step");
  if (!s.fluid.inflows.empty() && f.inflow_cells == 0) list.push_back("inflows bring nothing in the time of the run");
  add_rapid_inflows(s, list);
  add_thin_inflows(s, list);
  add_overfilling(s, f, list);
  constexpr double light = 500, heavy = 3000;  // kg/m^3
  if (s.fluid.density < light || s.fluid.density > heavy)
    list.push_back(fmt::format("fluid.density_kg_m3 is {:g}", s.fluid.density));
  if (f.least_limit_viscosity && s.fluid.rheology.limit_viscosity < *f.least_limit_viscosity)
    list.push_back(
        fmt::format("fluid.rheology.limit_viscosity_m2_s is {:g}, less than the {:.3g} of the flow law where "
                    "the liquid shears by its largest speed over its depth: the law is not felt",
                    s.fluid.rheology.limit_viscosity, *f.least_limit_viscosity));
  const bool models =
      s.domain.slip == WallSlip::wall_model ||
      std::any_of(s.walls.begin(), s.walls.end(), [](const auto& wall) { return wall.slip == WallSlip::wall_model; });
  if (models && s.fluid.smagorinsky == 0)
    list.push_back("slip = \"wall_model\" wants an eddy viscosity: fluid.smagorinsky is 0");
  if (f.depth < 4 * s.fluid.cell_size)
    list.push_back(fmt::format("the liquid is only {:.1f} cells deep", f.depth / s.fluid.cell_size));
  const auto have = static_cast<double>(scene::physical_memory());
  if (f.expected_bytes > 0.8 * have)
    list.push_back(fmt::format("the fluid may need {:.1f} GB of the {:.1f} GB of this machine", f.expected_bytes * 1e-9,
                               have * 1e-9));
}

}  // namespace lahar::cases

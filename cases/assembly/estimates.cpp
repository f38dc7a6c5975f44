#include "cases/assembly/estimates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/assembly/build.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_extent.h"
#include "cases/assembly/grain_sizes.h"
#include "cases/assembly/net_spec.h"
#include "core/capillary.h"
#include "dem/time_step.h"
#include "lbm/step/fluid_filling.h"

namespace lahar::cases {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Largest of direction . p over the corners of a box.
double highest(const Vec3& lower, const Vec3& upper, const Vec3& direction) {
  return (direction.array() > 0).select(upper, lower).dot(direction);
}

/// m^2, of a box seen along a direction; of its largest face where there is none.
double face_across(const Vec3& extent, const Vec3& direction) {
  const Vec3 faces = extent.prod() * extent.cwiseInverse();
  return direction.norm() > 0 ? faces.dot(direction.normalized().cwiseAbs()) : faces.maxCoeff();
}

}  // namespace

double peak_discharge(const scene::Inflow& inflow) {
  double peak = 0;
  const auto& points = inflow.discharge;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].time >= 0)
      peak = std::max(peak, points[k].value);
    else if (k + 1 < points.size() && points[k + 1].time > 0)
      peak = std::max(peak, std::lerp(points[k].value, points[k + 1].value,
                                      -points[k].time / (points[k + 1].time - points[k].time)));
  }
  return peak;
}

double inflow_speed(const scene::Inflow& inflow) {
  return std::max(inflow.velocity.norm(),
                  peak_discharge(inflow) / face_across(inflow.upper - inflow.lower, inflow.velocity));
}

double drop_speed(const scene::Scene& scene) {
  const Vec3 up = -scene.gravity.vector();
  const double lowest = -highest(scene.domain.lower, scene.domain.upper, -up);
  const double least = up.norm() * scene.fluid.cell_size;  // g h of a cell: thinner films wet the whole cell
  double fastest = 0;
  for (const scene::WallSettings& w : scene.walls) fastest = std::max(fastest, w.velocity.norm());
  for (const scene::FluidRegion& r : scene.fluid.regions) {
    const double fall = std::max(least, highest(r.lower, r.upper, up) - lowest);  // g h
    fastest = std::max(fastest, std::sqrt(r.velocity.squaredNorm() + 2 * fall));
  }
  for (const scene::Inflow& i : scene.fluid.inflows) {
    const double fall = std::max(least, highest(i.lower, i.upper, up) - lowest);
    fastest = std::max(fastest, std::hypot(inflow_speed(i), std::sqrt(2 * fall)));
  }
  return fastest;
}

double grain_drop_speed(const scene::Scene& scene) {
  const Vec3 up = -scene.gravity.vector();
  const double lowest = -highest(scene.domain.lower, scene.domain.upper, -up);
  double fastest = 0;  // m^2/s^2
  for (const scene::Packing& p : scene.grains.packings)
    fastest = std::max(fastest, 2 * (highest(p.lower, scene::upper_of_content(p), up) - lowest));
  for (const scene::GrainSphere& s : scene.grains.spheres)
    if (!s.fixed) fastest = std::max(fastest, s.velocity.squaredNorm() + 2 * (s.position.dot(up) - lowest));
  return std::sqrt(std::max(0.0, fastest));
}

double expected_max_speed(const scene::Scene& scene) {
  return scene.fluid.max_speed > 0 ? scene.fluid.max_speed : drop_speed(scene);
}

double sound_speed(const scene::Scene& scene) {
  return scene.fluid.cell_size / fluid_time_step(scene) / std::sqrt(3.0);
}

namespace {

/// A box of liquid up to the top of what stands on it, anywhere: as deep as the filling takes it at most.
scene::FluidRegion with_boxes_above(scene::FluidRegion r, const std::vector<scene::FluidRegion>& all) {
  const auto carries_on = [&](const scene::FluidRegion& o) {
    return o.shape == scene::RegionShape::box && (o.lower.array().head<2>() < r.upper.array().head<2>()).all() &&
           (o.upper.array().head<2>() > r.lower.array().head<2>()).all() && o.lower.z() <= r.upper.z() &&
           o.upper.z() > r.upper.z();
  };
  for (auto next = all.begin(); r.shape == scene::RegionShape::box && next != all.end();) {
    next = std::find_if(all.begin(), all.end(), carries_on);
    if (next != all.end()) r.upper.z() = next->upper.z();
  }
  return r;
}

}  // namespace

double start_compression(const scene::Scene& scene) {
  const Walls walls = scene::make_walls(scene);
  const std::vector<bool> borne = lbm::borne_regions(lbm::Domain(fluid_options(scene).domain), liquid_regions(scene));
  double depth = 0;
  for (std::size_t k = 0; k < borne.size(); ++k) {
    if (!borne[k]) continue;
    const scene::FluidRegion whole = with_boxes_above(scene.fluid.regions[k], scene.fluid.regions);
    depth = std::max(depth, scene::open_depth(walls, whole.lower, whole.upper).value_or(0));
  }
  const double pressure = -scene.gravity.vector().z() * depth / std::pow(sound_speed(scene), 2);  // over rho c_s^2
  return pressure > 0 ? std::expm1(pressure) / pressure - 1 : 0;
}

double longest_capillary_step(const scene::Scene& scene) {
  return capillary_time_step(scene.fluid.density, scene.fluid.cell_size, scene.fluid.surface_tension);
}

double fluid_time_step(const scene::Scene& scene) {
  return std::min(scene.fluid.lattice_velocity * scene.fluid.cell_size / expected_max_speed(scene),
                  longest_capillary_step(scene));
}

std::int64_t net_columns(const scene::Net& net) { return std::llround(net.width / net.ring_pitch); }
std::int64_t net_rows(const scene::Net& net) { return std::llround(net.height / net.ring_pitch); }

namespace {

/// Beads of what hangs on posts. To see whether it stands clear each is compared with all other beads.
double beads_on_posts(const scene::Scene& scene) {
  if (!scene.barrier.posts.enabled) return 0;
  const barrier::SpansSpec spec = scene::make_spans_spec(scene);
  double beads = 0;
  spec.elements.for_each_kind([&](const auto& list, std::size_t) {
    for (const auto& element : list) beads += element.beads(spec);
  });
  return beads;
}

}  // namespace

std::int64_t barrier_beads(const scene::Scene& scene) {
  const scene::Net& net = scene.barrier.net;
  double beads = 2 * (net.width + net.height) / net.wire_diameter;
  if (net.kind == scene::NetKind::rings)
    beads += static_cast<double>(net_columns(net) * net_rows(net) * net.beads_per_ring);
  else
    beads += 2 * net.width / net.mesh_width * net.height / (0.5 * (net.mesh_height + net.twist_length));
  const scene::Posts& posts = scene.barrier.posts;
  if (posts.enabled)
    beads = static_cast<double>(posts.spans) * beads +
            static_cast<double>(posts.spans + 1) * posts.height / posts.diameter + beads_on_posts(scene);
  constexpr double most = 1e18;  // that can be written as a whole number
  return std::llround(std::min(beads, most));
}

std::int64_t grain_count(const scene::Scene& scene) {
  auto count = static_cast<std::int64_t>(scene.grains.spheres.size());
  for (const scene::GrainSize& s : scene::grain_sizes(scene)) count += s.count;
  return count;
}

bool has_free_grains(const scene::Scene& scene) {
  const auto& spheres = scene.grains.spheres;
  return !scene.grains.packings.empty() ||
         std::any_of(spheres.begin(), spheres.end(), [](const scene::GrainSphere& s) { return !s.fixed; });
}

namespace {

struct GrainKind {
  double diameter, density;
  bool fixed;
};

std::vector<GrainKind> grain_kinds(const scene::Scene& scene) {
  std::vector<GrainKind> kinds;
  for (const scene::GrainSize& s : scene::grain_sizes(scene)) kinds.push_back({s.diameter, s.density, false});
  for (const scene::GrainSphere& s : scene.grains.spheres) kinds.push_back({s.diameter, s.density, s.fixed});
  return kinds;
}

}  // namespace

double smallest_grain(const scene::Scene& scene) {
  double smallest = never;
  for (const GrainKind& kind : grain_kinds(scene)) smallest = std::min(smallest, kind.diameter);
  return smallest;
}

double largest_grain(const scene::Scene& scene) {
  double largest = 0;
  for (const GrainKind& kind : grain_kinds(scene)) largest = std::max(largest, kind.diameter);
  return largest;
}

double lightest_free_grain(const scene::Scene& scene) {
  double lightest = never;
  for (const GrainKind& kind : grain_kinds(scene))
    if (!kind.fixed) lightest = std::min(lightest, kind.density);
  return lightest;
}

double settling_speed(double diameter, double density_ratio, double viscosity, double gravity) {
  const double weight = 4.0 / 3 * std::abs(density_ratio - 1) * gravity * diameter;  // = Cd v^2
  double slow = 0, fast = std::sqrt(weight / 0.44);
  for (int k = 0; k < 60; ++k) {
    const double v = (slow + fast) / 2, re = v * diameter / viscosity;
    const double drag = re > 1000 ? 0.44 * v * v : 24 * viscosity * v / diameter * (1 + 0.15 * std::pow(re, 0.687));
    (drag < weight ? slow : fast) = v;
  }
  return slow;
}

std::optional<double> settling_speed(const scene::Scene& scene) {
  if (!scene.fluid.enabled || scene.fluid.rheology.law != scene::FlowLaw::newtonian) return std::nullopt;
  double volume = 0, sum = 0;
  const auto add = [&](double diameter, double density, double count) {
    const double share = count * diameter * diameter * diameter;
    volume += share;
    sum += share * settling_speed(diameter, density / scene.fluid.density, scene.fluid.kinematic_viscosity,
                                  scene.gravity.vector().norm());
  };
  for (const scene::GrainSize& s : scene::grain_sizes(scene)) add(s.diameter, s.density, static_cast<double>(s.count));
  for (const scene::GrainSphere& s : scene.grains.spheres)
    if (!s.fixed) add(s.diameter, s.density, 1);
  if (volume <= 0) return std::nullopt;
  return sum / volume;
}

SolidsLimits solids_limits(const scene::Scene& scene) {
  const dem::Materials materials = scene::make_materials(scene);
  const auto rayleigh = [&](double diameter, double density, const std::string& material) {
    const dem::Material& m = materials[scene::material_index(scene, material)];
    return std::visit([&](const auto& law) { return law.time_limit(diameter / 2, density, m); },
                      scene.solids.contact_law);
  };
  SolidsLimits limits{never, never, never, never, never};
  for (const scene::GrainSize& s : scene::grain_sizes(scene))
    limits.grain_rayleigh = std::min(limits.grain_rayleigh, rayleigh(s.diameter, s.density, s.material));
  for (const scene::GrainSphere& s : scene.grains.spheres)
    limits.grain_rayleigh = std::min(limits.grain_rayleigh, rayleigh(s.diameter, s.density, s.material));
  if (!scene.barrier.enabled) return limits;
  const scene::Net& net = scene.barrier.net;
  const barrier::RingNetSpec spec = scene::make_net_spec(scene);
  limits.bead_rayleigh = rayleigh(net.wire_diameter, net.density * net.bead_mass_scale, net.material);
  limits.ring_bond = spec.bond_limit(spec.ring);
  if (spec.mesh) {
    const double volume = std::numbers::pi / 6 * std::pow(net.node_diameter, 3), node = spec.mesh->node_mass();
    limits.bead_rayleigh = std::min(limits.bead_rayleigh, rayleigh(net.node_diameter, node / volume, net.material));
    limits.ring_bond =
        std::min(dem::bond_time_step(wire_law_bond(spec.mesh->single, spec.mesh->single_length(), *spec.mesh), node),
                 dem::bond_time_step(wire_law_bond(spec.mesh->twist, spec.mesh->twist_length, *spec.mesh), node));
  }
  if (scene.barrier.posts.enabled) {
    const barrier::SpansSpec spans = scene::make_spans_spec(scene);
    limits.post_bond = post_bond_limit(spans);
    spans.elements.for_each_kind([&](const auto& list, std::size_t) {
      for (const auto& element : list) limits.cable_bond = std::min(limits.cable_bond, element.bond_limit(spans));
    });
  }
  limits.cable_bond = std::min(limits.cable_bond, spec.bond_limit(spec.cable));
  if (!scene.barrier.bonds.dissipator_stiffness.empty())
    limits.cable_bond = std::min(limits.cable_bond, spec.bond_limit(spec.dissipator));
  return limits;
}

double post_bond_limit(const barrier::SpansSpec& spec) {
  constexpr double few = 8;  // bonds
  barrier::PostSpec post = post_spec(spec, 0);
  const Vec3 axis = post.head - post.foot;
  if (const double shorter = few * barrier::post_spacing(axis.norm(), post.diameter); shorter < axis.norm())
    post.head = post.foot + shorter * axis.normalized();
  dem::Particles particles;
  dem::Bonds bonds;
  add_post(post, particles, bonds);
  return dem::bond_time_step(bonds, particles);
}

bool can_be_tried(const scene::Scene& scene) {
  constexpr double most_beads = 5e5, most_pairs = 1e9;
  if (!scene.barrier.enabled) return false;
  const auto beads = static_cast<double>(barrier_beads(scene));
  return beads <= most_beads && beads_on_posts(scene) * beads <= most_pairs;
}

double limit_as_built(const scene::Scene& scene) {
  if (!can_be_tried(scene)) return never;
  dem::Particles beads;
  dem::Bonds bonds;
  scene::build_barrier(scene, beads, bonds);
  return dem::bond_time_step(bonds, beads);
}

double solids_time_step(const scene::Scene& scene) {
  if (scene.solids.time_step > 0 && scene.has_solids()) return scene.solids.time_step;
  const SolidsLimits limits = solids_limits(scene);
  return std::min(scene.solids.contact_safety * std::min(limits.grain_rayleigh, limits.bead_rayleigh),
                  scene.solids.bond_safety * std::min({limits.ring_bond, limits.cable_bond, limits.post_bond}));
}

double grain_time_step(const scene::Scene& scene) {
  return scene.solids.contact_safety * solids_limits(scene).grain_rayleigh;
}

std::int64_t long_step(std::int64_t substeps, double time_step, double grain_step) {
  const double n = static_cast<double>(substeps);
  const double most = std::clamp(std::floor(grain_step / time_step * (1 + 1e-12)), 1.0, n);
  return std::llround(std::ceil(n / std::ceil(n / most)));
}

std::int64_t long_step_of(const scene::Scene& scene) {
  if (!scene.solids.two_rates || !scene.fluid.enabled || !scene.barrier.enabled || grain_count(scene) == 0) return 1;
  const double fluid_step = fluid_time_step(scene);
  const std::int64_t n = substeps(fluid_step, solids_time_step(scene));
  return long_step(n, fluid_step / static_cast<double>(n), grain_time_step(scene));
}

std::int64_t substeps(double fluid_step, double solids_step) {
  // A step that fits but for rounding counts as fitting.
  return std::max<std::int64_t>(1, std::llround(std::ceil(fluid_step / solids_step * (1 - 1e-12))));
}

}  // namespace lahar::cases

#pragma once
// The one description of every parameter: key (with its unit), range, default (the member's initializer in scene.h) and
// meaning. Reading, checking, suggestions, the resolved scene and docs/scene_reference.md all visit it. A visitor has
//   value(key, member, rule, doc)           one parameter
//   table(key, part, presence, doc)         a table
//   array(key, parts, doc)                  a list of tables
//   named(key, parts, doc)                  a table of tables, each under its own name
//   only_with(key, holds, condition, body)  keys that are meaningful, and needed, only with a value of the option `key`
//   when_on(enabled, body)                  keys of a part that can be switched off: needed only when it is on
#include <algorithm>
#include <initializer_list>
#include <string>
#include <variant>

#include "cases/scene/names.h"
#include "cases/scene/range.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// Whether a table may be left out altogether.
enum class Presence { needed, optional };

/// Keys that only belong to some values `of` the option `key`.
template <class V, class E, class Body>
void only_with(V& v, std::string_view key, E value, std::initializer_list<E> of, const Body& body) {
  std::string condition = std::string(key) + " = ";
  for (const E e : of) condition += (e == *of.begin() ? "\"" : " or \"") + name_of(e) + "\"";
  v.only_with(key, std::find(of.begin(), of.end(), value) != of.end(), condition, body);
}

/// Keys that only belong to the alternative T of the option `key`, which `body` is given.
template <class T, class V, class... Ts, class Body>
void only_with(V& v, std::string_view key, std::variant<Ts...>& value, const Body& body) {
  T other;
  T* const chosen = std::get_if<T>(&value);
  const std::string condition = std::string(key) + " = \"" + std::string(T::name) + "\"";
  v.only_with(key, chosen != nullptr, condition, [&] { body(chosen ? *chosen : other); });
}

template <class V>
void describe(V& v, Identity& s) {
  v.value("base", s.base, {},
          "Another scene file, relative to this one, whose values hold where this file says nothing. A list given here "
          "replaces the other's list.");
  v.value("changes", s.changes, {},
          "Changes to parts of the other's lists, as on the command line, by number or by name: "
          "[\"wall[bed].slip = no_slip\", \"probe[0].position_m = [1, 0, 0]\"].");
  v.value("name", s.name, required(),
          "Short name: letters, digits, `_` and `-`. Results go to `results/NAME` by default.");
  v.value("title", s.title, {}, "One line for reports.");
}

template <class V>
void describe(V& v, Run& s) {
  v.value("duration_s", s.duration, required(positive()), "Simulated time.");
  v.value("series_interval_s", s.series_interval, {positive()}, "Time between entries of the time series.");
  v.value("output_interval_s", s.output_interval, {non_negative()}, "Time between full outputs; 0 = none.");
  v.value("image_interval_s", s.image_interval, {non_negative()}, "Time between images; 0 = none.");
  v.value("force_map_interval_s", s.force_map_interval, {non_negative()},
          "Time between maps of the forces in the barrier's wires; 0 = none.");
  v.value("checkpoint_interval_s", s.checkpoint_interval, {non_negative()},
          "Simulated time between checkpoints, from which `lahar resume` goes on; 0 = only by wall time.");
  v.value(
      "checkpoint_wall_s", s.checkpoint_wall, {non_negative()},
      "Wall time between checkpoints; 0 = only by simulated time. With both 0 one is written only on interruption.");
  v.value("seed", s.seed, {non_negative()}, "Seed of everything random.");
  v.value("precision", s.precision, {}, "Number format of the fluid's populations.");
}

template <class V>
void describe(V& v, Gravity& s) {
  v.value("magnitude_m_s2", s.magnitude, {non_negative()}, "Acceleration of gravity.");
  v.value("slope_deg", s.slope_deg, {between(0, 90)},
          "Slope of the bed: x points down the slope, z is normal to the bed, g = magnitude (sin, 0, -cos).");
}

template <class V>
void describe(V& v, Domain& s) {
  v.value("lower_m", s.lower, required(), "Lower corner of the space that is simulated.");
  v.value("upper_m", s.upper, required(), "Upper corner.");
  v.value("open_faces", s.open_faces, {},
          "Faces through which water may leave (counted as outflow). Every other face is a wall for the water. "
          "Grains are held by [[wall]] alone and removed once they have left the domain, but for its top.");
  v.value("slip", s.slip, {},
          "How water slides along the faces that are walls, smooth ones. A [[wall]] in the same place goes before.");
  v.value(
      "periodic_axes", s.periodic_axes, {},
      "Axes along which the fluid repeats, each a multiple of 8 cells long; only without grains and barrier. Walls do "
      "not repeat: one that reaches over such a face ends there.");
}

/// Keys of a shape from a file; they stand in the table of the wall or region.
template <class V>
void describe_file(V& v, ShapeFile& s, std::string_view what) {
  v.value("file", s.file, required(), what);
  v.value("scale", s.scale, {positive()}, "Factor on all coordinates of the file, which then are metres.");
  v.value("translate_m", s.translate, {}, "Shift after scaling.");
  v.value("resolution_m", s.resolution, {non_negative()},
          "Distance between the points where the distance to the surface is stored; 0 = half a cell of the fluid, or "
          "an eighth of the smallest grain without one, or a 200th of its diagonal without either.");
}

template <class V>
void describe(V& v, WallSettings& s) {
  v.value("name", s.name, {}, "Name in results.");
  v.value("shape", s.shape, required(), "Shape of the solid.");
  only_with(v, "shape", s.shape, {WallShape::plane}, [&] {
    v.value("point_m", s.point, required(), "A point of the plane.");
    v.value("normal", s.normal, required(), "Normal of the plane, out of the solid; any length but zero.");
  });
  only_with(v, "shape", s.shape, {WallShape::box}, [&] {
    v.value("lower_m", s.lower, required(), "Lower corner.");
    v.value("upper_m", s.upper, required(), "Upper corner.");
  });
  only_with(v, "shape", s.shape, {WallShape::cylinder}, [&] {
    v.value("start_m", s.start, required(), "One end of the axis.");
    v.value("end_m", s.end, required(), "Other end of the axis.");
  });
  only_with(v, "shape", s.shape, {WallShape::sphere}, [&] { v.value("centre_m", s.centre, required(), "Centre."); });
  only_with(v, "shape", s.shape, {WallShape::cylinder, WallShape::sphere},
            [&] { v.value("radius_m", s.radius, required(positive()), "Radius."); });
  only_with(v, "shape", s.shape, {WallShape::mesh, WallShape::heightmap}, [&] {
    describe_file(
        v, s.file,
        "File beside the scene: a closed surface (.stl, .ply or .obj), solid inside; or heights, solid below: "
        "an ESRI ASCII grid, or rows of numbers of which the first has the largest y.");
  });
  only_with(v, "shape", s.shape, {WallShape::heightmap}, [&] {
    v.value("spacing_m", s.file.spacing, {non_negative()},
            "Distance between the heights of a plain matrix, before scaling; its last row begins at (0, 0).");
  });
  v.value("slip", s.slip, {}, "How water slides along the wall.");
  v.value("roughness_m", s.roughness, {non_negative()},
          "Equivalent sand roughness of a wall with slip = \"wall_model\"; 0 = smooth.");
  v.value("material", s.material, {}, "Name of a material; needed where the scene has grains or a barrier.");
  only_with(v, "shape", s.shape, {WallShape::plane, WallShape::box}, [&] {
    v.value("velocity_m_s", s.velocity, {}, "Tangential velocity of the surface (the wall itself stays in place).");
  });
  v.value("opens_at_s", s.opens_at, {non_negative()},
          "When the wall is taken away at once, as a gate; 0 = never. One that is lifted is a stack of walls that open "
          "one after the other.");
}

template <class V>
void describe(V& v, FluidRegion& s) {
  v.value("shape", s.shape, {}, "Shape of what is full of liquid at the start.");
  only_with(v, "shape", s.shape, {RegionShape::box}, [&] {
    v.value("lower_m", s.lower, required(), "Lower corner.");
    v.value("upper_m", s.upper, required(), "Upper corner.");
  });
  only_with(v, "shape", s.shape, {RegionShape::cylinder}, [&] {
    v.value("start_m", s.start, required(), "One end of the axis.");
    v.value("end_m", s.end, required(), "Other end of the axis.");
  });
  only_with(v, "shape", s.shape, {RegionShape::sphere}, [&] { v.value("centre_m", s.centre, required(), "Centre."); });
  only_with(v, "shape", s.shape, {RegionShape::cylinder, RegionShape::sphere},
            [&] { v.value("radius_m", s.radius, required(positive()), "Radius."); });
  only_with(v, "shape", s.shape, {RegionShape::mesh},
            [&] { describe_file(v, s.file, "File beside the scene: a closed surface (.stl, .ply or .obj)."); });
  v.value("velocity_m_s", s.velocity, {},
          "Velocity at the start; with averaged grains that of liquid and grains together.");
}

template <class V>
void describe(V& v, Rheology& s) {
  v.value("law", s.law, {}, "Flow law.");
  v.value("yield_stress_Pa", s.yield_stress, {non_negative()}, "Shear stress below which the fluid only creeps.");
  v.value("consistency_Pa_s_n", s.consistency, {non_negative()}, "K of the stress yield + K rate^n.");
  v.value("exponent", s.exponent, {between(0.3, 2)}, "n: below 1 thinner, above 1 thicker in fast shear.");
  v.value(
      "limit_viscosity_m2_s", s.limit_viscosity, {non_negative()},
      "Largest kinematic viscosity, that of the creep below the yield stress; needed with any law but `newtonian`.");
}

template <class V>
void describe(V& v, Inflow& s) {
  v.value("name", s.name, required(), "Name in messages: letters, digits, `_` and `-`.");
  v.value("lower_m", s.lower, required(), "Lower corner of the box whose cells liquid enters.");
  v.value("upper_m", s.upper, required(), "Upper corner.");
  v.value("velocity_m_s", s.velocity, {}, "Velocity with which it comes.");
  v.value("discharge_m3_s", s.discharge, {.range = non_negative(), .required = true, .min_count = 2},
          "Hydrograph: [time in s, discharge], straight lines between, nothing before the first and after the last.");
}

template <class V>
void describe(V& v, Fluid& s) {
  v.value("enabled", s.enabled, required(), "Whether there is a fluid.");
  v.when_on(s.enabled, [&] {
    v.value("cell_size_m", s.cell_size, required(positive()), "Edge of a lattice cell.");
    v.value("density_kg_m3", s.density, {positive()}, "Density.");
    v.value("kinematic_viscosity_m2_s", s.kinematic_viscosity, {positive()},
            "Kinematic viscosity. With `law = \"herschel_bulkley\"` for lubrication, weighting of bodies and estimates "
            "alone: "
            "that of the mud where it flows round grains.");
    v.value("surface_tension_N_m", s.surface_tension, {non_negative()},
            "Surface tension (clean water: 0.0728); 0 = off. Walls are wetted at 90 degrees.");
    v.value("collision", s.collision, {}, "Collision operator.");
    v.value("smagorinsky", s.smagorinsky, {between(0, 0.5)}, "Smagorinsky constant of the eddy viscosity; 0 = off.");
    v.value(
        "lattice_velocity", s.lattice_velocity, {above_up_to(0, 0.3)},
        "Largest expected speed in cells per time step; it sets the time step. Compressibility errors grow with its "
        "square.");
    v.value("max_speed_m_s", s.max_speed, {non_negative()},
            "Largest expected speed; 0 = from the drop height, a cell at least, sqrt(v0^2 + 2 g h).");
    v.value("adaptive_time_step", s.adaptive_time_step, {},
            "Whether the time step follows the liquid, so that its largest speed stays about lattice_velocity: shorter "
            "at once where it is too fast, longer when it has been calm. The largest expected speed then sets the "
            "first step alone.");
    v.value(
        "uncounted_share", s.uncounted_share, {between(0, 0.1)},
        "Share of the wet cells, the fastest, that adaptive_time_step does not count: drops and jets of a splash. 0 "
        "= the fastest cell counts.");
    v.value("wall_placement", s.wall_placement, {}, "Where no-slip walls are felt.");
    v.table("rheology", s.rheology, Presence::optional, "Flow law of mud and slurry. Newtonian when left out.");
    v.array("region", s.regions, "Where the liquid is at the start; where regions overlap it is that of the first.");
    v.array("inflow", s.inflows, "Where liquid comes in during the run.");
  });
}

template <class V>
void describe(V& v, MaterialSettings& s) {
  v.value("youngs_modulus_Pa", s.youngs_modulus, required(positive()), "Young's modulus.");
  v.value("poisson_ratio", s.poisson_ratio, required({.lower = 0, .upper = 0.5}), "Poisson's ratio.");
}

template <class V>
void describe(V& v, Contact& s) {
  v.value("materials", s.materials, {.required = true, .min_count = 2, .max_count = 2},
          "The two materials that touch (the same name twice for a material with itself).");
  v.value("friction", s.friction, required(non_negative()), "Coulomb coefficient.");
  v.value("restitution", s.restitution, required(above_up_to(0, 1)), "Coefficient of restitution.");
  v.value(
      "rolling_friction", s.rolling_friction, {non_negative()},
      "Coefficient of rolling resistance: the torque that keeps two surfaces rolling on each other / (radius x normal "
      "force), 1 / radius the sum of both curvatures, on a cylinder as a wall the root of their product; 0 = they roll "
      "freely.");
}

template <class V>
void describe(V& v, Solids& s) {
  v.value(
      "time_step_s", s.time_step, {non_negative()},
      "Time step of the particles; 0 = the smaller of the two limits below. Shortened so that a whole number fits into "
      "a fluid step.");
  v.value("contact_safety", s.contact_safety, {above_up_to(0, 1)},
          "Share of the smallest Rayleigh time of a particle (linear law: of 0.35 times the shortest contact) that is "
          "used. Up to 0.3 the energy of an elastic ball that bounces is known to 2 %.");
  v.value("bond_safety", s.bond_safety, {above_up_to(0, 1)}, "Share of the smallest limit of a bond that is used.");
  v.value(
      "two_rates", s.two_rates, {},
      "Whether contacts of grains among themselves and with walls take a longer step, the grains' own share of their "
      "Rayleigh time, where beads need a shorter one. Needs a fluid, whose step both fit into.");
  v.value("contact_modulus_scale", s.contact_modulus_scale, {above_up_to(0, 1)},
          "Factor on every Young's modulus in contacts: softer contacts allow longer time steps. Of no account with "
          "contact_law = \"linear\".");
  v.value("bond_stiffness_scale", s.bond_stiffness_scale, {above_up_to(0, 1)}, "Factor on every bond stiffness.");
  v.value("bond_damping_ratio", s.bond_damping_ratio, {between(0, 1)}, "Damping of the bonds, as a share of critical.");
  v.value("wire_contacts", s.wire_contacts, {},
          "How rings and cables touch each other and grains. With walls they touch bead by bead.");
  v.value("contact_law", s.contact_law, {}, "Law of contacts.");
  only_with<dem::LinearSpringDashpot>(v, "contact_law", s.contact_law, [&](dem::LinearSpringDashpot& law) {
    v.value("normal_stiffness_N_m", law.normal_stiffness, required(positive()), "Stiffness of the normal spring.");
    v.value("tangential_stiffness_N_m", law.tangential_stiffness, {non_negative()},
            "Stiffness of the tangential spring; 0 = 2/7 of the normal one.");
  });
}

template <class V>
void describe(V& v, GrainSize& s) {
  v.value("diameter_m", s.diameter, required(positive()), "Diameter.");
  v.value("count", s.count, required(between(1, 1e7)), "Number of grains.");
  v.value("density_kg_m3", s.density, required(positive()), "Density.");
  v.value("material", s.material, required(), "Name of a material.");
}

/// Keys of every grading, within its own table.
template <class V>
void describe_amount(V& v, GrainAmount& amount, double& density, std::string& material) {
  v.value(
      "mass_kg", amount.mass, {non_negative()},
      "Mass of these grains together; 0 = as much as solid_fraction asks for. Drawn to within one and a half of the "
      "largest grains (of each two sieves).");
  v.value("solid_fraction", amount.solid_fraction, {above_up_to(0, 0.74)},
          "Without a mass: the share of the box, from its floor to target_height_m, that these grains fill.");
  v.value("density_kg_m3", density, required(positive()), "Density.");
  v.value("material", material, required(), "Name of a material.");
}

template <class V>
void describe(V& v, LogNormalGrains& s) {
  v.value("median_diameter_m", s.median, required(positive()), "Median of the distribution before it is cut off.");
  v.value("log_deviation", s.deviation, required(above_up_to(0, 3)), "Standard deviation of ln(diameter).");
  v.value("smallest_diameter_m", s.smallest, required(positive()), "Lower cut-off.");
  v.value("largest_diameter_m", s.largest, required(positive()), "Upper cut-off.");
  v.value("weighting", s.weighting, {}, "What the distribution counts.");
  describe_amount(v, s.amount, s.density, s.material);
}

template <class V>
void describe(V& v, SievedGrains& s) {
  v.value("passing_percent", s.passing, {.range = between(0, 100), .required = true, .min_count = 2},
          "The sieve curve, straight over ln(opening) between its points: openings rising, percentages by mass from 0 "
          "to 100.");
  describe_amount(v, s.amount, s.density, s.material);
}

template <class V>
void describe(V& v, Packing& s) {
  v.value("lower_m", s.lower, required(),
          "Lower corner of a box in which grains are packed: they settle without friction along -z.");
  v.value("upper_m", s.upper, required(), "Upper corner.");
  v.value("target_height_m", s.target_height, {non_negative()},
          "Height above the floor to which the packing is tapped if it stands higher; 0 = as it settles.");
  v.array("sizes", s.sizes, "The grains, size by size.");
  v.array("log_normal", s.log_normal, "Grains of log-normal diameters between two cut-offs, drawn by run.seed.");
  v.array("sieve_curve", s.sieved, "Grains of a sieve curve, drawn by run.seed.");
}

template <class V>
void describe(V& v, GrainSphere& s) {
  v.value("position_m", s.position, required(), "Centre.");
  v.value("velocity_m_s", s.velocity, {}, "Velocity at the start.");
  v.value("angular_velocity_rad_s", s.angular_velocity, {}, "Angular velocity at the start.");
  v.value("diameter_m", s.diameter, required(positive()), "Diameter.");
  v.value("density_kg_m3", s.density, required(positive()), "Density.");
  v.value("material", s.material, required(), "Name of a material.");
  v.value("fixed", s.fixed, {}, "Held in place.");
}

template <class V>
void describe(V& v, Grains& s) {
  v.array("packing", s.packings, "A box of randomly packed grains.");
  v.array("sphere", s.spheres, "A single grain.");
}

/// Keys of a hexagonal mesh; they stand in the table of the net.
template <class V>
void describe_mesh(V& v, Net& s) {
  const Rule law{.range = positive(), .required = true, .min_count = 3, .max_count = 3};
  v.value("mesh_width_m", s.mesh_width, required(positive()),
          "Opening of a mesh between two twists; adjusted by up to 8 % so that whole meshes fill the frame.");
  v.value("mesh_height_m", s.mesh_height, required(positive()), "Height of a mesh from tip to tip; adjusted likewise.");
  v.value("twist_length_m", s.twist_length, required(positive()), "Length of a double twist.");
  v.value("mesh_wire_diameter_m", s.mesh_wire_diameter, required(positive()), "Diameter of the mesh's single wire.");
  v.value("node_diameter_m", s.node_diameter, required(positive()),
          "Diameter of the spheres at the ends of the twists, which grains meet; they carry the mass of the wire.");
  v.value("single_strain", s.single_strain, law,
          "Strains of three points of a single wire's tensile law, straight between; at the last it breaks.");
  v.value("single_force_N", s.single_force, law, "Forces at these strains.");
  v.value("twist_strain", s.twist_strain, law, "The same of a double twist.");
  v.value("twist_force_N", s.twist_force, law, "Forces at these strains.");
  v.value("wires_unload_plastically", s.wires_unload_plastically, {},
          "Wires of the mesh unload with the stiffness of the first piece instead of back along the curve.");
}

template <class V>
void describe(V& v, Net& s) {
  v.value("kind", s.kind, {}, "What the net is made of.");
  v.value("origin_m", s.origin, required(), "Lower corner of the net.");
  v.value("width_direction", s.width_direction, {}, "Direction of the width; any length but zero.");
  v.value("height_direction", s.height_direction, {}, "Direction of the height, at right angles to the width.");
  v.value("width_m", s.width, required(positive()),
          "Width of the frame that rings or meshes fill, all wires inside; with posts: of one span.");
  v.value("height_m", s.height, required(positive()), "Height of the frame.");
  only_with(v, "kind", s.kind, {NetKind::rings}, [&] {
    v.value("ring_diameter_m", s.ring_diameter, required(positive()),
            "Diameter of a ring along the wire's centre line.");
    v.value("ring_pitch_m", s.ring_pitch, required(positive()),
            "Distance between the centres of linked rings; adjusted by up to 8 % so that whole rings fill the frame.");
    v.value("beads_per_ring", s.beads_per_ring, required(between(8, 1000)),
            "Beads that make up a ring; they should touch.");
  });
  only_with(v, "kind", s.kind, {NetKind::hexagonal}, [&] { describe_mesh(v, s); });
  v.value("wire_diameter_m", s.wire_diameter, required(positive()), "Diameter of wire and beads of rings and cables.");
  v.value("density_kg_m3", s.density, {positive()}, "Density of the beads.");
  v.value("bead_mass_scale", s.bead_mass_scale, {at_least(1)},
          "Inertia of beads over that of steel of their density; their weight stays. The time step of bonds and of "
          "contacts of beads grows with its root. Nodes of a mesh keep theirs.");
  v.value("bead_inertia_scale", s.bead_inertia_scale, {at_least(1)},
          "Factor on the moment of inertia of beads, 2/5 m r^2. Above 1 the spins of beads, the fastest motion in a "
          "chain, are slower: from 2.5 on bonds allow a time step 1.6 times as long. Of no account in a mesh.");
  v.value("material", s.material, required(), "Name of a material.");
}

template <class V>
void describe(V& v, BarrierBonds& s) {
  v.value("ring_stiffness_N_m3", s.ring_stiffness, {non_negative()},
          "Normal and shear stiffness of ring bonds, per unit area; needed, and only allowed, with rings.");
  v.value("cable_stiffness_N_m3", s.cable_stiffness, required(positive()),
          "Normal and shear stiffness of cable bonds, per unit area.");
  const auto strength = [&](const char* key, double& value, const char* meaning) {
    v.value(key, value, {non_negative()}, meaning);
  };
  strength("ring_tensile_strength_Pa", s.ring_tensile_strength,
           "Tensile stress at the rim of a ring bond, of force and bending over the round section of the wire, above "
           "which it breaks; 0 = it does not. Only with rings.");
  strength("ring_shear_strength_Pa", s.ring_shear_strength,
           "The same of the shear stress, of shear force and torsion. Only with rings.");
  strength("cable_tensile_strength_Pa", s.cable_tensile_strength, "As of rings, of cable bonds but dissipators.");
  strength("cable_shear_strength_Pa", s.cable_shear_strength, "As of rings, of cable bonds but dissipators.");
  v.value("dissipator_stiffness_N_m3", s.dissipator_stiffness, {.range = positive(), .max_count = 3},
          "Stiffness of the two or three stages of the energy dissipators in the cables; empty = no dissipators.");
  v.value("dissipator_force_limit_N", s.dissipator_force_limit, {.range = positive(), .max_count = 2},
          "Force at which each stage but the last ends, rising.");
  v.value("dissipator_places", s.dissipator_places, {.range = between(0, 1)},
          "Where along each cable the dissipators are, as fractions of its length: the nearest bonds, each one of its "
          "own. A bottom cable that is fixed or held along the bed has none.");
  v.value(
      "plastic_unloading", s.plastic_unloading, {},
      "Dissipators unload with the stiffness of the first stage instead of back along the curve, and are slack from "
      "there down to their first length.");
}

template <class V>
void describe(V& v, Anchors& s) {
  v.value("bottom_cable", s.bottom_cable, {}, "How the bottom cable is held.");
  v.value("lateral_cable_middles_fixed", s.lateral_cable_middles_fixed, {},
          "The middles of the two lateral cables are fixed too.");
  v.value(
      "cable_places", s.cable_places, {.range = between(0, 1)},
      "Where each cable is fixed, as fractions of its length: the nearest beads. With posts the ends of the top and "
      "bottom cables and all these places of the lateral ones are tied to the posts instead.");
}

template <class V>
void describe(V& v, barrier::RetainingCable& s) {
  v.value("post", s.post, {.range = between(-1, 1000)},
          "Number of the post, 0 the first along the width; -1 = every post.");
  v.value("anchor_offset_m", s.anchor, required(),
          "From the foot of the post, on the line of the net's lower edge, to the anchor.");
  v.value(
      "dissipator_places", s.dissipators_at, {.range = between(0, 1)},
      "Where along the cable dissipators are, as fractions of its length from the anchor, each on a bond of its own.");
}

template <class V>
void describe(V& v, Posts& s) {
  v.value("enabled", s.enabled, required(), "Whether the net hangs between posts.");
  v.when_on(s.enabled, [&] {
    v.value("spans", s.spans, {between(1, 1000)},
            "Number of nets side by side; posts stand between them and at both ends.");
    v.value("height_m", s.height, required(positive()), "Top of the posts above the net's lower edge.");
    v.value("diameter_m", s.diameter, required(positive()),
            "Diameter that the flow meets. Posts stand beside the frames, a wire's diameter away.");
    v.value("foot", s.foot, {}, "How its foot is held, on the line of the net's lower edge.");
    v.value("youngs_modulus_Pa", s.youngs_modulus, {positive()}, "Young's modulus of the profile; steel by default.");
    v.value("area_m2", s.area, required(positive()), "Area of the profile.");
    v.value("second_moment_m4", s.second_moment, required(positive()),
            "Second moment of area of the profile in the direction of the flow; taken in all directions.");
    v.value("density_kg_m3", s.density, {positive()}, "Density of the profile.");
    s.elements.for_each_kind(
        [&]<class Kind>(std::vector<Kind>& list, std::size_t) { v.array(Kind::name, list, Kind::meaning); });
  });
}

template <class V>
void describe(V& v, Barrier& s) {
  v.value("enabled", s.enabled, required(), "Whether there is a barrier.");
  v.when_on(s.enabled, [&] {
    v.table("net", s.net, Presence::needed, "The net.");
    v.table("bonds", s.bonds, Presence::needed, "Stiffness of wire, cables and dissipators.");
    v.table("anchors", s.anchors, Presence::optional, "What is fixed.");
    v.table("posts", s.posts, Presence::optional, "Spans between posts. One span without posts when left out.");
    v.value("settle_time_s", s.settle_time, {non_negative()},
            "So long the barrier sags and comes to rest under gravity, alone, before the run begins; 0 = it starts as "
            "built, free of stress. Bonds keep their load; contacts begin the run without tangential force, and what "
            "friction held may move a little.");
  });
}

template <class V>
void describe(V& v, RigidBarrier& s) {
  v.value("enabled", s.enabled, required(), "Whether there is a rigid barrier.");
  v.when_on(s.enabled, [&] {
    v.value("origin_m", s.origin, required(), "Lower corner of its upstream face, at the lower y.");
    v.value("width_m", s.width, required(positive()), "Extent along y, slits included.");
    v.value("height_m", s.height, required(positive()), "Extent along z.");
    v.value("thickness_m", s.thickness, required(positive()), "Extent along x.");
    v.value("slits", s.slits, {between(0, 1000)}, "Number of slits from top to bottom, evenly spaced; 0 = a wall.");
    v.value("slit_width_m", s.slit_width, {non_negative()}, "Width of a slit.");
    v.value("material", s.material, {}, "Name of a material; needed where the scene has grains or a barrier.");
    v.value("slip", s.slip, {}, "How water slides along it.");
  });
}

template <class V>
void describe(V& v, Coupling& s) {
  v.value("enabled", s.enabled, required(), "Whether fluid and particles act on each other.");
  v.when_on(s.enabled, [&] {
    v.value("grains", s.grains, {}, "How fluid and grains act on each other.");
    only_with(v, "grains", s.grains, {GrainFluid::averaged}, [&] {
      v.value("averaging_length_m", s.averaging_length, {positive()},
              "Over which flow and grains are averaged, no less than a cell: two diameters or more. What divides each "
              "length of the domain and is no shorter is taken, or that length.");
      v.value("bed_drag", s.bed_drag, {}, "Drag law of grains among others.");
      v.value(
          "beads_as_grains", s.beads_as_grains, {},
          "Whether each bead of a wire feels drag and buoyancy as a grain among the grains around it, by that law, as "
          "in averaged studies, instead of wire_drag; it fills no space among them.");
    });
    v.value("body_weighting", s.body_weighting, {},
            "Weight of the solid in a partly covered cell. This and the next three are for resolved grains.");
    v.value("solid_operator", s.solid_operator, {}, "What a body puts in place of the fluid's collision.");
    v.value("radius_shift_cells", s.radius_shift_cells, {between(-0.5, 0.5)},
            "Added to the radius at which the fluid comes to rest; with body_weighting = wall_distance or inertial.");
    v.value("lubrication", s.lubrication, {},
            "Films between grains, and between grains and walls, closer than two thirds of a cell.");
    v.value("wire_drag", s.wire_drag, {}, "Drag of wires thinner than the cells by a drag law.");
    v.value("resolve_wires_from_cells", s.resolve_wires_from_cells, {at_least(2)},
            "Wires of at least so many cells a diameter are mapped as bodies instead. Default: none is.");
  });
}

template <class V>
void describe(V& v, Measure& s) {
  v.value("section_x_m", s.section_x, {},
          "Plane whose arrival times and passing masses are measured. Default: the barrier's plane, of a rigid one the "
          "upstream face, if there is a fluid, or none.");
  v.value("inflow_distance_m", s.inflow_distance, {non_negative()},
          "The energy of the arriving flow is taken when its front is this far upstream of the section.");
  v.value("outflow_distance_m", s.outflow_distance, {non_negative()},
          "Mass and energy that pass are counted this far downstream of the section.");
  v.value("energy_datum_z_m", s.energy_datum_z, {},
          "Potential energy is zero at the bed-normal coordinate z = this on the section.");
}

template <class V>
void describe(V& v, Probe& s) {
  v.value("name", s.name, required(), "Name in results: letters, digits, `_` and `-`.");
  v.value("kind", s.kind, required(), "What is measured.");
  v.value("position_m", s.position, required(),
          "Where; of a force: the point that its moment is taken about; of a grain: where its centre is at the start.");
  only_with(v, "kind", s.kind, {ProbeKind::pressure}, [&] {
    v.value("diameter_m", s.diameter, {non_negative()},
            "Of the sensor: a disc parallel to the nearest wall or face of the domain, over which the pressure is "
            "averaged; 0 = a point.");
    v.value("time_mean", s.time_mean, {},
            "Whether a row holds the mean over the time since the last row, sampled at every step, instead of the "
            "pressure at that moment.");
  });
  only_with(v, "kind", s.kind, {ProbeKind::force}, [&] { v.value("wall", s.wall, required(), "Name of a [[wall]]."); });
}

template <class V>
void describe(V& v, FluxSection& s) {
  v.value("name", s.name, required(), "Name in results: letters, digits, `_` and `-`.");
  v.value("point_m", s.point, required(), "Centre of the rectangle.");
  v.value("normal", s.normal, required(), "Normal of its plane, the direction that counts as positive.");
  v.value("width_m", s.width, {non_negative()},
          "Extent along z x normal (along x where the normal is z); 0 = as far as the domain.");
  v.value("height_m", s.height, {non_negative()}, "Extent along normal x width direction; 0 = as far as the domain.");
}

/// The whole file.
template <class V>
void describe(V& v, Scene& s) {
  v.table("scene", s.identity, Presence::needed, "What it is called.");
  v.table("run", s.run, Presence::needed, "How long and what to write.");
  v.table("gravity", s.gravity, Presence::optional, "Gravity and slope.");
  v.table("domain", s.domain, Presence::needed, "The space that is simulated.");
  v.array("wall", s.walls,
          "Solid walls, for fluid and particles alike. They never move, but may be taken away (opens_at_s).");
  v.table("fluid", s.fluid, Presence::optional, "Water or slurry: the lattice Boltzmann fluid. Off when left out.");
  v.named("materials", s.materials, "Elastic properties, each material under its own name.");
  v.array("contact", s.contacts, "Properties of a pair of materials. Pairs left out are smooth and elastic.");
  v.table("solids", s.solids, Presence::optional, "Time step and softening of grains and barrier.");
  v.table("grains", s.grains, Presence::optional, "Boulders and grains.");
  v.table("barrier", s.barrier, Presence::optional, "The flexible net. Off when left out.");
  v.table(
      "rigid_barrier", s.rigid_barrier, Presence::optional,
      "A wall or slit barrier across x, for comparison. It becomes walls named rigid_barrier_0, rigid_barrier_1, ..., "
      "whose force a probe can take. Off when left out.");
  v.table("coupling", s.coupling, Presence::optional, "Fluid and particles together. Off when left out.");
  v.table("measure", s.measure, Presence::optional, "Where arrival, inflow and outflow are measured.");
  v.array("probe", s.probes, "Points and walls of which a time series is taken.");
  v.array("section", s.sections, "Rectangles through which discharge and energy are measured.");
}

}  // namespace lahar::scene

#pragma once
// A scene as plain typed data in SI units: what the user's file says after defaults, includes and overrides. Every
// parameter's key, range and meaning is described once, in cases/scene/schema.h.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barrier/elements.h"
#include "barrier/post.h"
#include "core/geometry.h"
#include "core/vector.h"
#include "coupling/coupling_options.h"
#include "dem/contact/contact_laws.h"
#include "dem/packing/grading.h"
#include "dem/wires/wire_model.h"
#include "lbm/collision/coverage_weight.h"
#include "lbm/collision/operators.h"
#include "lbm/grid/domain.h"
#include "lbm/rheology/rheology.h"

namespace lahar::scene {

// Choices that a solver offers are the solver's own.
using barrier::FootJoint;
using coupling::BedDrag;
using dem::SizeWeight;
using dem::WireContacts;
using lbm::BodyWeighting;
using lbm::CollisionOperator;
using lbm::FlowLaw;
using lbm::SolidOperator;
using lbm::WallPlacement;
using ContactLaw = dem::ContactLawChoice;
using Rheology = lbm::RheologyOptions;

enum class Precision { float32, float64 };
enum class Face { x_lower, x_upper, y_lower, y_upper, z_lower, z_upper };
enum class Axis { x, y, z };
enum class WallShape { plane, box, cylinder, sphere, mesh, heightmap };
enum class RegionShape { box, cylinder, sphere, mesh };
enum class NetKind { rings, hexagonal };
enum class BottomCable { at_places, along_bed, fixed };
enum class GrainFluid { resolved, averaged };
enum class ProbeKind { height, pressure, velocity, force, grain };

struct Identity {
  std::optional<std::string> base;   ///< only in the file: unset in a loaded scene,
  std::vector<std::string> changes;  ///< and these
  std::string name, title;
  bool operator==(const Identity&) const = default;
};

struct Run {
  double duration = 0;             ///< s
  double series_interval = 0.01;   ///< s
  double output_interval = 0;      ///< s, 0 = off
  double image_interval = 0;       ///< s, 0 = off
  double force_map_interval = 0;   ///< s, 0 = off
  double checkpoint_interval = 0;  ///< s, 0 = off
  double checkpoint_wall = 600;    ///< s of wall time, 0 = off
  std::int64_t seed = 1;
  Precision precision = Precision::float32;
  bool operator==(const Run&) const = default;
};

struct Gravity {
  double magnitude = 9.81;  ///< m/s^2
  double slope_deg = 0;     ///< degrees
  /// m/s^2: magnitude times (sin slope, 0, -cos slope); x points down the slope, z is normal to the bed.
  [[nodiscard]] Vec3 vector() const;
  bool operator==(const Gravity&) const = default;
};

struct Domain {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< m
  std::vector<Face> open_faces;
  std::vector<Axis> periodic_axes;
  WallSlip slip = WallSlip::no_slip;  ///< of the faces that are neither open nor periodic
  [[nodiscard]] bool open(Face face) const;
  [[nodiscard]] bool periodic(Axis axis) const;
  [[nodiscard]] bool contains(const Vec3& p, double tolerance = 0) const;
  bool operator==(const Domain&) const = default;
};

/// The distance that was sampled from a file when the scene was loaded. The file's name stands for it in comparisons.
struct SampledShape {
  std::shared_ptr<const DistanceGrid> grid;
  std::string check_sum;  ///< of the file's bytes
  bool operator==(const SampledShape&) const { return true; }
};

/// A shape that comes from a file.
struct ShapeFile {
  std::string file;  ///< absolute in a loaded scene
  double scale = 1;
  Vec3 translate = Vec3::Zero();  ///< m
  double spacing = 0;             ///< m, between the points of a plain matrix of heights
  double resolution = 0;          ///< m, 0 = automatic
  SampledShape sampled;           ///< set by load_shapes (cases/assembly/load_shapes.h)
  bool operator==(const ShapeFile&) const = default;
};

/// Only the members of its shape are used: plane (point, normal), box (lower, upper), cylinder (start, end, radius),
/// sphere (centre, radius), mesh and heightmap (file).
struct WallSettings {
  std::string name;
  WallShape shape = WallShape::plane;
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  Vec3 start = Vec3::Zero(), end = Vec3::Zero(), centre = Vec3::Zero();
  double radius = 0;
  ShapeFile file;
  WallSlip slip = WallSlip::no_slip;
  double roughness = 0;  ///< m, of the wall model
  std::string material;  ///< empty where nothing solid can touch it
  Vec3 velocity = Vec3::Zero();
  double opens_at = 0;  ///< s, 0 = never
  bool operator==(const WallSettings&) const = default;
};

/// As WallSettings; `lower` and `upper` bound every shape in a loaded scene.
struct FluidRegion {
  RegionShape shape = RegionShape::box;
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  Vec3 start = Vec3::Zero(), end = Vec3::Zero(), centre = Vec3::Zero();
  double radius = 0;
  ShapeFile file;
  Vec3 velocity = Vec3::Zero();
  bool operator==(const FluidRegion&) const = default;
};

/// A value at a time, s.
struct TimeValue {
  double time = 0, value = 0;
  bool operator==(const TimeValue&) const = default;
};

struct Inflow {
  std::string name;
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero(), velocity = Vec3::Zero();
  std::vector<TimeValue> discharge;  ///< m^3/s
  bool operator==(const Inflow&) const = default;
};

struct Fluid {
  bool enabled = false;
  double cell_size = 0;               ///< m
  double density = 1000;              ///< kg/m^3
  double kinematic_viscosity = 1e-6;  ///< m^2/s
  double surface_tension = 0;         ///< N/m
  CollisionOperator collision = lbm::CentralMoments{};
  double smagorinsky = 0;
  double lattice_velocity = 0.1;
  double max_speed = 0;  ///< m/s, 0 = from the drop height
  bool adaptive_time_step = false;
  double uncounted_share = 0.001;
  WallPlacement wall_placement = WallPlacement::half_way;
  Rheology rheology;
  std::vector<FluidRegion> regions;
  std::vector<Inflow> inflows;
  bool operator==(const Fluid&) const = default;
};

struct MaterialSettings {
  std::string name;
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;
  bool operator==(const MaterialSettings&) const = default;
};

struct Contact {
  std::vector<std::string> materials;  ///< two names
  double friction = 0, restitution = 1, rolling_friction = 0;
  bool operator==(const Contact&) const = default;
};

struct Solids {
  double time_step = 0;  ///< s, 0 = automatic
  double contact_safety = 0.14;
  double bond_safety = 0.8;
  bool two_rates = false;
  double contact_modulus_scale = 1;
  double bond_stiffness_scale = 1;
  double bond_damping_ratio = 0.02;
  WireContacts wire_contacts = WireContacts::beads;
  ContactLaw contact_law = dem::HertzMindlin{};
  bool operator==(const Solids&) const = default;
};

struct GrainSize {
  double diameter = 0;  ///< m
  std::int64_t count = 0;
  double density = 0;  ///< kg/m^3
  std::string material;
  bool operator==(const GrainSize&) const = default;
};

/// How much of a grading there is: a mass, or a share of the box up to the packing's target height.
struct GrainAmount {
  double mass = 0;  ///< kg, 0 = by the solid fraction
  double solid_fraction = 0.64;
  bool operator==(const GrainAmount&) const = default;
};

struct LogNormalGrains {
  double median = 0;                 ///< m
  double deviation = 0;              ///< of ln d
  double smallest = 0, largest = 0;  ///< m
  SizeWeight weighting = SizeWeight::mass;
  GrainAmount amount;
  double density = 0;  ///< kg/m^3
  std::string material;
  bool operator==(const LogNormalGrains&) const = default;
};

/// A point of a sieve curve: what passes an opening (m), in percent of the mass.
struct SievePoint {
  double opening = 0, passing = 0;
  bool operator==(const SievePoint&) const = default;
};

struct SievedGrains {
  std::vector<SievePoint> passing;
  GrainAmount amount;
  double density = 0;  ///< kg/m^3
  std::string material;
  bool operator==(const SievedGrains&) const = default;
};

/// Where something is written, for what only a run finds wrong. It is nothing that scenes differ in.
struct WrittenAt {
  std::string file;
  int line = 1, column = 1;
  bool operator==(const WrittenAt&) const { return true; }
};

struct Packing {
  WrittenAt written_at;                             ///< set by load
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< m
  double target_height = 0;                         ///< m above the floor, 0 = as it comes
  std::vector<GrainSize> sizes;
  std::vector<LogNormalGrains> log_normal;
  std::vector<SievedGrains> sieved;
  bool operator==(const Packing&) const = default;
};

struct GrainSphere {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();
  double diameter = 0, density = 0;
  std::string material;
  bool fixed = false;
  WrittenAt written_at;  ///< set by load
  bool operator==(const GrainSphere&) const = default;
};

struct Grains {
  std::vector<Packing> packings;
  std::vector<GrainSphere> spheres;
  bool operator==(const Grains&) const = default;
};

struct Net {
  NetKind kind = NetKind::rings;
  Vec3 origin = Vec3::Zero();  ///< m, the lower corner of the net
  Vec3 width_direction{0, 1, 0}, height_direction{0, 0, 1};
  double width = 0, height = 0;  ///< m
  double ring_diameter = 0;      ///< m, of the wire's centre line
  double ring_pitch = 0;         ///< m, between ring centres
  std::int64_t beads_per_ring = 0;
  double wire_diameter = 0;  ///< m
  double density = 7800;     ///< kg/m^3
  double bead_mass_scale = 1, bead_inertia_scale = 1;
  std::string material;
  // of a hexagonal mesh
  double mesh_width = 0, mesh_height = 0, twist_length = 0;  ///< m
  double mesh_wire_diameter = 0, node_diameter = 0;          ///< m
  std::vector<double> single_strain, twist_strain;           ///< 1
  std::vector<double> single_force, twist_force;             ///< N
  bool wires_unload_plastically = true;
  bool operator==(const Net&) const = default;
};

struct BarrierBonds {
  double ring_stiffness = 0, cable_stiffness = 0;               ///< N/m^3
  double ring_tensile_strength = 0, ring_shear_strength = 0;    ///< Pa, 0 = does not break
  double cable_tensile_strength = 0, cable_shear_strength = 0;  ///< the same
  std::vector<double> dissipator_stiffness;                     ///< N/m^3, empty = no dissipators
  std::vector<double> dissipator_force_limit;                   ///< N
  std::vector<double> dissipator_places{0, 1};                  ///< fractions of a cable's length
  bool plastic_unloading = false;
  bool operator==(const BarrierBonds&) const = default;
};

struct Anchors {
  BottomCable bottom_cable = BottomCable::at_places;
  bool lateral_cable_middles_fixed = false;
  std::vector<double> cable_places{0, 1};  ///< fractions of a cable's length
  bool operator==(const Anchors&) const = default;
};

struct Posts {
  bool enabled = false;
  std::int64_t spans = 1;
  double height = 0, diameter = 0;  ///< m
  FootJoint foot = FootJoint::fixed;
  double youngs_modulus = 210e9;       ///< Pa
  double area = 0, second_moment = 0;  ///< m^2, m^4
  double density = 7850;               ///< kg/m^3, of the profile
  barrier::Elements elements;          ///< what else hangs on the posts
  bool operator==(const Posts&) const = default;
};

struct Barrier {
  bool enabled = false;
  Net net;
  BarrierBonds bonds;
  Anchors anchors;
  Posts posts;
  double settle_time = 0;  ///< s
  WrittenAt written_at;    ///< set by load
  bool operator==(const Barrier&) const = default;
};

/// Only in the file: a loaded scene has walls instead, see cases/assembly/rigid_barrier.h.
struct RigidBarrier {
  bool enabled = false;
  Vec3 origin = Vec3::Zero();                   ///< m, the lower corner, upstream
  double width = 0, height = 0, thickness = 0;  ///< m, along y, z, x
  std::int64_t slits = 0;
  double slit_width = 0;  ///< m
  std::string material;
  WallSlip slip = WallSlip::no_slip;
  bool operator==(const RigidBarrier&) const = default;
};

struct Coupling {
  bool enabled = false;
  GrainFluid grains = GrainFluid::resolved;
  double averaging_length =
      coupling::AveragedGrains{}.averaging_length;  ///< m; grains = averaged only, as the next two
  BedDrag bed_drag = coupling::AveragedGrains{}.drag;
  bool beads_as_grains = false;  ///< in place of the wires' own law
  BodyWeighting body_weighting = lbm::kBodyWeighting;
  SolidOperator solid_operator = lbm::kSolidOperator;
  double radius_shift_cells = coupling::kRadiusShift;  ///< body_weighting = wall_distance or inertial
  bool lubrication = false;
  bool wire_drag = true;
  std::optional<double> resolve_wires_from_cells;  ///< none: all wires by the drag law
  bool operator==(const Coupling&) const = default;
};

struct Measure {
  std::optional<double> section_x;  ///< m; see section_of()
  double inflow_distance = 0.15;    ///< m, upstream of the section
  double outflow_distance = 0.325;  ///< m, downstream of the section
  double energy_datum_z = 0;        ///< m
  bool operator==(const Measure&) const = default;
};

struct Probe {
  std::string name;
  ProbeKind kind = ProbeKind::height;
  Vec3 position = Vec3::Zero();  ///< m; of a force: the point that its moment is taken about
  double diameter = 0;           ///< m, of a pressure sensor; 0 = a point
  bool time_mean = false;        ///< of a pressure: the mean since the last row instead of the row's moment
  std::string wall;              ///< of a force: name of the wall
  bool operator==(const Probe&) const = default;
};

/// A rectangle through which discharge and energy are measured; see frame_of() in cases/observers/sections.h.
struct FluxSection {
  std::string name;
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  ///< m, centre of the rectangle; any length but zero
  double width = 0, height = 0;                      ///< m, 0 = as far as the domain
  bool operator==(const FluxSection&) const = default;
};

struct Scene {
  Identity identity;
  Run run;
  Gravity gravity;
  Domain domain;
  std::vector<WallSettings> walls;
  Fluid fluid;
  std::vector<MaterialSettings> materials;  ///< sorted by name
  std::vector<Contact> contacts;
  Solids solids;
  Grains grains;
  Barrier barrier;
  RigidBarrier rigid_barrier;
  Coupling coupling;
  Measure measure;
  std::vector<Probe> probes;
  std::vector<FluxSection> sections;
  bool operator==(const Scene&) const = default;

  [[nodiscard]] bool has_solids() const {
    return barrier.enabled || !grains.packings.empty() || !grains.spheres.empty();
  }
};

/// Index of a material, -1 if there is none of that name.
int material_index(const Scene& scene, const std::string& name);

/// The section that is measured: measure.section_x_m, or the barrier's plane where there is a fluid too, or none.
std::optional<double> section_of(const Scene& scene);

}  // namespace lahar::scene

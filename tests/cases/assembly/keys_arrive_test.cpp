// What a scene says reaches the solver: keys whose effect no other test would miss. Each is set to what is no default,
// and the scene without it must not have that.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "cases/assembly/build.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/net_spec.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

struct Arrival {
  std::string scene;
  std::vector<std::string> besides;  ///< set in both
  std::string set;
  std::function<bool(const Scene&)> arrived;
};

const std::string kDam = "dam_break/scene.toml", kDebris = "debris_flow/scene.toml", kSpans = "two_spans/scene.toml",
                  kMesh = "hexagonal_net/scene.toml";

auto fluid(std::function<bool(const lbm::FluidOptions&)> ask) {
  return [ask](const Scene& s) { return ask(cases::fluid_options(s)); };
}
auto coupling_of(std::function<bool(const coupling::CouplingOptions&)> ask) {
  return [ask](const Scene& s) { return ask(cases::coupling_options(s)); };
}
auto averaged(std::function<bool(const coupling::AveragedGrains&)> ask) {
  return coupling_of(
      [ask](const coupling::CouplingOptions& o) { return ask(std::get<coupling::AveragedGrains>(o.grains)); });
}
auto net(std::function<bool(const barrier::RingNetSpec&)> ask) {
  return [ask](const Scene& s) { return ask(make_net_spec(s)); };
}
auto spans(std::function<bool(const barrier::SpansSpec&)> ask) {
  return [ask](const Scene& s) { return ask(make_spans_spec(s)); };
}

std::vector<Arrival> arrivals() {
  const std::vector<std::string> none, as_averaged{"coupling.grains=averaged"};
  return {
      {kDam, none, "fluid.collision=trt",
       fluid([](const auto& o) { return std::holds_alternative<lbm::Trt>(o.collision); })},
      {kDam, none, "fluid.uncounted_share=0.01", fluid([](const auto& o) { return o.uncounted_share == 0.01; })},
      {kDam, none, "fluid.lattice_velocity=0.05", fluid([](const auto& o) { return o.lattice_velocity == 0.05; })},
      {kDam, none, "fluid.adaptive_time_step=true", fluid([](const auto& o) { return o.adaptive_time_step; })},
      {kDam, none, "fluid.smagorinsky=0.2", fluid([](const auto& o) { return o.smagorinsky == 0.2; })},
      {kDam, none, "fluid.density_kg_m3=1100", fluid([](const auto& o) { return o.density == 1100; })},
      {kDam, none, "fluid.kinematic_viscosity_m2_s=2e-5",
       fluid([](const auto& o) { return o.kinematic_viscosity == 2e-5; })},
      {kDam, none, "fluid.surface_tension_N_m=0.05", fluid([](const auto& o) { return o.surface_tension == 0.05; })},
      {kDam,
       {"wall[0].slip=no_slip"},
       "wall[0].velocity_m_s=[0.5, 0, 0]",
       [](const Scene& s) { return make_walls(s).all().at(0).velocity == Vec3(0.5, 0, 0); }},
      {kDam, none, "wall[0].opens_at_s=0.3", [](const Scene& s) { return make_walls(s).all().at(0).opens_at == 0.3; }},
      {kDebris, none, "coupling.solid_operator=faded",
       fluid([](const auto& o) { return o.solid_operator == lbm::SolidOperator::damped_nonequilibrium; })},
      {kDebris, none, "coupling.body_weighting=noble_torczynski",
       fluid([](const auto& o) { return o.weighting == lbm::BodyWeighting::noble_torczynski; })},
      {kDebris, none, "coupling.lubrication=true",
       coupling_of([](const auto& o) { return o.films == coupling::GrainFilms::lubrication; })},
      {kDebris, none, "coupling.wire_drag=false",
       coupling_of([](const auto& o) { return o.thin_wires == coupling::ThinWires::uncoupled; })},
      {kDebris, none, "coupling.radius_shift_cells=0.3",
       coupling_of([](const auto& o) { return std::get<coupling::ResolvedGrains>(o.grains).radius_shift == 0.3; })},
      {kDebris,
       {"coupling.body_weighting=wall_distance"},
       "coupling.resolve_wires_from_cells=3",
       coupling_of([](const auto& o) { return o.mapped_wires && o.mapped_wires->from_diameter == 3; })},
      {kDebris, as_averaged, "coupling.bed_drag=gidaspow",
       averaged([](const auto& o) { return o.drag == coupling::BedDrag::gidaspow; })},
      {kDebris, as_averaged, "coupling.averaging_length_m=0.2",
       averaged([](const auto& o) { return o.averaging_length == 0.2; })},
      {kDebris, as_averaged, "coupling.beads_as_grains=true",
       averaged([](const auto& o) { return o.beads_as_grains; })},
      {kDebris, as_averaged, "coupling.beads_as_grains=true",  // and not by the wires' law, too
       coupling_of([](const auto& o) { return o.thin_wires == coupling::ThinWires::uncoupled; })},
      {kDebris, none, "materials.rock.poisson_ratio=0.31",
       [](const Scene& s) {
         const dem::Materials m = make_materials(s);
         bool found = false;
         for (int k = 0; k < static_cast<int>(m.size()); ++k)
           found = found || (m[k].name == "rock" && m[k].poisson_ratio == 0.31);
         return found;
       }},
      {kSpans, none, "contact[0].rolling_friction=0.2",
       [](const Scene& s) {
         const dem::Materials m = make_materials(s);
         bool found = false;
         for (int a = 0; a < static_cast<int>(m.size()); ++a)
           for (int b = 0; b < static_cast<int>(m.size()); ++b) found = found || m.pair(a, b).rolling_friction == 0.2;
         return found;
       }},
      {kSpans, none, "solids.wire_contacts=capsules",
       [](const Scene& s) {
         return cases::build_solids(s).solids.options().wire_contacts == dem::WireContacts::capsules;
       }},
      {kSpans, none, "solids.bond_damping_ratio=0.07", net([](const auto& n) {
         return n.ring.damping_ratio == 0.07 && n.cable.damping_ratio == 0.07 && n.dissipator.damping_ratio == 0.07;
       })},
      {kSpans, none, "solids.bond_damping_ratio=0.06",
       spans([](const auto& p) { return p.section.damping_ratio == 0.06; })},
      {kSpans, none, "barrier.net.bead_mass_scale=2", net([](const auto& n) { return n.bead_mass_scale == 2; })},
      {kSpans, none, "barrier.net.bead_inertia_scale=3", net([](const auto& n) { return n.bead_inertia_scale == 3; })},
      {kSpans, none, "barrier.posts.height_m=0.24", spans([](const auto& p) { return p.post_height == 0.24; })},
      {kSpans, none, "barrier.posts.diameter_m=0.028", spans([](const auto& p) { return p.post_diameter == 0.028; })},
      {kSpans, none, "barrier.posts.area_m2=2e-4", spans([](const auto& p) { return p.section.area == 2e-4; })},
      {kSpans, none, "barrier.posts.second_moment_m4=1.1e-8",
       spans([](const auto& p) { return p.section.second_moment == 1.1e-8; })},
      {kSpans, none, "barrier.posts.density_kg_m3=7000",
       spans([](const auto& p) { return p.section.density == 7000; })},
      {kMesh, none, "barrier.net.mesh_wire_diameter_m=0.003",
       net([](const auto& n) { return n.mesh->wire_diameter == 0.003; })},
  };
}

TEST(Keys, ArriveAtTheSolver) {
  for (const Arrival& a : arrivals()) {
    std::vector<std::string> set = a.besides;
    EXPECT_FALSE(a.arrived(load(case_file(a.scene), set))) << a.set << " is what the scene says without it";
    set.push_back(a.set);
    EXPECT_TRUE(a.arrived(load(case_file(a.scene), set))) << a.set;
  }
}

}  // namespace
}  // namespace lahar::scene

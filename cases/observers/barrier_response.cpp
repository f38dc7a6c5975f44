#include "cases/observers/barrier_response.h"

#include <algorithm>

#include "cases/pictures/chart.h"

namespace lahar::cases {

BarrierResponse::BarrierResponse(const Observed& run) : Observer(run) {
  for (const auto c : barrier::all_components)
    if (is_reported(c, *run.simulation.net())) declare_component(c);
  if (run.simulation.net()->posts.empty())
    for (const auto c : {barrier::Component::lower_cable, barrier::Component::upper_cable,
                         barrier::Component::left_cable, barrier::Component::right_cable})
      declare_ends(c);
  else
    declare_foundations();
  column("barrier_elongation_m", "m", "largest displacement of a bead along the flow, torn wires aside", [this] {
    return now_.elongation;
  }).peak("max_elongation_m", "m", "largest `barrier_elongation_m` of the rows");
  column("barrier_elastic_J", "J", "elastic energy of all bonds", [this] {
    return now_[barrier::Component::barrier].energy.elastic();
  }).peak("peak_barrier_elastic_J", "J", "largest `barrier_elastic_J` of the rows");
  const auto kind = [this](const char* what, double dem::BondEnergy::*part) {
    const std::string name = "barrier_" + std::string(what) + "_J";
    column({name, "barrier_KIND_J"}, "J", "the part of it by kind: axial, shear, bending, torsion",
           [this, part] { return now_[barrier::Component::barrier].energy.*part; });
  };
  kind("axial", &dem::BondEnergy::axial), kind("shear", &dem::BondEnergy::shear);
  kind("bending", &dem::BondEnergy::bending), kind("torsion", &dem::BondEnergy::torsion);
  column("barrier_potential_J", "J", "potential energy of the barrier since it was built",
         [this] { return now_.potential_energy; });
  column("barrier_kinetic_J", "J", "kinetic energy of the barrier", [this] { return now_.kinetic_energy; });
  event("barrier_energy_start_J", "J", "elastic and potential energy of the barrier at the first row",
        [this] { return stored_energy(); });
  result("barrier_energy_end_J", "J", "the same at the end", [this] { return stored_energy(); });
  column("dissipator_elongation_m", "m", "largest elongation of a dissipator", [this] {
    return now_.largest_dissipator_elongation;
  }).peak("max_dissipator_elongation_m", "m", "largest `dissipator_elongation_m` of the rows");
  column("barrier_broken_bonds", "1", "bonds that are broken", [this] {
    return static_cast<double>(now_[barrier::Component::barrier].broken_bonds);
  }).peak("broken_bonds", "1", "bonds that are broken at the end");
  column("wet_beads", "1", "beads of the barrier in the fluid, posts included",
         [this] { return static_cast<double>(run_.simulation.wet_beads()); });
}

void BarrierResponse::declare_component(barrier::Component component) {
  const std::string part(barrier::name(component));
  column({part + "_force_sum_N", "PART_force_sum_N"}, "N",
         "sum over the bonds of a part of the barrier of the force's magnitude; grows with the number of beads",
         [this, component] { return now_[component].force_sum; })
      .peak({"peak_" + part + "_sum_kN", "peak_PART_sum_kN"}, "kN", "largest `PART_force_sum_N` of the rows", 1000);
  column({part + "_max_tension_N", "PART_max_tension_N"}, "N", "largest tension of a bond of a part of the barrier",
         [this, component] { return now_[component].max_tension; })
      .peak({"peak_" + part + "_tension_kN", "peak_PART_tension_kN"}, "kN", "largest `PART_max_tension_N` of the rows",
            1000);
}

/// Where no posts stand: a cable is fixed at its ends.
void BarrierResponse::declare_ends(barrier::Component cable) {
  const std::string part(barrier::name(cable));
  column({part + "_end_force_N", "PART_end_force_N"}, "N", "larger one of the forces that hold a cable's two ends",
         [this, cable] { return std::max(now_[cable].start_reaction.norm(), now_[cable].end_reaction.norm()); })
      .peak({"peak_" + part + "_end_kN", "peak_PART_end_kN"}, "kN", "largest `PART_end_force_N` of the rows", 1000);
}

/// Where cables end at posts: what stands in the ground, and what is anchored in it.
void BarrierResponse::declare_foundations() {
  using barrier::Component;
  column("posts_foot_force_N", "N", "largest force of the ground on the foot of a post", [this] {
    return now_[Component::posts].anchor_force;
  }).peak("peak_posts_foot_kN", "kN", "largest `posts_foot_force_N` of the rows", 1000);
  column("posts_foot_moment_Nm", "Nm", "largest moment of the ground about the foot of a post", [this] {
    return now_[Component::posts].anchor_moment;
  }).peak("peak_posts_foot_kNm", "kNm", "largest `posts_foot_moment_Nm` of the rows", 1000);
  for (std::size_t kind = 0; kind < barrier::Elements::components.size(); ++kind) {
    const Component c = barrier::component_of_kind(kind);
    if (!is_reported(c, *run_.simulation.net())) continue;
    const std::string part(barrier::name(c));
    column({part + "_anchor_force_N", "PART_anchor_force_N"}, "N",
           "largest force that an anchor in the ground holds, of a part of the barrier that hangs on posts",
           [this, c] { return now_[c].anchor_force; })
        .peak({"peak_" + part + "_anchor_kN", "peak_PART_anchor_kN"}, "kN", "largest `PART_anchor_force_N` of the rows",
              1000);
  }
}

void BarrierResponse::sample(double) {
  const auto& solids = *run_.simulation.solids();
  now_ = barrier::response(*run_.simulation.net(), solids.particles(), solids.bonds(), run_.scene.gravity.vector());
  times_.push_back(run_.simulation.time());
  for (std::size_t c = 0; c < cable_sums_.size(); ++c)
    cable_sums_[c].push_back(now_[barrier::all_components[c]].force_sum / 1000);
}

void BarrierResponse::transfer(Archive& archive) {
  archive.list("times", times_);
  for (std::size_t c = 0; c < cable_sums_.size(); ++c) archive.list("cable_sums_" + std::to_string(c), cable_sums_[c]);
}

void BarrierResponse::finish(const std::filesystem::path& folder) const {
  Chart chart{.title = "Sum of bond forces in the cables", .x = {"time", "s"}, .y = {"force", "kN"}};
  for (std::size_t c = 0; c < cable_sums_.size(); ++c) {
    ChartSeries line{std::string(barrier::name(barrier::all_components[c])), times_, cable_sums_[c]};
    std::replace(line.name.begin(), line.name.end(), '_', ' ');
    if (c == 3) line.dash = Dash::dashed;  // the left cable, often pulled alike, shows in between
    chart.series.push_back(std::move(line));
  }
  chart.write_all(folder / "cable_forces.png");
}

}  // namespace lahar::cases

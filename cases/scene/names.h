#pragma once
// The words that stand for an option in a scene file, and the nearest word to a mistyped one.
#include <array>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cases/scene/scene.h"

namespace lahar::scene {

/// One value of an option: its word in a scene file, and what it means for docs/scene_reference.md.
template <class E>
struct Choice {
  std::string_view word;
  E value;
  std::string_view meaning = {};  ///< empty where the word says it all
};

// `choices(E{})`: every value of an option. A value is registered by its line here, or by its type's in the variant
// that is the option; reading, messages, the resolved scene and the reference page follow.
constexpr auto choices(Precision) {
  return std::to_array<Choice<Precision>>(
      {{"float", Precision::float32, "4 bytes a number"}, {"double", Precision::float64, "8 bytes"}});
}
constexpr auto choices(Face) {
  return std::to_array<Choice<Face>>({{"x-", Face::x_lower},
                                      {"x+", Face::x_upper},
                                      {"y-", Face::y_lower},
                                      {"y+", Face::y_upper},
                                      {"z-", Face::z_lower},
                                      {"z+", Face::z_upper}});
}
constexpr auto choices(Axis) { return std::to_array<Choice<Axis>>({{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}}); }
constexpr auto choices(WallShape) {
  return std::to_array<Choice<WallShape>>({{"plane", WallShape::plane},
                                           {"box", WallShape::box},
                                           {"cylinder", WallShape::cylinder},
                                           {"sphere", WallShape::sphere},
                                           {"mesh", WallShape::mesh},
                                           {"heightmap", WallShape::heightmap}});
}
constexpr auto choices(RegionShape) {
  return std::to_array<Choice<RegionShape>>({{"box", RegionShape::box},
                                             {"cylinder", RegionShape::cylinder},
                                             {"sphere", RegionShape::sphere},
                                             {"mesh", RegionShape::mesh}});
}
constexpr auto choices(WallSlip) {
  return std::to_array<Choice<WallSlip>>(
      {{"no_slip", WallSlip::no_slip, "not at all"},
       {"free_slip", WallSlip::free_slip, "freely"},
       {"wall_model", WallSlip::wall_model, "with the wall stress of a turbulent layer thinner than the cells"}});
}
constexpr auto choices(WallPlacement) {
  return std::to_array<Choice<WallPlacement>>(
      {{"half_way", WallPlacement::half_way, "half-way between cells, a staircase"},
       {"interpolated", WallPlacement::interpolated,
        "at their own place between the cells (interpolated bounce-back, second order)"}});
}
constexpr auto choices(FlowLaw) {
  return std::to_array<Choice<FlowLaw>>(
      {{"newtonian", FlowLaw::newtonian, "the kinematic viscosity alone"},
       {"bingham", FlowLaw::bingham, "yield stress, and the kinematic viscosity as the plastic one"},
       {"herschel_bulkley", FlowLaw::herschel_bulkley,
        "yield stress, consistency and exponent in place of the kinematic viscosity"}});
}
constexpr auto choices(WireContacts) {
  return std::to_array<Choice<WireContacts>>(
      {{"beads", WireContacts::beads, "bead by bead"},
       {"capsules", WireContacts::capsules, "as smooth round wires along the beads"}});
}
constexpr auto choices(SizeWeight) {
  return std::to_array<Choice<SizeWeight>>(
      {{"mass", SizeWeight::mass, "mass, as sieves do"}, {"number", SizeWeight::number, "grains"}});
}
constexpr auto choices(BottomCable) {
  return std::to_array<Choice<BottomCable>>(
      {{"at_places", BottomCable::at_places, "at cable_places, with dissipators, as the others are"},
       {"along_bed", BottomCable::along_bed,
        "at its ends; between them the bed holds it down and against the slope, and it slides along itself"},
       {"fixed", BottomCable::fixed, "bead by bead: no bond of it bears anything"}});
}
constexpr auto choices(GrainFluid) {
  return std::to_array<Choice<GrainFluid>>(
      {{"resolved", GrainFluid::resolved, "cell by cell: the fluid flows round each grain"},
       {"averaged", GrainFluid::averaged,
        "by a drag law and the pressure of the flow averaged over a length, without a wall of the grain in the "
        "cells"}});
}
constexpr auto choices(BedDrag) {
  return std::to_array<Choice<BedDrag>>(
      {{"di_felice", BedDrag::di_felice, "Di Felice 1994: a lone sphere times a power of the liquid's share"},
       {"gidaspow", BedDrag::gidaspow, "Gidaspow 1994: Ergun above a solid fraction of 0.2, Wen & Yu below"},
       {"beetstra", BedDrag::beetstra, "Beetstra 2007: resolved flow through random arrays of equal spheres"}});
}
constexpr auto choices(BodyWeighting) {
  return std::to_array<Choice<BodyWeighting>>(
      {{"solid_fraction", BodyWeighting::solid_fraction, "the solid fraction"},
       {"noble_torczynski", BodyWeighting::noble_torczynski, "Noble & Torczynski 1998, with tau - 1/2"},
       {"wall_distance", BodyWeighting::wall_distance, "from the distance of the cell's centre to the surface"},
       {"inertial", BodyWeighting::inertial,
        "the same, and quadratic in the slip within grains where that is fast beside the viscosity"}});
}
constexpr auto choices(SolidOperator) {
  return std::to_array<Choice<SolidOperator>>(
      {{"faded", SolidOperator::damped_nonequilibrium,
        "equilibrium at the body's velocity; the non-equilibrium part is faded"},
       {"equilibrium_difference", SolidOperator::equilibrium_difference,
        "difference of equilibria on top of the fluid's own collision (SC2 of Rettinger & Rude 2017)"},
       {"bounce_back", SolidOperator::nonequilibrium_bounce_back,
        "bounce-back of the non-equilibrium part, Noble & Torczynski 1998 (SC1)"},
       {"holdych", SolidOperator::wall_velocity_bounce_back,
        "bounce-back at the body's velocity, Holdych 2003 (SC3)"}});
}
constexpr auto choices(NetKind) {
  return std::to_array<Choice<NetKind>>(
      {{"rings", NetKind::rings, "linked rings"}, {"hexagonal", NetKind::hexagonal, "mesh of double-twisted wire"}});
}
constexpr auto choices(FootJoint) {
  return std::to_array<Choice<FootJoint>>(
      {{"fixed", FootJoint::fixed, "clamped"},
       {"hinged", FootJoint::hinged, "a ball joint that turns freely about all axes"}});
}
constexpr auto choices(ProbeKind) {
  return std::to_array<Choice<ProbeKind>>({{"height", ProbeKind::height, "depth of liquid above the point"},
                                           {"pressure", ProbeKind::pressure, "pressure in it"},
                                           {"velocity", ProbeKind::velocity, "velocity of the liquid at it"},
                                           {"force", ProbeKind::force, "force on a wall"},
                                           {"grain", ProbeKind::grain, "place and velocity of a grain"}});
}

/// Types that are registered in a variant say themselves what they are called and mean.
template <class... Ts>
constexpr auto choices(const std::variant<Ts...>&) {
  return std::to_array<Choice<std::variant<Ts...>>>({{Ts::name, Ts{}, Ts::meaning}...});
}

template <class E>
concept Option = requires {
  choices(E{});
};

/// All words of an option.
template <class E>
std::vector<std::string> words() {
  std::vector<std::string> all;
  for (const auto& choice : choices(E{})) all.emplace_back(choice.word);
  return all;
}

/// The word for an option.
template <class E>
std::string name_of(E value) {
  for (const auto& choice : choices(E{}))
    if (choice.value == value) return std::string(choice.word);
  return {};
}
template <class... Ts>
std::string name_of(const std::variant<Ts...>& value) {
  return std::visit([](const auto& chosen) { return std::string(chosen.name); }, value);
}

/// Edits (insert, delete, replace, swap neighbours) that turn one word into the other (Damerau-Levenshtein, optimal
/// string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of the known words, or "" if none is near enough to be meant.
std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

}  // namespace lahar::scene

#pragma once
// The words that stand for an option in a scene file, and the nearest word to a mistyped one.
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/scene/scene.h"

namespace lahar::scene {

template <class E, std::size_t N>
using NameTable = std::array<std::pair<std::string_view, E>, N>;

/// `names_of(E{})`: every word of an option with its value.
constexpr auto names_of(Precision) {
  return NameTable<Precision, 2>{{{"float", Precision::float32}, {"double", Precision::float64}}};
}
constexpr auto names_of(Face) {
  return NameTable<Face, 6>{{{"x-", Face::x_lower},
                             {"x+", Face::x_upper},
                             {"y-", Face::y_lower},
                             {"y+", Face::y_upper},
                             {"z-", Face::z_lower},
                             {"z+", Face::z_upper}}};
}
constexpr auto names_of(Axis) { return NameTable<Axis, 3>{{{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}}}; }
constexpr auto names_of(WallShape) {
  return NameTable<WallShape, 6>{{{"plane", WallShape::plane},
                                  {"box", WallShape::box},
                                  {"cylinder", WallShape::cylinder},
                                  {"sphere", WallShape::sphere},
                                  {"mesh", WallShape::mesh},
                                  {"heightmap", WallShape::heightmap}}};
}
constexpr auto names_of(RegionShape) {
  return NameTable<RegionShape, 4>{{{"box", RegionShape::box},
                                    {"cylinder", RegionShape::cylinder},
                                    {"sphere", RegionShape::sphere},
                                    {"mesh", RegionShape::mesh}}};
}
constexpr auto names_of(WallSlip) {
  return NameTable<WallSlip, 3>{
      {{"no_slip", WallSlip::no_slip}, {"free_slip", WallSlip::free_slip}, {"wall_model", WallSlip::wall_model}}};
}
constexpr auto names_of(WallPlacement) {
  return NameTable<WallPlacement, 2>{
      {{"half_way", WallPlacement::half_way}, {"interpolated", WallPlacement::interpolated}}};
}
constexpr auto names_of(FlowLaw) {
  return NameTable<FlowLaw, 3>{{{"newtonian", FlowLaw::newtonian},
                                {"bingham", FlowLaw::bingham},
                                {"herschel_bulkley", FlowLaw::herschel_bulkley}}};
}
constexpr auto names_of(Collision) {
  return NameTable<Collision, 3>{
      {{"central_moments", Collision::central_moments}, {"bgk", Collision::bgk}, {"trt", Collision::trt}}};
}
constexpr auto names_of(ContactLaw) {
  return NameTable<ContactLaw, 2>{{{"hertz_mindlin", ContactLaw::hertz_mindlin}, {"linear", ContactLaw::linear}}};
}
constexpr auto names_of(WireContacts) {
  return NameTable<WireContacts, 2>{{{"beads", WireContacts::beads}, {"capsules", WireContacts::capsules}}};
}
constexpr auto names_of(SizeWeighting) {
  return NameTable<SizeWeighting, 2>{{{"mass", SizeWeighting::mass}, {"number", SizeWeighting::number}}};
}
constexpr auto names_of(BodyWeighting) {
  return NameTable<BodyWeighting, 4>{{{"solid_fraction", BodyWeighting::solid_fraction},
                                      {"noble_torczynski", BodyWeighting::noble_torczynski},
                                      {"seepage", BodyWeighting::seepage},
                                      {"wall_distance", BodyWeighting::wall_distance}}};
}
constexpr auto names_of(SolidOperator) {
  return NameTable<SolidOperator, 4>{{{"faded", SolidOperator::faded},
                                      {"equilibrium_difference", SolidOperator::equilibrium_difference},
                                      {"bounce_back", SolidOperator::bounce_back},
                                      {"holdych", SolidOperator::holdych}}};
}
constexpr auto names_of(NetKind) {
  return NameTable<NetKind, 2>{{{"rings", NetKind::rings}, {"hexagonal", NetKind::hexagonal}}};
}
constexpr auto names_of(PostFoot) {
  return NameTable<PostFoot, 2>{{{"fixed", PostFoot::fixed}, {"hinged", PostFoot::hinged}}};
}
constexpr auto names_of(ProbeKind) {
  return NameTable<ProbeKind, 3>{
      {{"height", ProbeKind::height}, {"pressure", ProbeKind::pressure}, {"force", ProbeKind::force}}};
}

/// The word for an option.
template <class E>
std::string name_of(E value) {
  for (const auto& [name, v] : names_of(E{}))
    if (v == value) return std::string(name);
  return {};
}

/// Edits (insert, delete, replace, swap neighbours) that turn one word into the other (Damerau-Levenshtein, optimal
/// string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of the known words, or "" if none is near enough to be meant.
std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

}  // namespace lahar::scene

#include "cases/pictures/solids_in_view.h"

#include <algorithm>
#include <cmath>

namespace lahar::cases {

namespace {

using dem::ParticleKind;
using dem::ParticleState;

bool is_grain(const dem::Particles& p, std::size_t i) {
  return p.kind[i] == ParticleKind::grain && p.state[i] != ParticleState::removed;
}

bool finite(const dem::Particles& p, std::size_t i) { return p.position[i].allFinite() && p.radius[i] > 0; }

// Natural stone is not uniform: a factor on the brightness that belongs to the grain.
float own_brightness(dem::ParticleId id) {
  const auto hash = id * 2654435761U;
  return 0.86F + 0.28F * static_cast<float>(hash >> 8 & 0xffffU) / 65535.0F;
}

void measure_grains(const dem::Particles& p, SolidsInView& view) {
  double least = std::numeric_limits<double>::infinity(), most = 0, fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_grain(p, i)) continue;
    least = std::min(least, 2 * p.radius[i]);
    most = std::max(most, 2 * p.radius[i]);
    fastest = std::max(fastest, p.velocity[i].norm());
  }
  if (most > 0) view.smallest_diameter = least, view.largest_diameter = most;
  if (view.full_speed <= 0) view.full_speed = std::max(fastest, 1e-9);
}

Colour grain_colour(const dem::Particles& p, std::size_t i, const SolidsInView& view, GrainColour by) {
  if (by == GrainColour::speed) {
    const double speed = p.velocity[i].norm() / view.full_speed;
    return to_linear(ramp_colour(ColourRamp::speed, static_cast<float>(speed)));
  }
  const double range = std::log(view.largest_diameter / view.smallest_diameter);
  const double t = range > 1e-6 ? std::log(2 * p.radius[i] / view.smallest_diameter) / range : 0.6;
  return own_brightness(p.id(i)) * to_linear(ramp_colour(ColourRamp::stone, static_cast<float>(t)));
}

void add_capsule(SolidsInView& view, const Vec3& start, const Vec3& end, double radius, const Colour& colour,
                 bool metallic) {
  view.capsules.push_back({start.cast<float>(), end.cast<float>(), static_cast<float>(radius)});
  view.colours.push_back(colour);
  view.metallic.push_back(metallic);
}

double tautest(const dem::Bonds& bonds) {
  double most = 0;
  for (std::size_t b = 0; b < bonds.size(); ++b)
    if (bonds.intact[b] != 0) most = std::max(most, bonds.axial_force[b]);
  return most;
}

// Adds the wires and returns which particles they cover.
std::vector<bool> add_bonds(const dem::Particles& p, const dem::Bonds& bonds, const PictureStyle& style,
                            SolidsInView& view) {
  std::vector<bool> covered(p.size(), false);
  view.full_tension = style.full_tension > 0 ? style.full_tension : std::max(tautest(bonds), 1e-9);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const std::size_t i = bonds.i[b], j = bonds.j[b];
    if (bonds.intact[b] == 0 || !finite(p, i) || !finite(p, j)) continue;
    const auto share = static_cast<float>(bonds.axial_force[b] / view.full_tension);
    add_capsule(view, p.position[i], p.position[j], style.wire_scale * std::min(p.radius[i], p.radius[j]),
                to_linear(ramp_colour(ColourRamp::tension, share)), true);
    covered[i] = covered[j] = true;
  }
  return covered;
}

}  // namespace

SolidsInView solids_in_view(const PictureScene& scene, const PictureStyle& style) {
  SolidsInView view;
  view.full_speed = style.full_speed;
  if (scene.particles == nullptr) return view;
  const dem::Particles& p = *scene.particles;
  measure_grains(p, view);
  std::vector<bool> covered(p.size(), false);
  if (scene.bonds != nullptr && scene.bonds->size() > 0) covered = add_bonds(p, *scene.bonds, style, view);
  const Colour steel = to_linear(ramp_colour(ColourRamp::tension, 0));
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (covered[i] || p.state[i] == ParticleState::removed || !finite(p, i)) continue;
    if (is_grain(p, i))
      add_capsule(view, p.position[i], p.position[i], p.radius[i], grain_colour(p, i, view, style.grain_colour), false);
    else
      add_capsule(view, p.position[i], p.position[i], style.wire_scale * p.radius[i], steel, true);
  }
  return view;
}

}  // namespace lahar::cases

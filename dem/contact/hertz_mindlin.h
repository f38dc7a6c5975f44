#pragma once
// Hertz's normal and Mindlin's tangential contact of elastic spheres, damped.
#include <string_view>

#include "dem/contact/contact_state.h"
#include "dem/contact/normal_damper.h"
#include "dem/contact/tangential_spring.h"
#include "dem/time_step.h"

namespace lahar::dem {

/// F_n = 4/3 E* sqrt(R*) overlap^1.5 + gamma_n closing_speed, never attractive; k_t = 8 G* sqrt(R* overlap) (Mindlin's
/// no-slip stiffness, as in Di Renzo & Di Maio 2005, Chem. Eng. Sci. 60:1303). Dampers gamma = 2 sqrt(5/6) beta
/// sqrt(S m*) with S_n = 2 E* sqrt(R* overlap), S_t = k_t (Tsuji et al. 1992, Powder Technol. 71:239): the restitution
/// does not depend on the impact speed.
struct HertzMindlin {
  static constexpr std::string_view name = "hertz_mindlin", meaning = "elastic spheres of their materials, damped";
  bool operator==(const HertzMindlin&) const = default;

  /// The Rayleigh time.
  [[nodiscard]] double time_limit(double radius, double density, const Material& material) const {
    return rayleigh_time_step(radius, density, material);
  }

  template <class V>
  [[gnu::always_inline]] ContactForceOf<V> operator()(const ContactStateOf<V>& s, ContactHistoryOf<V>& history,
                                                      double dt) const {
    constexpr double two_sqrt_5_6 = 1.8257418583505537;
    const V contact_radius = root(s.effective_radius * s.overlap);
    const V slope = 2 * s.effective_modulus * contact_radius;
    const V elastic = 2.0 / 3.0 * slope * s.overlap;
    const V damper = two_sqrt_5_6 * s.damping_ratio;

    ContactForceOf<V> f;
    const V first = weight_of_hertz_damper<V>(share_since_touch<V>(s, history, dt));
    const V normal_damper = first * damper * root(slope * s.effective_mass);
    set_normal_force<V>(s, elastic, normal_damper, dt, history, f);
    f.elastic_normal = 0.4 * elastic * s.overlap;

    const V shear = 8 * s.effective_shear_modulus * contact_radius;
    const V shear_damper = damper * root(shear * s.tangential_mass);
    add_tangential_spring<V>(s, shear, within_step(s, shear_damper, f.damping, dt), dt, history, f);
    return f;
  }
};

static_assert(ContactLaw<HertzMindlin>);

}  // namespace lahar::dem

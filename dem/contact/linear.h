#pragma once
// Linear spring and dashpot (Cundall & Strack 1979, Geotechnique 29:47): one stiffness for all sizes and materials.
#include <cmath>
#include <numbers>
#include <string_view>

#include "dem/contact/contact_state.h"
#include "dem/contact/normal_damper.h"
#include "dem/contact/tangential_spring.h"
#include "dem/time_step.h"

namespace lahar::dem {

/// F_n = k overlap + 2 beta sqrt(k m*) closing_speed, never attractive; the tangential spring likewise.
struct LinearSpringDashpot {
  static constexpr std::string_view name = "linear", meaning = "springs and dashpots of one stiffness for all";
  double normal_stiffness = 1e6;    ///< N/m, > 0
  double tangential_stiffness = 0;  ///< N/m; 0 = 2/7 of the normal one, which gives both modes the same period
  bool operator==(const LinearSpringDashpot&) const = default;

  /// 0.35 of the duration of a contact of two equal spheres, half a period of the spring that swings faster: an elastic
  /// ball then errs in the ledger of energy as one of Hertz' law does at the same share of the Rayleigh time. Of two
  /// spheres that slide on each other the surfaces also yield by turning: 2/7 of the mass.
  [[nodiscard]] double time_limit(double radius, double density, const Material&) const {
    return 0.35 * linear_contact_time(0.5 * std::numbers::pi / 6 * std::pow(2 * radius, 3) * density,
                                      std::max(normal_stiffness, 3.5 * tangential_stiffness));
  }

  template <class V>
  [[gnu::always_inline]] ContactForceOf<V> operator()(const ContactStateOf<V>& s, ContactHistoryOf<V>& history,
                                                      double dt) const {
    const V elastic = normal_stiffness * s.overlap;
    const V damper = 2 * s.damping_ratio;

    ContactForceOf<V> f;
    const V first = weight_of_constant_damper<V>(share_since_touch<V>(s, history, dt));
    const V normal_damper = first * damper * root(V(normal_stiffness * s.effective_mass));
    set_normal_force<V>(s, elastic, normal_damper, dt, history, f);
    f.elastic_normal = 0.5 * elastic * s.overlap;

    const double shear = tangential_stiffness > 0 ? tangential_stiffness : 2.0 / 7 * normal_stiffness;
    const V shear_damper = damper * root(V(shear * s.tangential_mass));
    add_tangential_spring<V>(s, V{} + shear, within_step(s, shear_damper, f.damping, dt), dt, history, f);
    return f;
  }
};

static_assert(ContactLaw<LinearSpringDashpot>);

}  // namespace lahar::dem

#pragma once
// What a contact law sees and what it answers. Geometry and loops live elsewhere: a law is a pure function of these.
// Everything is a template over the number type: a double, or a pack of them (core/simd.h).
#include <concepts>
#include <string_view>

#include "core/simd.h"
#include "core/triple.h"
#include "dem/material.h"

namespace lahar::dem {

/// One contact at one moment. Side j is a second sphere or a wall (of infinite mass).
///
/// Positions are those at the end of a time step. Displacements over the step need the velocity at its middle, dampers
/// the velocity at its end, so both are given: mixing them up turns springs into (negative) dampers of order dt.
template <class V>
struct ContactStateOf {
  V overlap{};                            ///< m, > 0 in contact
  V closing_speed{};                      ///< m/s at the end of the step if all forces stayed; > 0: overlap grows
  TripleOf<V> normal_ij{V(1), V{}, V{}};  ///< unit, from i to j
  TripleOf<V> tangential_velocity{};      ///< m/s at mid-step, surface of i relative to j, normal to normal_ij
  TripleOf<V> tangential_velocity_end{};  ///< the same at the end of the step
  V twist_rate{};                         ///< rad/s, mean spin of the two bodies about normal_ij
  V effective_radius{};                   ///< m, 1/R* = 1/Ri + 1/Rj
  V effective_mass{};                     ///< kg, 1/m* = 1/mi + 1/mj, of what yields along the normal
  V tangential_mass{};                    ///< kg, the same without regard to rails and creases: see damping_rate
  V effective_modulus{};                  ///< Pa, E*
  V effective_shear_modulus{};            ///< Pa, G*
  V friction{};                           ///< Coulomb coefficient
  V damping_ratio{};                      ///< of critical, see damping.h
  /// 1/s, sum over the two bodies of (sum of the dampers of all its contacts, one step before) / mass; what a lone
  /// contact has of it need not be there. A body that is held to a rail, or that meets the crease of a wall, yields
  /// along the normal by a share of its inverse mass alone, and that share is in `damping_rate` and in effective_mass.
  /// Along the tangent it may yield with all of it: the other two are for that.
  V damping_rate{}, tangential_damping_rate{};
};
using ContactState = ContactStateOf<double>;

/// What a contact remembers. All zero when a contact begins.
template <class V>
struct ContactHistoryOf {
  TripleOf<V> tangential_displacement{};  ///< m, elastic part, of i relative to j
  V tangential_stiffness{};               ///< N/m, of the step before
  V normal_force{};                       ///< N, of the step before
  V damping_force{};                      ///< N, the damper's part of it
};
using ContactHistory = ContactHistoryOf<double>;

/// Answer of a law, and its share of the energy ledger.
template <class V>
struct ContactForceOf {
  V normal{};                ///< N, >= 0, pushes i along -normal_ij
  TripleOf<V> tangential{};  ///< N, on i
  V damping{};               ///< N s/m, of the normal damper
  V elastic_normal{};        ///< J, stored now
  V elastic_tangential{};    ///< J, stored now
  V damping_work{};          ///< J, dissipated by dampers in this step, >= 0
  V friction_work{};         ///< J, dissipated by slip in this step, >= 0
};
using ContactForce = ContactForceOf<double>;

/// A contact law of one number type: state and history in, force out; the history is advanced by one time step `dt`
/// (s).
template <class L, class V>
concept ContactLawOf = requires(const L& law, const ContactStateOf<V>& state, ContactHistoryOf<V>& history, double dt) {
  { law(state, history, dt) } -> std::same_as<ContactForceOf<V>>;
};

/// A contact law: of one contact, and of several side by side. A scene calls it by `name`, its reference page quotes
/// `meaning`, and steps are a share of `time_limit` (s): the least of all particles of a radius (m), a density (kg/m^3)
/// and a material.
template <class L>
concept ContactLaw = ContactLawOf<L, double> && ContactLawOf<L, Row<double>> && std::equality_comparable<L> &&
    requires(const L& law, const Material& material) {
  { L::name } -> std::convertible_to<std::string_view>;
  { L::meaning } -> std::convertible_to<std::string_view>;
  { law.time_limit(1.0, 1.0, material) } -> std::same_as<double>;
};

}  // namespace lahar::dem

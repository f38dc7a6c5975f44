// Case H8 of reference/hard_cases.csv, the cavity: a sphere enters water fast, a cavity opens behind it and closes
// under the weight of the water. Above some 8 m/s even a wetted sphere makes one (Duez et al. 2007, Nature Physics 3,
// 180; from memory): the speeds here are those of boulders of centimetres at 5 to 15 m/s.
//
// Neck: for a sphere at constant speed the walls at depth z move as a cylinder under the head g z (Duclaux et al. 2007,
// J. Fluid Mech. 591, 1): it closes first at half of the depth that the sphere has reached by then. Measured time from
// the entry of the centre to the closure: 1.726 sqrt(R/g) whatever the Froude number (Truscott, Epps & Belden 2014,
// Annu. Rev. Fluid Mech. 46, 355; from memory, as is that spheres that slow down close a little earlier and higher).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/sphere_tanks.h"

namespace lahar::validate {
namespace {

constexpr double kSpeed = 0.1;  ///< lu, of the impact

struct Entering {
  double diameter = 6;
  double froude = 30;   ///< u^2 / (g D)
  bool driven = false;  ///< at constant speed, and then stopped; else of steel
  [[nodiscard]] double gravity() const { return kSpeed * kSpeed / (froude * diameter); }
  /// Steps from the entry of the centre.
  [[nodiscard]] double closure() const { return 1.726 * std::sqrt(diameter / 2 / gravity()); }
};

SphereTank tank_for(const Entering& e) {
  const int w = static_cast<int>(7 * e.diameter);
  SphereTank t;
  t.gravity = e.gravity();
  t.depth = std::ceil(1.2 * kSpeed * e.closure() + 1.5 * e.diameter) + 0.4;
  t.cells = Vec3i(w, w, static_cast<int>(t.depth + 2.5 * e.diameter));
  t.diameter = e.diameter;
  t.density = 7.8;
  t.held = e.driven;
  t.velocity = Vec3(0, 0, -kSpeed);
  t.viscosity = 1e-5;
  t.place = Vec3(w / 2 + 0.2, w / 2 - 0.1, t.depth + e.diameter / 2 + 0.5);
  return t;
}

/// Gas under the first level of the water, in layers of cells and in a column as wide as the sphere.
struct Gas {
  std::vector<double> layers;
  [[nodiscard]] double between(double low, double high) const {
    double sum = 0;
    for (auto z = static_cast<std::size_t>(std::max(0.0, low)); z + 1 <= high; ++z) sum += layers[z];
    return sum;
  }
  /// Layer that holds least.
  [[nodiscard]] std::size_t neck(double low, double high) const {
    const auto first = layers.begin() + static_cast<std::ptrdiff_t>(low);
    return static_cast<std::size_t>(std::min_element(first, layers.begin() + static_cast<std::ptrdiff_t>(high)) -
                                    layers.begin());
  }
};

template <class Real>
Gas gas_around(const lbm::Fluid<Real>& fluid, const SphereTank& t) {
  const auto is_near = [&](double x, double y) {
    return std::hypot(x - t.place.x(), y - t.place.y()) < t.diameter / 2;
  };
  double column = 0;
  for (int i = 0; i < t.cells.x(); ++i)
    for (int j = 0; j < t.cells.y(); ++j) column += is_near(i + 0.5, j + 0.5);
  Gas gas{std::vector<double>(static_cast<std::size_t>(t.cells.z()), column)};
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    if (is_near(c.centre.x(), c.centre.y())) gas.layers[static_cast<std::size_t>(c.centre.z())] -= c.fill_level;
  });
  return gas;
}

struct Course {
  double fastest = 0;                         ///< over the impact's speed
  double most_gas = 0, left = 0;              ///< over the sphere's volume
  double closure = 0, neck = 0, reached = 0;  ///< steps after the entry; depths of neck and sphere then
};

template <class Real>
Course follow(const Entering& e, const SphereTank& t, coupling::CoupledStep<Real>& step) {
  Course c;
  auto& particles = step.solids()->particles();
  const double volume = std::numbers::pi / 6 * std::pow(e.diameter, 3);
  const double narrow = 0.1 * std::numbers::pi / 4 * e.diameter * e.diameter;
  double entered = -1, gas_now = 0;
  for (int s = 0; entered < 0 || s < entered + 1.2 * e.closure(); ++s) {
    step.advance();
    c.fastest = std::max(c.fastest, step.fluid()->max_speed_lu() / kSpeed);
    const double z = particles.position.z[0];
    if (entered < 0 && z < t.depth) entered = s;
    const double top = z + e.diameter / 2;
    if (s % 4 != 0 || top > t.depth - 4) continue;
    const Gas gas = gas_around(*step.fluid(), t);
    gas_now = gas.between(top, t.depth - 1) / volume;
    c.most_gas = std::max(c.most_gas, gas_now);
    const std::size_t neck = gas.neck(top + 2, t.depth - 1);
    if (c.closure == 0 && gas.layers[neck] < narrow)
      c.closure = s - entered, c.neck = t.depth - static_cast<double>(neck) - 0.5, c.reached = t.depth - z;
  }
  if (!e.driven) return c;
  // Gas of constant pressure holds nothing open: once the sphere stands still all must fill.
  particles.velocity.set(0, Vec3::Zero());
  for (int s = 0; s < 2 * e.closure(); ++s) {
    step.advance();
    c.fastest = std::max(c.fastest, step.fluid()->max_speed_lu() / kSpeed);
  }
  const double top = particles.position.z[0] + e.diameter / 2;
  c.left = gas_around(*step.fluid(), t).between(top, 0.5 * (top + t.depth)) / volume;
  return c;
}

template <class Real>
void enter(std::vector<Row>& rows, const Entering& e) {
  const SphereTank t = tank_for(e);
  const auto tank = make_tank<Real>(t);
  const Course c = follow<Real>(e, t, *tank);
  const std::string what = fmt::format("{} of {:g} cells, u^2/(g D) {:g}", e.driven ? "driven sphere" : "steel sphere",
                                       e.diameter, e.froude);
  rows.push_back(at_most_row(what + ": fastest cell over the impact's speed", c.fastest, 2));
  rows.push_back(at_least_row(what + ": gas behind it at most, of its volume", c.most_gas, 1));
  rows.push_back(relative_row(what + ": neck down to a tenth of the sphere's section, of 1.726 sqrt(R/g) (our bar)",
                              c.closure / e.closure(), 1, 0.3));
  const std::string depth = what + ": depth of the neck over the sphere's then";
  if (e.driven)
    rows.push_back(absolute_row(depth + " (theory 0.5, our bar)", c.neck / c.reached, 0.5, 0.1));
  else
    rows.push_back(note_row(depth, c.neck / c.reached));
  if (e.driven)
    rows.push_back(at_most_row(
        what + ": gas left between it and half its depth long after it was stopped, of its volume", c.left, 0.01));
  add_ledgers(rows, what, *tank);
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    enter<Real>(rows, {.diameter = 6, .froude = context.quick ? 15.0 : 30.0, .driven = true});
    if (context.quick) return rows;
    enter<Real>(rows, {.diameter = 8, .froude = 30, .driven = true});
    enter<Real>(rows, {.diameter = 6, .froude = 80, .driven = true});
    enter<Real>(rows, {.diameter = 8, .froude = 30});
    return rows;
  });
}

}  // namespace

Entry water_entry_cavity() {
  return {"grains_in_fluid.water_entry_cavity",
          {"case H8 of the hard cases; Truscott, Epps & Belden 2014, Duclaux et al. 2007 for the time and depth of the "
           "neck",
           {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate

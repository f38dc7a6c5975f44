// A dam breaks over a film of water: speed of the bore, depth and velocity behind it against Stoker's; the water's
// momentum against that of the forces on the ends, which is exact where the bed slips.
//
// Shallow water has no vertical acceleration: a dam that is taken away at once starts slower, and a bore of this height
// breaks, its front some depths long. Speeds are therefore those of the second half of the run, of the place where the
// depth, averaged over a reservoir's depth along the stream, is half-way between film and plateau; depth and velocity
// are means over the middle of the plateau. The bar on the momentum was set with figures in view.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/stoker.h"
#include "cases/validate/free_surface/surface_charts.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

constexpr int kWidth = 8;          // of the channel, cells; periodic
constexpr double kUntil = 10;      // T = t sqrt(g/h0) at the end
constexpr double kWave = 0.05;     // sqrt(g h0), lu: nothing is faster than twice that
constexpr double kReynolds = 5e5;  // h0 sqrt(g h0)/nu: water 0.3 m deep

struct Channel {
  int reservoir;  ///< its depth h0, cells
  double film;    ///< depth ahead, of that
  bool slip;      ///< of the bed

  [[nodiscard]] Bore theory() const { return stoker(film); }
  /// Cells to the dam and in all: no wave reaches an end (the rarefaction has a foot of some depths).
  [[nodiscard]] int dam() const { return whole_blocks(kUntil + 5); }
  [[nodiscard]] int length() const { return dam() + whole_blocks(kUntil * theory().speed + 3); }

  [[nodiscard]] lbm::FluidOptions options() const {
    const double h0 = reservoir;
    lbm::FluidOptions o = open_tank({length(), kWidth, reservoir + reservoir / 2}, kWave * h0 / kReynolds,
                                    Vec3(0, 0, -kWave * kWave / h0));
    o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
    if (slip) {
      o.domain.faces[4] = lbm::FaceKind::open;
      o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
    }
    return o;
  }
  [[nodiscard]] std::vector<lbm::LiquidRegion> water() const {
    return {{Vec3::Zero(), Vec3(dam(), kWidth - 1e-9, reservoir)},
            {Vec3(dam(), 0, 0), Vec3(length(), kWidth - 1e-9, film * reservoir)}};
  }

 private:
  [[nodiscard]] int whole_blocks(double depths) const {
    return lbm::kBlockWidth * static_cast<int>(std::ceil(depths * reservoir / lbm::kBlockWidth));
  }
};

/// Depth (cells) and discharge (lu) along the stream, averaged across; the water's momentum along it, per width, lu.
struct Profile {
  std::vector<double> depth, discharge;
  double momentum = 0;
};

template <class Real>
Profile profile_of(const lbm::Fluid<Real>& fluid, int length) {
  const auto n = static_cast<std::size_t>(length);
  Profile p{std::vector<double>(n), std::vector<double>(n), 0};
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const auto x = static_cast<std::size_t>(c.centre.x());
    p.depth[x] += c.liquid_volume / kWidth;
    p.discharge[x] += c.liquid_volume * c.velocity.x() / kWidth;
    p.momentum += c.liquid_volume * (1 + 3 * c.pressure) * c.velocity.x() / kWidth;
  });
  return p;
}

/// Last place, in cells, from where on the mean depth over `window` cells is below `depth`.
double last_above(const std::vector<double>& depths, double depth, int window) {
  std::vector<double> up_to(depths.size() + 1, 0.0);
  std::partial_sum(depths.begin(), depths.end(), up_to.begin() + 1);
  const auto w = static_cast<std::size_t>(window);
  double ahead = 0;
  for (std::size_t first = depths.size() - w; first > 0; --first) {
    const double mean = (up_to[first + w] - up_to[first]) / window;
    if (mean >= depth) return static_cast<double>(first) + 0.5 * window + (mean - depth) / (mean - ahead);
    ahead = mean;
  }
  return 0;
}

double mean_over(const std::vector<double>& values, double from, double to) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(from);
  const auto last = values.begin() + static_cast<std::ptrdiff_t>(to);
  return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
}

/// What Stoker's bore is compared with, in its units; and the depth along the stream at the end.
struct Found {
  Bore bore;
  double momentum = 0;               ///< of all water at the end, over what the ends have given it
  std::vector<double> place, depth;  ///< from the dam, over h0
};

template <class Real>
Found run_bore(const Channel& channel) {
  const Bore theory = channel.theory();
  const double h0 = channel.reservoir, half_way = 0.5 * (channel.film + theory.depth) * h0;
  lbm::Fluid<Real> fluid(channel.options());
  fluid.fill(channel.water());
  const int steps = static_cast<int>(kUntil * h0 / kWave);
  const auto advance = [&](int count) {
    for (int s = 0; s < count; ++s) fluid.step();
    return profile_of(fluid, channel.length());
  };
  const double before = last_above(advance(steps / 2).depth, half_way, channel.reservoir);
  const Profile end = advance(steps - steps / 2);
  const double front = last_above(end.depth, half_way, channel.reservoir);

  const double begin = channel.dam() + theory.end_of_rarefaction() * kWave * steps, plateau = front - begin;
  const double depth = mean_over(end.depth, begin + 0.15 * plateau, begin + 0.85 * plateau);
  const double discharge = mean_over(end.discharge, begin + 0.15 * plateau, begin + 0.85 * plateau);
  const double given = 0.5 * kWave * kWave * h0 * (1 - channel.film * channel.film) * steps;
  Found found{{(front - before) / (steps - steps / 2) / kWave, depth / h0, discharge / depth / kWave},
              end.momentum / given,
              {},
              {}};
  for (std::size_t x = 0; x < end.depth.size(); ++x) {
    found.place.push_back((static_cast<double>(x) + 0.5 - channel.dam()) / h0);
    found.depth.push_back(end.depth[x] / h0);
  }
  return found;
}

/// Stoker's depth at the end at a place from the dam.
double depth_of(const Channel& channel, double place) {
  const Bore theory = channel.theory();
  const double x = place / kUntil;
  if (x < -1) return 1;
  if (x < theory.end_of_rarefaction()) return (2 - x) * (2 - x) / 9;
  return x < theory.speed ? theory.depth : channel.film;
}

void draw(const Context& context, const Channel& channel, const Found& found) {
  std::vector<double> exact;
  for (const double x : found.place) exact.push_back(depth_of(channel, x));
  draw_depths(context, "bore_over_film", "Dam break over a film of a tenth, t = 10 (h_{0}/g)^{1/2}", found.place,
              found.depth, "Stoker 1957", exact);
}

std::vector<Row> run(const Context& context) {
  constexpr double bar = 0.1;
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    const auto add = [&](const Channel& channel) {
      const Found found = run_bore<Real>(channel);
      const Bore theory = channel.theory();
      char text[96];
      std::snprintf(text, sizeof text, "%d cells, film %.2f%s: ", channel.reservoir, channel.film,
                    channel.slip ? "" : ", no-slip bed");
      const std::string name = text;
      rows.push_back(relative_row(name + "speed of the bore", found.bore.speed, theory.speed, bar));
      rows.push_back(relative_row(name + "depth behind it", found.bore.depth, theory.depth, bar));
      rows.push_back(relative_row(name + "velocity there", found.bore.velocity, theory.velocity, bar));
      if (channel.slip) rows.push_back(relative_row(name + "momentum of all water", found.momentum, 1, 0.02));
      if (channel.reservoir == 20 && channel.film == 0.1 && channel.slip) draw(context, channel, found);
    };
    for (const int cells : {10, 20})
      for (const double film : {0.02, 0.05, 0.1, 0.2})
        if (!context.quick || cells == 10) add({cells, film, true});
    if (context.quick) return rows;
    for (const double film : {0.02, 0.1}) add({40, film, true});
    for (const double film : {0.02, 0.05, 0.1, 0.2}) add({20, film, false});  // theory has no friction
    return rows;
  });
}

}  // namespace

Entry bore_over_film() {
  return {"free_surface.bore_over_film", {"Stoker 1957, Water Waves, section 10.8: shallow water"}, run};
}

}  // namespace lahar::validate

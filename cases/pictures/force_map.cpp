#include "cases/pictures/force_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "cases/pictures/annotation.h"
#include "cases/pictures/canvas.h"
#include "cases/pictures/colour.h"
#include "core/check.h"

namespace lahar::cases {

namespace {

constexpr float kPixelsPerPoint = 2, kWidth = 640, kMargin = 16, kHead = 26, kFoot = 44;  // points
constexpr float kHighestFrame = 4000;  // points; nets are drawn smaller than that
constexpr int kDecades = 3;
const Colour kInk = from_hex(0x222222), kBefore = from_hex(0xcccccc);
const Lettering kLetters{.colour = kInk, .size = 11};

/// N, of intact bonds; 0 of others.
double force_of(const dem::Bonds& bonds, std::size_t b) {
  return bonds.intact[b] ? std::hypot(bonds.axial_force[b], Vec3(bonds.shear_force[b]).norm()) : 0.0;
}

/// The power of ten at or above a force; one newton where there is none.
int decade_above(double force) { return force > 0 ? static_cast<int>(std::ceil(std::log10(force))) : 0; }

/// A bar of the ramp with the decades under it.
void draw_legend(Canvas& canvas, float height, int highest) {
  const float left = kMargin, right = left + 220, top = height - kFoot + 10, bottom = top + 8;
  const std::vector<Colour> colours = ramp_anchors(ColourRamp::tension);
  canvas.colour_bar(Point(left, top), Point(right, bottom), colours);
  for (int d = 0; d <= kDecades; ++d) {
    const float x = left + (right - left) * static_cast<float>(d) / kDecades;
    const Hold hold = d == 0 ? Hold::start : d == kDecades ? Hold::end : Hold::middle;
    canvas.text(Point(x, bottom + 14), fmt::format("10^{{{}}}", highest - kDecades + d), kLetters, hold);
  }
  canvas.text(Point(right + 12, bottom), "force in a bond, N", kLetters);
}

/// A grey line and what it means.
void draw_legend_of_before(Canvas& canvas, float height) {
  const float right = kWidth - kMargin, y = height - kFoot + 18;
  canvas.text(Point(right, y), "in the first map", kLetters, Hold::end);
  canvas.line(Point(right - 108, y - 4), Point(right - 84, y - 4), {.colour = kBefore, .width = 1});
}

}  // namespace

Image force_map(const ForceMap& map) {
  require(map.particles && map.bonds, "a map of forces needs bonds");
  require(map.width > 0 && map.height > 0, "a map of forces needs a frame");
  const dem::Bonds& bonds = *map.bonds;
  std::vector<double> force(map.bond_count);
  for (std::size_t k = 0; k < map.bond_count; ++k) force[k] = force_of(bonds, map.first_bond + k);
  const int highest = decade_above(force.empty() ? 0.0 : *std::max_element(force.begin(), force.end()));
  std::vector<std::size_t> order(map.bond_count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return force[a] < force[b]; });

  const double around = 0.1 * map.width;  // m
  const float scale = std::min((kWidth - 2 * kMargin) / static_cast<float>(map.width + 2 * around),
                               kHighestFrame / static_cast<float>(map.height + 2 * around));
  const float foot = kHead + scale * static_cast<float>(map.height + 2 * around), height = std::ceil(foot + kFoot);
  const auto at = [&](const Vec3& p) {
    const Vec3 r = p - map.origin;
    return Point(kMargin + scale * static_cast<float>(r.dot(map.across) + around),
                 foot - scale * static_cast<float>(r.dot(map.up) + around));
  };

  Canvas canvas(Canvas::Medium::pixels, kWidth, height, kPixelsPerPoint);
  canvas.text(Point(kMargin, kHead - 8), map.title, kLetters);
  canvas.text(Point(kWidth - kMargin, kHead - 8), "t = " + time_label(map.time_s), kLetters, Hold::end);
  canvas.clip(Point(kMargin, kHead), Point(kWidth - kMargin, foot));
  for (std::size_t k = 0; map.before && k < map.bond_count; ++k) {
    const std::size_t b = map.first_bond + k;
    const auto place = [&](std::size_t i) { return at((*map.before)[map.particles->id(i)]); };
    canvas.line(place(bonds.i[b]), place(bonds.j[b]), {.colour = kBefore, .width = 0.5F});
  }
  for (const std::size_t k : order) {
    const std::size_t b = map.first_bond + k;
    if (!bonds.intact[b]) continue;
    const double decades = force[k] > 0 ? std::log10(force[k]) - (highest - kDecades) : 0.0;
    const auto share = static_cast<float>(std::clamp(decades / kDecades, 0.0, 1.0));
    canvas.line(at(map.particles->position[bonds.i[b]]), at(map.particles->position[bonds.j[b]]),
                {.colour = ramp_colour(ColourRamp::tension, share), .width = 0.5F + 2.5F * share});
  }
  canvas.unclip();
  draw_legend(canvas, height, highest);
  if (map.before) draw_legend_of_before(canvas, height);
  Image image(static_cast<int>(std::lround(kPixelsPerPoint * kWidth)),
              static_cast<int>(std::lround(kPixelsPerPoint * height)));
  canvas.lay_over(image);
  return image;
}

}  // namespace lahar::cases

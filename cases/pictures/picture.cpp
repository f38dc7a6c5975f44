#include "cases/pictures/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "cases/pictures/annotation.h"
#include "cases/pictures/backdrop.h"
#include "cases/pictures/capsule.h"
#include "cases/pictures/colour.h"
#include "cases/pictures/occlusion_field.h"
#include "cases/pictures/solids_in_view.h"
#include "cases/pictures/water_field.h"
#include "core/check.h"
#include "core/parallel.h"

namespace lahar::cases {

namespace {

const Colour kKeyLight(2.30F, 2.20F, 2.02F);  // a low warm sun
const Colour kSkyLight(0.74F, 0.82F, 0.94F);  // from above
const Colour kBounce(0.40F, 0.37F, 0.34F);    // from below
const Colour kFloor(0.40F, 0.385F, 0.36F), kSideWall(0.70F, 0.73F, 0.76F), kSolid(0.27F, 0.29F, 0.32F);
constexpr float kLightRadius = 0.03F;  // of the sun as seen from the scene: softens shadows

// Light of the surroundings from a direction, by its height above the horizon.
Colour surroundings(float height) {
  static const Colour horizon = to_linear(from_hex(0xf2f3f3)), zenith = to_linear(from_hex(0xa9bccd)),
                      ground = to_linear(from_hex(0xd9d8d5));
  const float h = std::clamp(height, -1.0F, 1.0F);
  const Colour& end = h >= 0 ? zenith : ground;
  const float t = std::pow(std::abs(h), 0.7F);
  return (1 - t) * horizon + t * end;
}

// Compresses what is brighter than 1 while darker values stay nearly unchanged.
Colour expose(const Colour& linear) {
  return linear.unaryExpr([](float v) {
    constexpr float knee = 0.7F;
    return v <= knee ? v : knee + (1 - knee) * (1 - std::exp(-(v - knee) / (1 - knee)));
  });
}

float schlick(float cosine, float normal_reflectance) {
  const float x = 1 - std::clamp(cosine, 0.0F, 1.0F), x2 = x * x;
  return normal_reflectance + (1 - normal_reflectance) * x2 * x2 * x;
}

Vec3f reflected(const Vec3f& direction, const Vec3f& normal) { return direction - 2 * direction.dot(normal) * normal; }

// What a surface does with light.
struct Finish {
  Colour colour;
  float gloss;      // strength of the highlight
  float sharpness;  // Blinn-Phong exponent
};

class Renderer {
 public:
  Renderer(const PictureScene& scene, const Camera& camera, const PictureStyle& style, const SolidsInView& view)
      : view_(view),
        projection_(camera, style.width, style.height),
        tree_(view.capsules),
        occlusion_(tree_.items()),
        backdrop_(scene.walls != nullptr ? *scene.walls : no_walls_, scene.box, camera.eye),
        water_(scene.fluid != nullptr ? *scene.fluid : no_fluid_, style.water_smoothing),
        up_((scene.gravity.norm() > 0 ? Vec3(-scene.gravity.normalized()) : Vec3(camera.up.normalized()))
                .cast<float>()),
        to_light_((1.0F * up_ - 0.38F * projection_.right() - 0.62F * projection_.forward()).normalized()),
        absorption_(Colour(2.6F, 1.0F, 0.72F) / static_cast<float>(std::max(style.water_clarity, 1e-6))),
        water_colour_(style.water_colour),
        coarse_grid_(round_spacing((scene.box.upper - scene.box.lower).maxCoeff(), 8)),
        skin_(1e-4F * static_cast<float>((scene.box.upper - scene.box.lower).norm())) {}

  // Display colour of a pixel: the mean over samples x samples rays.
  [[nodiscard]] Colour pixel(int x, int y, int samples) const {
    Colour sum = Colour::Zero();
    for (int n = 0; n < samples * samples; ++n) {
      const Point offset(static_cast<float>(n % samples) + 0.5F, static_cast<float>(n / samples) + 0.5F);
      const Point place = Point(static_cast<float>(x), static_cast<float>(y)) + offset / static_cast<float>(samples);
      sum += expose(trace(projection_.ray(place), light_direction(n, samples * samples)));
    }
    return to_display(sum / static_cast<float>(samples * samples));
  }

 private:
  struct SolidHit {
    float distance = kNoHit;
    Colour light = Colour::Zero();
  };

  // Each sample of a pixel sees another point of the sun, so that shadows have soft edges.
  [[nodiscard]] Vec3f light_direction(int n, int count) const {
    if (count == 1) return to_light_;
    const float angle = 2.399963F * static_cast<float>(n);  // golden angle
    const float radius = kLightRadius * std::sqrt((static_cast<float>(n) + 0.5F) / static_cast<float>(count));
    const Vec3f side = to_light_.cross(projection_.forward()).normalized(), other = to_light_.cross(side);
    return (to_light_ + radius * (std::cos(angle) * side + std::sin(angle) * other)).normalized();
  }

  [[nodiscard]] Colour background(const Vec3f& direction) const { return surroundings(direction.dot(up_)); }

  [[nodiscard]] Colour trace(const Ray& ray, const Vec3f& to_light) const {
    const SolidHit solid = solid_light(ray, to_light);
    const Colour behind = solid.distance < kNoHit ? solid.light : background(ray.direction);
    return water_.empty() ? behind : through_water(ray, to_light, solid.distance, behind);
  }

  [[nodiscard]] SolidHit solid_light(const Ray& ray, const Vec3f& to_light) const {
    const BackdropHit wall = backdrop_.nearest(ray, kNoHit);
    const CapsuleHit hit = nearest_capsule(tree_, ray, wall.distance);
    if (hit.capsule >= 0) {
      const auto c = static_cast<std::size_t>(hit.capsule);
      const Vec3f p = ray.at(hit.distance);
      const Finish finish =
          view_.metallic[c] ? Finish{view_.colours[c], 0.55F, 40} : Finish{view_.colours[c], 0.06F, 12};
      return {hit.distance, shade(p, capsule_normal(tree_.items()[c], p), ray.direction, finish, to_light)};
    }
    if (wall.wall < 0) return {};
    const Vec3f p = ray.at(wall.distance);
    return {wall.distance, shade(p, wall.normal, ray.direction, wall_finish(ray, wall, p), to_light)};
  }

  [[nodiscard]] Finish wall_finish(const Ray& ray, const BackdropHit& wall, const Vec3f& p) const {
    if (!wall.flat) return {kSolid, 0.15F, 30};
    const Colour base = wall.normal.dot(up_) > 0.5F ? kFloor : kSideWall;
    const float footprint =
        wall.distance * projection_.pixel_angle() / std::max(0.15F, std::abs(ray.direction.dot(wall.normal)));
    const float strong = grid_line_share(p, wall.normal, coarse_grid_, 0.012F * coarse_grid_, footprint);
    const float faint = grid_line_share(p, wall.normal, 0.2F * coarse_grid_, 0.006F * coarse_grid_, footprint);
    return {base * (1 - std::max(0.34F * strong, 0.16F * faint)), 0.02F, 10};
  }

  [[nodiscard]] Colour shade(const Vec3f& p, const Vec3f& normal, const Vec3f& view, const Finish& finish,
                             const Vec3f& to_light) const {
    const float open = occlusion_.openness(p, normal);
    const float height = 0.5F + 0.5F * normal.dot(up_);
    const Colour ambient = open * (height * kSkyLight + (1 - height) * kBounce) * 0.62F;
    Colour light = finish.colour.cwiseProduct(ambient);
    const float facing = normal.dot(to_light);
    const Ray to_sun{p + skin_ * normal, to_light};
    if (facing <= 0 || blocked(tree_, to_sun) || backdrop_.blocked(to_sun)) return light;
    const Vec3f half = (to_light - view).normalized();
    const float highlight = finish.gloss * std::pow(std::max(0.0F, half.dot(normal)), finish.sharpness);
    return light + facing * kKeyLight.cwiseProduct(0.42F * finish.colour + Colour::Constant(0.3F * highlight));
  }

  // Light from `behind` on its way through the water: absorbed over the wet path (Beer-Lambert), joined by scattered
  // light and by reflections at each surface.
  [[nodiscard]] Colour through_water(const Ray& ray, const Vec3f& to_light, float limit, const Colour& behind) const {
    const WetSpans wet = water_.wet_spans(ray, limit);
    Colour light = behind;
    for (int s = wet.count - 1; s >= 0; --s) {
      const auto [entry, exit] = wet.spans[static_cast<std::size_t>(s)];
      const Colour passed = (-absorption_ * (exit - entry)).array().exp();
      light = light.cwiseProduct(passed) + water_colour_.cwiseProduct(Colour::Ones() - passed) * 1.25F;
      if (entry > 0) light = at_surface(ray, to_light, entry, light);
    }
    return light;
  }

  [[nodiscard]] Colour at_surface(const Ray& ray, const Vec3f& to_light, float entry, const Colour& inside) const {
    const Vec3f normal = water_.normal(ray.at(entry));
    const float cosine = std::max(0.0F, -normal.dot(ray.direction));
    const float reflectance = std::min(0.65F, schlick(cosine, 0.03F));
    const Vec3f mirror = reflected(ray.direction, normal);
    const float diffuse = 0.86F + 0.22F * normal.dot(to_light);  // foam and fine ripples make slopes visible
    const float glint = std::pow(std::max(0.0F, mirror.dot(to_light)), 90.0F);
    return inside * (1 - reflectance) * diffuse + background(mirror) * reflectance + kKeyLight * (0.55F * glint);
  }

  inline static const Walls no_walls_{};
  inline static const lbm::FluidSnapshot no_fluid_{};
  const SolidsInView& view_;
  Projection projection_;
  CapsuleTree tree_;
  OcclusionField occlusion_;
  Backdrop backdrop_;
  WaterField water_;
  Vec3f up_, to_light_;
  Colour absorption_, water_colour_;
  float coarse_grid_, skin_;
};

}  // namespace

Image render_picture(const PictureScene& scene, const Camera& camera, const PictureStyle& style) {
  require(style.width > 0 && style.height > 0 && style.samples > 0,
          "render_picture: size and samples must be positive");
  const SolidsInView view = solids_in_view(scene, style);
  const Renderer renderer(scene, camera, style, view);
  Image image(style.width, style.height);
  parallel_for(0, static_cast<std::size_t>(style.height), 1, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < style.width; ++x) image.at(x, y) = renderer.pixel(x, y, style.samples);
  });
  annotate(image, scene, camera, style, view);
  return image;
}

}  // namespace lahar::cases

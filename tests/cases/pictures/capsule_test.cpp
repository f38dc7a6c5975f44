#include "cases/pictures/capsule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lahar::cases {
namespace {

float distance_to_axis(const Capsule& c, const Vec3f& p) {
  const Vec3f axis = c.end - c.start;
  const float t = axis.squaredNorm() > 0 ? std::clamp((p - c.start).dot(axis) / axis.squaredNorm(), 0.0F, 1.0F) : 0;
  return (p - c.start - t * axis).norm();
}

class Random {
 public:
  float number() { return uniform_(engine_); }
  Vec3f vector() { return {number(), number(), number()}; }
  // From anywhere around towards somewhere in the middle.
  Ray ray() {
    const Vec3f origin = 3 * vector();
    return {origin, (0.7F * vector() - origin).normalized()};
  }
  Capsule capsule(float size) {
    const Vec3f start = vector();
    const bool sphere = number() > 0;
    return {start, sphere ? start : Vec3f(start + size * vector()), size * (0.2F + 0.1F * number())};
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<float> uniform_{-1, 1};
};

TEST(Capsule, EntryLiesOnTheSurfaceAndNothingBeforeItIsInside) {
  Random random;
  int hits = 0;
  for (int n = 0; n < 3000; ++n) {
    const Capsule c = random.capsule(1.0F);
    const Ray ray = random.ray();
    if (distance_to_axis(c, ray.origin) < c.radius) continue;
    const float t = capsule_entry(c, ray);
    const float last = t < kNoHit ? t : 8.0F;
    if (t < kNoHit) {
      ++hits;
      EXPECT_NEAR(distance_to_axis(c, ray.at(t)), c.radius, 2e-4F);
      EXPECT_LE(capsule_normal(c, ray.at(t)).dot(ray.direction), 1e-2F);
    }
    for (int s = 0; s < 100; ++s)
      EXPECT_GT(distance_to_axis(c, ray.at(last * static_cast<float>(s) / 100)), c.radius - 2e-4F);
  }
  EXPECT_GT(hits, 100);
}

TEST(Capsule, RaysAlongTheAxisHitTheCap) {
  const Capsule c{Vec3f(0, 0, 0), Vec3f(2, 0, 0), 0.5F};
  EXPECT_NEAR(capsule_entry(c, {Vec3f(-3, 0, 0), Vec3f::UnitX()}), 2.5F, 1e-5F);
  EXPECT_NEAR(capsule_entry(c, {Vec3f(5, 0.3F, 0), -Vec3f::UnitX()}), 5 - 2 - 0.4F, 1e-5F);
  EXPECT_EQ(capsule_entry(c, {Vec3f(5, 0.3F, 0), Vec3f::UnitX()}), kNoHit) << "behind the ray";
}

TEST(CapsuleTree, AgreesWithTryingEveryCapsule) {
  Random random;
  std::vector<Capsule> capsules;
  for (int n = 0; n < 2000; ++n) capsules.push_back(random.capsule(n % 50 == 0 ? 0.3F : 0.03F));
  const CapsuleTree tree(capsules);
  int hits = 0;
  for (int n = 0; n < 4000; ++n) {
    const Ray ray = random.ray();
    const float limit = n % 2 == 0 ? kNoHit : 3.0F;
    CapsuleHit best;
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      const float t = capsule_entry(capsules[i], ray);
      if (t < limit && t < best.distance) best = {t, static_cast<std::int32_t>(i)};
    }
    const CapsuleHit hit = nearest_capsule(tree, ray, limit);
    EXPECT_EQ(hit.distance, best.distance);
    EXPECT_EQ(blocked(tree, ray, limit), best.capsule >= 0);
    hits += best.capsule >= 0;
  }
  EXPECT_GT(hits, 500);
}

TEST(CapsuleTree, CopesWithNothingAndWithManyInOnePlace) {
  EXPECT_EQ(nearest_capsule(CapsuleTree({}), {Vec3f::Zero(), Vec3f::UnitX()}).capsule, -1);
  const CapsuleTree heap(std::vector<Capsule>(500, Capsule{Vec3f::Ones(), Vec3f::Ones(), 0.5F}));
  EXPECT_NEAR(nearest_capsule(heap, {Vec3f(-2, 1, 1), Vec3f::UnitX()}).distance, 2.5F, 1e-5F);
}

}  // namespace
}  // namespace lahar::cases

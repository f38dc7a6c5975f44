#pragma once
// Vector and matrix aliases of Eigen. Everything in SI units unless a name ends in `_lu`. Kernels use triple.h and
// simd.h.
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

namespace lahar {

using Vec3 = Eigen::Vector3d;
using Vec3i = Eigen::Vector3i;
using Mat3 = Eigen::Matrix3d;

/// Structure-of-arrays field of three-vectors: one contiguous array per component, so that loops over particles
/// vectorize.
struct Vec3Field {
  std::vector<double> x, y, z;

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3& v) { x[i] = v.x(), y[i] = v.y(), z[i] = v.z(); }
  void add(std::size_t i, const Vec3& v) { x[i] += v.x(), y[i] += v.y(), z[i] += v.z(); }
  void push_back(const Vec3& v) { x.push_back(v.x()), y.push_back(v.y()), z.push_back(v.z()); }
  void fill(const Vec3& v) {
    x.assign(x.size(), v.x());
    y.assign(y.size(), v.y());
    z.assign(z.size(), v.z());
  }
  void resize(std::size_t n) { x.resize(n), y.resize(n), z.resize(n); }
};

}  // namespace lahar

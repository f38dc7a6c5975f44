#pragma once
// Plain three-vectors for vectorized kernels.

namespace lahar::dem {

/// A three-vector that compilers keep in registers when loops over contacts or bonds are vectorized.
struct Triple {
  double x, y, z;
};
inline Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Triple operator*(double s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Triple cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Triple& a) { return __builtin_sqrt(dot(a, a)); }
/// The part of a that is normal to the unit vector n.
inline Triple normal_part(const Triple& a, const Triple& n) { return a - dot(a, n) * n; }

}  // namespace lahar::dem

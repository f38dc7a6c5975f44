#pragma once
// Materials and the properties of their pairs.
#include <cmath>
#include <string>
#include <vector>

#include "core/check.h"

namespace lahar::dem {

struct Material {
  std::string name;
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;   ///< -
};

/// What two materials share when they touch. friction, restitution and rolling friction belong to the pair, not to one
/// side.
struct MaterialPair {
  double effective_modulus = 0;        ///< Pa: 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2
  double effective_shear_modulus = 0;  ///< Pa: 1/G* = (2-nu1)/G1 + (2-nu2)/G2, G = E / (2 (1+nu))
  double friction = 0;                 ///< Coulomb coefficient
  double restitution = 1;              ///< coefficient of restitution
  double rolling_friction = 0;         ///< torque that rolls on / (R* normal force), 0 = rolls freely
};

class Materials {
 public:
  /// Adds a material; all its pairs start with friction 0 and restitution 1.
  int add(const Material& m) {
    materials_.push_back(m);
    const std::size_t n = materials_.size();
    std::vector<MaterialPair> bigger(n * n);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        bigger[a * n + b] = (a + 1 < n && b + 1 < n) ? pairs_[a * (n - 1) + b] : elastic_pair(a, b);
    pairs_ = std::move(bigger);
    return static_cast<int>(n - 1);
  }

  void set_pair(int a, int b, double friction, double restitution, double rolling_friction = 0) {
    for (auto* p : {&pairs_[index(a, b)], &pairs_[index(b, a)]})
      p->friction = friction, p->restitution = restitution, p->rolling_friction = rolling_friction;
  }

  [[nodiscard]] const MaterialPair& pair(int a, int b) const { return pairs_[index(a, b)]; }
  [[nodiscard]] const Material& operator[](int m) const { return materials_[static_cast<std::size_t>(m)]; }
  [[nodiscard]] std::size_t size() const { return materials_.size(); }

 private:
  [[nodiscard]] std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(a) * materials_.size() + static_cast<std::size_t>(b);
  }
  [[nodiscard]] MaterialPair elastic_pair(std::size_t a, std::size_t b) const {
    const auto& [na, ea, va] = materials_[a];
    const auto& [nb, eb, vb] = materials_[b];
    const double ga = ea / (2 * (1 + va)), gb = eb / (2 * (1 + vb));
    return {1.0 / ((1 - va * va) / ea + (1 - vb * vb) / eb), 1.0 / ((2 - va) / ga + (2 - vb) / gb), 0.0, 1.0, 0.0};
  }

  std::vector<Material> materials_;
  std::vector<MaterialPair> pairs_;
};

}  // namespace lahar::dem

#pragma once
// How many loose grains there are, how many have left the domain, and whether one has gone through a wall.
#include <cstdint>
#include <vector>

#include "cases/observers/observer.h"

namespace lahar::cases {

class GrainCount final : public Observer {
 public:
  explicit GrainCount(const Observed& run);
  static bool applies(const Observed& run);
  [[nodiscard]] std::string_view name() const override { return "grain_count"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  [[nodiscard]] std::vector<ResultCheck> checks(const Metrics& metrics) const override;

 private:
  /// Whether its centre is in or below a wall that stands now.
  [[nodiscard]] bool is_behind_a_wall(std::size_t i) const;

  double gone_ = 0;                   // at the last row
  std::vector<std::uint8_t> behind_;  // by id: was behind a wall, for good
};

}  // namespace lahar::cases

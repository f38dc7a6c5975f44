#pragma once
// How many cells the fluid has, and how fast they are for the lattice.
#include <cstdint>

#include "cases/observers/observer.h"

namespace lahar::cases {

class FluidCells final : public Observer {
 public:
  explicit FluidCells(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.fluid() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "fluid_cells"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  /// Most cells and blocks among the rows.
  [[nodiscard]] std::uint64_t most_wet_cells() const { return most_wet_cells_; }
  [[nodiscard]] std::uint64_t most_blocks() const { return most_blocks_; }

 private:
  std::uint64_t most_wet_cells_ = 0, most_blocks_ = 0;
};

}  // namespace lahar::cases

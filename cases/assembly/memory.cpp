#include "cases/assembly/memory.h"

#include <unistd.h>

#include <cmath>

namespace lahar::scene {

std::size_t fluid_bytes_per_cell(Precision precision) {
  constexpr std::size_t numbers = 19 + 3 + 7, flags = 6;
  return numbers * (precision == Precision::float32 ? sizeof(float) : sizeof(double)) + flags;
}

double liquid_cells(const Scene& scene) {
  double volume = 0;
  for (const FluidRegion& r : scene.fluid.regions) volume += (r.upper - r.lower).prod();
  return volume / std::pow(scene.fluid.cell_size, 3);
}

std::size_t physical_memory() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace lahar::scene

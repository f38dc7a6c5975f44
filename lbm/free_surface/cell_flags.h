#pragma once
// Which interface cells are to convert, judged for one block by itself (rules: conversion.h).
#include <cstdint>
#include <vector>

#include "lbm/free_surface/drops.h"
#include "lbm/grid/cell_set.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// What is to become of the interface cells of one block.
template <class Real>
struct Flagged {
  CellSet filled, emptied;
  CellSet owing;  ///< of the emptied, those that owe so much that they cannot wait (conversion.cpp)
  std::vector<Drop<Real>> drops;
  [[nodiscard]] bool empty() const { return filled.empty() && emptied.empty() && drops.empty(); }
  void clear() { filled.clear(), emptied.clear(), owing.clear(), drops.clear(); }
};

/// Flags one block's interface cells and sets their fill levels from their new mass; returns what left at the rim.
/// `round` is any count of the steps; no cell of the block is faster than `speed`, lu.
template <class Real>
double flag_conversions(FluidGrid<Real>& grid, BlockIndex b, Parity parity, std::uint64_t round, double speed,
                        Flagged<Real>& flagged);

extern template double flag_conversions<float>(FluidGrid<float>&, BlockIndex, Parity, std::uint64_t, double,
                                               Flagged<float>&);
extern template double flag_conversions<double>(FluidGrid<double>&, BlockIndex, Parity, std::uint64_t, double,
                                                Flagged<double>&);

}  // namespace lahar::lbm

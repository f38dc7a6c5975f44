#pragma once
// A plane screen of parallel wires or of square mesh across a stream. What the liquid loses is the drag of the wires
// per area (momentum balance of the audit), with no gradient left in a periodic box.
#include "cases/validate/wires_in_fluid/wire_flows.h"

namespace lahar::validate {

struct Screen {
  double diameter = 1;  ///< of a wire, cells
  double reynolds = 100, solidity = 0.3;
  bool mesh = false;
  double speed = 0.1;     ///< lu
  bool resolved = false;  ///< WireStream
  double scale = 1;       ///< of the box, 64 cells long and 40 wide, and of the way that the stream goes in it
};

struct ScreenLoss {
  double solidity = 0;          ///< of whole wires in the box
  double found = 0, table = 0;  ///< pressure loss over 1/2 rho U^2; loss_of_screens.h
  double audit = 0;             ///< WireLoad
};

/// In the context's precision.
ScreenLoss flow_through_screen(const Screen& screen, const Context& context);

}  // namespace lahar::validate

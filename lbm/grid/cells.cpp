#include "lbm/grid/cells.h"

namespace lahar::lbm {

constinit const NeighbourTable kNeighbours = make_neighbour_table();

}  // namespace lahar::lbm

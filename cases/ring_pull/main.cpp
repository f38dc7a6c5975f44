// ring_pull: a ring pulled open between two beads, held against the paper's section 3.1.
#include "cases/procedure/procedure.h"
#include "cases/ring_pull/describe.h"
#include "cases/ring_pull/report.h"

int main(int argc, char** argv) {
  using namespace lahar::cases;
  return procedure_main<RingPull>(argc, argv, "ring_pull",
                                  "Pulls a ring open: force over displacement (Li, Zhao & Kwan 2020, section 3.1)",
                                  [](const RingPull& ring, const Workplace& place, Summary& summary) {
                                    return run_ring_pull(ring, place.out, place.quiet, summary);
                                  });
}

// rockfall: a ball falls onto a ring net, held against the paper's section 3.3.
#include "cases/procedure/procedure.h"
#include "cases/rockfall/describe.h"
#include "cases/rockfall/report.h"

int main(int argc, char** argv) {
  using namespace lahar::cases;
  return procedure_main<Rockfall>(argc, argv, "rockfall",
                                  "Drops a ball onto a ring net in braked cables (Li, Zhao & Kwan 2020, section 3.3)",
                                  [](const Rockfall& rockfall, const Workplace& place, Summary& summary) {
                                    return run_rockfall_to(rockfall, place.out, place.quiet, summary);
                                  });
}

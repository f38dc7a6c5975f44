// energy_dissipator: a dissipator in a cable, stretched and let go, held against the paper's section 3.2.
#include "cases/energy_dissipator/describe.h"
#include "cases/energy_dissipator/report.h"
#include "cases/procedure/procedure.h"

int main(int argc, char** argv) {
  using namespace lahar::cases;
  return procedure_main<EnergyDissipator>(
      argc, argv, "energy_dissipator",
      "Stretches an energy dissipator in a cable and lets it go (Li, Zhao & Kwan 2020, section 3.2)",
      [](const EnergyDissipator& brake, const Workplace& place, Summary& summary) {
        return run_energy_dissipator(brake, place.out, summary);
      });
}

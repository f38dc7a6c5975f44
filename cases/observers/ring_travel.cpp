#include "cases/observers/ring_travel.h"

namespace lahar::cases {

RingTravel::RingTravel(const Observed& run) : Observer(run), threads_(barrier::threadings(*run.simulation.net())) {
  column("ring_travel_m", "m",
         "way that edge rings have slid along their cables since the first row, mean, torn rings and cables aside; "
         "what cables and dissipators are drawn out by is not counted",
         [this] { return now_.mean; })
      .peak("max_mean_ring_travel_m", "m", "largest `ring_travel_m` of the rows");
  column("ring_travel_furthest_m", "m", "the same of the ring that slid furthest", [this] {
    return now_.furthest;
  }).peak("max_ring_travel_m", "m", "largest `ring_travel_furthest_m` of the rows");
}

void RingTravel::sample(double) {
  const dem::Solids& solids = *run_.simulation.solids();
  const std::vector<double> places =
      barrier::places_on_cables(*run_.simulation.net(), threads_, solids.particles(), solids.bonds());
  if (start_.empty()) start_ = places;
  now_ = barrier::travel_between(start_, places);
}

}  // namespace lahar::cases

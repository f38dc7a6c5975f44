#include "cases/observers/ring_travel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lahar::cases {

RingTravel::RingTravel(const Observed& run) : Observer(run), threads_(barrier::threadings(*run.simulation.net())) {
  column("ring_travel_m", "m",
         "way that edge rings have slid along their cables since the first row, mean; what cables and dissipators are "
         "drawn "
         "out by is not counted",
         [this] { return mean_; })
      .peak("max_mean_ring_travel_m", "m", "largest `ring_travel_m` of the rows");
  column("ring_travel_furthest_m", "m", "the same of the ring that slid furthest", [this] {
    return furthest_;
  }).peak("max_ring_travel_m", "m", "largest `ring_travel_furthest_m` of the rows");
}

std::vector<double> RingTravel::places() const {
  const barrier::Net& net = *run_.simulation.net();
  const dem::Particles& particles = run_.simulation.solids()->particles();
  const dem::Bonds& bonds = run_.simulation.solids()->bonds();
  std::vector<double> all;
  for (const auto& [ring, cable] : threads_) {
    const barrier::Wire& wire = net.cables[cable];
    const auto segment = barrier::place_on_cable(barrier::centre_line(net.rings[ring], particles),
                                                 barrier::centre_line(wire, particles));
    // Along the wire as it was made: a place that is drawn out with the cable and its dissipators has not slid.
    const auto first = bonds.rest_length.begin() + static_cast<std::ptrdiff_t>(wire.first_bond);
    const double made = std::accumulate(first, first + static_cast<std::ptrdiff_t>(wire.bonds), 0.0);
    all.push_back(segment ? *segment * made / static_cast<double>(wire.bonds) : kUnknown);
  }
  return all;
}

void RingTravel::sample(double) {
  const std::vector<double> now = places();
  if (start_.empty()) start_ = now;
  double sum = 0, count = 0;
  furthest_ = 0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double travel = std::abs(now[k] - start_[k]);
    if (!std::isfinite(travel)) continue;
    sum += travel, count += 1;
    furthest_ = std::max(furthest_, travel);
  }
  mean_ = sum / std::max(count, 1.0);
}

}  // namespace lahar::cases

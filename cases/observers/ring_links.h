#pragma once
// Whether rings have gone through each other since the start.
#include "barrier/topology.h"
#include "cases/observers/observer.h"

namespace lahar::cases {

class RingLinks final : public Observer {
 public:
  explicit RingLinks(const Observed& run) : Observer(run), at_start_(now()) {}
  static bool applies(const Observed& run) {
    return run.simulation.net() != nullptr && !run.simulation.net()->rings.empty();
  }
  [[nodiscard]] std::string_view name() const override { return "ring_links"; }
  [[nodiscard]] std::vector<ResultCheck> checks(const Metrics&) const override {
    const bool kept = warning().empty();
    return {{"ring_links_changed", kept ? 0.0 : 1.0, 0, 0, kept, "linking numbers at the start"}};
  }
  /// The first link that was lost, in words; empty if none was.
  [[nodiscard]] std::string warning() const override { return barrier::first_difference(at_start_, now()); }

 private:
  [[nodiscard]] barrier::Topology now() const {
    const dem::Solids& solids = *run_.simulation.solids();
    return barrier::find_topology(*run_.simulation.net(), solids.particles(), solids.bonds());
  }
  barrier::Topology at_start_;  // also of a run that goes on: of the net as built, whose links are those it hangs with
};

}  // namespace lahar::cases

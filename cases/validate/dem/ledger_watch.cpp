#include "cases/validate/dem/ledger_watch.h"

#include <algorithm>
#include <cmath>

namespace lahar::validate {

LedgerWatch::LedgerWatch(dem::Solids& solids) : solids_(&solids) {
  solids.advance(0);
  const dem::EnergyLedger ledger = solids.ledger();
  first_ = ledger.total();
  const auto terms = ledger.terms();
  for (std::size_t k = 0; k < kTerms; ++k) lowest_[k] = highest_[k] = terms[k].second;
}

void LedgerWatch::look() {
  const dem::EnergyLedger ledger = solids_->ledger();
  last_error_ = ledger.total() - first_;
  const double departure = std::abs(last_error_);
  if (!(departure <= error_)) error_ = departure;  // a total that is not a number stays visible
  const auto terms = ledger.terms();
  for (std::size_t k = 0; k < kTerms; ++k) {
    lowest_[k] = std::min(lowest_[k], terms[k].second);
    highest_[k] = std::max(highest_[k], terms[k].second);
  }
}

double LedgerWatch::exchanged() const {
  double widest = 0;
  for (std::size_t k = 0; k < kTerms; ++k) widest = std::max(widest, highest_[k] - lowest_[k]);
  return widest;
}

Row LedgerWatch::row(const std::string& what, double bar) const {
  return at_most_row(what + ": ledger, share of the exchanged energy", error_ / exchanged(), bar);
}

void advance_watched(dem::Solids& solids, LedgerWatch& watch, int steps, int interval) {
  for (int done = 0; done < steps; done += interval) {
    solids.advance(std::min(interval, steps - done));
    watch.look();
  }
}

}  // namespace lahar::validate

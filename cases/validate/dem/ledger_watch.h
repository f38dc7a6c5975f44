#pragma once
// Follows the energy ledger of a run. Every entry with particles holds its ledger against the same bar.
#include <array>
#include <string>
#include <tuple>

#include "cases/validate/entry.h"
#include "dem/solids.h"

namespace lahar::validate {

/// Largest share of the exchanged energy by which a ledger may fail to close.
inline constexpr double kLedgerBar = 1e-3;

/// Looks at the ledger whenever it is asked to; in between it sees nothing.
class LedgerWatch {
 public:
  /// Evaluates the forces of the start and notes the ledger.
  explicit LedgerWatch(dem::Solids& solids);
  void look();

  /// Largest departure of the ledger's total from its first value so far, J.
  [[nodiscard]] double error() const { return error_; }
  /// The departure when it was last looked at, J.
  [[nodiscard]] double last_error() const { return last_error_; }
  /// The energy that was exchanged, J: the widest range that a single term of the ledger has gone through. (Less than
  /// the sum of what all terms gave and took, so that a share of it is the stricter measure.)
  [[nodiscard]] double exchanged() const;
  /// error() as a share of exchanged(), held against the bar.
  [[nodiscard]] Row row(const std::string& what, double bar = kLedgerBar) const;

 private:
  static constexpr std::size_t kTerms = std::tuple_size_v<decltype(dem::EnergyLedger{}.terms())>;
  const dem::Solids* solids_;
  double first_ = 0, error_ = 0, last_error_ = 0;
  std::array<double, kTerms> lowest_{}, highest_{};
};

/// Advances by `steps`, with a look at the ledger every `interval` steps.
void advance_watched(dem::Solids& solids, LedgerWatch& watch, int steps, int interval);

}  // namespace lahar::validate

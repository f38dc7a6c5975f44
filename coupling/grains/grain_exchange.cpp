#include "coupling/grains/grain_exchange.h"

#include "coupling/grains/averaged_exchange.h"
#include "coupling/grains/resolved_exchange.h"

namespace lahar::coupling {

namespace {

template <class Real>
struct Make {
  using Exchange = std::unique_ptr<GrainExchange<Real>>;
  const lbm::FluidOptions& fluid;
  Exchange operator()(const ResolvedGrains& o) const {
    return std::make_unique<ResolvedExchange<Real>>(o, fluid.weighting);
  }
  Exchange operator()(const AveragedGrains& o) const { return std::make_unique<AveragedExchange<Real>>(o, fluid); }
  Exchange operator()(const UncoupledGrains&) const { return nullptr; }
};

}  // namespace

template <class Real>
std::unique_ptr<GrainExchange<Real>> make_grain_exchange(const GrainExchangeChoice& choice,
                                                         const lbm::FluidOptions& fluid) {
  return std::visit(Make<Real>{fluid}, choice);
}

template std::unique_ptr<GrainExchange<float>> make_grain_exchange<float>(const GrainExchangeChoice&,
                                                                          const lbm::FluidOptions&);
template std::unique_ptr<GrainExchange<double>> make_grain_exchange<double>(const GrainExchangeChoice&,
                                                                            const lbm::FluidOptions&);

}  // namespace lahar::coupling

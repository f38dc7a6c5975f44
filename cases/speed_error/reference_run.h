#pragma once
// The finest run of a problem that has no exact answer: run once, when a trial first asks for it, and not in its time.
#include <functional>
#include <memory>
#include <optional>

namespace lahar::validate {

template <class Result>
class ReferenceRun {
 public:
  explicit ReferenceRun(std::function<Result()> run) : run_(std::move(run)) {}

  const Result& result() const {
    if (!*kept_) *kept_ = run_();
    return **kept_;
  }

 private:
  std::function<Result()> run_;
  std::shared_ptr<std::optional<Result>> kept_ = std::make_shared<std::optional<Result>>();  // of all copies
};

}  // namespace lahar::validate

#pragma once
// The alternatives of a variant in which implementations are registered, for suites that run over all of them.
#include <gtest/gtest.h>

#include <variant>
#include <vector>

namespace lahar {

template <class Variant, class... More>
struct AlternativesOf;
template <class... Ts, class... More>
struct AlternativesOf<std::variant<Ts...>, More...> {
  using Types = testing::Types<Ts..., More...>;
  static std::vector<std::variant<Ts...>> values() { return {Ts{}...}; }
};

/// As types, for TYPED_TEST_SUITE, with more of them after.
template <class Variant, class... More>
using AlternativeTypes = typename AlternativesOf<Variant, More...>::Types;

/// As values, each as it is by default.
template <class Variant>
std::vector<Variant> alternatives() {
  return AlternativesOf<Variant>::values();
}

}  // namespace lahar

#pragma once
// What else hangs on the posts of a barrier: kinds of elements, and lists of them.
//
// A kind is a struct of what a scene sets, with
//   name, meaning        its table [[barrier.posts.NAME]] in a scene, and what docs/scene_reference.md says of it
//   component            what results call all of the kind together
//   add_to(construction, wires)   adds one to a barrier whose nets and posts stand (construction.h) and its wires to
//                        those of the kind; throws InputError where it cannot stand
//   beads(spec)          about how many beads it adds, for estimates
//   bond_limit(spec)     largest stable time step of its bonds, s
#include <array>
#include <string_view>
#include <tuple>
#include <vector>

#include "barrier/retaining.h"

namespace lahar::barrier {

/// A list of elements of each kind.
template <class... Kinds>
class ElementLists {
 public:
  static constexpr std::array<std::string_view, sizeof...(Kinds)> components{Kinds::component...};

  template <class Kind>
  [[nodiscard]] std::vector<Kind>& of() {
    return std::get<std::vector<Kind>>(lists_);
  }
  template <class Kind>
  [[nodiscard]] const std::vector<Kind>& of() const {
    return std::get<std::vector<Kind>>(lists_);
  }
  /// Calls f(list, number of the kind) for every kind in turn.
  template <class F>
  void for_each_kind(const F& f) {
    std::size_t kind = 0;
    std::apply([&](auto&... lists) { (f(lists, kind++), ...); }, lists_);
  }
  template <class F>
  void for_each_kind(const F& f) const {
    std::size_t kind = 0;
    std::apply([&](const auto&... lists) { (f(lists, kind++), ...); }, lists_);
  }
  bool operator==(const ElementLists&) const = default;

 private:
  std::tuple<std::vector<Kinds>...> lists_;
};

/// All kinds, in the order in which they are built. Who stands here is a table of the scene, whose keys are in
/// cases/scene/schema.h, and a component of the results.
using Elements = ElementLists<RetainingCable>;

}  // namespace lahar::barrier

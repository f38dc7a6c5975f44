#pragma once
// The contact laws that there are.
#include <variant>

#include "dem/contact/hertz_mindlin.h"
#include "dem/contact/linear.h"

namespace lahar::dem {

/// All of them. Who stands here is a choice of `solids.contact_law`, acts between spheres, walls and wires and runs
/// through the property suite; members that a scene sets have their keys in cases/scene/schema.h.
using ContactLawChoice = std::variant<HertzMindlin, LinearSpringDashpot>;

}  // namespace lahar::dem

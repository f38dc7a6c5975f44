#pragma once
// Vectors of a state as numbers of a checkpoint (Archive::pieces).
#include <initializer_list>

#include "core/archive.h"

namespace lahar::coupling {

/// Three numbers each, from `stored` on.
inline void transfer_vectors(const Archive& archive, std::initializer_list<Vec3*> vectors, double* stored) {
  for (Vec3* const v : vectors)
    for (int a = 0; a < 3; ++a, ++stored) {
      if (archive.loading())
        (*v)[a] = *stored;
      else
        *stored = (*v)[a];
    }
}

}  // namespace lahar::coupling

#pragma once
// Hexagonal mesh of double-twisted wire as nodes joined by wires that only pull: remote bonds (Bertrand et al. 2008;
// Thoeni et al. 2013, Comput. Geotech. 49:158; Li & Zhao 2018). A node stands where a twist begins or ends, and carries
// the mass of the wire around it. Flow meets the nodes as spheres; what is smaller than a mesh passes.
//
// Twists stand along `up`, in rows: those of every other row are half a mesh aside. From the upper end of a twist two
// single wires lead to the lower ends of the next row's.
#include <array>
#include <cstdint>
#include <vector>

#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::barrier {

/// Tensile law of a wire: three straight pieces from 0 through these points; at the last it breaks.
struct WireLaw {
  std::array<double, 3> strain{}, force{};  ///< 1, N; both rising, and the curve never steeper than before
};

struct HexagonalMesh {
  double mesh_width = 0;     ///< m, between neighbouring twists of a row
  double mesh_height = 0;    ///< m, of a hexagon from the lower end of its lower wires to the upper end of its upper
  double twist_length = 0;   ///< m, below mesh_height
  double wire_diameter = 0;  ///< m, of the single wire
  double wire_density = 0;   ///< kg/m^3, of its steel
  double node_diameter = 0;  ///< m, of the spheres that the flow meets
  WireLaw single, twist;
  bool plastic_unloading = true;
  double damping_ratio = 0;

  [[nodiscard]] double row_distance() const { return 0.5 * (mesh_height + twist_length); }
  [[nodiscard]] double single_length() const;
  /// Of a node: a twist's half (two wires) and the halves of two single wires, kg.
  [[nodiscard]] double node_mass() const;
};

/// A mesh that was built. Nodes and bonds are contiguous.
struct MeshPart {
  dem::ParticleId first_node = 0;
  std::size_t nodes = 0, first_bond = 0, bonds = 0;
  int columns = 0, rows = 0;                               ///< meshes across, rows of twists
  std::vector<dem::ParticleId> left, right, lower, upper;  ///< nodes on the edges, from below or from the left
};

/// Where it stands: the node at its lower left corner, unit vectors.
struct MeshPlace {
  Vec3 corner = Vec3::Zero(), across = Vec3::UnitY(), up = Vec3::UnitZ();
};

/// Bond sort of a wire of this length: tension only, breaking at the last point of its law. Throws InputError for a law
/// that does not rise, whose later pieces are steeper than the earlier, or which goes on straight after its first point
/// where it unloads plastically.
[[nodiscard]] dem::BondSort wire_law_bond(const WireLaw& law, double length, const HexagonalMesh& mesh);

/// Adds a panel of `columns` meshes across and `rows` rows of twists, at rest. Throws InputError for a mesh that makes
/// no sense.
MeshPart add_hexagonal_mesh(const HexagonalMesh& mesh, int columns, int rows, const MeshPlace& place, int material,
                            std::int32_t body, dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::barrier

#pragma once
// XDMF: the small XML file that tells ParaView how to read arrays in an HDF5 file. The form is the one that both of
// ParaView's readers (XDMF2 and XDMF3) accept: explicit connectivity, all attributes spelled out, one uniform grid per
// time in one temporal collection, whole datasets only.
#include <cstdint>
#include <string>
#include <vector>

namespace lahar::cases {

enum class XdmfType { float32, int32, uint8 };
enum class XdmfTopology { points, segments };
enum class XdmfCentre { node, cell };

/// A dataset of `rows` x `width` numbers, named as FILE:/PATH.
struct XdmfArray {
  std::string location;
  std::uint64_t rows = 0;
  int width = 1;
  XdmfType type = XdmfType::float32;
};

struct XdmfField {
  std::string name;
  XdmfCentre centre = XdmfCentre::node;
  XdmfArray array;  ///< width 1 is a scalar, 3 a vector
};

/// What one time shows.
struct XdmfGrid {
  std::string name;
  double time_s = 0;
  XdmfTopology topology = XdmfTopology::points;
  XdmfArray connectivity, points;
  std::vector<XdmfField> fields;
};

/// The <Grid> element of one time.
[[nodiscard]] std::string xdmf_grid(const XdmfGrid& grid);

/// A complete document around the grids of all times.
[[nodiscard]] std::string xdmf_document(const std::string& collection_name, const std::string& grids);

}  // namespace lahar::cases

#include "cases/files/xdmf.h"

#include <fmt/format.h>

namespace lahar::cases {

namespace {

std::string data_item(const XdmfArray& array) {
  const char* type = array.type == XdmfType::float32 ? "Float" : array.type == XdmfType::int32 ? "Int" : "UChar";
  const int bytes = array.type == XdmfType::uint8 ? 1 : 4;
  const std::string dimensions =
      array.width == 1 ? fmt::format("{}", array.rows) : fmt::format("{} {}", array.rows, array.width);
  return fmt::format(R"(<DataItem Format="HDF" NumberType="{}" Precision="{}" Dimensions="{}">{}</DataItem>)", type,
                     bytes, dimensions, array.location);
}

std::string field_element(const XdmfField& field) {
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", field.name,
                     field.array.width == 3 ? "Vector" : "Scalar", field.centre == XdmfCentre::node ? "Node" : "Cell",
                     data_item(field.array));
}

}  // namespace

std::string xdmf_grid(const XdmfGrid& grid) {
  const bool points = grid.topology == XdmfTopology::points;
  std::string text = fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n", grid.name);
  text += fmt::format("        <Time Value=\"{:.9g}\"/>\n", grid.time_s);
  text += fmt::format(
      "        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">{}</Topology>\n",
      points ? "Polyvertex" : "Polyline", grid.connectivity.rows, points ? 1 : 2, data_item(grid.connectivity));
  text += fmt::format("        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n", data_item(grid.points));
  for (const XdmfField& field : grid.fields) text += field_element(field);
  return text + "      </Grid>\n";
}

std::string xdmf_document(const std::string& collection_name, const std::string& grids) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<Xdmf Version=\"2.0\">\n"
      "  <Domain>\n"
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
      "{}"
      "    </Grid>\n"
      "  </Domain>\n"
      "</Xdmf>\n",
      collection_name, grids);
}

}  // namespace lahar::cases

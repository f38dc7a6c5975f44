// Meshes and heights from files: what can be read, and every way in which a file can be wrong.
#include <gtest/gtest.h>

#include <cstring>

#include "cases/files/heightmap_file.h"
#include "cases/files/mesh_file.h"
#include "core/mesh_distance.h"
#include "tests/cases/files/shape_texts.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

/// The unit box that every format below describes, whatever the order of its triangles.
void expect_box(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.points.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(open_edges(mesh), 0u);
  EXPECT_NEAR(signed_volume(mesh), 1, 1e-6);
  EXPECT_LT(bounds_of(mesh).lower.norm(), 1e-6);
}

TEST(MeshFile, EveryFormatGivesTheBox) {
  const scene::ScratchFolder scratch;
  const TriangleMesh box = box_mesh(Vec3::Zero(), Vec3::Ones());
  expect_box(read_closed_mesh(scratch.write("text.stl", stl_text(box))));
  expect_box(read_closed_mesh(scratch.write("binary.STL", stl_bytes(box))));
  expect_box(read_closed_mesh(scratch.write("box.obj", obj_text(box))));
  expect_box(read_closed_mesh(scratch.write("text.ply", ply_text(box))));
  expect_box(read_closed_mesh(scratch.write("little.ply", ply_bytes(box, false))));
  expect_box(read_closed_mesh(scratch.write("big.ply", ply_bytes(box, true))));
  const std::string mark = "\xEF\xBB\xBF";  // before texts in UTF-8
  expect_box(read_closed_mesh(scratch.write("marked.stl", mark + stl_text(box))));
  expect_box(read_closed_mesh(scratch.write("marked.obj", mark + obj_text(box))));
  expect_box(read_closed_mesh(scratch.write("marked.ply", mark + ply_text(box))));
  TriangleMesh inwards = box;
  flip(inwards);
  expect_box(read_closed_mesh(scratch.write("inwards.stl", stl_text(inwards))));
}

TEST(MeshFile, FacesOfObjMayBePolygonsAndCountBackwards) {
  const TriangleMesh m =
      parse_obj("# a square\nv 0 0 0\nv 1 0 0 # first\nvn 0 0 1\nv 1 1 0\nv 0 1 0\nf 1//1 2//1 -2//1 4//1\n");
  ASSERT_EQ(m.triangles.size(), 2u);
  EXPECT_EQ(m.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

/// Two arms along x and z with caps at the ends of y: faces of any number of corners, counted from 1, as an OBJ.
std::string l_shape(const std::string& caps) {
  std::string text;
  for (const double y : {0.1, 0.9})
    for (const auto& [x, z] : {std::pair{0.9, 0.1}, {0.9, 0.3}, {0.3, 0.3}, {0.3, 0.9}, {0.1, 0.9}, {0.1, 0.1}})
      text += fmt::format("v {} {} {}\n", x, y, z);
  return text + caps + "f 2 1 7 8\nf 3 2 8 9\nf 4 3 9 10\nf 5 4 10 11\nf 6 5 11 12\nf 1 6 12 7\n";
}

/// The same as a PLY of text with caps of six corners.
std::string l_shape_in_ply() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 12\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 8\nproperty list uchar int vertex_indices\nend_header\n";
  for (const double y : {0.1, 0.9})
    for (const auto& [x, z] : {std::pair{0.9, 0.1}, {0.9, 0.3}, {0.3, 0.3}, {0.3, 0.9}, {0.1, 0.9}, {0.1, 0.1}})
      text += fmt::format("{} {} {}\n", x, y, z);
  return text +
         "6 0 1 2 3 4 5\n6 11 10 9 8 7 6\n4 1 0 6 7\n4 2 1 7 8\n4 3 2 8 9\n4 4 3 9 10\n4 5 4 10 11\n4 0 5 11 6\n";
}

/// No triangle of a cap may hang in the notch: distances there are those of a body cut by hand.
TEST(MeshFile, ConcaveFacesAreCutWithinThemselves) {
  const scene::ScratchFolder scratch;
  const std::string polygons = "f 1 2 3 4 5 6\nf 12 11 10 9 8 7\n";
  const std::string by_hand = "f 3 4 5\nf 3 5 6\nf 3 6 1\nf 3 1 2\nf 11 10 9\nf 12 11 9\nf 7 12 9\nf 8 7 9\n";
  const auto distances = [](const TriangleMesh& mesh) {
    EXPECT_NEAR(signed_volume(mesh), 0.8 * 0.28, 1e-12);
    return sample_distance(mesh, Vec3::Zero(), Vec3::Ones(), 0.02, 0.2);
  };
  const auto right = distances(read_closed_mesh(scratch.write("hand.obj", l_shape(by_hand))));
  const auto obj = distances(read_closed_mesh(scratch.write("l.obj", l_shape(polygons))));
  const auto ply = distances(read_closed_mesh(scratch.write("l.ply", l_shape_in_ply())));
  EXPECT_NEAR(right->distance({0.5, 0.12, 0.4}), 0.1, 1e-5);
  for (const Vec3& p : {Vec3(0.5, 0.12, 0.4), Vec3(0.5, 0.88, 0.5), Vec3(0.4, 0.1, 0.6), Vec3(0.2, 0.12, 0.5)}) {
    EXPECT_NEAR(obj->distance(p), right->distance(p), 1e-6) << p.transpose();
    EXPECT_NEAR(ply->distance(p), right->distance(p), 1e-6) << p.transpose();
  }
}

/// Two boxes side by side, each as it is or inside out.
TriangleMesh two_boxes(bool first_turned, bool second_turned) {
  TriangleMesh mesh = box_mesh(Vec3(0.1, 0.1, 0.1), Vec3(0.5, 0.5, 0.5));
  TriangleMesh second = box_mesh(Vec3(0.6, 0.6, 0.1), Vec3(0.92, 0.92, 0.42));
  if (first_turned) flip(mesh);
  if (second_turned) flip(second);
  const auto start = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), second.points.begin(), second.points.end());
  for (const auto& t : second.triangles) mesh.triangles.push_back({t[0] + start, t[1] + start, t[2] + start});
  return mesh;
}

TEST(MeshFile, AWholeFileInsideOutIsTurned) {
  const scene::ScratchFolder scratch;
  for (const bool turned : {false, true}) {
    const TriangleMesh mesh = read_closed_mesh(scratch.write("two.obj", obj_text(two_boxes(turned, turned))));
    EXPECT_NEAR(signed_volume(mesh), std::pow(0.4, 3) + std::pow(0.32, 3), 1e-12) << turned;
  }
}

struct BadFile {
  std::string name, bytes, part;
  friend std::ostream& operator<<(std::ostream& out, const BadFile& f) { return out << f.part; }
};
class BadMesh : public testing::TestWithParam<BadFile> {};

TEST_P(BadMesh, SaysWhatIsWrong) {
  const scene::ScratchFolder scratch;
  const auto file = scratch.write(GetParam().name, GetParam().bytes);
  try {
    read_closed_mesh(file);
    FAIL() << "read";
  } catch (const ShapeFileError& e) {
    EXPECT_NE(std::string(e.what()).find(GetParam().part), std::string::npos) << e.what();
  }
}

TriangleMesh open_box() {
  TriangleMesh box = box_mesh(Vec3::Zero(), Vec3::Ones());
  box.triangles.pop_back();
  return box;
}

TriangleMesh mixed_box() {
  TriangleMesh box = box_mesh(Vec3::Zero(), Vec3::Ones());
  std::swap(box.triangles[0][0], box.triangles[0][1]);
  return box;
}

/// Two faces back to back.
TriangleMesh flat() {
  TriangleMesh m;
  m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  m.triangles = {{0, 1, 2}, {0, 2, 1}};
  return m;
}

const std::string box_bytes = stl_bytes(box_mesh(Vec3::Zero(), Vec3::Ones()));
const std::string ply_head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n";

INSTANTIATE_TEST_SUITE_P(
    MeshFile, BadMesh,
    testing::Values(
        BadFile{"a.step", "", "expected .stl, .ply or .obj"}, BadFile{"a.stl", "", "is no STL file"},
        BadFile{"a.stl", "solid nothing\nendsolid\n", "has no triangles, expected"},
        BadFile{"a.stl", box_bytes.substr(0, box_bytes.size() - 1), "is no STL file"},
        BadFile{"a.stl", "solid s\nvertex 0 0\n", "line 2: expected \"vertex x y z\""},
        BadFile{"a.stl", "solid s\nvertex 0 0 up\n", "line 2: \"up\" is no finite number"},
        BadFile{"a.stl", "solid s\nvertex 0 0 nan\n", "is no finite number"},
        BadFile{"a.stl", "solid s\n\nvertex 0 0 0\nendloop\n", "line 4: a facet has 1 corners"},
        BadFile{"a.stl", "solid s\nvertex 0 0 0\n", "ends inside a facet"},
        BadFile{"a.stl", "solid s\ntriangle 0 0 0\n", "\"triangle\" is no word of an STL file"},
        BadFile{"a.stl", stl_text(open_box()), "outside, expected none"},
        BadFile{"a.stl", stl_text(mixed_box()), "is not closed: 3 edges"},
        BadFile{"a.stl", stl_text(flat()), "encloses no volume"},
        BadFile{"a.obj", obj_text(two_boxes(false, true)), "from (0.6, 0.6, 0.1) to (0.92, 0.92, 0.42)"},
        BadFile{"a.obj", obj_text(two_boxes(true, false)), "from (0.1, 0.1, 0.1) to (0.5, 0.5, 0.5)"},
        BadFile{"a.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n", "line 5: a face cannot be cut"},
        BadFile{"a.ply",
                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0\n1 1\n1 0\n0 1\n3 0 1 2\n4 0 1 2 3\n",
                "face 1: a face cannot be cut"},
        BadFile{"a.obj", "v 0 0\n", "line 1: expected \"v x y z\""},
        BadFile{"a.obj", "v 0 0 0\nf 1 1\n", "fewer than 3 corners"},
        BadFile{"a.obj", "v 0 0 0\nf 1 1 2\n", "line 2: corner 2 does not exist"},
        BadFile{"a.obj", "v 0 0 0\nf 1 0 1\n", "corner 0 does not exist"},
        BadFile{"a.obj", "v 0 0 0\nf 1 x 1\n", "is no whole number"}, BadFile{"a.ply", "plz\n", "expected \"ply\""},
        BadFile{"a.ply", "ply\n", "ends inside its header"}, BadFile{"a.ply", "ply\nformat utf 1\n", "unknown format"},
        BadFile{"a.ply", "ply\nelement vertex -1\n", "negative number"},
        BadFile{"a.ply", "ply\nelement vertex 1\nproperty quad x\n", "unknown type"},
        BadFile{"a.ply", "ply\nsurprise\n", "\"surprise\" is not understood"},
        BadFile{"a.ply", ply_head + "end_header\n", "ends too early"},
        BadFile{"a.ply", "ply\nelement vertex 1000000000000000000\nend_header\n", "has no triangles"},
        BadFile{"a.ply", "ply\nelement dust 1000000000000000000\nproperty float x\nend_header\n1 2\n",
                "says that it has 1000000000000000000 of \"dust\""},
        BadFile{"a.ply", ply_head + "end_header\nwide\n", "\"wide\" is no number"},
        BadFile{"a.ply", ply_head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0\n3 0 1 2\n",
                "corner 1 of a face does not exist"}));

TEST(MeshFile, UnreadableFiles) {
  const scene::ScratchFolder scratch;
  EXPECT_THROW(read_closed_mesh(scratch.path() / "none.stl"), ShapeFileError);
  std::filesystem::create_directory(scratch.path() / "folder.stl");
  EXPECT_THROW(read_closed_mesh(scratch.path() / "folder.stl"), ShapeFileError);
  std::filesystem::resize_file(scratch.write("huge.stl", ""), std::uintmax_t{4} << 30);  // no byte of it is stored
  EXPECT_THROW(read_closed_mesh(scratch.path() / "huge.stl"), ShapeFileError);
}

const std::string grid_text =
    "ncols 3\nNROWS 2\nxllcorner 10\nyllcorner 20\ncellsize 2\nNODATA_value -9999\n1 2 3\n4 5 6\n";

TEST(HeightmapFile, AsciiGrid) {
  const Heightmap map = parse_heightmap(grid_text, 0);
  EXPECT_EQ(map.columns, 3u);
  EXPECT_EQ(map.rows, 2u);
  EXPECT_EQ(map.x, 11);
  EXPECT_EQ(map.y, 21);
  EXPECT_EQ(map.at(0, 0), 4);  // the last row has the smallest y
  EXPECT_EQ(map.at(2, 1), 3);
  const Heightmap there = placed(map, 2, Vec3(-20, 0, 1));
  EXPECT_EQ(there.x, 2);
  EXPECT_EQ(there.spacing, 4);
  EXPECT_EQ(there.highest(), 13);
}

TEST(HeightmapFile, PlainMatrix) {
  const Heightmap map = parse_heightmap("1 2\n\n3 4\n5 6\n", 0.5);
  EXPECT_EQ(map.rows, 3u);
  EXPECT_EQ(map.at(1, 2), 2);
  EXPECT_EQ(map.x, 0);
  EXPECT_EQ(map.spacing, 0.5);
}

/// A plane stays one, the ground goes on level beyond the map, and what is far outside is left out.
TEST(HeightmapFile, TerrainCoversTheRectangle) {
  std::string text;
  for (int row = 0; row < 4; ++row) text += "0 1 2 3 4 5\n";
  const Heightmap map = parse_heightmap(text, 1);
  const TriangleMesh mesh = terrain(map, Vec3(-2, -1, 0), Vec3(3.5, 7, 0));
  const Bounds b = bounds_of(mesh);
  EXPECT_EQ(b.lower, Vec3(-2, -1, 0));
  EXPECT_EQ(b.upper, Vec3(4, 7, 4));
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    EXPECT_GT(normal.z(), 0);
    area += normal.z() / 2;
  }
  EXPECT_NEAR(area, 6 * 8, 1e-12);
  for (const Vec3& p : mesh.points) EXPECT_EQ(p.z(), std::max(0.0, p.x()));
  EXPECT_EQ(bounds_of(terrain(map, Vec3(50, 50, 0), Vec3(60, 60, 0))).lower, Vec3(50, 50, 5));
}

class BadHeights : public testing::TestWithParam<BadFile> {};

TEST_P(BadHeights, SaysWhatIsWrong) {
  try {
    parse_heightmap(GetParam().bytes, GetParam().name == "with spacing" ? 1 : 0);
    FAIL() << "read";
  } catch (const ShapeFileError& e) {
    EXPECT_NE(std::string(e.what()).find(GetParam().part), std::string::npos) << e.what();
  }
}

std::string grid_with(const std::string& from, const std::string& to) {
  std::string text = grid_text;
  return text.replace(text.find(from), from.size(), to);
}

INSTANTIATE_TEST_SUITE_P(
    HeightmapFile, BadHeights,
    testing::Values(BadFile{"", "", "less than two rows"}, BadFile{"", "1 2\n3 4\n", "expected spacing_m"},
                    BadFile{"with spacing", "1 2\n3\n", "line 2: has 1 numbers, expected 2"},
                    BadFile{"with spacing", "1 2\n3 x4\n", "line 2: \"x4\" is no finite number"},
                    BadFile{"with spacing", "1 2\n3 inf\n", "is no finite number"},
                    BadFile{"with spacing", "1 2 3\n", "less than two rows"},
                    BadFile{"", grid_with("ncols 3", "columns 3"), "line 1: \"columns\" is no line"},
                    BadFile{"", grid_with("ncols 3\n", ""), "has no ncols"},
                    BadFile{"", grid_with("NROWS 2", "NROWS 4"), "expected 4 rows of 3"},
                    BadFile{"", grid_with("ncols 3", "ncols 4"), "ends inside a row"},
                    BadFile{"", grid_with("xllcorner 10\n", ""), "neither xllcorner nor xllcenter"},
                    BadFile{"with spacing", grid_text, "expected no spacing_m with it"},
                    BadFile{"", grid_with("cellsize 2", "cellsize 0"), "cellsize that is not above 0"},
                    BadFile{"", grid_with("5 6", "5 -9999"), "has 1 points without data"},
                    BadFile{"", grid_with("NODATA_value -9999\n1", "-9999"), "has 1 points without data"}));

}  // namespace
}  // namespace lahar::cases

#include "cases/files/particle_writer.h"

#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "tests/cases/files/small_disk.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

struct System {
  dem::Particles particles;
  dem::Bonds bonds;
};

System three_beads_and_a_grain() {
  System s;
  for (int n = 0; n < 3; ++n)
    s.particles.add({.position = Vec3(n, 0, 0.25),
                     .radius = 0.1,
                     .density = 7800,
                     .kind = dem::ParticleKind::bead,
                     .state = n == 0 ? dem::ParticleState::fixed : dem::ParticleState::free,
                     .body = 5});
  s.particles.add({.position = Vec3(0, 2, 0),
                   .velocity = Vec3(1, -2, 3),
                   .angular_velocity = Vec3(0, 0, 9),
                   .radius = 0.5,
                   .density = 2600});
  s.bonds.add_sort({});
  s.bonds.add({0, 1, 0}, s.particles);
  s.bonds.add({1, 2, 0}, s.particles);
  s.bonds.axial_force[1] = 125;
  s.bonds.elongation[1] = 0.5;
  return s;
}

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// Checks that tags are properly nested and returns how often each occurs.
std::map<std::string, int> elements(const std::string& xml) {
  std::map<std::string, int> counts;
  std::vector<std::string> open;
  const std::regex tag("<(/?)([A-Za-z]+)((?:\\s+[A-Za-z]+=\"[^\"<]*\")*)\\s*(/?)>");
  for (std::sregex_iterator m(xml.begin(), xml.end(), tag), end; m != end; ++m) {
    const std::string name = (*m)[2];
    if ((*m)[1].length() == 0) {
      ++counts[name];
      if ((*m)[4].length() == 0) open.push_back(name);
    } else {
      EXPECT_FALSE(open.empty() || open.back() != name) << "</" << name << "> closes nothing";
      if (!open.empty()) open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty()) << "unclosed <" << (open.empty() ? "" : open.back()) << ">";
  EXPECT_EQ(std::count(xml.begin(), xml.end(), '<'), std::count(xml.begin(), xml.end(), '>'));
  return counts;
}

// Every DataItem must name an existing dataset and repeat its dimensions. Returns how many there are.
int check_data_items(const TestFolder& folder, const std::string& xml) {
  int count = 0;
  const Hdf5File file = Hdf5File::open_for_reading(folder / "particles.h5");
  const std::regex item("<DataItem[^>]*Dimensions=\"([^\"]*)\">particles.h5:([^<]*)</DataItem>");
  for (std::sregex_iterator m(xml.begin(), xml.end(), item), end; m != end; ++m, ++count) {
    std::istringstream stated((*m)[1]);
    const std::vector<std::uint64_t> dimensions{std::istream_iterator<std::uint64_t>(stated), {}};
    EXPECT_EQ(file.dimensions((*m)[2]), dimensions) << (*m)[2];
  }
  return count;
}

TEST(ParticleWriter, FramesReadBack) {
  const TestFolder folder;
  System s = three_beads_and_a_grain();
  ParticleWriter writer(folder.path());
  writer.write(0.5, s.particles, s.bonds);
  s.particles.position.set(3, Vec3(7, 8, 9));
  s.bonds.intact[0] = 0;
  writer.write(1.5, s.particles, s.bonds);

  // Not closed.
  EXPECT_EQ(Hdf5File::open_for_reading(folder / "particles.h5").members("/frames").size(), 1U);
  writer.flush();
  const Hdf5File file = Hdf5File::open_for_reading(folder / "particles.h5");
  EXPECT_EQ(file.members("/frames").size(), 2U);
  EXPECT_EQ(file.number_attribute("/frames/000001", "time_s"), 1.5);
  EXPECT_EQ(file.dimensions("/frames/000000/position"), (std::vector<std::uint64_t>{4, 3}));
  EXPECT_EQ(file.read<float>("/frames/000001/position")[10], 8.0F);
  EXPECT_EQ(file.text_attribute("/frames/000000/position", "unit"), "m");
  EXPECT_EQ(file.read<float>("/frames/000000/velocity")[10], -2.0F);
  EXPECT_EQ(file.read<float>("/frames/000000/angular_velocity")[11], 9.0F);
  EXPECT_EQ(file.read<std::uint8_t>("/frames/000000/state"), (std::vector<std::uint8_t>{1, 0, 0, 0}));
  EXPECT_EQ(file.read<std::uint8_t>("/constant/000000/kind"), (std::vector<std::uint8_t>{1, 1, 1, 0}));
  EXPECT_EQ(file.read<std::int32_t>("/constant/000000/body"), (std::vector<std::int32_t>{5, 5, 5, -1}));
  EXPECT_EQ(file.read<float>("/constant/000000/radius")[3], 0.5F);
  EXPECT_EQ(file.read<std::int32_t>("/constant/000000/connectivity"), (std::vector<std::int32_t>{0, 1, 1, 2}));
  EXPECT_EQ(file.read<float>("/frames/000000/axial_force"), (std::vector<float>{0, 125}));
  EXPECT_EQ(file.read<float>("/frames/000000/elongation"), (std::vector<float>{0, 0.5F}));
  EXPECT_EQ(file.read<std::uint8_t>("/frames/000001/intact"), (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(file.members("/constant").size(), 1U) << "constants must be stored once";
}

TEST(ParticleWriter, FilesAreInTheOrderOfIds) {
  const TestFolder plain, moved;
  System s = three_beads_and_a_grain();
  ParticleWriter(plain.path()).write(0, s.particles, s.bonds);
  s.particles.renumber(dem::Renumbering({3, 1, 0, 2}));
  s.bonds.find_ends(s.particles);
  ParticleWriter(moved.path()).write(0, s.particles, s.bonds);
  const Hdf5File a = Hdf5File::open_for_reading(plain / "particles.h5");
  const Hdf5File b = Hdf5File::open_for_reading(moved / "particles.h5");
  for (const char* name : {"/frames/000000/position", "/frames/000000/velocity", "/constant/000000/radius"})
    EXPECT_EQ(a.read<float>(name), b.read<float>(name)) << name;
  for (const char* name : {"/constant/000000/id", "/constant/000000/body", "/constant/000000/connectivity"})
    EXPECT_EQ(a.read<std::int32_t>(name), b.read<std::int32_t>(name)) << name;
}

TEST(ParticleWriter, XdmfIsWellFormedAndMatchesTheArrays) {
  const TestFolder folder;
  const System s = three_beads_and_a_grain();
  ParticleWriter writer(folder.path());
  for (int n = 0; n < 3; ++n) writer.write(0.1 * n, s.particles, s.bonds);
  writer.close();
  const std::string points = content(folder / "particles.xmf"), lines = content(folder / "bonds.xmf");
  EXPECT_EQ(elements(points)["Grid"], 4);
  EXPECT_EQ(elements(lines)["Time"], 3);
  EXPECT_EQ(check_data_items(folder, points), 3 * (2 + 7));
  EXPECT_EQ(check_data_items(folder, lines), 3 * (2 + 4));
  EXPECT_NE(points.find("<Time Value=\"0.2\"/>"), std::string::npos);
  EXPECT_NE(points.find("TopologyType=\"Polyvertex\" NumberOfElements=\"4\" NodesPerElement=\"1\""), std::string::npos);
  EXPECT_NE(lines.find("TopologyType=\"Polyline\" NumberOfElements=\"2\" NodesPerElement=\"2\""), std::string::npos);
}

TEST(ParticleWriter, NewParticlesBringNewConstants) {
  const TestFolder folder;
  System s = three_beads_and_a_grain();
  ParticleWriter writer(folder.path());
  writer.write(0, s.particles, s.bonds);
  s.particles.add({.position = Vec3(1, 1, 1), .radius = 0.25, .density = 2600});
  writer.write(1, s.particles, s.bonds);
  writer.write(2, s.particles, s.bonds);
  writer.flush();
  const Hdf5File file = Hdf5File::open_for_reading(folder / "particles.h5");
  EXPECT_EQ(file.members("/constant"), (std::vector<std::string>{"000000", "000001"}));
  EXPECT_EQ(file.read<float>("/constant/000001/radius")[4], 0.25F);
  check_data_items(folder, content(folder / "particles.xmf"));
}

TEST(ParticleWriter, WorksWithoutParticlesOrBonds) {
  const TestFolder folder;
  ParticleWriter writer(folder.path());
  writer.write(0, {}, {});
  dem::Particles one;
  one.add({.position = Vec3::Zero(), .radius = 1, .density = 1});
  writer.write(1, one, {});
  writer.flush();
  EXPECT_EQ(elements(content(folder / "particles.xmf"))["Time"], 1);
  EXPECT_FALSE(std::filesystem::exists(folder / "bonds.xmf"));
}

/// A disk that was full for a moment: the frame that was not written in full is in nobody's file.
TEST(ParticleWriter, AfterARefusedWriteOthersSeeTheLastWholeFile) {
  const TestFolder folder;
  const int status = status_of_child([&] {
    int told = 0;
    {
      System s = three_beads_and_a_grain();
      for (int n = 0; n < 20000; ++n)
        s.particles.add(
            {.position = Vec3(std::sin(1e4 * n * n), std::cos(1e4 * n * n), n), .radius = 0.1, .density = 1});
      ParticleWriter writer(folder.path());
      writer.write(0, s.particles, s.bonds);
      writer.flush();
      try {
        const SmallDisk disk(std::filesystem::file_size(folder / "particles.h5") + 20000);
        writer.write(1, s.particles, s.bonds);
      } catch (const FileError&) {
        told = 1;
      }
    }
    _exit(told);
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const Hdf5File file = Hdf5File::open_for_reading(folder / "particles.h5");
  for (const std::string& frame : file.members("/frames"))
    EXPECT_EQ(file.members("/frames/" + frame).size(), 7U) << frame;
  EXPECT_EQ(file.members("/frames").front(), "000000");
}

}  // namespace
}  // namespace lahar::cases

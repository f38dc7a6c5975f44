#include "cases/files/series_writer.h"

#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

#include "cases/files/series_reader.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

std::vector<double> plain_column(const std::filesystem::path& path, const char* name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space), H5Dclose(dataset), H5Fclose(file);
  return values;
}

TEST(SeriesWriter, ColumnsReadBackWithUnits) {
  const TestFolder folder;
  SeriesWriter writer(folder / "series.h5", 3);
  EXPECT_EQ(writer.declare("force_kN", "kN", "sum over the lower cables"), 0U);
  EXPECT_EQ(writer.declare("front_m", "m", "furthest liquid"), 1U);
  EXPECT_EQ(writer.declare("force_kN", "kN", "again"), 0U);
  for (int n = 0; n < 8; ++n) writer.append(0.1 * n, {1.0 * n, -2.0 * n});
  writer.close();

  EXPECT_EQ(plain_column(folder / "series.h5", "/series/front_m"),
            (std::vector<double>{0, -2, -4, -6, -8, -10, -12, -14}));
  const Series series = read_series(folder / "series.h5");
  ASSERT_EQ(series.time_s.size(), 8U);
  EXPECT_DOUBLE_EQ(series.time_s[7], 0.7);
  ASSERT_NE(series.find("force_kN"), nullptr);
  EXPECT_EQ(series.find("force_kN")->unit, "kN");
  EXPECT_EQ(series.find("force_kN")->description, "sum over the lower cables");
  EXPECT_EQ(series.find("force_kN")->values[5], 5);
  EXPECT_EQ(series.find("other"), nullptr);
}

TEST(SeriesWriter, ALateColumnHasNoValuesBefore) {
  const TestFolder folder;
  {
    SeriesWriter writer(folder / "series.h5", 2);
    writer.declare("a", "m", "");
    for (int n = 0; n < 3; ++n) writer.append(n, {1});
    writer.declare("b", "s", "");
    writer.append(3, {1, 7});
  }
  const Series series = read_series(folder / "series.h5");
  const std::vector<double>& b = series.find("b")->values;
  ASSERT_EQ(b.size(), 4U);
  for (int n = 0; n < 3; ++n) EXPECT_TRUE(std::isnan(b[static_cast<std::size_t>(n)]));
  EXPECT_EQ(b[3], 7);
}

TEST(SeriesWriter, ResumeDropsWhatCameLater) {
  const TestFolder folder;
  {
    SeriesWriter writer(folder / "series.h5");
    writer.declare("a", "m", "");
    writer.declare("dropped", "m", "");
    for (int n = 0; n < 10; ++n) writer.append(n, {1.0 * n, 5.0});
  }
  {
    SeriesWriter writer = SeriesWriter::resume(folder / "series.h5", 4.5);
    EXPECT_EQ(writer.rows(), 5U);
    EXPECT_THROW(writer.declare("a", "km", ""), std::logic_error);
    writer.declare("a", "m", "");
    writer.append(4.5, {-1});
  }
  const Series series = read_series(folder / "series.h5");
  EXPECT_EQ(series.time_s, (std::vector<double>{0, 1, 2, 3, 4, 4.5}));
  EXPECT_EQ(series.find("a")->values, (std::vector<double>{0, 1, 2, 3, 4, -1}));
  EXPECT_EQ(series.find("dropped")->values[4], 5);
  EXPECT_TRUE(std::isnan(series.find("dropped")->values[5]));
}

TEST(SeriesWriter, AKilledRunKeepsItsFlushedRows) {
  const TestFolder folder;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    SeriesWriter writer(folder / "series.h5", 4);
    writer.declare("a", "m", "");
    for (int n = 0; n < 6; ++n) writer.append(n, {2.0 * n});
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
  EXPECT_EQ(read_series(folder / "series.h5").find("a")->values, (std::vector<double>{0, 2, 4, 6}));
}

TEST(SeriesWriter, RefusesMisuse) {
  const TestFolder folder;
  SeriesWriter writer(folder / "series.h5");
  for (const char* name : {"", "time_s", "a/b"}) EXPECT_THROW(writer.declare(name, "m", ""), std::logic_error);
  writer.declare("a", "m", "");
  EXPECT_THROW(writer.declare("a", "s", ""), std::logic_error);
  EXPECT_THROW(writer.append(0, {}), std::logic_error);
  writer.append(1, {0});
  EXPECT_THROW(writer.append(0.5, {0}), std::logic_error);
  writer.close();
  EXPECT_THROW(writer.append(2, {0}), std::logic_error);
}

}  // namespace
}  // namespace lahar::cases

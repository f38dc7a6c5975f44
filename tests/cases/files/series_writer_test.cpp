#include "cases/files/series_writer.h"

#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <thread>

#include "cases/files/series_reader.h"
#include "tests/cases/files/small_disk.h"
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

/// As if a program had been killed while it replaced the packed rows of a column.
void overwrite_chunk(const std::filesystem::path& path, const char* name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), dataset = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t space = H5Dget_space(dataset);
  haddr_t at = 0;
  hsize_t bytes = 0, offset = 0;
  H5Dget_chunk_info(dataset, space, 0, &offset, nullptr, &at, &bytes);
  H5Sclose(space), H5Dclose(dataset), H5Fclose(file);
  std::fstream out(path, std::ios::in | std::ios::out | std::ios::binary);
  out.seekp(static_cast<std::streamoff>(at));
  out << std::string(bytes, 'x');
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

/// A copy that cannot be made is for onlookers: rows go on.
TEST(SeriesWriter, GoesOnWhereThereIsNoRoomForACopy) {
  const TestFolder folder;
  std::filesystem::create_directories((folder / "series.h5.part") / "in the way");
  SeriesWriter writer(folder / "series.h5", 1);
  writer.declare("a", "m", "");
  EXPECT_NO_THROW(writer.append(0, {1}));
  EXPECT_NE(writer.refusal().find("cannot be brought up to date"), std::string::npos) << writer.refusal();
  EXPECT_NO_THROW(writer.append(1, {2}));
  EXPECT_THROW(writer.flush(), CannotCopy);
  writer.close();
  EXPECT_EQ(read_series(folder / "series.h5").find("a")->values, (std::vector<double>{1, 2}));
}

/// A disk that was full for a moment: rows that HDF5 was given before may be lost, and the former file stays.
TEST(SeriesWriter, AfterARefusedWriteOthersSeeTheLastWholeFile) {
  const TestFolder folder;
  const int status = status_of_child([&] {
    int told = 0;
    {
      SeriesWriter writer(folder / "series.h5", 1);
      writer.declare("noise", "m", "");
      const auto noise = [](int n) { return std::sin(1e4 * n * n); };
      for (int n = 0; n < 600; ++n) writer.append(n, {noise(n)});
      writer.flush();
      try {
        const SmallDisk disk(std::filesystem::file_size(folder / "series.h5") + 2000);
        for (int n = 600; n < 20000; ++n) writer.append(n, {noise(n)});
        writer.flush();
      } catch (const CannotCopy&) {
        told = 2;
      } catch (const FileError&) {
        told = 1;
      }
    }
    _exit(told);
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const Series series = read_series(folder / "series.h5");
  ASSERT_GE(series.time_s.size(), 600U);
  for (std::size_t n = 0; n < series.time_s.size(); ++n) {
    ASSERT_EQ(series.time_s[n], static_cast<double>(n));
    ASSERT_EQ(series.find("noise")->values[n], std::sin(1e4 * static_cast<double>(n) * static_cast<double>(n))) << n;
  }
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

/// The first row is copied at once, the next ones with the first that comes a second later.
TEST(SeriesWriter, AKilledRunKeepsWhatWasCopied) {
  for (const bool late : {false, true}) {
    const TestFolder folder;
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      SeriesWriter writer(folder / "series.h5");
      writer.declare("a", "m", "");
      for (int n = 0; n < 3; ++n) writer.append(n, {2.0 * n});
      if (late) std::this_thread::sleep_for(std::chrono::milliseconds(1100));
      if (late) writer.append(3, {6});
      kill(getpid(), SIGKILL);
    }
    waitpid(child, nullptr, 0);
    const std::vector<double> kept = read_series(folder / "series.h5").find("a")->values;
    EXPECT_EQ(kept, late ? (std::vector<double>{0, 2, 4, 6}) : std::vector<double>{0});
  }
}

TEST(SeriesWriter, IsWholeWheneverTheRunIsKilled) {
  const TestFolder folder;
  const auto path = folder / "series.h5";
  std::fflush(nullptr);
  for (int k = 0; k < 40; ++k) {
    const pid_t child = fork();
    if (child == 0) {
      SeriesWriter writer = k == 0 ? SeriesWriter(path) : SeriesWriter::resume(path, 1e9);
      for (const char* name : {"a", "b", "c"}) writer.declare(name, "m", "");
      for (auto n = static_cast<double>(writer.rows());; ++n) {
        writer.append(n, {n, 2 * n, 3 * n});
        writer.flush();
      }
    }
    std::this_thread::sleep_for(std::chrono::microseconds(k == 0 ? 100000 : 3000 + 731 * k));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const Series series = read_series(path);
    ASSERT_FALSE(series.time_s.empty());
    for (std::size_t n = 0; n < series.time_s.size(); ++n)
      ASSERT_EQ(series.find("c")->values[n], 3.0 * static_cast<double>(n)) << "after " << k << " kills";
  }
}

TEST(SeriesWriter, AColumnThatCannotBeReadIsLeftOut) {
  const TestFolder folder;
  const auto path = folder / "series.h5";
  {
    SeriesWriter writer(path);
    writer.declare("a", "m", "");
    writer.declare("b", "m", "");
    for (int n = 0; n < 300; ++n) writer.append(n, {1.0 * n, std::sin(n)});
  }
  overwrite_chunk(path, "/series/b");
  {
    SeriesWriter writer = SeriesWriter::resume(path, 199.5);
    EXPECT_EQ(writer.lost(), std::vector<std::string>{"b"});
    writer.declare("a", "m", "");
    writer.declare("b", "m", "");
    writer.append(200, {200, 7});
  }
  const Series series = read_series(path);
  EXPECT_EQ(series.find("a")->values[150], 150);
  EXPECT_TRUE(std::isnan(series.find("b")->values[150]));
  EXPECT_EQ(series.find("b")->values[200], 7);
}

/// Tables, lists and groups beside the columns.
TEST(SeriesWriter, WhatOthersHaveAddedStays) {
  const TestFolder folder;
  const auto path = folder / "series.h5";
  {
    SeriesWriter writer(path);
    writer.declare("a", "m", "");
    for (int n = 0; n < 10; ++n) writer.append(n, {1.0 * n});
  }
  const std::vector<double> values(12, 0.5);
  {
    Hdf5File file = Hdf5File::open_for_appending(path);
    file.write<double>("/series/table", values, {6, 2});
    file.write<double>("/series/list", values, {12});
    file.write<double>("/series/mine/list", values, {12});
    file.create_column("/series/bare", 4).append(values);
  }
  {
    SeriesWriter writer = SeriesWriter::resume(path, 4.5);
    EXPECT_EQ(writer.lost(), std::vector<std::string>{});
    EXPECT_THROW(writer.declare("table", "m", ""), FileError);
    writer.declare("a", "m", "");
    writer.append(5, {-1});
  }
  const Hdf5File file = Hdf5File::open_for_reading(path);
  EXPECT_EQ(file.dimensions("/series/table"), (std::vector<std::uint64_t>{6, 2}));
  for (const char* name : {"/series/table", "/series/list", "/series/mine/list", "/series/bare"})
    EXPECT_EQ(file.read<double>(name), values) << name;
  const Series series = read_series(path);
  EXPECT_EQ(series.time_s, (std::vector<double>{0, 1, 2, 3, 4, 5}));
  ASSERT_EQ(series.columns.size(), 1U);
  EXPECT_EQ(series.columns[0].values, (std::vector<double>{0, 1, 2, 3, 4, -1}));
}

/// Whatever has become of its attributes.
TEST(SeriesWriter, ResumeShortensTheTimesInAnyCase) {
  const TestFolder folder;
  const auto path = folder / "series.h5";
  {
    SeriesWriter writer(path);
    for (int n = 0; n < 4; ++n) writer.append(n, {});
  }
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Adelete_by_name(file, "/series/time_s", "unit", H5P_DEFAULT);
  H5Fclose(file);
  SeriesWriter::resume(path, 1.5).close();
  EXPECT_EQ(read_series(path).time_s, (std::vector<double>{0, 1}));
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

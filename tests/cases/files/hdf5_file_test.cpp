#include "cases/files/hdf5_file.h"

#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <numeric>

#include "tests/cases/files/small_disk.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

// What a program that knows nothing of this project sees.
struct Plain {
  std::vector<hsize_t> dimensions;
  std::vector<double> values;
  bool shuffled = false, zipped = false;
};

Plain read_plainly(const std::filesystem::path& path, const char* name) {
  Plain p;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
  p.dimensions.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, p.dimensions.data(), nullptr);
  p.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, p.values.data()), 0);
  const hid_t layout = H5Dget_create_plist(dataset);
  for (int f = 0; f < H5Pget_nfilters(layout); ++f) {
    unsigned flags = 0, level = 0;
    std::size_t count = 1;
    const auto filter = H5Pget_filter2(layout, static_cast<unsigned>(f), &flags, &count, &level, 0, nullptr, nullptr);
    p.shuffled |= filter == H5Z_FILTER_SHUFFLE;
    p.zipped |= filter == H5Z_FILTER_DEFLATE && level == 1;
  }
  H5Pclose(layout), H5Sclose(space), H5Dclose(dataset), H5Fclose(file);
  return p;
}

TEST(Hdf5File, WholeArraysReadBackWithThePlainLibrary) {
  const TestFolder folder;
  std::vector<float> values(6);
  std::iota(values.begin(), values.end(), 0.5F);
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  file.write<float>("/group/inner/array", values, {2, 3});
  file.close();
  const Plain p = read_plainly(folder / "a.h5", "/group/inner/array");
  EXPECT_EQ(p.dimensions, (std::vector<hsize_t>{2, 3}));
  EXPECT_EQ(p.values, (std::vector<double>{0.5, 1.5, 2.5, 3.5, 4.5, 5.5}));
  EXPECT_TRUE(p.shuffled);
  EXPECT_TRUE(p.zipped);
}

TEST(Hdf5File, ColumnsGrowAndShrink) {
  const TestFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    Hdf5Column column = file.create_column("/c", 4);
    for (int n = 0; n < 11; ++n) column.append(std::vector<double>{1.0 * n});
    column.truncate(9);
    EXPECT_EQ(column.rows(), 9U);
    column.append(std::vector<double>{-1, -2});
  }
  const Plain p = read_plainly(folder / "a.h5", "/c");
  EXPECT_EQ(p.values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, -1, -2}));
  EXPECT_TRUE(p.shuffled && p.zipped);
}

TEST(Hdf5File, AttributesTypesAndMembers) {
  const TestFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write<std::int64_t>("/g/big", std::vector<std::int64_t>{1LL << 60}, {1});
    file.write<std::uint8_t>("/g/bytes", std::vector<std::uint8_t>{255, 0}, {2});
    file.write<double>("/g/none", std::vector<double>{}, {0, 3});
    file.set_attribute("/g/big", "unit", std::string("m/s²"));
    file.set_attribute("/", "time_s", 0.1);
    file.set_attribute("/", "empty", std::string());
  }
  const Hdf5File file = Hdf5File::open_for_reading(folder / "a.h5");
  EXPECT_EQ(file.members("/g"), (std::vector<std::string>{"big", "bytes", "none"}));
  EXPECT_EQ(file.read<std::int64_t>("/g/big"), std::vector<std::int64_t>{1LL << 60});
  EXPECT_EQ(file.read<std::uint8_t>("/g/bytes"), (std::vector<std::uint8_t>{255, 0}));
  EXPECT_EQ(file.dimensions("/g/none"), (std::vector<std::uint64_t>{0, 3}));
  EXPECT_TRUE(file.read<double>("/g/none").empty());
  EXPECT_EQ(file.text_attribute("/g/big", "unit"), "m/s²");
  EXPECT_EQ(file.number_attribute("/", "time_s"), 0.1);
  EXPECT_EQ(file.text_attribute("/", "empty"), "");
  EXPECT_TRUE(file.contains("/g/big"));
  EXPECT_FALSE(file.contains("/h/big"));
  EXPECT_THROW((void)file.text_attribute("/g/big", "colour"), FileError);
  EXPECT_THROW((void)file.read<double>("/g/absent"), FileError);
}

/// What others put into a file may have any form.
TEST(Hdf5File, OnlyGrowingColumnsWithTheirTextsAreColumns) {
  const TestFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  const std::vector<double> values(6, 0.5);
  for (const char* name : {"/g/column", "/g/bare", "/g/listed"}) file.create_column(name, 4).append(values);
  file.write<double>("/g/table", values, {3, 2});
  file.write<double>("/g/list", values, {6});
  file.write<float>("/g/inner/list", std::vector<float>(6), {6});
  for (const char* name : {"/g/column", "/g/table", "/g/list", "/g/inner"})
    file.set_attribute(name, "unit", std::string("m"));
  file.set_attribute("/g/listed", "unit", 1.0);
  file.close();
  const hid_t plain = H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Lcreate_soft("/g/column", plain, "/g/link", H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(plain);
  file = Hdf5File::open_for_appending(folder / "a.h5");
  EXPECT_EQ(file.columns("/g", {"unit"}), std::vector<std::string>{"column"});
  EXPECT_EQ(file.columns("/g", {}), (std::vector<std::string>{"bare", "column", "listed"}));
  EXPECT_EQ(file.open_column("/g/bare").rows(), 6U);
  for (const char* name : {"/g/table", "/g/list", "/g/inner", "/g/absent"})
    EXPECT_THROW((void)file.open_column(name), FileError) << name;
}

TEST(Hdf5File, AttributesOfOtherFormsAreRefused) {
  const TestFolder folder;
  Hdf5File::create(folder / "a.h5").close();
  const hid_t plain = H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hsize_t count = 1000;
  const hid_t many = H5Screate_simple(1, &count, nullptr), one = H5Screate(H5S_SCALAR);
  const hid_t text = H5Tcopy(H5T_C_S1), endless = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, 8), H5Tset_size(endless, H5T_VARIABLE);
  H5Aclose(H5Acreate2(plain, "numbers", H5T_NATIVE_DOUBLE, many, H5P_DEFAULT, H5P_DEFAULT));
  H5Aclose(H5Acreate2(plain, "texts", text, many, H5P_DEFAULT, H5P_DEFAULT));
  H5Aclose(H5Acreate2(plain, "endless", endless, one, H5P_DEFAULT, H5P_DEFAULT));
  H5Tclose(text), H5Tclose(endless), H5Sclose(many), H5Sclose(one), H5Fclose(plain);
  const Hdf5File file = Hdf5File::open_for_reading(folder / "a.h5");
  EXPECT_THROW((void)file.number_attribute("/", "numbers"), FileError);
  for (const char* key : {"texts", "endless", "numbers"})
    EXPECT_THROW((void)file.text_attribute("/", key), FileError) << key;
}

TEST(Hdf5File, SaysWhyAFileCannotBeOpened) {
  const TestFolder folder;
  const std::string path = (folder / "missing/a.h5").string();
  try {
    (void)Hdf5File::create(path);
    FAIL() << "no exception";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()), path + ": cannot be created: No such file or directory");
  }
  replace_text_file(folder / "b.h5", "not an HDF5 file");
  EXPECT_THROW((void)Hdf5File::open_for_reading(folder / "b.h5"), FileError);
}

TEST(Hdf5File, AKilledWriterLeavesWhatWasFlushed) {
  const TestFolder folder;
  const int status = status_of_child([&] {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    Hdf5Column column = file.create_column("/c", 16);
    column.append(std::vector<double>{1, 2, 3});
    file.flush();
    kill(getpid(), SIGKILL);
  });
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  EXPECT_EQ(read_plainly(folder / "a.h5", "/c").values, (std::vector<double>{1, 2, 3}));
}

// Tries to write more than the system allows and ends the process in the ordinary way: the library's clean-up at exit
// must not crash either. A limit on the size of files stands in for a full disk.
[[noreturn]] void exit_after_refused_write(const TestFolder& folder) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{30000, 30000};
  setrlimit(RLIMIT_FSIZE, &limit);
  int result = 1;
  try {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    std::vector<double> noise(20000);
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = std::sin(1e4 * static_cast<double>(i * i));
    file.write<double>("/noise", noise, {noise.size()});
    file.close();
  } catch (const FileError& error) {
    const std::string text = error.what();
    result = text.starts_with((folder / "a.h5").string()) && text.ends_with("File too large") ? 0 : 2;
  }
  std::filesystem::remove_all(folder.path());
  std::exit(result);
}

/// A disk that was full for a moment: the write that failed is told, though there is room again when the file closes.
TEST(Hdf5File, ARefusedWriteIsToldAtOnce) {
  const TestFolder folder;
  const int status = status_of_child([&] {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    std::vector<double> noise(20000);
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = std::sin(1e4 * static_cast<double>(i * i));
    int told = 0;
    try {
      const SmallDisk disk(30000);
      file.write<double>("/noise", noise, {noise.size()});
    } catch (const FileError&) {
      told = 1;
    }
    _exit(told);
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

TEST(Hdf5FileDeathTest, ARefusedWriteBecomesAnExceptionAndACleanExit) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // a fresh process, so that exit handlers may run
  const TestFolder folder;
  EXPECT_EXIT(exit_after_refused_write(folder), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace lahar::cases

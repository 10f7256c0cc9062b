#include "test_folder.h"

#include <dem/io/table_file.h>

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <hdf5.h>
#include <limits>
#include <sstream>
#include <thread>

// Tables are read back by the C API, bit for bit.
namespace
{
std::string scratch(const std::string &name)
{
  return (support::test_folder() / name).string();
}

std::string bytes_of(const std::string &path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/// More rows than a chunk has.
constexpr std::size_t n_rows = 70000;

dem::TableFile sample()
{
  std::vector<double> values(3 * n_rows);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = std::sin(double(k)) * std::pow(10., double(k % 600) - 300.);
  values[0] = -0.;
  values[1] = std::numeric_limits<double>::denorm_min();
  values[2] = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::int64_t> ids(n_rows);
  for (std::size_t k = 0; k < n_rows; ++k)
    ids[k] = (std::int64_t{1} << 53) + 1 + std::int64_t(k);
  return {
      .attributes = {{"title", std::string("Kies, gr\xc3\xb6\xc3\x9f"
                                           "er")},
                     {"step", std::int64_t{-7}},
                     {"time_s", 1. / 3.},
                     {"cell_m", dem::Vec3(0.1, 0.2, 0.3)}},
      .groups = {
          {"particles",
           {{"position_m", "m", "Where.", values, 3}, {"id", "1", "", ids}}},
          {"walls",
           {{"name", "1", "", std::vector<std::string>{"floor", ""}},
            {"kind", "1", "", std::vector<std::int32_t>{1, -2}}}},
          {"none", {{"overlap_m", "m", "", std::vector<double>{}}}}}};
}

void write_sample(const std::string &path)
{
  std::ofstream file(path, std::ios::binary);
  dem::write_hdf5(file, sample());
}

/// The file of sample(), open.
class Written : public testing::Test
{
protected:
  Written() : path(scratch("sample.h5"))
  {
    write_sample(path);
    file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }
  ~Written() override { H5Fclose(file); }

  template <class Number>
  std::vector<Number> read(const char *name, hid_t type, std::size_t n) const
  {
    std::vector<Number> values(n);
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    EXPECT_EQ(H5Sget_simple_extent_npoints(space), hssize_t(n)) << name;
    EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
              0)
        << name;
    H5Sclose(space);
    H5Dclose(set);
    return values;
  }
  std::string text(const char *object, const char *name) const
  {
    const hid_t attribute =
        H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    EXPECT_EQ(H5Tget_cset(type), H5T_CSET_UTF8);
    char *words = nullptr;
    EXPECT_GE(H5Aread(attribute, type, static_cast<void *>(&words)), 0);
    const std::string found = words;
    H5free_memory(words);
    H5Tclose(type);
    H5Aclose(attribute);
    return found;
  }

  std::string path;
  hid_t file = -1;
};

TEST_F(Written, NumbersKeepAllTheirBits)
{
  const dem::TableFile expected = sample();
  const auto &columns = expected.groups[0].columns;
  const auto &values = std::get<std::vector<double>>(columns[0].values);
  const auto found =
      read<double>("particles/position_m", H5T_NATIVE_DOUBLE, values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(found[k]),
              std::bit_cast<std::uint64_t>(values[k]))
        << k;
  EXPECT_EQ(read<std::int64_t>("particles/id", H5T_NATIVE_INT64, n_rows),
            std::get<std::vector<std::int64_t>>(columns[1].values));
  EXPECT_EQ(read<std::int32_t>("walls/kind", H5T_NATIVE_INT32, 2),
            (std::vector<std::int32_t>{1, -2}));
}

TEST_F(Written, RowsOfVectorsAreRowsOfThree)
{
  const hid_t set = H5Dopen2(file, "particles/position_m", H5P_DEFAULT);
  const hid_t space = H5Dget_space(set), layout = H5Dget_create_plist(set);
  hsize_t size[2] = {}, chunk[2] = {};
  ASSERT_EQ(H5Sget_simple_extent_dims(space, size, nullptr), 2);
  EXPECT_EQ(size[0], n_rows);
  EXPECT_EQ(size[1], 3u);
  ASSERT_EQ(H5Pget_chunk(layout, 2, chunk), 2);
  EXPECT_LT(chunk[0], n_rows);
  EXPECT_EQ(H5Pget_nfilters(layout), 2); // shuffle, gzip
  H5Pclose(layout);
  H5Sclose(space);
  H5Dclose(set);
}

TEST_F(Written, AttributesHoldUnitsTextsAndNumbers)
{
  EXPECT_EQ(text("particles/position_m", "unit"), "m");
  EXPECT_EQ(text("particles/position_m", "sentence"), "Where.");
  EXPECT_EQ(text("/", "title"), "Kies, gr\xc3\xb6\xc3\x9f"
                                "er");
  const auto number = [this](const char *name, hid_t type, void *value)
  {
    const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
    EXPECT_GE(H5Aread(attribute, type, value), 0) << name;
    H5Aclose(attribute);
  };
  std::int64_t step = 0;
  double time = 0., cell[3] = {};
  number("step", H5T_NATIVE_INT64, &step);
  number("time_s", H5T_NATIVE_DOUBLE, &time);
  number("cell_m", H5T_NATIVE_DOUBLE, cell);
  EXPECT_EQ(step, -7);
  EXPECT_EQ(time, 1. / 3.);
  EXPECT_EQ(cell[2], 0.3);
}

TEST_F(Written, TextsAreRows)
{
  const hid_t set = H5Dopen2(file, "walls/name", H5P_DEFAULT);
  const hid_t type = H5Dget_type(set);
  char *words[2] = {};
  ASSERT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                    static_cast<void *>(words)),
            0);
  EXPECT_STREQ(words[0], "floor");
  EXPECT_STREQ(words[1], "");
  for (char *word : words)
    H5free_memory(word);
  H5Tclose(type);
  H5Dclose(set);
}

TEST_F(Written, TablesWithoutRowsAreThere)
{
  EXPECT_TRUE(read<double>("none/overlap_m", H5T_NATIVE_DOUBLE, 0).empty());
}

// A run and its repetition have equal files: no time of writing is in them,
// which HDF5 notes in whole seconds.
TEST_F(Written, EqualTablesMakeEqualBytes)
{
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  const std::string again = scratch("again.h5");
  write_sample(again);
  EXPECT_EQ(bytes_of(again), bytes_of(path));
}
} // namespace

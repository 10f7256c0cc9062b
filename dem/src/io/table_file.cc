#include <dem/io/table_file.h>

#include <stdexcept>

#ifdef SPALL_HDF5
#include <dem/assert.h>

#include <algorithm>
#include <array>
#include <hdf5.h>
#include <ostream>
#include <type_traits>
#endif

namespace dem
{
#ifdef SPALL_HDF5
namespace
{
/// Rows of a chunk have about so many bytes: half of the cache that readers
/// have for one dataset by default.
constexpr std::size_t chunk_bytes = 1 << 19;
/// Of gzip: the fastest.
constexpr unsigned compression_level = 1;
/// The file grows in memory by so much [bytes].
constexpr std::size_t growth = 1 << 22;

/// HDF5 refuses.
struct Refused
{
};

hid_t checked(hid_t id)
{
  if (id < 0)
    throw Refused();
  return id;
}

void check(herr_t status)
{
  if (status < 0)
    throw Refused();
}

/// An object of HDF5, which is closed at the end.
class Handle
{
public:
  Handle(hid_t opened, herr_t (*closer)(hid_t))
      : id(checked(opened)), close(closer)
  {
  }
  ~Handle()
  {
    if (id >= 0)
      close(id);
  }
  Handle(Handle &&other) noexcept
      : id(std::exchange(other.id, -1)), close(other.close)
  {
  }
  Handle &operator=(Handle &&) = delete;

  operator hid_t() const { return id; }

private:
  hid_t id;
  herr_t (*close)(hid_t);
};

/// HDF5 prints no pages about its errors meanwhile.
class Quiet
{
public:
  Quiet()
  {
    H5Eget_auto2(H5E_DEFAULT, &print, &data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print, data); }
  Quiet(const Quiet &) = delete;
  Quiet &operator=(const Quiet &) = delete;

private:
  H5E_auto2_t print = nullptr;
  void *data = nullptr;
};

hid_t type_in_file(const std::vector<double> &)
{
  return H5T_IEEE_F64LE;
}
hid_t type_in_file(const std::vector<std::int64_t> &)
{
  return H5T_STD_I64LE;
}
hid_t type_in_file(const std::vector<std::int32_t> &)
{
  return H5T_STD_I32LE;
}
hid_t type_in_memory(const std::vector<double> &)
{
  return H5T_NATIVE_DOUBLE;
}
hid_t type_in_memory(const std::vector<std::int64_t> &)
{
  return H5T_NATIVE_INT64;
}
hid_t type_in_memory(const std::vector<std::int32_t> &)
{
  return H5T_NATIVE_INT32;
}

/// UTF-8 of any length.
Handle text_type()
{
  hid_t type = checked(H5Tcopy(H5T_C_S1));
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  return {type, H5Tclose};
}

void add_attribute(hid_t object, const std::string &name,
                   const std::string &text)
{
  const Handle type = text_type(), space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  const char *first = text.c_str();
  check(H5Awrite(attribute, type, static_cast<const void *>(&first)));
}

/// One number, or a row of them.
template <class Number>
void add_attribute(hid_t object, const std::string &name,
                   const std::vector<Number> &values)
{
  const hsize_t n = values.size();
  const Handle space(n == 1 ? H5Screate(H5S_SCALAR)
                            : H5Screate_simple(1, &n, nullptr),
                     H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), type_in_file(values),
                                    space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  check(H5Awrite(attribute, type_in_memory(values), values.data()));
}

void add_attribute(hid_t object, const std::string &name,
                   const TableFile::Attribute &value)
{
  if (const auto *text = std::get_if<std::string>(&value))
    add_attribute(object, name, *text);
  else if (const auto *number = std::get_if<double>(&value))
    add_attribute(object, name, std::vector{*number});
  else if (const auto *count = std::get_if<std::int64_t>(&value))
    add_attribute(object, name, std::vector{*count});
  else
  {
    const Vec3 &v = std::get<Vec3>(value);
    add_attribute(object, name, std::vector{v.x(), v.y(), v.z()});
  }
}

/// In chunks, compressed, without times, which would differ from run to run.
Handle layout_of(const std::vector<hsize_t> &size, std::size_t row_bytes,
                 bool is_compressed)
{
  hid_t layout = checked(H5Pcreate(H5P_DATASET_CREATE));
  check(H5Pset_obj_track_times(layout, false));
  if (is_compressed && size[0] > 0)
  {
    std::vector<hsize_t> chunk = size;
    chunk[0] = std::clamp<hsize_t>(chunk_bytes / row_bytes, 1, size[0]);
    check(H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data()));
    check(H5Pset_shuffle(layout));
    check(H5Pset_deflate(layout, compression_level));
  }
  return {layout, H5Pclose};
}

template <class Number>
Handle add_values(hid_t group, const TableColumn &column,
                  const std::vector<Number> &values)
{
  DEM_ASSERT(values.size() % column.n_components == 0);
  std::vector<hsize_t> size{values.size() / column.n_components};
  if (column.n_components > 1)
    size.push_back(column.n_components);
  const Handle space(
      H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
      H5Sclose);
  const Handle layout =
      layout_of(size, column.n_components * sizeof(Number), true);
  Handle dataset(H5Dcreate2(group, column.name.c_str(), type_in_file(values),
                            space, H5P_DEFAULT, layout, H5P_DEFAULT),
                 H5Dclose);
  if (!values.empty())
    check(H5Dwrite(dataset, type_in_memory(values), H5S_ALL, H5S_ALL,
                   H5P_DEFAULT, values.data()));
  return dataset;
}

Handle add_values(hid_t group, const TableColumn &column,
                  const std::vector<std::string> &texts)
{
  std::vector<const char *> first;
  for (const std::string &text : texts)
    first.push_back(text.c_str());
  const std::vector<hsize_t> size{texts.size()};
  const Handle type = text_type(),
               space(H5Screate_simple(1, size.data(), nullptr), H5Sclose),
               layout = layout_of(size, sizeof(char *), false);
  Handle dataset(H5Dcreate2(group, column.name.c_str(), type, space,
                            H5P_DEFAULT, layout, H5P_DEFAULT),
                 H5Dclose);
  if (!texts.empty())
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                   static_cast<const void *>(first.data())));
  return dataset;
}

void add_group(hid_t file, const TableGroup &table)
{
  const Handle layout(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(layout, false));
  // Readers then list the columns in this order, not by name.
  check(H5Pset_link_creation_order(layout, H5P_CRT_ORDER_TRACKED |
                                               H5P_CRT_ORDER_INDEXED));
  const Handle group(
      H5Gcreate2(file, table.name.c_str(), H5P_DEFAULT, layout, H5P_DEFAULT),
      H5Gclose);
  for (const TableColumn &column : table.columns)
    std::visit(
        [&](const auto &values)
        {
          const Handle dataset = add_values(group, column, values);
          add_attribute(dataset, "unit", column.unit);
          add_attribute(dataset, "sentence", column.sentence);
        },
        column.values);
}

/// HDF5 makes the bytes only: its own writing prints a page about a full disk.
std::string bytes_of(const TableFile &tables)
{
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_fapl_core(access, growth, false));
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(creation, false));
  const Handle file(H5Fcreate("tables", H5F_ACC_TRUNC, creation, access),
                    H5Fclose);
  for (const auto &[name, value] : tables.attributes)
    add_attribute(file, name, value);
  for (const TableGroup &group : tables.groups)
    add_group(file, group);
  check(H5Fflush(file, H5F_SCOPE_LOCAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0)
    throw Refused();
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) != size)
    throw Refused();
  return bytes;
}
} // namespace

std::string hdf5_version()
{
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." +
         std::to_string(release);
}

void write_hdf5(std::ostream &out, const TableFile &tables)
{
  const Quiet quiet;
  try
  {
    out << bytes_of(tables);
  }
  catch (const Refused &)
  {
    throw std::runtime_error("HDF5 cannot make the contents of a table");
  }
}
#else
std::string hdf5_version()
{
  return {};
}

void write_hdf5(std::ostream &, const TableFile &)
{
  throw std::runtime_error("this program is built without HDF5");
}
#endif
} // namespace dem

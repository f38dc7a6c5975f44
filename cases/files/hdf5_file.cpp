#include "cases/files/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "core/check.h"

namespace lahar::cases {

static_assert(std::is_same_v<Hdf5Handle::Id, std::int64_t> && sizeof(hid_t) == sizeof(Hdf5Handle::Id));

namespace {

constexpr unsigned kGzipLevel = 1;
constexpr std::uint64_t kChunkValues = 64 * 1024;  // values per chunk of a whole array

// Keeps entry 0 of HDF5's error stack, the cause: the others only repeat the call chain.
herr_t keep_cause(unsigned level, const H5E_error2_t* entry, void* cause) {
  if (level == 0 && entry->desc != nullptr) *static_cast<std::string*>(cause) = entry->desc;
  return 0;
}

// HDF5 describes a refusal of the operating system as "..., error message = 'No space left on device', ...".
std::string system_message(const std::string& description) {
  const std::string key = "error message = '";
  const auto start = description.find(key);
  if (start == std::string::npos) return description;
  const auto end = description.find('\'', start + key.size());
  return description.substr(start + key.size(), end - start - key.size());
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  std::string cause;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_cause, &cause);
  H5Eclear2(H5E_DEFAULT);
  const std::string reason = system_message(cause);
  throw FileError(path, what + (reason.empty() ? "" : ": " + reason));
}

// Errors become exceptions, so the library need not print them. Its own clean-up at exit is switched off: after a
// failed write it touches the broken dataset again and crashes (HDF5 1.10); our handles close what was opened.
void set_up_library() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Handle owned(hid_t id, const std::filesystem::path& path, const std::string& what) {
  if (id < 0) fail(path, what);
  return Hdf5Handle(id);
}

void check(herr_t status, const std::filesystem::path& path, const std::string& what) {
  if (status < 0) fail(path, what);
}

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
}

hid_t native_type(Archive::Number type) {
  switch (type) {
    case Archive::Number::u8:
      return H5T_NATIVE_UINT8;
    case Archive::Number::i32:
      return H5T_NATIVE_INT32;
    case Archive::Number::u32:
      return H5T_NATIVE_UINT32;
    case Archive::Number::i64:
      return H5T_NATIVE_INT64;
    case Archive::Number::u64:
      return H5T_NATIVE_UINT64;
    case Archive::Number::f32:
      return H5T_NATIVE_FLOAT;
    case Archive::Number::f64:
      break;
  }
  return H5T_NATIVE_DOUBLE;
}

// Without locks ParaView and h5dump can look at a run that is still writing.
Hdf5Handle access_without_locks(const std::filesystem::path& path) {
  Hdf5Handle access = owned(H5Pcreate(H5P_FILE_ACCESS), path, "cannot set up HDF5");
  check(H5Pset_file_locking(access.id(), false, true), path, "cannot set up HDF5");
  return access;
}

Hdf5Handle compressed_layout(const std::filesystem::path& path, const std::vector<hsize_t>& chunk) {
  Hdf5Handle layout = owned(H5Pcreate(H5P_DATASET_CREATE), path, "cannot set up HDF5");
  check(H5Pset_chunk(layout.id(), static_cast<int>(chunk.size()), chunk.data()), path, "cannot set up HDF5");
  check(H5Pset_shuffle(layout.id()), path, "HDF5 lacks the shuffle filter");
  check(H5Pset_deflate(layout.id(), kGzipLevel), path, "HDF5 lacks the gzip filter");
  return layout;
}

Hdf5Handle links_with_parents(const std::filesystem::path& path) {
  Hdf5Handle links = owned(H5Pcreate(H5P_LINK_CREATE), path, "cannot set up HDF5");
  check(H5Pset_create_intermediate_group(links.id(), 1), path, "cannot set up HDF5");
  return links;
}

std::vector<hsize_t> chunk_for(const std::vector<hsize_t>& dimensions) {
  std::vector<hsize_t> chunk = dimensions;
  hsize_t row = 1;
  for (std::size_t d = 1; d < chunk.size(); ++d) row *= chunk[d];
  chunk[0] = std::clamp<hsize_t>(kChunkValues / std::max<hsize_t>(row, 1), 1, std::max<hsize_t>(chunk[0], 1));
  return chunk;
}

/// Whether a dataset is what create_column makes: doubles in one dimension without a limit.
bool is_column(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset)), type(H5Dget_type(dataset));
  if (H5Sget_simple_extent_ndims(space.id()) != 1) return false;
  hsize_t most = 0;
  return H5Sget_simple_extent_dims(space.id(), nullptr, &most) == 1 && most == H5S_UNLIMITED &&
         H5Tget_class(type.id()) == H5T_FLOAT && H5Tget_size(type.id()) == sizeof(double);
}

/// Whether an attribute holds one value: other programs write lists as well.
bool is_single(hid_t attribute) {
  const Hdf5Handle space(H5Aget_space(attribute));
  return H5Sget_simple_extent_npoints(space.id()) == 1;
}

/// Whether an attribute is one text of fixed length, as set_attribute writes it.
bool is_text(hid_t attribute) {
  const Hdf5Handle type(H5Aget_type(attribute));
  return is_single(attribute) && H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) == 0;
}

/// Whether a member of a file is a column with these texts, or cannot be opened, as one that is damaged.
bool is_column_with(hid_t file, const std::string& name, const std::vector<std::string>& texts) {
  H5L_info_t link;
  if (H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) return false;
  const Hdf5Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT));
  if (!object.valid()) return true;
  if (H5Iget_type(object.id()) != H5I_DATASET || !is_column(object.id())) return false;
  return std::all_of(texts.begin(), texts.end(), [&](const std::string& key) {
    const Hdf5Handle attribute(H5Aopen(object.id(), key.c_str(), H5P_DEFAULT));
    return attribute.valid() && is_text(attribute.id());
  });
}

}  // namespace

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  if (this != &other) {
    reset();
    std::swap(id_, other.id_);
  }
  return *this;
}

void Hdf5Handle::reset() noexcept {
  if (id_ >= 0) H5Idec_ref(id_);  // closes whatever kind of object it is
  id_ = -1;
}

Hdf5Column::Hdf5Column(std::filesystem::path path, std::string name, Hdf5Handle dataset)
    : path_(std::move(path)), name_(std::move(name)), dataset_(std::move(dataset)) {
  if (!is_column(dataset_.id())) throw FileError(path_, name_ + " is no growing column of doubles");
  const Hdf5Handle space = owned(H5Dget_space(dataset_.id()), path_, "cannot read the size of " + name_);
  hsize_t rows = 0;
  check(H5Sget_simple_extent_dims(space.id(), &rows, nullptr), path_, "cannot read the size of " + name_);
  rows_ = rows;
}

void Hdf5Column::append(std::span<const double> values) {
  if (values.empty()) return;
  const std::string what = "cannot write " + name_;
  const hsize_t start = rows_, count = values.size(), total = start + count;
  check(H5Dset_extent(dataset_.id(), &total), path_, what);
  const Hdf5Handle file_space = owned(H5Dget_space(dataset_.id()), path_, what);
  check(H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, &start, nullptr, &count, nullptr), path_, what);
  const Hdf5Handle memory_space = owned(H5Screate_simple(1, &count, nullptr), path_, what);
  check(H5Dwrite(dataset_.id(), H5T_NATIVE_DOUBLE, memory_space.id(), file_space.id(), H5P_DEFAULT, values.data()),
        path_, what);
  rows_ = total;
}

void Hdf5Column::truncate(std::uint64_t rows) {
  if (rows >= rows_) return;
  const hsize_t total = rows;
  check(H5Dset_extent(dataset_.id(), &total), path_, "cannot shorten " + name_);
  rows_ = rows;
}

Hdf5Parts::Hdf5Parts(std::filesystem::path path, std::string name, Hdf5Handle dataset, Archive::Number type,
                     std::uint64_t count)
    : path_(std::move(path)), name_(std::move(name)), dataset_(std::move(dataset)), type_(type), count_(count) {}

template <class Pass>
void Hdf5Parts::pass(std::uint64_t count, const std::string& what, const Pass& transfer) {
  if (count == 0) return;
  require(count <= count_ - done_, "Hdf5Parts: more numbers than the dataset has");
  const hsize_t start = done_, size = count;
  const Hdf5Handle file_space = owned(H5Dget_space(dataset_.id()), path_, what);
  check(H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, &start, nullptr, &size, nullptr), path_, what);
  const Hdf5Handle memory_space = owned(H5Screate_simple(1, &size, nullptr), path_, what);
  check(transfer(memory_space.id(), file_space.id()), path_, what);
  done_ += count;
}

void Hdf5Parts::write(const void* data, std::uint64_t count) {
  pass(count, "cannot write " + name_, [&](hid_t memory, hid_t file) {
    return H5Dwrite(dataset_.id(), native_type(type_), memory, file, H5P_DEFAULT, data);
  });
}

void Hdf5Parts::flush() { check(H5Dflush(dataset_.id()), path_, "cannot write " + name_); }

void Hdf5Parts::read(void* data, std::uint64_t count) {
  pass(count, "cannot read " + name_, [&](hid_t memory, hid_t file) {
    return H5Dread(dataset_.id(), native_type(type_), memory, file, H5P_DEFAULT, data);
  });
}

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  set_up_library();
  const Hdf5Handle access = access_without_locks(path);
  return {path, owned(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), path, "cannot be created")};
}

Hdf5File Hdf5File::open_for_reading(const std::filesystem::path& path) {
  set_up_library();
  const Hdf5Handle access = access_without_locks(path);
  return {path, owned(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), path, "cannot be read")};
}

Hdf5File Hdf5File::open_for_appending(const std::filesystem::path& path) {
  set_up_library();
  const Hdf5Handle access = access_without_locks(path);
  return {path, owned(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()), path, "cannot be opened for writing")};
}

bool Hdf5File::contains(const std::string& name) const {
  // Every part of the path must exist before the next may be asked for.
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    if (H5Lexists(file_.id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const std::string what = "cannot list " + group;
  const Hdf5Handle opened = owned(H5Gopen2(file_.id(), group.c_str(), H5P_DEFAULT), path_, what);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Literate(opened.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), path_, what);
  return names;
}

template <class T>
void Hdf5File::write(const std::string& name, std::span<const T> values, const std::vector<std::uint64_t>& dimensions) {
  const std::string what = "cannot write " + name;
  const std::vector<hsize_t> extent(dimensions.begin(), dimensions.end());
  hsize_t count = 1;
  for (const hsize_t d : extent) count *= d;
  require(!extent.empty() && count == values.size(), "Hdf5File::write: dimensions do not match the number of values");
  const Hdf5Handle space =
      owned(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), path_, what);
  const Hdf5Handle links = links_with_parents(path_);
  const Hdf5Handle layout =
      count > 0 ? compressed_layout(path_, chunk_for(extent)) : owned(H5Pcreate(H5P_DATASET_CREATE), path_, what);
  const Hdf5Handle dataset =
      owned(H5Dcreate2(file_.id(), name.c_str(), native_type<T>(), space.id(), links.id(), layout.id(), H5P_DEFAULT),
            path_, what);
  if (count == 0) return;
  check(H5Dwrite(dataset.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path_, what);
  check(H5Dflush(dataset.id()), path_, what);  // as it closes nobody hears of what fails
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& name) const {
  std::uint64_t count = 1;
  for (const std::uint64_t d : dimensions(name)) count *= d;
  std::vector<T> values(count);
  if (count == 0) return values;
  const std::string what = "cannot read " + name;
  const Hdf5Handle dataset = owned(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), path_, what);
  check(H5Dread(dataset.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path_, what);
  return values;
}

std::vector<std::uint64_t> Hdf5File::dimensions(const std::string& name) const {
  const std::string what = "cannot read " + name;
  const Hdf5Handle dataset = owned(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), path_, what);
  const Hdf5Handle space = owned(H5Dget_space(dataset.id()), path_, what);
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  check(H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr), path_, what);
  return {extent.begin(), extent.end()};
}

Hdf5Column Hdf5File::create_column(const std::string& name, std::uint64_t chunk_rows) {
  const std::string what = "cannot create column " + name;
  const hsize_t none = 0, unlimited = H5S_UNLIMITED;
  const Hdf5Handle space = owned(H5Screate_simple(1, &none, &unlimited), path_, what);
  const Hdf5Handle links = links_with_parents(path_);
  const Hdf5Handle layout = compressed_layout(path_, {chunk_rows});
  return {
      path_, name,
      owned(H5Dcreate2(file_.id(), name.c_str(), H5T_NATIVE_DOUBLE, space.id(), links.id(), layout.id(), H5P_DEFAULT),
            path_, what)};
}

Hdf5Column Hdf5File::open_column(const std::string& name) {
  return {path_, name, owned(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), path_, "cannot open column " + name)};
}

std::vector<std::string> Hdf5File::columns(const std::string& group, const std::vector<std::string>& texts) const {
  std::vector<std::string> names = members(group);
  std::erase_if(names, [&](const std::string& name) { return !is_column_with(file_.id(), group + "/" + name, texts); });
  return names;
}

Hdf5Parts Hdf5File::create_parts(const std::string& name, Archive::Number type, std::uint64_t count) {
  const std::string what = "cannot write " + name;
  const hsize_t extent = count;
  const Hdf5Handle space = owned(H5Screate_simple(1, &extent, nullptr), path_, what);
  const Hdf5Handle links = links_with_parents(path_);
  return {
      path_, name,
      owned(H5Dcreate2(file_.id(), name.c_str(), native_type(type), space.id(), links.id(), H5P_DEFAULT, H5P_DEFAULT),
            path_, what),
      type, count};
}

Hdf5Parts Hdf5File::open_parts(const std::string& name, Archive::Number type) const {
  const std::string what = "cannot read " + name;
  if (!contains(name)) throw FileError(path_, name + " is missing");
  const auto extent = dimensions(name);
  Hdf5Handle dataset = owned(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), path_, what);
  const Hdf5Handle stored = owned(H5Dget_type(dataset.id()), path_, what);
  if (extent.size() != 1 || H5Tequal(stored.id(), native_type(type)) <= 0)
    throw FileError(path_, name + " is of another kind");
  if (H5Dget_storage_size(dataset.id()) != extent[0] * Archive::bytes_of(type))
    throw FileError(path_, name + " is not there in full");
  return {path_, name, std::move(dataset), type, extent[0]};
}

void Hdf5File::remove(const std::string& name) {
  check(H5Ldelete(file_.id(), name.c_str(), H5P_DEFAULT), path_, "cannot remove " + name);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& key, const std::string& text) {
  const std::string what = "cannot write attribute " + key + " of " + object;
  const Hdf5Handle type = owned(H5Tcopy(H5T_C_S1), path_, what);
  check(H5Tset_size(type.id(), std::max<std::size_t>(1, text.size())), path_, what);
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), path_, what);
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), path_, what);
  const Hdf5Handle space = owned(H5Screate(H5S_SCALAR), path_, what);
  const Hdf5Handle attribute = owned(H5Acreate_by_name(file_.id(), object.c_str(), key.c_str(), type.id(), space.id(),
                                                       H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                     path_, what);
  check(H5Awrite(attribute.id(), type.id(), text.c_str()), path_, what);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& key, double value) {
  const std::string what = "cannot write attribute " + key + " of " + object;
  const Hdf5Handle space = owned(H5Screate(H5S_SCALAR), path_, what);
  const Hdf5Handle attribute = owned(H5Acreate_by_name(file_.id(), object.c_str(), key.c_str(), H5T_NATIVE_DOUBLE,
                                                       space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                     path_, what);
  check(H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, &value), path_, what);
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& key) const {
  const std::string what = "cannot read attribute " + key + " of " + object;
  const Hdf5Handle attribute =
      owned(H5Aopen_by_name(file_.id(), object.c_str(), key.c_str(), H5P_DEFAULT, H5P_DEFAULT), path_, what);
  const Hdf5Handle type = owned(H5Aget_type(attribute.id()), path_, what);
  if (!is_text(attribute.id())) throw FileError(path_, what + ": it is no single text of fixed length");
  std::string text(H5Tget_size(type.id()), '\0');
  check(H5Aread(attribute.id(), type.id(), text.data()), path_, what);
  text.resize(std::strlen(text.c_str()));
  return text;
}

double Hdf5File::number_attribute(const std::string& object, const std::string& key) const {
  const std::string what = "cannot read attribute " + key + " of " + object;
  const Hdf5Handle attribute =
      owned(H5Aopen_by_name(file_.id(), object.c_str(), key.c_str(), H5P_DEFAULT, H5P_DEFAULT), path_, what);
  if (!is_single(attribute.id())) throw FileError(path_, what + ": it is not one number");
  double value = 0;
  check(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value), path_, what);
  return value;
}

void Hdf5File::flush() { check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), path_, "cannot be flushed"); }

void Hdf5File::close() {
  if (!file_.valid()) return;
  flush();
  file_.reset();
}

template void Hdf5File::write(const std::string&, std::span<const float>, const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const double>, const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const std::int32_t>, const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const std::int64_t>, const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const std::uint8_t>, const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const std::uint32_t>, const std::vector<std::uint64_t>&);
template std::vector<float> Hdf5File::read(const std::string&) const;
template std::vector<double> Hdf5File::read(const std::string&) const;
template std::vector<std::int32_t> Hdf5File::read(const std::string&) const;
template std::vector<std::int64_t> Hdf5File::read(const std::string&) const;
template std::vector<std::uint8_t> Hdf5File::read(const std::string&) const;
template std::vector<std::uint32_t> Hdf5File::read(const std::string&) const;

}  // namespace lahar::cases

#include "apps/archive/snapshot/hdf5_table.hpp"

#include "apps/support/error.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>
#include <unistd.h>
#include <utility>
#include <variant>

namespace listric::archive {

using namespace dem;

namespace {

/// Why a call of HDF5 has failed.
struct Cause {
    std::string text; ///< of the innermost entry of its stack of errors
    bool is_memory = false;
};

/// HDF5 that has run out of memory is left with what it had half made: its next call may be a
/// crash. So the process ends here.
[[noreturn]] void end_for_memory() {
    constexpr std::string_view text =
        "listric: memory is short (within HDF5); what was saved before stays: --resume goes on "
        "where there is more memory\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
    _exit(4); // exit code of what storage or memory does not hold
}

/// Whether little is left: a damaged file may ask for more than any machine has.
bool is_memory_short() {
    constexpr std::size_t ample = 16 << 20;
    void* volatile const room = std::malloc(ample);
    std::free(room);
    return !room;
}

/// Failure and its reason.
[[noreturn]] void fail(const std::string& what) {
    Cause cause;
    const auto take = [](unsigned depth, const H5E_error2_t* error, void* into) -> herr_t {
        Cause& found = *static_cast<Cause*>(into);
        if (depth == 0 && error->desc)
            found.text = error->desc;
        found.is_memory |= error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take, &cause);
    if (cause.is_memory && is_memory_short())
        end_for_memory();
    throw StorageError(what + (cause.text.empty() ? "" : " (HDF5: " + cause.text + ")"));
}

/// @param what  what could not be done, if `status` says so
void check(herr_t status, const std::string& what) {
    if (status < 0)
        fail(what);
}

} // namespace

void prepare_hdf5(double bytes) {
    // Before its first call. Volatile, or clang would leave out what is only freed.
    void* volatile const room = std::malloc(static_cast<std::size_t>(bytes));
    if (!room)
        throw std::bad_alloc();
    std::free(room);
    H5dont_atexit(); // at its end it would visit all that a failed call has left
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are thrown, not printed
}

Handle::Handle(Hdf5Id id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0)
        fail(what);
}

Handle::~Handle() {
    if (id_ >= 0)
        close_(id_);
}

Handle make_file() {
    const char* const what = "cannot make the file in memory";
    const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
    check(H5Pset_fapl_core(in_memory, 1 << 20, false), what);
    return {H5Fcreate("snapshot", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory), H5Fclose, what};
}

std::vector<std::byte> image_of(Hdf5Id file) {
    const char* const what = "cannot make the file in memory";
    check(H5Fflush(file, H5F_SCOPE_LOCAL), what);
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    std::vector<std::byte> image(size > 0 ? static_cast<std::size_t>(size) : 0);
    if (size <= 0 || H5Fget_file_image(file, image.data(), image.size()) < 0)
        throw StorageError(what);
    return image;
}

Handle open_file(const std::filesystem::path& path) {
    const char* const what = "cannot be opened as HDF5";
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
    check(H5Pset_file_locking(access, false, true), what);
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, what};
}

bool has_attribute(Hdf5Id object, const char* name) { return H5Aexists(object, name) > 0; }

bool has_member(Hdf5Id group, const char* name) { return H5Lexists(group, name, H5P_DEFAULT) > 0; }

Handle create_group(Hdf5Id parent, const std::string& name) {
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
            "cannot make the group " + name};
}

Handle open_group(Hdf5Id parent, const std::string& name) {
    return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "lacks the group " + name};
}

std::vector<std::string> names_in(Hdf5Id group) {
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
        static_cast<std::vector<std::string>*>(into)->push_back(name);
        return 0;
    };
    check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names),
          "cannot list a group");
    return names;
}

namespace {

template <class T> hid_t hdf5_type() {
    if constexpr (std::is_same_v<T, double>)
        return H5T_NATIVE_DOUBLE;
    else if constexpr (std::is_same_v<T, float>)
        return H5T_NATIVE_FLOAT;
    else if constexpr (std::is_same_v<T, std::int64_t>)
        return H5T_NATIVE_INT64;
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return H5T_NATIVE_INT32;
    else if constexpr (std::is_same_v<T, std::int16_t>)
        return H5T_NATIVE_INT16;
    else
        return H5T_NATIVE_UINT8;
}

/// The type of a text; HDF5 has none of no length.
Handle text_type(std::size_t size) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, std::max<std::size_t>(size, 1));
    return {type, H5Tclose, "cannot make a type"};
}

std::string without_padding(std::string text) {
    while (!text.empty() && text.back() == '\0')
        text.pop_back();
    return text;
}

Handle single() { return {H5Screate(H5S_SCALAR), H5Sclose, "cannot make a dataspace"}; }

Handle create_attribute(hid_t object, const char* name, hid_t type) {
    return {H5Acreate2(object, name, type, single(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
            std::string("cannot make the attribute ") + name};
}

Handle open_attribute(hid_t object, const char* name) {
    return {H5Aopen(object, name, H5P_DEFAULT), H5Aclose,
            std::string("lacks the attribute ") + name};
}

} // namespace

void write_text(Hdf5Id group, const char* name, const std::string& text) {
    const Handle type = text_type(text.size()), space = single();
    check(H5Tset_cset(type, H5T_CSET_UTF8), "cannot make a type");
    const Handle set(H5Dcreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Dclose, std::string("cannot make the text ") + name);
    check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()),
          std::string("cannot write the text ") + name);
}

std::string read_text(Hdf5Id group, const char* name) {
    const Handle set(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose,
                     std::string("lacks the text ") + name);
    const Handle type(H5Dget_type(set), H5Tclose, std::string("has no type of ") + name);
    std::string text(H5Tget_size(type), '\0');
    check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()),
          std::string("cannot read the text ") + name);
    return without_padding(std::move(text));
}

void write_text_attribute(Hdf5Id object, const char* name, const std::string& text) {
    const Handle type = text_type(text.size()), attribute = create_attribute(object, name, type);
    check(H5Awrite(attribute, type, text.c_str()),
          std::string("cannot write the attribute ") + name);
}

std::string read_text_attribute(Hdf5Id object, const char* name) {
    const Handle attribute = open_attribute(object, name);
    const Handle type(H5Aget_type(attribute), H5Tclose, std::string("has no type of ") + name);
    std::string text(H5Tget_size(type), '\0');
    check(H5Aread(attribute, type, text.data()), std::string("cannot read the attribute ") + name);
    return without_padding(std::move(text));
}

template <class T> void write_number(Hdf5Id object, const char* name, T value) {
    const Handle attribute = create_attribute(object, name, hdf5_type<T>());
    check(H5Awrite(attribute, hdf5_type<T>(), &value),
          std::string("cannot write the attribute ") + name);
}

template <class T> T read_number(Hdf5Id object, const char* name) {
    const Handle attribute = open_attribute(object, name);
    T value{};
    check(H5Aread(attribute, hdf5_type<T>(), &value),
          std::string("cannot read the attribute ") + name);
    return value;
}

template void write_number(Hdf5Id, const char*, double);
template void write_number(Hdf5Id, const char*, std::int64_t);
template double read_number(Hdf5Id, const char*);
template std::int64_t read_number(Hdf5Id, const char*);

std::vector<std::string> attributes_of(Hdf5Id object) {
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* into) -> herr_t {
        static_cast<std::vector<std::string>*>(into)->push_back(name);
        return 0;
    };
    check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names),
          "cannot list attributes");
    return names;
}

namespace {

/// Rows from which on a column is packed.
constexpr std::size_t packed_rows = 1024;

/// The first of the columns before the one at `position` that has its very bytes; none: null.
/// Events note places and porosities, and many a snapshot is taken just then.
const Column* twin_before(std::span<const Column> columns, std::size_t position) {
    const auto bytes = [](const Column& column) {
        return std::visit([](const auto& values) { return std::as_bytes(std::span(values)); },
                          column.values);
    };
    const auto& values = columns[position].values;
    const auto twin = std::ranges::find_if(columns.first(position), [&](const Column& column) {
        return column.values.index() == values.index() &&
               std::ranges::equal(bytes(column), bytes(columns[position]));
    });
    return twin - columns.begin() == static_cast<std::ptrdiff_t>(position) ? nullptr : &*twin;
}

std::string path_of(hid_t object) {
    std::string path(
        static_cast<std::size_t>(std::max<ssize_t>(0, H5Iget_name(object, nullptr, 0))), ' ');
    H5Iget_name(object, path.data(), path.size() + 1);
    return path;
}

/// @param twin  column of the group with the same bytes, which this one then refers to; none: null
void write_column(hid_t group, const Column& column, std::size_t position, const Column* twin) {
    std::visit(
        [&](const auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            const hsize_t size = values.size();
            const std::string what = "cannot write the column " + column.name;
            const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, what);
            const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
            if (twin && size >= packed_rows) {
                const std::string source = path_of(group) + '/' + twin->name;
                check(H5Pset_virtual(properties, space, ".", source.c_str(), space), what);
            } else if (size >= packed_rows) {
                check(H5Pset_chunk(properties, 1, &size), what);
                check(H5Pset_shuffle(properties), what);
                check(H5Pset_deflate(properties, 1), what);
            }
            const Handle set(H5Dcreate2(group, column.name.c_str(), hdf5_type<T>(), space,
                                        H5P_DEFAULT, properties, H5P_DEFAULT),
                             H5Dclose, what);
            if (!twin || size < packed_rows)
                check(H5Dwrite(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                      what);
            write_text_attribute(set, "unit", column.unit);
            write_number(set, "initial", std::get<T>(column.initial));
            if (!column.begins_as.empty())
                write_text_attribute(set, "begins_as", column.begins_as);
            if (column.is_note)
                write_number(set, "is_note", std::int64_t{1});
            write_number(set, "position", static_cast<std::int64_t>(position));
        },
        column.values);
}

template <class T> Column read_values(hid_t set, const std::string& name, std::size_t size) {
    std::vector<T> values(size);
    check(H5Dread(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "cannot read the column " + name);
    return {name,
            read_text_attribute(set, "unit"),
            std::move(values),
            read_number<T>(set, "initial"),
            has_attribute(set, "begins_as") ? read_text_attribute(set, "begins_as") : "",
            has_attribute(set, "is_note")};
}

} // namespace

template <class T>
void write_matrix(Hdf5Id group, const char* name, std::span<const T> values, std::size_t columns) {
    const hsize_t size[] = {values.size() / columns, columns};
    const std::string what = std::string("cannot write the matrix ") + name;
    const Handle space(H5Screate_simple(2, size, nullptr), H5Sclose, what);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
    check(H5Pset_obj_track_times(properties, false), what); // equal files of equal values
    check(H5Pset_chunk(properties, 2, size), what);
    check(H5Pset_shuffle(properties), what);
    check(H5Pset_deflate(properties, 6), what);
    const Handle set(
        H5Dcreate2(group, name, hdf5_type<T>(), space, H5P_DEFAULT, properties, H5P_DEFAULT),
        H5Dclose, what);
    check(H5Dwrite(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what);
}

template void write_matrix(Hdf5Id, const char*, std::span<const float>, std::size_t);
template void write_matrix(Hdf5Id, const char*, std::span<const std::int16_t>, std::size_t);
template void write_matrix(Hdf5Id, const char*, std::span<const std::uint8_t>, std::size_t);

void write_table(Hdf5Id group, const Table& table) {
    write_number(group, "rows", static_cast<std::int64_t>(table.rows()));
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        write_column(group, table.columns()[k], k, twin_before(table.columns(), k));
}

Table read_table(Hdf5Id parent, const std::string& name) {
    const Handle group = open_group(parent, name);
    std::map<std::int64_t, Column> columns;
    for (const std::string& column : names_in(group)) {
        const std::string what = "cannot read the column " + column;
        const Handle set(H5Dopen2(group, column.c_str(), H5P_DEFAULT), H5Dclose, what);
        const Handle space(H5Dget_space(set), H5Sclose, what);
        const Handle type(H5Dget_type(set), H5Tclose, what);
        const auto size = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
        const auto is = [&](hid_t candidate) { return H5Tequal(type, candidate) > 0; };
        Column read = is(H5T_NATIVE_DOUBLE)  ? read_values<double>(set, column, size)
                      : is(H5T_NATIVE_FLOAT) ? read_values<float>(set, column, size)
                      : is(H5T_NATIVE_INT64) ? read_values<std::int64_t>(set, column, size)
                      : is(H5T_NATIVE_INT32) ? read_values<std::int32_t>(set, column, size)
                                             : read_values<std::uint8_t>(set, column, size);
        columns.emplace(read_number<std::int64_t>(set, "position"), std::move(read));
    }
    Table table;
    for (auto& [position, column] : columns)
        table.set(std::move(column));
    if (table.columns().empty())
        table.resize(static_cast<std::size_t>(read_number<std::int64_t>(group, "rows")));
    return table;
}

} // namespace listric::archive

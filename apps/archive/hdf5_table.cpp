#include "apps/archive/hdf5_table.hpp"

#include "apps/support/error.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <type_traits>
#include <utility>
#include <variant>

namespace listric::archive {

using namespace dem;

Handle::Handle(hid_t id, herr_t (*close)(hid_t), const char* what) : id_(id), close_(close) {
    if (id < 0)
        throw StorageError(what);
}

Handle::~Handle() {
    if (id_ >= 0)
        close_(id_);
}

void check(herr_t status, const char* what) {
    if (status < 0)
        throw StorageError(what);
}

Handle create_group(hid_t parent, const std::string& name) {
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
            "group"};
}

Handle open_group(hid_t parent, const std::string& name) {
    return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "missing group"};
}

std::vector<std::string> names_in(hid_t group) {
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
        static_cast<std::vector<std::string>*>(into)->push_back(name);
        return 0;
    };
    check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "listing");
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
    else
        return H5T_NATIVE_UINT8;
}

} // namespace

void write_text_attribute(hid_t object, const char* name, const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "type");
    check(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)), "string size");
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "dataspace");
    const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, "attribute");
    std::string padded = text.empty() ? std::string(1, '\0') : text;
    check(H5Awrite(attribute, type, padded.data()), "writing an attribute");
}

std::string read_text_attribute(hid_t object, const char* name) {
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "missing attribute");
    const Handle type(H5Aget_type(attribute), H5Tclose, "type");
    std::string text(H5Tget_size(type), '\0');
    check(H5Aread(attribute, type, text.data()), "reading an attribute");
    while (!text.empty() && text.back() == '\0')
        text.pop_back();
    return text;
}

template <class T> void write_number(hid_t object, const char* name, T value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "dataspace");
    const Handle attribute(
        H5Acreate2(object, name, hdf5_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
        "attribute");
    check(H5Awrite(attribute, hdf5_type<T>(), &value), "writing an attribute");
}

template <class T> T read_number(hid_t object, const char* name) {
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "missing attribute");
    T value{};
    check(H5Aread(attribute, hdf5_type<T>(), &value), "reading an attribute");
    return value;
}

template void write_number(hid_t, const char*, double);
template void write_number(hid_t, const char*, std::int64_t);
template double read_number(hid_t, const char*);
template std::int64_t read_number(hid_t, const char*);

std::vector<std::string> attributes_of(hid_t object) {
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* into) -> herr_t {
        static_cast<std::vector<std::string>*>(into)->push_back(name);
        return 0;
    };
    check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "listing");
    return names;
}

namespace {

void write_column(hid_t group, const Column& column, std::size_t position) {
    std::visit(
        [&](const auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            const hsize_t size = values.size();
            const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "dataspace");
            const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
            if (size >= 1024) {
                check(H5Pset_chunk(properties, 1, &size), "chunk");
                check(H5Pset_shuffle(properties), "shuffle");
                check(H5Pset_deflate(properties, 1), "deflate");
            }
            const Handle set(H5Dcreate2(group, column.name.c_str(), hdf5_type<T>(), space,
                                        H5P_DEFAULT, properties, H5P_DEFAULT),
                             H5Dclose, "dataset");
            check(H5Dwrite(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                  "writing a column");
            write_text_attribute(set, "unit", column.unit);
            write_number(set, "initial", std::get<T>(column.initial));
            if (!column.begins_as.empty())
                write_text_attribute(set, "begins_as", column.begins_as);
            write_number(set, "position", static_cast<std::int64_t>(position));
        },
        column.values);
}

template <class T> Column read_values(hid_t set, const std::string& name, std::size_t size) {
    std::vector<T> values(size);
    check(H5Dread(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "reading a column");
    return {name, read_text_attribute(set, "unit"), std::move(values),
            read_number<T>(set, "initial"),
            H5Aexists(set, "begins_as") > 0 ? read_text_attribute(set, "begins_as") : ""};
}

} // namespace

void write_table(hid_t group, const Table& table) {
    write_number(group, "rows", static_cast<std::int64_t>(table.rows()));
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        write_column(group, table.columns()[k], k);
}

Table read_table(hid_t parent, const std::string& name) {
    const Handle group = open_group(parent, name);
    std::map<std::int64_t, Column> columns;
    for (const std::string& column : names_in(group)) {
        const Handle set(H5Dopen2(group, column.c_str(), H5P_DEFAULT), H5Dclose, "dataset");
        const Handle space(H5Dget_space(set), H5Sclose, "dataspace");
        const Handle type(H5Dget_type(set), H5Tclose, "type");
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

#pragma once

#include "dem/column.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

// Tables, numbers and texts in groups of an HDF5 file. Everything here throws StorageError, and
// ends the process where memory runs out within HDF5. A page, which has no HDF5, has what writes of
// its own (apps/page/hdf5_writer.cpp).

using Hdf5Id = std::int64_t; ///< of what is open, HDF5's hid_t

/// Makes HDF5 ready for work that takes so much memory. Throws std::bad_alloc where there is not
/// that much: HDF5 does not survive to find out.
void prepare_hdf5(double bytes);

/// An HDF5 identifier that closes itself.
class Handle {
public:
    using Close = int (*)(Hdf5Id);

    /// @param what  what could not be done, if `id` is not valid
    Handle(Hdf5Id id, Close close, const std::string& what);
    ~Handle();
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator Hdf5Id() const { return id_; }

private:
    Hdf5Id id_;
    Close close_;
};

/// A new file. It is in memory: a disk that fills up while HDF5 writes leaves the library in a
/// state that cannot even be closed.
Handle make_file();

/// The bytes of such a file.
std::vector<std::byte> image_of(Hdf5Id file);

/// Opens a file to read it, without a lock: some shared disks refuse locks.
Handle open_file(const std::filesystem::path& path);

bool has_attribute(Hdf5Id object, const char* name);
bool has_member(Hdf5Id group, const char* name);

Handle create_group(Hdf5Id parent, const std::string& name);
Handle open_group(Hdf5Id parent, const std::string& name);

/// Names of what is in a group, sorted.
std::vector<std::string> names_in(Hdf5Id group);

/// A text of any length as a dataset.
void write_text(Hdf5Id group, const char* name, const std::string& text);
std::string read_text(Hdf5Id group, const char* name);

/// A short text as an attribute: HDF5 has room for 64 kB in an object's attributes.
void write_text_attribute(Hdf5Id object, const char* name, const std::string& text);
std::string read_text_attribute(Hdf5Id object, const char* name);

/// A number as an attribute: a double or a std::int64_t.
template <class T> void write_number(Hdf5Id object, const char* name, T value);
template <class T> T read_number(Hdf5Id object, const char* name);

/// Names of a group's own attributes, sorted.
std::vector<std::string> attributes_of(Hdf5Id object);

/// Rows of a matrix as a dataset of two dimensions, compressed: a float, std::int16_t or
/// std::uint8_t.
template <class T>
void write_matrix(Hdf5Id group, const char* name, std::span<const T> values, std::size_t columns);

/// A table's columns as datasets in `group`, with unit, initial value and position.
void write_table(Hdf5Id group, const dem::Table& table);
dem::Table read_table(Hdf5Id parent, const std::string& name);

} // namespace listric::archive

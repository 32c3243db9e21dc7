#pragma once

#include "dem/column.hpp"

#include <hdf5.h>

#include <string>
#include <vector>

namespace listric::archive {

// Tables, numbers and texts in groups of an HDF5 file. Everything here throws StorageError, and
// ends the process where memory runs out within HDF5.

/// Makes HDF5 ready for work that takes so much memory. Throws std::bad_alloc where there is not
/// that much: HDF5 does not survive to find out.
void prepare_hdf5(double bytes);

/// An HDF5 identifier that closes itself.
class Handle {
public:
    /// @param what  what could not be done, if `id` is not valid
    Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what);
    ~Handle();
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// @param what  what could not be done, if `status` says so
void check(herr_t status, const std::string& what);

Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);

/// Names of what is in a group, sorted.
std::vector<std::string> names_in(hid_t group);

/// A text of any length as a dataset.
void write_text(hid_t group, const char* name, const std::string& text);
std::string read_text(hid_t group, const char* name);

/// A short text as an attribute: HDF5 has room for 64 kB in an object's attributes.
void write_text_attribute(hid_t object, const char* name, const std::string& text);
std::string read_text_attribute(hid_t object, const char* name);

/// A number as an attribute: a double or a std::int64_t.
template <class T> void write_number(hid_t object, const char* name, T value);
template <class T> T read_number(hid_t object, const char* name);

/// Names of a group's own attributes, sorted.
std::vector<std::string> attributes_of(hid_t object);

/// A table's columns as datasets in `group`, with unit, initial value and position.
void write_table(hid_t group, const dem::Table& table);
dem::Table read_table(hid_t parent, const std::string& name);

} // namespace listric::archive

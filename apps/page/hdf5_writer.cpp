// What a snapshot asks of HDF5 where it is written (apps/archive/snapshot/hdf5_table.hpp), without
// its library. An identifier is the place of an object in memory.

#include "apps/archive/snapshot/hdf5_table.hpp"
#include "apps/page/hdf5_image.hpp"
#include "apps/support/error.hpp"

#include <memory>
#include <variant>

namespace listric::archive {

namespace {

Hdf5Object& object_of(Hdf5Id id) {
    return *reinterpret_cast<Hdf5Object*>(static_cast<std::intptr_t>(id));
}

Hdf5Id id_of(Hdf5Object& object) { return reinterpret_cast<std::intptr_t>(&object); }

int leave(Hdf5Id) { return 0; }

void put_attribute(Hdf5Id object, const char* name, Hdf5Data data) {
    object_of(object).attributes.emplace_back(name, std::move(data));
}

} // namespace

void prepare_hdf5(double) {}

Handle::Handle(Hdf5Id id, Close close, const std::string&) : id_(id), close_(close) {}
Handle::~Handle() { close_(id_); }

Handle make_file() {
    const auto forget = [](Hdf5Id id) {
        delete &object_of(id);
        return 0;
    };
    return {id_of(*std::make_unique<Hdf5Object>().release()), forget, ""};
}

std::vector<std::byte> image_of(Hdf5Id file) { return hdf5_image(object_of(file)); }

Handle create_group(Hdf5Id parent, const std::string& name) {
    return {id_of(object_of(parent).add(name)), leave, ""};
}

void write_text(Hdf5Id group, const char* name, const std::string& text) {
    object_of(group).add(name, hdf5_text(text, true));
}

void write_text_attribute(Hdf5Id object, const char* name, const std::string& text) {
    put_attribute(object, name, hdf5_text(text, false));
}

template <class T> void write_number(Hdf5Id object, const char* name, T value) {
    put_attribute(object, name, hdf5_number(value));
}
template void write_number(Hdf5Id, const char*, double);
template void write_number(Hdf5Id, const char*, std::int64_t);

void write_table(Hdf5Id group, const dem::Table& table) {
    write_number(group, "rows", static_cast<std::int64_t>(table.rows()));
    std::int64_t position = 0;
    for (const dem::Column& column : table.columns()) {
        Hdf5Object& set = object_of(group).add(
            column.name,
            std::visit([](const auto& values) { return hdf5_column(values); }, column.values));
        const Hdf5Id id = id_of(set);
        write_text_attribute(id, "unit", column.unit);
        put_attribute(id, "initial",
                      std::visit([](auto value) { return hdf5_number(value); }, column.initial));
        if (!column.begins_as.empty())
            write_text_attribute(id, "begins_as", column.begins_as);
        if (column.is_note)
            write_number(id, "is_note", std::int64_t{1});
        write_number(id, "position", position++);
    }
}

} // namespace listric::archive

#include "apps/studies/dataset/section_file.hpp"

#include "apps/archive/snapshot/hdf5_table.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/sha256.hpp"

#include <bit>

namespace listric {

namespace fs = std::filesystem;
using namespace archive;

static_assert(std::endian::native == std::endian::little); // or hashes would be of other bytes

SectionRecord write_section(const fs::path& file, const LabelledSection& section,
                            const std::string& made_of) {
    SectionRecord record{.made_of = made_of};
    const Handle hdf5 = make_file();
    Sha256 hash;
    const auto write = [&](const char* name, const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        write_matrix<T>(hdf5, name, std::span<const T>(values), section.samples);
        hash.add(std::as_bytes(std::span<const T>(values)));
    };
    write("image", section.image);
    write("fault", section.fault);
    write("fault_throw", section.fault_throw);
    write("layer", section.layer);
    write("strain", section.strain);
    write("reflectivity", section.reflectivity);
    for (const auto& [name, value] : section.numbers)
        record.numbers[name] = value;
    record.numbers["faults"] = static_cast<double>(section.faults);
    record.numbers["marked_throw_m"] = section.greatest_throw;
    for (const auto& [name, value] : record.numbers)
        write_number(hdf5, name.c_str(), value);
    record.sha256 = hash.hexadecimal();
    write_text_attribute(hdf5, "sha256", record.sha256);
    write_text_attribute(hdf5, "made_of", made_of);
    write_bytes(file, image_of(hdf5));
    return record;
}

std::optional<SectionRecord> read_section_record(const fs::path& file) {
    if (!fs::exists(file))
        return std::nullopt;
    try {
        const Handle hdf5 = open_file(file);
        SectionRecord record{
            read_text_attribute(hdf5, "made_of"), read_text_attribute(hdf5, "sha256"), {}};
        for (const std::string& name : attributes_of(hdf5))
            if (name != "made_of" && name != "sha256")
                record.numbers[name] = read_number<double>(hdf5, name.c_str());
        return record;
    } catch (const StorageError&) {
        return std::nullopt; // it is made again
    }
}

} // namespace listric

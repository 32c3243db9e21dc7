#include "apps/archive/snapshot/snapshot.hpp"

#include "apps/archive/snapshot/checksum.hpp"
#include "apps/archive/snapshot/hdf5_table.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/version.hpp"
#include "dem/numbers/hash.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <charconv>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace listric::archive {

using namespace dem;

namespace {

namespace fs = std::filesystem;

// Raised when a file can no longer be read by a program of before, or no longer has all that a
// state needs. 6: the scene is a text of its own; as an attribute of format 5 it had room for 64
// kB. 7: materials of layers have more properties. 8: the column start_extension, which held the
// travel, is start_travel.
constexpr int format = 8;
constexpr int oldest_format = 5; // that is read, too
constexpr std::string_view kind = "listric snapshot ";

/// The state's numbers by name; used to write and to read.
template <class AnyState, class Visit> void for_each_number(AnyState& s, Visit&& visit) {
    visit("seed", s.seed);
    visit("cycle", s.clock.cycle);
    visit("time_step", s.clock.time_step);
    visit("extension", s.clock.extension.m);
    visit("initial_mass", s.ledger.initial);
    visit("deposited_mass", s.ledger.deposited);
    visit("removed_mass", s.ledger.removed);
    visit("next_id", s.next_id);
    visit("mean_radius", s.mean_radius);
    visit("inertial_mass_floor", s.inertial_mass_floor);
    visit("skin", s.skin);
    visit("searched_extension", s.searched_extension);
    visit("displacement_bound", s.displacement_bound);
    visit("window_speed", s.window_speed);
    visit("look_interval", s.check_interval);
}

/// Properties of a material, for reading and for writing.
template <class AnyMaterial, class Visit> void for_each_property(AnyMaterial& m, Visit&& visit) {
    visit("normal_stiffness", m.normal_stiffness);
    visit("shear_stiffness", m.shear_stiffness);
    visit("friction", m.friction);
    visit("bondable", m.bondable);
}

/// Properties that only materials of layers have.
template <class AnyMaterial, class Visit>
void for_each_property_of_layer(AnyMaterial& m, Visit&& visit) {
    visit("is_soft", m.is_soft);
    visit("is_welded", m.is_welded);
    visit("weak_of", m.weak_of);
}

/// Strength of a layer's bonds, for reading and for writing.
template <class AnyStrength, class Visit> void for_each_strength(AnyStrength& s, Visit&& visit) {
    visit("tensile_mean", s.tensile_mean);
    visit("tensile_deviation", s.tensile_deviation);
    visit("shear_mean", s.shear_mean);
    visit("shear_deviation", s.shear_deviation);
}

/// The tables that every state has.
template <class AnyState, class Visit> void for_each_table(AnyState& s, Visit&& visit) {
    visit("discs", s.discs);
    visit("contacts", s.contacts);
    visit("base_contacts", s.base_contacts);
}

/// Numbers of a run.
template <class AnyRecord, class Visit> void for_each_run_number(AnyRecord& r, Visit&& visit) {
    visit("disc_steps", r.disc_steps);
    visit("predicted_seconds", r.predicted_seconds);
}

/// As what a number or a truth value stands in the file.
template <class T> using Stored = std::conditional_t<std::is_integral_v<T>, std::int64_t, double>;

/// Visitor that writes what it is shown into the attributes of `object`.
auto writes_numbers(Hdf5Id object) {
    return [object](const char* name, const auto& value) {
        using T = std::decay_t<decltype(value)>;
        write_number(object, name, static_cast<Stored<T>>(value));
    };
}

/// Visitor that reads them back.
auto reads_numbers(Hdf5Id object) {
    return [object](const char* name, auto& value) {
        using T = std::decay_t<decltype(value)>;
        value = static_cast<T>(read_number<Stored<T>>(object, name));
    };
}

/// Memory of an event.
struct Memory {
    const Table& table;
    std::int64_t applied;
};

/// All that a snapshot holds, wherever it is kept.
struct Content {
    const State& state;
    std::map<std::string_view, Memory> memories; ///< by the event's name
    const RunRecord& record;
};

Content content_of(const State& state, std::span<const std::unique_ptr<Event>> events,
                   const RunRecord& record) {
    Content content{state, {}, record};
    for (const auto& event : events)
        content.memories.emplace(event->name(), Memory{event->memory, event->applied});
    return content;
}

Content content_of(const Snapshot& snapshot) {
    Content content{snapshot.state, {}, snapshot.record};
    for (const auto& [name, table] : snapshot.event_memory)
        content.memories.emplace(name, Memory{table, snapshot.event_applied.at(name)});
    return content;
}

/// Hash of all that a snapshot holds, so that a damaged file is not taken for another state.
std::uint64_t content_hash(const Content& content) {
    std::uint64_t h = hash(content.state, Notes::counted);
    const auto add = [&h](std::uint64_t word) { h = chained(h, word); };
    const auto add_text = [&](std::string_view text) {
        add(text.size());
        for (char letter : text)
            add(static_cast<unsigned char>(letter));
    };
    for (const auto& [name, memory] : content.memories) {
        add_text(name);
        add(hash(memory.table));
        add(static_cast<std::uint64_t>(memory.applied));
    }
    const RunRecord& record = content.record;
    add_text(record.scene);
    add(hash(record.history));
    for_each_run_number(
        record, [&](const char*, double value) { add(std::bit_cast<std::uint64_t>(value)); });
    for (const auto& [part, seconds] : record.seconds_by_part) {
        add_text(part);
        add(std::bit_cast<std::uint64_t>(seconds));
    }
    for (const std::string& earlier : record.earlier_versions)
        add_text(earlier);
    return h;
}

void write_state(Hdf5Id file, const State& state) {
    for_each_number(state, writes_numbers(file));
    if (state.clock.travel.m != state.clock.extension.m) // the way and the place: stages of motion
        write_number(file, "travel", state.clock.travel.m);
    for_each_table(state, [&](const char* name, const Table& table) {
        write_table(create_group(file, name), table);
    });
    if (state.base_nodes.rows() > 0) {
        write_table(create_group(file, "base_nodes"), state.base_nodes);
        const Handle base_memory = create_group(file, "base_memory");
        for (const auto& [name, table] : state.base_memory)
            write_table(create_group(base_memory, name), table);
    }
    const Handle materials = create_group(file, "materials");
    for (std::size_t k = 0; k < state.materials.size(); ++k) {
        const Material& m = state.materials[k];
        const Handle group = create_group(materials, std::to_string(k));
        for_each_property(m, writes_numbers(group));
        if (m.rolling_friction != 0.0)
            write_number(group, "rolling_friction", m.rolling_friction);
        if (k <= weak)
            continue;
        for_each_property_of_layer(m, writes_numbers(group));
        if (m.bonds) {
            for_each_strength(*m.bonds, writes_numbers(group));
            write_number(group, "strength_is_force",
                         std::int64_t{m.bonds->reading == StrengthReading::force});
        }
    }
}

/// The discs, whose columns have other names in a file of before.
Table with_present_names(Table discs) {
    if (!discs.has("start_extension"))
        return discs;
    Table renamed;
    for (Column column : discs.columns()) {
        if (column.name == "start_extension")
            column.name = "start_travel";
        renamed.set(std::move(column));
    }
    return renamed;
}

State read_state(Hdf5Id file) {
    State state;
    for_each_number(state, reads_numbers(file));
    state.clock.travel = Travel(has_attribute(file, "travel") ? read_number<double>(file, "travel")
                                                              : state.clock.extension.m);
    for_each_table(state, [&](const char* name, Table& table) { table = read_table(file, name); });
    state.discs = with_present_names(std::move(state.discs));
    if (has_member(file, "base_nodes")) {
        state.base_nodes = read_table(file, "base_nodes");
        const Handle base_memory = open_group(file, "base_memory");
        for (const std::string& name : names_in(base_memory))
            state.base_memory[name] = read_table(base_memory, name);
    }
    const Handle materials = open_group(file, "materials");
    state.materials.resize(names_in(materials).size());
    for (std::size_t k = 0; k < state.materials.size(); ++k) {
        Material& m = state.materials[k];
        const Handle group = open_group(materials, std::to_string(k));
        for_each_property(m, reads_numbers(group));
        if (has_attribute(group, "rolling_friction"))
            m.rolling_friction = read_number<double>(group, "rolling_friction");
        if (k <= weak)
            continue;
        for_each_property_of_layer(m, reads_numbers(group));
        if (has_attribute(group, "tensile_mean")) {
            m.bonds.emplace();
            for_each_strength(*m.bonds, reads_numbers(group));
            m.bonds->reading = read_number<std::int64_t>(group, "strength_is_force") != 0
                                   ? StrengthReading::force
                                   : StrengthReading::stress;
        }
    }
    return state;
}

void write_memories(Hdf5Id file, std::span<const std::unique_ptr<Event>> events) {
    const Handle memories = create_group(file, "events");
    for (const auto& event : events) {
        const Handle group = create_group(memories, event->name());
        write_number(group, "applied", event->applied);
        write_table(group, event->memory);
    }
}

void read_memories(Hdf5Id file, Snapshot& snapshot) {
    const Handle memories = open_group(file, "events");
    for (const std::string& name : names_in(memories)) {
        const Handle group = open_group(memories, name);
        snapshot.event_applied[name] = read_number<std::int64_t>(group, "applied");
        snapshot.event_memory[name] = read_table(memories, name);
    }
}

void write_record(Hdf5Id file, const RunRecord& record) {
    const Handle run = create_group(file, "run");
    write_text(run, "scene", record.scene);
    if (!record.earlier_versions.empty())
        write_text(run, "earlier_versions",
                   fmt::format("{}", fmt::join(record.earlier_versions, "\n")));
    for_each_run_number(record, writes_numbers(run));
    write_table(create_group(run, "history"), record.history);
    const Handle parts = create_group(run, "seconds_by_part");
    for (const auto& [part, seconds] : record.seconds_by_part)
        write_number(parts, part.c_str(), seconds);
}

RunRecord read_record(Hdf5Id file) {
    RunRecord record;
    const Handle run = open_group(file, "run");
    record.scene = has_attribute(run, "scene") ? read_text_attribute(run, "scene") // format 5
                                               : read_text(run, "scene");
    if (has_member(run, "earlier_versions")) {
        std::istringstream lines(read_text(run, "earlier_versions"));
        for (std::string line; std::getline(lines, line);)
            record.earlier_versions.push_back(line);
    }
    for_each_run_number(record, reads_numbers(run));
    record.history = read_table(run, "history");
    const Handle parts = open_group(run, "seconds_by_part");
    for (const std::string& part : attributes_of(parts))
        record.seconds_by_part[part] = read_number<double>(parts, part.c_str());
    record.written_by = read_text_attribute(file, "version");
    return record;
}

/// The HDF5 file as bytes.
std::vector<std::byte> file_image(const State& state,
                                  std::span<const std::unique_ptr<Event>> events,
                                  const RunRecord& record) {
    const Handle file = make_file();
    write_text_attribute(file, "format", std::string(kind) + std::to_string(format));
    write_text_attribute(file, "version", std::string(version));
    write_text_attribute(file, "coordinates",
                         "x: m from the breakaway; y: m above the original surface (y = 0)");
    write_state(file, state);
    write_memories(file, events);
    write_record(file, record);
    const std::uint64_t h = content_hash(content_of(state, events, record));
    write_number(file, "content_hash", static_cast<std::int64_t>(h));
    return image_of(file);
}

constexpr double hdf5_itself = 3e6; // bytes that it takes for a file of a few discs

/// Memory for making a file's image, bytes: HDF5 has it, and a part of it twice as it grows, and we
/// take a copy. Most of it are discs and contacts.
double need_of_image(const State& state) {
    double bytes = 0.0;
    for_each_table(state, [&](const char*, const Table& table) {
        for (const Column& column : table.columns())
            std::visit(
                [&](const auto& values) {
                    bytes += static_cast<double>(values.size() * sizeof values[0]);
                },
                column.values);
    });
    return 2.0 * bytes + hdf5_itself;
}

/// Memory for reading a file, bytes: its columns are packed to a third or more.
double need_of_file(const fs::path& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    return (error ? 0.0 : 4.0 * static_cast<double>(size)) + hdf5_itself;
}

void check_format(const std::string& found, const std::string& writer) {
    int number = 0;
    if (found.starts_with(kind))
        std::from_chars(found.data() + kind.size(), found.data() + found.size(), number);
    if (number == 0)
        throw StorageError("is not a snapshot");
    if (number < oldest_format || number > format)
        throw UsageError(fmt::format("is of format {}, written by version {}, and this program "
                                     "({}) reads formats {} to {}; go on with {}",
                                     number, writer, version, oldest_format, format,
                                     number > format ? "a newer program" : "that version"));
}

/// Calls read(file). HDF5 must not see a damaged file, for it reads beyond what is damaged: the
/// checksum comes first.
template <class Read> auto read_verified(const fs::path& path, Read&& read) {
    const bool verified = verify_checksum(path);
    const Handle file = open_file(path); // it is whole from the moment that it has its name
    check_format(read_text_attribute(file, "format"), read_text_attribute(file, "version"));
    if (!verified)
        throw StorageError("is damaged (it lacks its checksum)");
    return read(file);
}

/// Reads a file; an error names it.
template <class Read> auto read_file(const fs::path& path, Read&& read) {
    try {
        prepare_hdf5(need_of_file(path));
        return read_verified(path, read);
    } catch (const UsageError& error) {
        throw UsageError(path.string() + ": " + error.what());
    } catch (const std::bad_alloc&) { // the file is good
        throw;
    } catch (const UnreadableFile& error) {
        throw UnreadableFile(path.string() + ": " + error.what());
    } catch (const std::exception& error) {
        throw StorageError(path.string() + ": " + error.what());
    }
}

Snapshot read_all(Hdf5Id file) {
    Snapshot snapshot;
    snapshot.state = read_state(file);
    read_memories(file, snapshot);
    snapshot.record = read_record(file);
    const auto recorded =
        static_cast<std::uint64_t>(read_number<std::int64_t>(file, "content_hash"));
    if (content_hash(content_of(snapshot)) != recorded)
        throw StorageError("is damaged (its content does not match its hash)");
    return snapshot;
}

} // namespace

std::vector<std::byte> snapshot_bytes(const State& state,
                                      std::span<const std::unique_ptr<Event>> events,
                                      const RunRecord& record) {
    prepare_hdf5(need_of_image(state));
    std::vector<std::byte> bytes = file_image(state, events, record);
    append_checksum(bytes); // behind the end of the HDF5 file, where HDF5 does not look
    return bytes;
}

void write_snapshot(const fs::path& path, const State& state,
                    std::span<const std::unique_ptr<Event>> events, const RunRecord& record) {
    std::vector<std::byte> bytes;
    try {
        bytes = snapshot_bytes(state, events, record);
    } catch (const StorageError& error) {
        throw StorageError(path.string() + ": " + error.what());
    }
    write_bytes(path, bytes);
}

Snapshot read_snapshot(const fs::path& path) { return read_file(path, read_all); }

RunRecord read_run_record(const fs::path& path) { return read_file(path, read_record); }

std::uint64_t run_hash(const State& state, std::span<const std::unique_ptr<Event>> events) {
    return hash(state, events);
}

std::uint64_t run_hash(const Snapshot& snapshot) {
    std::map<std::string_view, std::uint64_t> memories;
    for (const auto& [name, memory] : snapshot.event_memory)
        memories[name] = hash(memory);
    return hash(snapshot.state, memories);
}

} // namespace listric::archive

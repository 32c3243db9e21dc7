#include "apps/archive/snapshot.hpp"

#include "apps/support/version.hpp"

#include <hdf5.h>

#include <bit>
#include <cstring>
#include <fstream>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;

/// An HDF5 identifier that closes itself.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t), const char* what) : id_(id), close_(close) {
        if (id < 0)
            throw StorageError(what);
    }
    ~Handle() {
        if (id_ >= 0)
            close_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

void check(herr_t status, const char* what) {
    if (status < 0)
        throw StorageError(what);
}

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

void write_attribute(hid_t object, const char* name, const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "type");
    check(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)), "string size");
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "dataspace");
    const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, "attribute");
    std::string padded = text.empty() ? std::string(1, '\0') : text;
    check(H5Awrite(attribute, type, padded.data()), "writing an attribute");
}

std::string read_attribute(hid_t object, const char* name) {
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "missing attribute");
    const Handle type(H5Aget_type(attribute), H5Tclose, "type");
    std::string text(H5Tget_size(type), '\0');
    check(H5Aread(attribute, type, text.data()), "reading an attribute");
    while (!text.empty() && text.back() == '\0')
        text.pop_back();
    return text;
}

template <class T> void write_attribute_value(hid_t object, const char* name, T value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "dataspace");
    const Handle attribute(
        H5Acreate2(object, name, hdf5_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
        "attribute");
    check(H5Awrite(attribute, hdf5_type<T>(), &value), "writing an attribute");
}

template <class T> T read_attribute_value(hid_t object, const char* name) {
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "missing attribute");
    T value{};
    check(H5Aread(attribute, hdf5_type<T>(), &value), "reading an attribute");
    return value;
}

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
            write_attribute(set, "unit", column.unit);
            write_attribute_value(set, "initial", std::get<T>(column.initial));
            write_attribute_value(set, "position", static_cast<std::int64_t>(position));
        },
        column.values);
}

Handle create_group(hid_t parent, const std::string& name) {
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
            "group"};
}

void write_table(hid_t group, const Table& table) {
    write_attribute_value(group, "rows", static_cast<std::int64_t>(table.rows()));
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        write_column(group, table.columns()[k], k);
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

template <class T> Column read_values(hid_t set, const std::string& name, std::size_t size) {
    std::vector<T> values(size);
    check(H5Dread(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "reading a column");
    return {name, read_attribute(set, "unit"), std::move(values),
            read_attribute_value<T>(set, "initial")};
}

Table read_table(hid_t parent, const std::string& name) {
    const Handle group(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "missing group");
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
        columns.emplace(read_attribute_value<std::int64_t>(set, "position"), std::move(read));
    }
    Table table;
    for (auto& [position, column] : columns)
        table.set(std::move(column));
    if (table.columns().empty())
        table.resize(static_cast<std::size_t>(read_attribute_value<std::int64_t>(group, "rows")));
    return table;
}

/// The state's numbers, each as a member pointer would be; used to write and to read.
template <class AnyState, class Visit> void for_each_number(AnyState& s, Visit&& visit) {
    visit("cycle", s.clock.cycle);
    visit("time_step", s.clock.time_step);
    visit("extension", s.clock.extension);
    visit("initial_mass", s.ledger.initial);
    visit("deposited_mass", s.ledger.deposited);
    visit("removed_mass", s.ledger.removed);
    visit("next_id", s.next_id);
    visit("mean_radius", s.mean_radius);
    visit("inertial_mass_floor", s.inertial_mass_floor);
    visit("skin", s.skin);
    visit("searched_extension", s.searched_extension);
    visit("displacement_bound", s.displacement_bound);
}

constexpr std::string_view format = "listric snapshot 4";
constexpr std::string_view format_without_checksum = "listric snapshot 3";

/// Hash of all that a snapshot holds, so that a damaged file is not taken for another state.
std::uint64_t content_hash(const Snapshot& snapshot) {
    std::uint64_t h = hash(snapshot.state);
    const auto stir = [&h](std::uint64_t word) {
        h = std::rotl(h ^ word, 29) * 0x9e3779b97f4a7c15u;
    };
    const auto stir_text = [&](std::string_view text) {
        stir(text.size());
        for (char letter : text)
            stir(static_cast<unsigned char>(letter));
    };
    for (const auto& [name, memory] : snapshot.event_memory) {
        stir_text(name);
        stir(hash(memory));
        stir(static_cast<std::uint64_t>(snapshot.event_applied.at(name)));
    }
    const RunRecord& record = snapshot.record;
    stir_text(record.scene);
    stir(hash(record.history));
    stir(std::bit_cast<std::uint64_t>(record.disc_steps));
    stir(std::bit_cast<std::uint64_t>(record.predicted_seconds));
    for (const auto& [part, seconds] : record.seconds_by_part) {
        stir_text(part);
        stir(std::bit_cast<std::uint64_t>(seconds));
    }
    return h;
}

/// The HDF5 file as bytes. It is made in memory: a disk that fills up while HDF5 writes leaves the
/// library in a state that cannot even be closed.
std::vector<std::byte> file_image(const State& state,
                                  std::span<const std::unique_ptr<Event>> events,
                                  const RunRecord& record) {
    const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "properties");
    check(H5Pset_fapl_core(in_memory, 1 << 20, false), "core driver");
    const Handle file(H5Fcreate("snapshot", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory), H5Fclose,
                      "cannot create the file");
    write_attribute(file, "format", std::string(format));
    write_attribute(file, "version", std::string(version));
    write_attribute_value(file, "seed", static_cast<std::int64_t>(state.seed));
    for_each_number(state, [&](const char* name, const auto& value) {
        write_attribute_value(file, name, value);
    });
    write_table(create_group(file, "discs"), state.discs);
    write_table(create_group(file, "contacts"), state.contacts);
    write_table(create_group(file, "base_contacts"), state.base_contacts);
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
        write_attribute_value(group, "normal_stiffness", m.normal_stiffness);
        write_attribute_value(group, "shear_stiffness", m.shear_stiffness);
        write_attribute_value(group, "friction", m.friction);
        write_attribute_value(group, "bondable", static_cast<std::int64_t>(m.bondable));
    }
    Snapshot content{state, {}, {}, record};
    const Handle memories = create_group(file, "events");
    for (const auto& event : events) {
        const Handle group = create_group(memories, event->name());
        write_attribute_value(group, "applied", event->applied);
        write_table(group, event->memory);
        content.event_memory[event->name()] = event->memory;
        content.event_applied[event->name()] = event->applied;
    }
    const Handle run = create_group(file, "run");
    // An attribute holds at most 64 kB; a scene is a few kB.
    write_attribute(run, "scene", record.scene);
    write_attribute_value(run, "disc_steps", record.disc_steps);
    write_attribute_value(run, "predicted_seconds", record.predicted_seconds);
    write_table(create_group(run, "history"), record.history);
    const Handle parts = create_group(run, "seconds_by_part");
    for (const auto& [part, seconds] : record.seconds_by_part)
        write_attribute_value(parts, part.c_str(), seconds);
    write_attribute_value(file, "content_hash", static_cast<std::int64_t>(content_hash(content)));
    check(H5Fflush(file, H5F_SCOPE_LOCAL), "flushing");
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    std::vector<std::byte> image(size > 0 ? static_cast<std::size_t>(size) : 0);
    if (size <= 0 || H5Fget_file_image(file, image.data(), image.size()) < 0)
        throw StorageError("no file image");
    return image;
}

// The file ends with a mark and a sum of all bytes before it. HDF5 does not look there. Snapshots
// of earlier versions of the program have none.
constexpr std::string_view checksum_mark = "listric checksum"; // 16 bytes, 8 more are the sum
constexpr std::size_t checksum_bytes = checksum_mark.size() + sizeof(std::uint64_t);

std::uint64_t checksum(std::span<const std::byte> bytes) {
    std::uint64_t sum = bytes.size();
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), sizeof sum))) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), std::min(bytes.size(), sizeof word));
        sum = std::rotl(sum ^ word, 29) * 0x9e3779b97f4a7c15u; // one to one for every word
    }
    return sum;
}

void append_checksum(std::vector<std::byte>& bytes) {
    const std::uint64_t sum = checksum(bytes);
    const auto* mark = reinterpret_cast<const std::byte*>(checksum_mark.data());
    const auto* word = reinterpret_cast<const std::byte*>(&sum);
    bytes.insert(bytes.end(), mark, mark + checksum_mark.size());
    bytes.insert(bytes.end(), word, word + sizeof sum);
}

/// False if the file has no checksum. Throws if it has one that is not its own: HDF5 must not see
/// such a file, for it reads beyond what is damaged.
bool verify_checksum(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (error || !in)
        throw StorageError("cannot be read");
    std::vector<std::byte> bytes(size);
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw StorageError("cannot be read");
    if (size < checksum_bytes)
        throw StorageError("is not a snapshot");
    const std::span content(bytes.data(), size - checksum_bytes);
    if (std::memcmp(content.data() + content.size(), checksum_mark.data(), checksum_mark.size()))
        return false;
    std::uint64_t sum = 0;
    std::memcpy(&sum, bytes.data() + size - sizeof sum, sizeof sum);
    if (sum != checksum(content))
        throw StorageError("is damaged (its bytes do not match their checksum)");
    return true;
}

void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

} // namespace

void write_snapshot(const fs::path& path, const State& state,
                    std::span<const std::unique_ptr<Event>> events, const RunRecord& record) {
    silence_hdf5();
    std::vector<std::byte> bytes = file_image(state, events, record);
    append_checksum(bytes);
    write_bytes(path, bytes);
}

Snapshot read_snapshot(const fs::path& path) {
    silence_hdf5();
    try {
        const bool verified = verify_checksum(path);
        const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                          "cannot be opened as HDF5");
        const std::string found = read_attribute(file, "format");
        if (found != format && found != format_without_checksum)
            throw StorageError("is not a snapshot of this version of the program");
        if (found == format && !verified)
            throw StorageError("is damaged (it lacks its checksum)");
        Snapshot snapshot;
        State& state = snapshot.state;
        state.seed = static_cast<std::uint64_t>(read_attribute_value<std::int64_t>(file, "seed"));
        for_each_number(state, [&](const char* name, auto& value) {
            value = read_attribute_value<std::decay_t<decltype(value)>>(file, name);
        });
        state.discs = read_table(file, "discs");
        state.contacts = read_table(file, "contacts");
        state.base_contacts = read_table(file, "base_contacts");
        if (H5Lexists(file, "base_nodes", H5P_DEFAULT) > 0) {
            state.base_nodes = read_table(file, "base_nodes");
            const Handle base_memory(H5Gopen2(file, "base_memory", H5P_DEFAULT), H5Gclose,
                                     "base_memory");
            for (const std::string& name : names_in(base_memory))
                state.base_memory[name] = read_table(base_memory, name);
        }
        const Handle materials(H5Gopen2(file, "materials", H5P_DEFAULT), H5Gclose, "materials");
        for (std::size_t k = 0; k < names_in(materials).size(); ++k) {
            const Handle group(H5Gopen2(materials, std::to_string(k).c_str(), H5P_DEFAULT),
                               H5Gclose, "material");
            state.materials.push_back({read_attribute_value<double>(group, "normal_stiffness"),
                                       read_attribute_value<double>(group, "shear_stiffness"),
                                       read_attribute_value<double>(group, "friction"),
                                       read_attribute_value<std::int64_t>(group, "bondable") != 0});
        }
        const Handle memories(H5Gopen2(file, "events", H5P_DEFAULT), H5Gclose, "events");
        for (const std::string& name : names_in(memories)) {
            const Handle group(H5Gopen2(memories, name.c_str(), H5P_DEFAULT), H5Gclose, "event");
            snapshot.event_applied[name] = read_attribute_value<std::int64_t>(group, "applied");
            snapshot.event_memory[name] = read_table(memories, name);
        }
        const Handle run(H5Gopen2(file, "run", H5P_DEFAULT), H5Gclose, "run");
        snapshot.record.scene = read_attribute(run, "scene");
        snapshot.record.disc_steps = read_attribute_value<double>(run, "disc_steps");
        snapshot.record.predicted_seconds = read_attribute_value<double>(run, "predicted_seconds");
        snapshot.record.history = read_table(run, "history");
        const Handle parts(H5Gopen2(run, "seconds_by_part", H5P_DEFAULT), H5Gclose, "parts");
        const auto collect = [](hid_t location, const char* name, const H5A_info_t*,
                                void* into) -> herr_t {
            (*static_cast<std::map<std::string, double>*>(into))[name] =
                read_attribute_value<double>(location, name);
            return 0;
        };
        check(H5Aiterate2(parts, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect,
                          &snapshot.record.seconds_by_part),
              "parts");
        if (content_hash(snapshot) !=
            static_cast<std::uint64_t>(read_attribute_value<std::int64_t>(file, "content_hash")))
            throw StorageError("is damaged (its content does not match its hash)");
        return snapshot;
    } catch (const std::exception& error) {
        throw StorageError(path.string() + ": " + error.what());
    }
}

std::uint64_t run_hash(const State& state, std::span<const std::unique_ptr<Event>> events) {
    return hash(state, events);
}

std::uint64_t run_hash(const Snapshot& snapshot) {
    std::map<std::string_view, std::uint64_t> memories;
    for (const auto& [name, memory] : snapshot.event_memory)
        memories[name] = hash(memory);
    return hash(snapshot.state, memories);
}

} // namespace listric

#include "apps/scene.hpp"

#include "apps/declaration.hpp"
#include "apps/effects.hpp"
#include "dem/genesis.hpp"

// Without its assertions the parser reports a stray bracket where a value should be; with them
// toml++ 3.3 ends the program.
#define TOML_ASSERT(condition) static_assert(true)

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace listric {

namespace fs = std::filesystem;

namespace {

// ---------------------------------------------------------------------------------------- errors

/// A value of the document and the path of keys that leads to it.
struct Entry {
    const toml::node& node;
    std::string path;
};

[[noreturn]] void fail(std::string message) {
    std::ranges::replace(message, '\n', ' ');
    throw SceneError(message);
}

/// "file:line", or the option of the call that the value comes from.
std::string place(const toml::source_region& source) {
    const std::string origin = source.path ? *source.path : "";
    return origin.starts_with("--") ? origin : fmt::format("{}:{}", origin, source.begin.line);
}

[[noreturn]] void fail(const Entry& entry, std::string_view message) {
    fail(fmt::format("{}: {}: {}", place(entry.node.source()), entry.path, message));
}

std::string quoted(const std::string& string) {
    std::ostringstream stream;
    stream << toml::toml_formatter(toml::value<std::string>(string),
                                   toml::format_flags::allow_unicode_strings);
    return stream.str();
}

/// A float of TOML: it has a point or an exponent.
std::string toml_float(double x) {
    std::string number = text(x);
    return number.find_first_of(".en") == number.npos ? number + ".0" : number;
}

/// What a wrong value is: integer 3, string "abc", table.
std::string type_and_value(const toml::node& node) {
    if (const auto* number = node.as_floating_point())
        return "number " + toml_float(number->get());
    if (const auto* number = node.as_integer())
        return fmt::format("integer {}", number->get());
    if (const auto* string = node.as_string())
        return "string " + quoted(string->get());
    if (const auto* boolean = node.as_boolean())
        return boolean->get() ? "boolean true" : "boolean false";
    return node.is_table() ? "table" : node.is_array() ? "array" : "date or time";
}

[[noreturn]] void fail_type(const Entry& entry, std::string_view allowed) {
    fail(entry, fmt::format("wrong type ({}), allowed: {}", type_and_value(entry.node), allowed));
}

/// "did you mean mean_radius_m?", or else all that is allowed.
std::string advice(std::string_view name, const std::vector<std::string_view>& allowed) {
    const auto meant = nearest(name, allowed);
    return meant ? fmt::format("did you mean {}?", *meant)
                 : fmt::format("allowed: {}", fmt::join(allowed, ", "));
}

std::vector<std::string_view> keys(const std::vector<Parameter>& parameters) {
    std::vector<std::string_view> keys;
    std::ranges::transform(parameters, std::back_inserter(keys), &Parameter::key);
    return keys;
}

// --------------------------------------------------------------------------------------- reading

/// The number behind `node`, if it is one in the parameter's range.
double number(const Entry& entry, const Parameter& parameter) {
    const auto* integer = entry.node.as_integer();
    const auto* floating = entry.node.as_floating_point();
    if (!integer && !floating)
        fail_type(entry, type_of(parameter));
    const double x = integer ? static_cast<double>(integer->get()) : floating->get();
    if (!parameter.range.contains(x))
        fail(entry, fmt::format("out of range ({}), allowed: {}", text(x), text(parameter.range)));
    return x;
}

const toml::array& array(const Entry& entry, const Parameter& parameter) {
    if (!entry.node.is_array())
        fail_type(entry, type_of(parameter));
    return *entry.node.as_array();
}

const std::string& string(const Entry& entry, const Parameter& parameter) {
    if (!entry.node.is_string())
        fail_type(entry, type_of(parameter));
    return entry.node.as_string()->get();
}

/// Whether a parameter still has a default that it cannot keep.
bool must_be_given(const Parameter& parameter) {
    const auto* variable = std::get_if<double*>(&parameter.variable);
    return variable && !parameter.range.contains(**variable * parameter.per_si);
}

DetachmentSegment read_segment(const Entry& entry);

/// Reads an entry into a variable, one function for each type of variable.
struct Reader {
    const Entry& entry;
    const Parameter& parameter;

    void operator()(double* x) const { *x = number(entry, parameter) / parameter.per_si; }
    void operator()(std::optional<double>* x) const {
        *x = number(entry, parameter) / parameter.per_si;
    }
    void operator()(int* x) const { read_integer(x); }
    void operator()(std::uint64_t* x) const { read_integer(x); }
    void operator()(std::string* x) const { *x = string(entry, parameter); }

    void operator()(const Choice& choice) const {
        const std::string& name = string(entry, parameter);
        if (std::ranges::find(choice.names, name) == choice.names.end())
            fail(entry,
                 fmt::format("unknown value ({}), {}", quoted(name), advice(name, choice.names)));
        choice.set(name);
    }

    void operator()(std::vector<double>* x) const {
        x->clear();
        for (const toml::node& node : array(entry, parameter))
            x->push_back(number({node, item_path(x->size())}, parameter) / parameter.per_si);
    }

    void operator()(std::vector<DetachmentSegment>* x) const {
        x->clear();
        for (const toml::node& node : array(entry, parameter))
            x->push_back(read_segment({node, item_path(x->size())}));
    }

private:
    template <class Integer> void read_integer(Integer* x) const {
        if (!entry.node.is_integer())
            fail_type(entry, type_of(parameter));
        number(entry, parameter); // checks the range
        *x = static_cast<Integer>(entry.node.as_integer()->get());
    }

    std::string item_path(std::size_t index) const {
        return fmt::format("{}[{}]", entry.path, index);
    }
};

void read(const Entry& entry, const Parameter& parameter) {
    std::visit(Reader{entry, parameter}, parameter.variable);
}

void read_table(const Entry& entry, const std::vector<Parameter>& parameters) {
    if (!entry.node.is_table())
        fail_type(entry, "table");
    for (const auto& [key, node] : *entry.node.as_table()) {
        const Entry inner{node, fmt::format("{}.{}", entry.path, key.str())};
        const auto parameter = std::ranges::find(parameters, key.str(), &Parameter::key);
        if (parameter == parameters.end())
            fail(inner, fmt::format("unknown key, {}", advice(key.str(), keys(parameters))));
        read(inner, *parameter);
    }
    for (const Parameter& parameter : parameters) {
        if (must_be_given(parameter))
            fail(entry, fmt::format("needs {} ({}; {})", parameter.key, parameter.doc,
                                    text(parameter.range)));
    }
}

DetachmentSegment read_segment(const Entry& entry) {
    using Kind = DetachmentSegment::Kind;
    const toml::table* table = entry.node.as_table();
    if (!table || table->size() != 1)
        fail(entry, "needs exactly one of arc and line, "
                    "allowed: {arc = {radius_m = 15000.0}}, {line = {length_m = 5000.0}}");
    const auto [key, node] = *table->begin();
    const Entry inner{node, fmt::format("{}.{}", entry.path, key.str())};
    if (key != "arc" && key != "line")
        fail(inner, fmt::format("unknown segment, {}", advice(key.str(), {"arc", "line"})));
    DetachmentSegment segment;
    segment.kind = key == "arc" ? Kind::arc : Kind::line;
    read_table(inner, parameters(segment));
    return segment;
}

[[noreturn]] void fail_unknown(const Entry& entry, const std::vector<Parameter>& top,
                               const std::vector<SceneTable>& all) {
    std::vector<std::string_view> allowed = keys(top);
    std::ranges::transform(all, std::back_inserter(allowed), &SceneTable::name);
    // A parameter that lacks its table is worth recognising; --set damping=0.5 is easily typed.
    std::vector<std::string> meant;
    if (!nearest(entry.path, allowed)) {
        for (const SceneTable& table : all) {
            if (const auto key = nearest(entry.path, keys(table.parameters)))
                meant.push_back(fmt::format("{}.{}", table.name, *key));
        }
    }
    fail(entry,
         fmt::format("unknown {}, {}", entry.node.is_table() ? "table" : "key",
                     meant.empty() ? advice(entry.path, allowed)
                                   : fmt::format("did you mean {}?", fmt::join(meant, " or "))));
}

void drop_effects(const std::vector<std::string>& without, std::vector<SceneTable>& all) {
    std::vector<std::string_view> names, effects;
    for (const SceneTable& table : all) {
        names.push_back(table.name);
        if (table.is_effect && table.in_scene)
            effects.push_back(table.name);
    }
    const std::string in_scene =
        effects.empty() ? "the scene has no effects"
                        : fmt::format("effects in the scene: {}", fmt::join(effects, ", "));
    for (const std::string& name : without) {
        const auto refuse = [&](std::string_view what) {
            fail(fmt::format("--without {}: {} ({})", name, what, in_scene));
        };
        const auto table = std::ranges::find(all, name, &SceneTable::name);
        if (table == all.end()) {
            const auto meant = nearest(name, names);
            refuse(meant ? fmt::format("unknown table, did you mean {}?", *meant)
                         : "unknown table");
        }
        if (!table->is_effect)
            refuse("is not an effect and cannot be left out");
        if (std::ranges::find(effects, name) == effects.end())
            refuse("is not in the scene");
        table->in_scene = false;
    }
}

// ----------------------------------------------------------------------- files and --set options

fs::path scenes_folder() {
    const char* folder = std::getenv("LISTRIC_SCENES");
    return folder && *folder ? fs::path(folder) : fs::path(LISTRIC_SOURCE_DIR) / "apps/scenes";
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator file(scenes_folder(), error), end; !error && file != end;
         file.increment(error)) {
        if (file->path().extension() == ".toml")
            names.push_back(file->path().stem().string());
    }
    if (error)
        fail(fmt::format("{}: scenes folder cannot be read: {}", scenes_folder().string(),
                         error.message()));
    std::ranges::sort(names);
    return names;
}

fs::path find_scene(const std::string& scene) {
    const bool is_path = scene.find('/') != scene.npos || scene.ends_with(".toml");
    const fs::path path = is_path ? fs::path(scene) : scenes_folder() / (scene + ".toml");
    std::error_code error;
    if (fs::is_directory(path, error))
        fail(fmt::format("{}: is a directory, needs a scene file", path.string()));
    if (fs::exists(path, error))
        return path;
    const std::vector<std::string> shipped = scene_names();
    const std::vector<std::string_view> names(shipped.begin(), shipped.end());
    const auto meant = nearest(is_path ? path.stem().string() : scene, names);
    fail(fmt::format("{}: {}{} (scenes: {})", scene.empty() ? "\"\"" : scene,
                     error     ? error.message()
                     : is_path ? "no such file"
                               : "no such scene",
                     meant ? fmt::format(", did you mean {}?", *meant) : "",
                     fmt::join(names, ", ")));
}

/// `origin` is where messages say that the text comes from.
toml::table parse(const std::string& text, const std::string& origin) {
    try {
        return toml::parse(text, origin);
    } catch (const toml::parse_error& error) {
        fail(fmt::format("{}:{}:{}: {}", origin, error.source().begin.line,
                         error.source().begin.column, error.description()));
    }
}

toml::table read_file(const fs::path& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    std::getline(file, text, '\0'); // stops early where the file is not text
    if (!file.is_open() || file.bad())
        fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    if (!file.eof())
        fail(fmt::format("{}:{}: is not a text file (it has a NUL byte); a scene is TOML in UTF-8",
                         path.string(), 1 + std::ranges::count(text, '\n')));
    toml::table document = parse(text, path.string());
    if (document.empty())
        fail(fmt::format("{}: is empty; a scene has at least [hanging_wall] and [detachment], "
                         "or [flexure] and [elastic_base]",
                         path.string()));
    return document;
}

/// Moves the values over, tables into the tables of the same name. They keep their origin.
void merge(toml::table& into, toml::table& from) {
    for (auto&& [key, node] : from) {
        toml::table* table = into[key].as_table();
        if (table && node.is_table()) {
            merge(*table, *node.as_table());
        } else {
            into.insert_or_assign(key, std::move(node));
        }
    }
}

/// `assignment` is "table.key=value"; a value that is not TOML is a string.
void set(toml::table& document, const std::string& assignment, const std::string& origin) {
    const auto equals = assignment.find('=');
    const std::string key = assignment.substr(0, equals);
    const std::string value = equals == key.npos ? "" : assignment.substr(equals + 1);
    toml::table given;
    try {
        given = toml::parse(assignment, origin);
    } catch (const toml::parse_error&) {
        try {
            given = toml::parse(fmt::format("{}={}", key, quoted(value)), origin);
        } catch (const toml::parse_error&) {
        }
    }
    if (equals == key.npos || given.size() != 1)
        fail(fmt::format("{}: needs the form table.key=value", origin));
    merge(document, given);
}

// ------------------------------------------------------------------------- checks between tables

/// The value at `path`, or else its table, or else the document.
Entry entry_at(const toml::table& document, const std::string& path) {
    const std::string table = path.substr(0, path.find('.'));
    const toml::node* node = document.at_path(path).node();
    if (!node)
        node = document.get(table);
    return {node ? *node : document, path};
}

void check_detachment(const Scene& scene, const toml::table& document) {
    constexpr double tolerance = 1.0; // m
    const DetachmentParameters& detachment = *scene.detachment;
    const double thickness = scene.hanging_wall->thickness;
    const Entry entry = entry_at(document, "detachment.segments");
    if (detachment.segments.empty())
        fail(entry, "has no arc and no line, needs at least one, for example "
                    "segments = [{arc = {radius_m = 15000.0, end_dip_deg = 0.0}}]");
    double dip = detachment.start_dip;
    for (const DetachmentSegment& segment : detachment.segments) {
        const double start = segment.start_dip.value_or(dip);
        const bool is_arc = segment.kind == DetachmentSegment::Kind::arc;
        dip = is_arc ? segment.end_dip : start;
        if (is_arc && start == dip)
            fail(entry, fmt::format("has an arc that starts and ends with a dip of {} degrees, "
                                    "needs an end_dip_deg that differs, or a line",
                                    text(dip)));
    }
    if (dip != 0.0)
        fail(entry, fmt::format("ends with a dip of {} degrees, allowed: 0; let the last arc have "
                                "end_dip_deg = 0.0",
                                text(dip)));
    const double depth = -make_base(scene).surfaces.front().chain.back().end.y; // it never rises
    if (std::abs(depth - thickness) > tolerance)
        fail(entry, fmt::format("reaches a depth of {:.1f} m, allowed: hanging_wall.thickness_m = "
                                "{} within {} m; change the thickness, or radii and lengths; an "
                                "arc of radius R from dip a to dip b descends R |cos b - cos a|",
                                depth, text(thickness), tolerance));
    if (!(hanging_wall_area(scene) > 0.0))
        fail(entry, "stays at the surface up to the moving wall, needs to descend before "
                    "hanging_wall.length_m");
}

void check_resolution(const Scene& scene, const toml::table& document) {
    constexpr double fewest = 100, most = 5e6;
    const double radius = scene.hanging_wall->mean_radius;
    const double area = hanging_wall_area(scene);
    // Counted with so many discs that the count's being whole does not matter.
    HangingWallParameters fine = *scene.hanging_wall;
    fine.mean_radius = 1e-4 * std::sqrt(area);
    const double fine_discs = static_cast<double>(disc_count(fine, area));
    const auto radius_for = [&](double discs) {
        return fine.mean_radius * std::sqrt(fine_discs / discs);
    };
    const auto refuse = [&](const char* what, const char* bound, double allowed, double discs) {
        fail(entry_at(document, "hanging_wall.mean_radius_m"),
             fmt::format("too {} ({}), gives {} discs, allowed: at {} {:.4g} ({} discs)", what,
                         text(radius), estimated_discs(scene), bound, allowed, text(discs)));
    };
    // What is advised keeps away from the bound, because it is rounded.
    if (radius > radius_for(fewest))
        refuse("large", "most", 0.999 * radius_for(fewest), fewest);
    if (radius < radius_for(most))
        refuse("small", "least", 1.001 * radius_for(most), most);
}

/// A scene without discs has no effects on discs.
void check_flexure(const Scene& scene, const toml::table& document) {
    Scene copy = scene; // scene_tables() binds variables
    for (const SceneTable& table : scene_tables(copy)) {
        const bool allowed = !table.drop || table.name == "flexure" ||
                             table.name == "elastic_base" || table.name == "gravity";
        if (table.in_scene && !allowed)
            fail(entry_at(document, std::string(table.name)),
                 "needs discs, which a scene with [flexure] does not have; leave out one of the "
                 "two");
    }
    const auto& base = scene.elastic_base;
    if (!base)
        fail(entry_at(document, "flexure"), "needs [elastic_base], the plate that bends; add it");
    if (!(base->mantle_density > base->infill_density))
        fail(entry_at(document, "elastic_base.mantle_density_kg_per_m3"),
             fmt::format("is {}, allowed: above infill_density_kg_per_m3 = {}",
                         text(base->mantle_density), text(base->infill_density)));
    if (!(base->mantle_density >= base->crust_density) ||
        !(base->crust_density >= base->infill_density))
        fail(entry_at(document, "elastic_base.crust_density_kg_per_m3"),
             fmt::format("is {}, allowed: between those of infill ({}) and mantle ({}), for the "
                         "base to float upright",
                         text(base->crust_density), text(base->infill_density),
                         text(base->mantle_density)));
    // Waves shorter than the base is thick do not bend it, and cells would be flat.
    const auto refuse_short = [&](const char* key, double length, double least) {
        if (length < least)
            fail(entry_at(document, std::string("flexure.") + key),
                 fmt::format("too short ({}), allowed: at least {}, {}", text(length), text(least),
                             "a tenth of the elastic thickness"));
    };
    if (scene.flexure->load == FlexureLoad::sinusoid)
        refuse_short("wavelength_m", scene.flexure->wavelength, 0.1 * base->elastic_thickness);
    if (scene.flexure->load == FlexureLoad::strip)
        refuse_short("half_width_m", scene.flexure->half_width, 0.1 * base->elastic_thickness);
}

void check(const Scene& scene, const toml::table& document) {
    const auto needs = [&](const char* table, bool present, const char* needed, bool given) {
        if (present && !given)
            fail(entry_at(document, table),
                 fmt::format("needs [{1}], which the scene does not have; add [{1}] or leave out "
                             "[{0}]",
                             table, needed));
    };
    if (scene.flexure) {
        check_flexure(scene, document);
        return;
    }
    if (!scene.hanging_wall)
        fail(entry_at(document, "hanging_wall"),
             "is missing, every scene needs [hanging_wall] or [flexure]");
    if (!scene.detachment)
        fail(entry_at(document, "hanging_wall"),
             "needs [detachment], the surface on which it slides; add [detachment]");
    if (scene.elastic_base)
        fail(entry_at(document, "elastic_base"),
             "is not coupled to discs yet; leave it out, or use it with [flexure]");
    check_detachment(scene, document);
    check_resolution(scene, document);
    needs("bond_healing", scene.bond_healing.has_value(), "bonds", scene.bonds.has_value());
    needs("compaction", scene.compaction.has_value(), "sedimentation",
          scene.sedimentation.has_value());
}

// --------------------------------------------------------------------------------------- writing

/// The shortest number in units of the key that reads back as the same SI value, if there is any:
/// of two units, one may have fewer doubles around a value.
double in_key_units(double si, double per_si) {
    for (int digits = 1; per_si != 1.0 && digits <= 17; ++digits) {
        const std::string rounded = fmt::format("{:.{}g}", si * per_si, digits);
        const double x = std::strtod(rounded.c_str(), nullptr);
        if (x / per_si == si)
            return x;
    }
    return si * per_si;
}

/// Writes a variable, one function for each type; empty if there is nothing to write.
struct Writer {
    double per_si;

    std::string operator()(const double* x) const { return toml_float(in_key_units(*x, per_si)); }
    std::string operator()(const std::optional<double>* x) const {
        return *x ? operator()(&**x) : "";
    }
    std::string operator()(const int* x) const { return fmt::format("{}", *x); }
    std::string operator()(const std::uint64_t* x) const { return fmt::format("{}", *x); }
    std::string operator()(const std::string* x) const { return quoted(*x); }
    std::string operator()(const Choice& choice) const { return quoted(std::string(choice.get())); }
    std::string operator()(const std::vector<double>* x) const {
        std::vector<std::string> items;
        for (const double& item : *x)
            items.push_back(operator()(&item));
        return fmt::format("[{}]", fmt::join(items, ", "));
    }
    std::string operator()(const std::vector<DetachmentSegment>* x) const;
};

std::string write(const Parameter& parameter) {
    return std::visit(Writer{parameter.per_si}, parameter.variable);
}

std::string Writer::operator()(const std::vector<DetachmentSegment>* x) const {
    std::string lines;
    for (DetachmentSegment segment : *x) {
        std::vector<std::string> pairs;
        for (const Parameter& parameter : parameters(segment)) {
            if (const std::string value = write(parameter); !value.empty())
                pairs.push_back(fmt::format("{} = {}", parameter.key, value));
        }
        lines += fmt::format("    {{{} = {{{}}}}},\n",
                             segment.kind == DetachmentSegment::Kind::arc ? "arc" : "line",
                             fmt::join(pairs, ", "));
    }
    return lines.empty() ? "[]" : fmt::format("[\n{}]", lines);
}

/// Lines "key = value  # doc".
std::string write(const std::vector<Parameter>& parameters) {
    std::string lines;
    for (const Parameter& parameter : parameters)
        lines +=
            fmt::format("{:<40}  # {}\n", fmt::format("{} = {}", parameter.key, write(parameter)),
                        parameter.doc);
    return lines;
}

/// A parameter of the reference: a line with the default, a line with the meaning.
std::string explain(const Parameter& parameter) {
    const std::string value = must_be_given(parameter) ? "(required)" : write(parameter);
    std::vector<std::string> facts{type_of(parameter)};
    if (!parameter.unit.empty())
        facts.back() += fmt::format(" in {}", parameter.unit);
    if (const std::string range = text(parameter.range); !range.empty())
        facts.push_back(range);
    if (!parameter.symbol.empty())
        facts.push_back(fmt::format("symbol {}", parameter.symbol));
    return fmt::format("    {} = {}\n        {}\n        {}\n", parameter.key,
                       value.empty() ? "(none)" : value, parameter.doc, fmt::join(facts, "; "));
}

} // namespace

// ------------------------------------------------------------------------------------- interface

Scene load_scene(const SceneRequest& request) {
    const fs::path path = find_scene(request.scene);
    toml::table document = read_file(path);
    for (const std::string& assignment : request.set)
        set(document, assignment, "--set " + assignment);
    if (request.accuracy)
        set(document, "accuracy=" + quoted(*request.accuracy), "--accuracy " + *request.accuracy);
    if (request.seed) {
        const std::string seed = std::to_string(*request.seed);
        set(document, "seed=" + seed, "--seed " + seed);
    }

    Scene scene;
    scene.name = path.stem().string();
    const std::vector<Parameter> top = top_level(scene);
    std::vector<SceneTable> all = scene_tables(scene);
    for (const auto& [key, node] : document) {
        const Entry entry{node, std::string(key.str())};
        if (const auto parameter = std::ranges::find(top, key.str(), &Parameter::key);
            parameter != top.end()) {
            read(entry, *parameter);
        } else if (std::ranges::find(all, key.str(), &SceneTable::name) == all.end()) {
            fail_unknown(entry, top, all);
        }
    }
    const AccuracyLevel& level =
        *std::ranges::find(accuracy_levels(), scene.accuracy, &AccuracyLevel::name);
    scene.hanging_wall->mean_radius = level.mean_radius;
    scene.extension.speed = level.speed;
    for (SceneTable& table : all) {
        if (const toml::node* node = document.get(table.name)) {
            read_table({*node, std::string(table.name)}, table.parameters);
            table.in_scene = true;
        }
    }
    drop_effects(request.without, all);
    for (const SceneTable& table : all) {
        if (!table.in_scene)
            table.drop();
    }
    check(scene, document);
    return scene;
}

std::string to_toml(const Scene& scene) {
    Scene copy = scene; // scene_tables() binds variables
    std::string lines = fmt::format("# All parameters in force.\n\n{}", write(top_level(copy)));
    for (const SceneTable& table : scene_tables(copy)) {
        if (table.in_scene)
            lines +=
                fmt::format("\n[{}]  # {}\n{}", table.name, table.doc, write(table.parameters));
    }
    return lines;
}

std::string parameter_reference() {
    Scene scene;
    std::string lines = "At the top of the file\n";
    for (const Parameter& parameter : top_level(scene))
        lines += explain(parameter);
    for (const SceneTable& table : scene_tables(scene)) {
        lines += fmt::format("\n[{}]{}: {}\n", table.name, table.is_effect ? " (effect)" : "",
                             table.doc);
        for (const Parameter& parameter : table.parameters)
            lines += explain(parameter);
    }
    for (const auto kind : {DetachmentSegment::Kind::arc, DetachmentSegment::Kind::line}) {
        DetachmentSegment segment;
        segment.kind = kind;
        lines += fmt::format("\nSegment {{{} = {{...}}}} of [detachment]\n",
                             kind == DetachmentSegment::Kind::arc ? "arc" : "line");
        for (const Parameter& parameter : parameters(segment))
            lines += explain(parameter);
    }
    return lines;
}

double hanging_wall_area(const Scene& scene) {
    return scene.hanging_wall && scene.detachment && !scene.detachment->segments.empty()
               ? hanging_wall_area(*scene.hanging_wall, make_base(scene).surfaces.front().chain)
               : 0.0;
}

std::size_t estimated_discs(const Scene& scene) {
    return scene.hanging_wall ? disc_count(*scene.hanging_wall, hanging_wall_area(scene)) : 0;
}

std::vector<std::pair<std::string, std::string>> list_scenes() {
    std::vector<std::pair<std::string, std::string>> scenes;
    for (const std::string& name : scene_names()) {
        std::string description;
        try {
            const toml::table document = read_file(scenes_folder() / (name + ".toml"));
            description = document["description"].value_or(std::string());
        } catch (const SceneError& error) {
            description = error.what(); // one bad file must not hide the others
        }
        scenes.emplace_back(name, description);
    }
    return scenes;
}

} // namespace listric

#include "apps/scene/toml/toml.hpp"

#include "apps/scene/toml/pieces.hpp"
#include "apps/scene/toml/toml_slips.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

namespace listric {

using namespace dem;

// ---------------------------------------------------------------------------------------- errors

void fail(std::string message) {
    std::ranges::replace(message, '\n', ' ');
    throw SceneError(shown(message)); // it may repeat what somebody wrote
}

namespace {

/// "file:line", or the option of the call that the value comes from.
std::string place(const toml::source_region& source) {
    const std::string origin = source.path ? *source.path : "";
    return origin.starts_with("--") ? origin : fmt::format("{}:{}", origin, source.begin.line);
}

} // namespace

void fail(const Entry& entry, std::string_view message) {
    const std::string path = entry.path.empty() ? "" : entry.path + ": "; // none: the whole file
    fail(fmt::format("{}: {}{}", place(entry.node.source()), path, message));
}

std::string quoted(const std::string& string) {
    std::ostringstream stream;
    stream << toml::toml_formatter(toml::value<std::string>(string),
                                   toml::format_flags::allow_unicode_strings);
    return stream.str();
}

std::string toml_float(double x) {
    std::string number = text(x);
    return number.find_first_of(".en") == number.npos ? number + ".0" : number;
}

namespace {

/// Description of a wrong value: integer 3, string "abc", table.
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

} // namespace

void fail_type(const Entry& entry, std::string_view allowed) {
    const auto* string = entry.node.as_string();
    const bool is_of_number = allowed.starts_with("number") || allowed.starts_with("integer");
    fail(entry,
         fmt::format("wrong type ({}), allowed: {}{}", type_and_value(entry.node), allowed,
                     string && is_of_number ? cure_of_number(entry.path, string->get()) : ""));
}

// --------------------------------------------------------------------------------------- reading

namespace {

/// The number behind `node`, if it is one in the parameter's range.
double number(const Entry& entry, const Parameter& parameter) {
    const auto* integer = entry.node.as_integer();
    const auto* floating = entry.node.as_floating_point();
    if (!integer && !floating)
        fail_type(entry, type_of(parameter));
    const double x = integer ? static_cast<double>(integer->get()) : floating->get();
    if (!parameter.range.contains(x))
        fail(entry,
             fmt::format("out of range ({}), allowed: {}{}{}", text(x), text(parameter.range),
                         parameter.range.reason.empty() ? "" : "; ", parameter.range.reason));
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
    const std::string& text = entry.node.as_string()->get();
    if (const auto place = unsound_byte(text)) // "\u0000" is TOML
        fail(entry, fmt::format("\"{}\" {}", text, objection_to_byte(text, *place)));
    return text;
}

dem::DetachmentSegment read_segment(const Entry& entry);
std::vector<Point> read_points(const Entry& entry, const Parameter& parameter);
std::vector<TargetStage> read_target(const Entry& entry, const Parameter& parameter);

/// Reads an entry into an object, one function for each type of value.
struct Reader {
    const Entry& entry;
    const Parameter& parameter;
    void* object;

    void operator()(const Place<double>& x) const {
        x.reach(object) = number(entry, parameter) / parameter.per_si;
    }
    void operator()(const Place<std::optional<double>>& x) const {
        x.reach(object) = number(entry, parameter) / parameter.per_si;
    }
    void operator()(const Place<int>& x) const { read_integer(x.reach(object)); }
    void operator()(const Place<std::uint64_t>& x) const { read_integer(x.reach(object)); }
    void operator()(const Place<bool>& x) const {
        if (!entry.node.is_boolean())
            fail_type(entry, type_of(parameter));
        x.reach(object) = entry.node.as_boolean()->get();
    }
    void operator()(const Place<std::string>& x) const {
        x.reach(object) = string(entry, parameter);
    }

    void operator()(const Choice& choice) const {
        const std::string& given = string(entry, parameter);
        const auto former =
            std::ranges::find(choice.former, given, [](const auto& names) { return names.first; });
        const std::string name(former == choice.former.end() ? given : former->second);
        if (std::ranges::find(choice.names, name) == choice.names.end())
            fail(entry,
                 fmt::format("unknown value ({}), {}", quoted(name), advice(name, choice.names)));
        choice.set(object, choice.names, name);
    }

    void operator()(const Place<std::vector<double>>& place) const {
        auto& x = place.reach(object);
        x.clear();
        for (const toml::node& node : array(entry, parameter))
            x.push_back(number({node, item_path(x.size())}, parameter) / parameter.per_si);
    }

    void operator()(const Place<std::vector<dem::DetachmentSegment>>& place) const {
        auto& x = place.reach(object);
        x.clear();
        for (const toml::node& node : array(entry, parameter))
            x.push_back(read_segment({node, item_path(x.size())}));
    }

    void operator()(const Place<std::vector<dem::TargetStage>>& x) const {
        x.reach(object) = read_target(entry, parameter);
    }

    void operator()(const Place<std::vector<dem::Point>>& x) const {
        x.reach(object) = read_points(entry, parameter);
    }

    void operator()(const Place<std::vector<fem::Layer>>& place) const {
        read_items(place.reach(object), layer_parameters());
    }
    void operator()(const Place<std::vector<PickedLine>>& place) const {
        read_items(place.reach(object), picked_line_parameters());
    }

    void operator()(const Place<std::vector<std::array<double, 4>>>& place) const {
        auto& x = place.reach(object);
        x.clear();
        for (const toml::node& node : array(entry, parameter)) {
            const Entry item{node, item_path(x.size())};
            const toml::array* four = node.as_array();
            if (!four || four->size() != 4)
                fail(item, "needs four numbers, [px, py, x_m, depth_m]");
            x.emplace_back();
            for (std::size_t k = 0; k < 4; ++k)
                x.back()[k] =
                    number({*four->get(k), fmt::format("{}[{}]", item.path, k)}, parameter);
        }
    }

private:
    template <class Integer> void read_integer(Integer& x) const {
        if (!entry.node.is_integer())
            fail_type(entry, type_of(parameter));
        number(entry, parameter); // checks the range
        x = static_cast<Integer>(entry.node.as_integer()->get());
    }

    template <class Item>
    void read_items(std::vector<Item>& items, const std::vector<Parameter>& parameters) const {
        items.clear();
        for (const toml::node& node : array(entry, parameter)) {
            Item item;
            read_table({node, item_path(items.size())}, parameters, &item);
            items.push_back(item);
        }
    }

    std::string item_path(std::size_t index) const {
        return fmt::format("{}[{}]", entry.path, index);
    }
};

} // namespace

bool must_be_given(const Parameter& parameter, const void* object) {
    const auto* value = std::get_if<Place<double>>(&parameter.value);
    return value && !parameter.range.contains(value->get(object) * parameter.per_si);
}

void read(const Entry& entry, const Parameter& parameter, void* object) {
    std::visit(Reader{entry, parameter, object}, parameter.value);
}

void read_table(const Entry& entry, const std::vector<Parameter>& parameters, void* object,
                const std::vector<std::string_view>& read_elsewhere) {
    if (!entry.node.is_table())
        fail_type(entry, "table");
    for (const auto& [key, node] : *entry.node.as_table()) {
        const Entry inner{node, entry.path + (entry.path.empty() ? "" : ".") + std::string(key)};
        const auto parameter = std::ranges::find(parameters, key.str(), &Parameter::key);
        if (parameter != parameters.end()) {
            read(inner, *parameter, object);
        } else if (std::ranges::find(read_elsewhere, key.str()) == read_elsewhere.end()) {
            std::vector<std::string_view> allowed = keys(parameters);
            allowed.insert(allowed.end(), read_elsewhere.begin(), read_elsewhere.end());
            fail(inner, fmt::format("unknown key, {}", advice(key.str(), allowed)));
        }
    }
    for (const Parameter& parameter : parameters) {
        if (must_be_given(parameter, object))
            fail(entry, fmt::format("needs {} ({}; {})", parameter.key, parameter.doc,
                                    text(parameter.range)));
    }
}

namespace {

dem::DetachmentSegment read_segment(const Entry& entry) {
    using Kind = dem::DetachmentSegment::Kind;
    const toml::table* table = entry.node.as_table();
    if (!table || table->size() != 1)
        fail(entry, "needs exactly one of arc and line, "
                    "allowed: {arc = {radius_m = 15000.0}}, {line = {length_m = 5000.0}}");
    const auto [key, node] = *table->begin();
    const Entry inner{node, fmt::format("{}.{}", entry.path, key.str())};
    if (key != "arc" && key != "line")
        fail(inner, fmt::format("unknown segment, {}", advice(key.str(), {"arc", "line"})));
    dem::DetachmentSegment segment;
    segment.kind = key == "arc" ? Kind::arc : Kind::line;
    read_table(inner, segment_parameters(segment.kind), &segment);
    return segment;
}

/// Points [x, y]; the parameter's range holds for y.
std::vector<Point> read_points(const Entry& entry, const Parameter& parameter) {
    Parameter x_parameter = parameter;
    x_parameter.range = ranges::target_x;
    std::vector<Point> points;
    for (const toml::node& node : array(entry, parameter)) {
        const Entry item{node, fmt::format("{}[{}]", entry.path, points.size())};
        const toml::array* pair = node.as_array();
        if (!pair || pair->size() != 2)
            fail(item, "needs two numbers, for example [12000.0, -350.0]");
        const Point p{number({*pair->get(0), item.path + "[0]"}, x_parameter),
                      number({*pair->get(1), item.path + "[1]"}, parameter)};
        points.push_back(p);
    }
    if (points.empty())
        fail(entry,
             "has no points, needs at least one, for example [[0.0, 0.0], [40000.0, -500.0]]");
    return points;
}

/// Points by ascending x.
std::vector<Point> read_sorted_points(const Entry& entry, const Parameter& parameter) {
    std::vector<Point> points = read_points(entry, parameter);
    for (std::size_t k = 1; k < points.size(); ++k)
        if (points[k].x <= points[k - 1].x)
            fail({*entry.node.as_array()->get(k), fmt::format("{}[{}]", entry.path, k)},
                 fmt::format("is not sorted: x = {} comes after {}; sort the points by x, each "
                             "x once",
                             text(points[k].x), text(points[k - 1].x)));
    return points;
}

std::vector<TargetStage> read_target(const Entry& entry, const Parameter& parameter) {
    const toml::array& items = array(entry, parameter);
    if (items.empty() || !items.front().is_table())
        return {{0.0, read_sorted_points(entry, parameter)}};
    Parameter years = parameter;
    years.range = ranges::target_time;
    std::vector<TargetStage> stages;
    for (const toml::node& node : items) {
        const Entry item{node, fmt::format("{}[{}]", entry.path, stages.size())};
        const toml::table* table = node.as_table();
        const toml::node* points = table ? table->get("points") : nullptr;
        const toml::node* time = table ? table->get("time_a") : nullptr;
        if (!points || !time || table->size() != 2)
            fail(item,
                 "needs time_a and points, for example {time_a = 0.0, points = [[0.0, 0.0]]}");
        TargetStage stage;
        stage.time = number({*time, item.path + ".time_a"}, years);
        if (!stages.empty() && stage.time <= stages.back().time)
            fail(item, fmt::format("is not sorted: time_a = {} comes after {}; sort the stages by "
                                   "time, each time once",
                                   text(stage.time), text(stages.back().time)));
        stage.points = read_sorted_points({*points, item.path + ".points"}, parameter);
        stages.push_back(stage);
    }
    return stages;
}

} // namespace

// ----------------------------------------------------------------------- files and --set options

namespace {

/// The first of a text that may be long.
std::string beginning(const std::string& text) {
    constexpr std::size_t most = 80;
    return text.size() > most ? text.substr(0, most) + "..." : text;
}

/// Refuses what would be nested so deep that its tables cannot be made or ended.
void check_depth(const std::string& text, const std::string& origin) {
    const auto line = too_deep_line(text);
    if (!line)
        return;
    const std::string where =
        origin.starts_with("--") ? beginning(origin) : fmt::format("{}:{}", origin, *line);
    fail(fmt::format("{}: is nested too deep, allowed: {} brackets in each other and {} dots in a "
                     "key; no table of this program has more than four",
                     where, deepest_toml, deepest_toml));
}

} // namespace

toml::table parse(const std::string& text, const std::string& origin) {
    check_depth(text, origin);
    try {
        return toml::parse(text, origin);
    } catch (const toml::parse_error& error) {
        const std::size_t line = error.source().begin.line;
        fail(fmt::format("{}:{}:{}: {}{}", origin, line, error.source().begin.column,
                         error.description(), cure_of_line(text, line)));
    }
}

namespace {

bool is_number(std::string_view key) {
    return !key.empty() && key.size() < 4 &&
           std::ranges::all_of(key, [](unsigned char c) { return std::isdigit(c); });
}

/// Whether a table's keys are numbers of an array's items: stage.0.distance_m.
bool names_items(const toml::node& node) {
    const toml::table* table = node.as_table();
    return table && !table->empty() &&
           std::ranges::all_of(*table, [](const auto& one) { return is_number(one.first.str()); });
}

void merge(toml::table& into, toml::table& from, const std::string& origin);

/// Moves items over by their number, tables into the tables that are there; the next number adds
/// an item.
void merge_items(toml::array& into, toml::table& from, std::string_view name,
                 const std::string& origin) {
    for (auto&& [key, node] : from) {
        const auto number = static_cast<std::size_t>(std::stoul(std::string(key.str())));
        if (number > into.size())
            fail(fmt::format("{}: {}.{}: there are {}, counted from 0; the next is {}.{}", origin,
                             name, number, into.size(), name, into.size()));
        if (number == into.size())
            into.push_back(std::move(node));
        else if (into[number].is_table() && node.is_table())
            merge(*into[number].as_table(), *node.as_table(), origin);
        else
            into.replace(into.cbegin() + static_cast<std::ptrdiff_t>(number), std::move(node));
    }
}

/// Moves the values over, tables into the tables of the same name. They keep their origin.
void merge(toml::table& into, toml::table& from, const std::string& origin) {
    for (auto&& [key, node] : from) {
        toml::table* table = into[key].as_table();
        if (table && node.is_table()) {
            merge(*table, *node.as_table(), origin);
        } else if (names_items(node) && (into[key].is_array() || !into.contains(key))) {
            if (!into.contains(key))
                into.insert(key, toml::array{});
            merge_items(*into[key].as_array(), *node.as_table(), key.str(), origin);
        } else {
            into.insert_or_assign(key, std::move(node));
        }
    }
}

} // namespace

void set(toml::table& document, const std::string& assignment, const std::string& origin) {
    const auto equals = assignment.find('=');
    const std::string key = assignment.substr(0, equals);
    const std::string value = equals == key.npos ? "" : assignment.substr(equals + 1);
    toml::table given;
    check_depth(assignment, origin);
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
    merge(document, given, origin);
}

// --------------------------------------------------------------------------------------- writing

double in_key_units(double si, double per_si) {
    for (int digits = 1; per_si != 1.0 && digits <= 17; ++digits) {
        const std::string rounded = fmt::format("{:.{}g}", si * per_si, digits);
        const double x = std::strtod(rounded.c_str(), nullptr);
        if (x / per_si == si)
            return x;
    }
    return si * per_si;
}

namespace {

/// Writes a value, one function for each type; empty if there is nothing to write.
struct Writer {
    const void* object;
    double per_si;

    std::string operator()(const Place<double>& x) const { return one(x.get(object)); }
    std::string operator()(const Place<std::optional<double>>& x) const {
        return x.get(object) ? one(*x.get(object)) : "";
    }
    std::string operator()(const Place<int>& x) const { return fmt::format("{}", x.get(object)); }
    std::string operator()(const Place<std::uint64_t>& x) const {
        return fmt::format("{}", x.get(object));
    }
    std::string operator()(const Place<bool>& x) const { return x.get(object) ? "true" : "false"; }
    std::string operator()(const Place<std::string>& x) const { return quoted(x.get(object)); }
    std::string operator()(const Choice& choice) const {
        const std::string_view name = choice.get(object, choice.names);
        return name.empty() ? "" : quoted(std::string(name));
    }
    std::string operator()(const Place<std::vector<double>>& x) const {
        std::vector<std::string> items;
        for (const double item : x.get(object))
            items.push_back(one(item));
        return fmt::format("[{}]", fmt::join(items, ", "));
    }
    std::string operator()(const Place<std::vector<dem::DetachmentSegment>>& x) const;
    std::string operator()(const Place<std::vector<fem::Layer>>& x) const;
    std::string operator()(const Place<std::vector<PickedLine>>& x) const;
    std::string operator()(const Place<std::vector<dem::TargetStage>>& x) const;
    std::string operator()(const Place<std::vector<dem::Point>>& x) const;
    std::string operator()(const Place<std::vector<std::array<double, 4>>>& x) const {
        std::vector<std::string> items;
        for (const auto& four : x.get(object))
            items.push_back(fmt::format("[{}]", fmt::join(four, ", ")));
        return fmt::format("[{}]", fmt::join(items, ", "));
    }

private:
    std::string one(double x) const { return toml_float(in_key_units(x, per_si)); }
};

std::string write(const Parameter& parameter, const void* object) {
    return std::visit(Writer{object, parameter.per_si}, parameter.value);
}

std::string inline_table(const std::vector<Parameter>& parameters, const void* object) {
    std::vector<std::string> pairs;
    for (const Parameter& parameter : parameters) {
        if (const std::string value = write(parameter, object); !value.empty())
            pairs.push_back(fmt::format("{} = {}", parameter.key, value));
    }
    return fmt::format("{{{}}}", fmt::join(pairs, ", "));
}

std::string Writer::operator()(const Place<std::vector<dem::DetachmentSegment>>& x) const {
    using Kind = dem::DetachmentSegment::Kind;
    std::string lines;
    for (const dem::DetachmentSegment& segment : x.get(object))
        lines += fmt::format("    {{{} = {}}},\n", segment.kind == Kind::arc ? "arc" : "line",
                             inline_table(segment_parameters(segment.kind), &segment));
    return lines.empty() ? "[]" : fmt::format("[\n{}]", lines);
}

/// Items of an array, a line each.
template <class Item>
std::string lines_of(const std::vector<Item>& items, const std::vector<Parameter>& parameters) {
    std::string lines;
    for (const Item& item : items)
        lines += fmt::format("    {},\n", inline_table(parameters, &item));
    return lines.empty() ? "" : fmt::format("[\n{}]", lines);
}

std::string Writer::operator()(const Place<std::vector<fem::Layer>>& x) const {
    return lines_of(x.get(object), layer_parameters());
}

std::string Writer::operator()(const Place<std::vector<PickedLine>>& x) const {
    return lines_of(x.get(object), picked_line_parameters());
}

std::string points_text(const std::vector<dem::Point>& points) {
    std::vector<std::string> items;
    for (const dem::Point& p : points)
        items.push_back(fmt::format("[{}, {}]", toml_float(p.x), toml_float(p.y)));
    return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string Writer::operator()(const Place<std::vector<dem::Point>>& x) const {
    return x.get(object).empty() ? "" : points_text(x.get(object));
}

std::string Writer::operator()(const Place<std::vector<dem::TargetStage>>& x) const {
    const std::vector<dem::TargetStage>& stages = x.get(object);
    if (stages.empty())
        return "";
    if (stages.size() == 1 && stages.front().time == 0.0)
        return points_text(stages.front().points);
    std::string lines;
    for (const dem::TargetStage& stage : stages)
        lines += fmt::format("    {{time_a = {}, points = {}}},\n", toml_float(stage.time),
                             points_text(stage.points));
    return fmt::format("[\n{}]", lines);
}

} // namespace

std::string value_text(const Parameter& parameter, const void* object) {
    return write(parameter, object);
}

std::string write(const std::vector<Parameter>& parameters, const void* object) {
    std::string lines;
    for (const Parameter& parameter : parameters)
        if (const std::string value = write(parameter, object); !value.empty())
            lines += fmt::format("{:<40}  # {}\n", fmt::format("{} = {}", parameter.key, value),
                                 parameter.doc);
    return lines;
}

std::string facts(const Parameter& parameter) {
    std::vector<std::string> all{type_of(parameter)};
    if (!parameter.unit.empty())
        all.back() += fmt::format(" in {}", parameter.unit);
    if (const std::string range = text(parameter.range); !range.empty())
        all.push_back(range);
    if (!parameter.symbol.empty())
        all.push_back(fmt::format("symbol {}", parameter.symbol));
    if (const std::string usual = usual_text(parameter); !usual.empty())
        all.push_back(fmt::format("usual {}", usual));
    if (parameter.follows_rate)
        all.push_back(fmt::format("the default is for {:g} m/a and follows extension.rate_m_per_a",
                                  usual_rate));
    return fmt::format("{}", fmt::join(all, "; "));
}

std::string default_text(const Parameter& parameter, const void* object) {
    if (must_be_given(parameter, object))
        return "(required)";
    const std::string value = write(parameter, object);
    return value.empty() ? "(none)" : value;
}

std::string explain(const Parameter& parameter, const void* object) {
    const std::string changes =
        parameter.changes.empty() ? "" : fmt::format("        {}\n", parameter.changes);
    return fmt::format("    {} = {}\n        {}\n{}        {}\n", parameter.key,
                       default_text(parameter, object), parameter.doc, changes, facts(parameter));
}

} // namespace listric

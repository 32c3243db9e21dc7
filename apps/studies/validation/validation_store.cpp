#include "apps/studies/validation/validation_store.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/number.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <vector>

namespace listric {

namespace {

/// Columns before the measures: those of the place, then those of the origin.
constexpr std::size_t places = 3;
struct OriginColumn {
    std::string_view name;
    std::string Origin::*text;
};
constexpr std::array<OriginColumn, 5> origin_columns{{{"state_hash", &Origin::state_hash},
                                                      {"scene_hash", &Origin::scene_hash},
                                                      {"made_by", &Origin::made_by},
                                                      {"measured_by", &Origin::measured_by},
                                                      {"measures_hash", &Origin::measures_hash}}};

} // namespace

std::optional<double> number_at(const MeasureStore& store, const MeasuredPlace& place,
                                const std::string& measure) {
    const auto m = store.find(place);
    if (m == store.end())
        return std::nullopt;
    const auto found = m->second.numbers.find(measure);
    return found == m->second.numbers.end() ? std::nullopt : std::optional(found->second);
}

MeasureStore read_store(const std::filesystem::path& file) {
    MeasureStore store;
    std::vector<std::string> names;
    const auto refuse = [&](const std::string& what) {
        throw StorageError(fmt::format("{}: {}; --remeasure writes it again", file.string(), what));
    };
    const auto number = [&](const std::string& cell) {
        const auto value = parse_number(cell);
        if (!value)
            refuse(no_number(cell));
        return *value;
    };
    const auto take = [&](const CsvRecord& record) {
        const std::vector<std::string>& cells = record.cells;
        if (names.empty()) {
            names = cells;
            return true;
        }
        if (cells.size() != names.size() || cells.size() < places)
            refuse("a line has another number of columns than the first");
        const MeasuredPlace place{cells[0], static_cast<int>(number(cells[1])), number(cells[2])};
        if (store.contains(place))
            refuse(
                fmt::format("{}, seed {}, {:g} m is there twice", place.run, place.seed, place.at));
        MeasuredNumbers& m = store[place];
        for (std::size_t k = places; k < cells.size(); ++k)
            if (const auto o = std::ranges::find(origin_columns, names[k], &OriginColumn::name);
                o != origin_columns.end())
                m.from.*o->text = cells[k];
            else if (!cells[k].empty())
                m.numbers[names[k]] = number(cells[k]);
        return true;
    };
    const std::string text = read_text_if_there(file);
    try {
        read_records(text, file.string(), ',', take);
    } catch (const SceneError& error) {
        refuse(error.what());
    }
    return store;
}

void write_store(const std::filesystem::path& file, const MeasureStore& store) {
    std::set<std::string> names;
    for (const auto& [place, m] : store)
        for (const auto& [name, value] : m.numbers)
            names.insert(name);
    std::string text = "run,seed,at_m";
    for (const OriginColumn& o : origin_columns)
        text += fmt::format(",{}", o.name);
    text += fmt::format(",{}\n", fmt::join(names, ","));
    for (const auto& [place, m] : store) {
        text += fmt::format("{},{},{}", place.run, place.seed, place.at);
        for (const OriginColumn& o : origin_columns)
            text += fmt::format(",{}", m.from.*o.text);
        for (const std::string& name : names) {
            const auto number = m.numbers.find(name);
            text += number == m.numbers.end() ? "," : fmt::format(",{:.6g}", number->second);
        }
        text += '\n';
    }
    write_text(file, text);
}

} // namespace listric

#include "apps/studies/validation_store.hpp"

#include "apps/studies/table_cell.hpp"
#include "apps/support/error.hpp"
#include "apps/support/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

namespace listric {

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
    std::ifstream in(file);
    std::string line, cell;
    std::vector<std::string> names;
    while (std::getline(in, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line + ",");
        while (std::getline(row, cell, ','))
            cells.push_back(cell);
        if (names.empty()) {
            names = cells;
            continue;
        }
        if (cells.size() != names.size() || cells.size() < 4)
            throw StorageError(file.string() + ": a line has another number of columns than the "
                                               "first; --remeasure writes it anew");
        MeasuredNumbers& m = store[{cells[0], static_cast<int>(number_in(cells[1], file)),
                                    number_in(cells[2], file)}];
        m.hash = cells[3];
        for (std::size_t k = 4; k < cells.size(); ++k)
            if (names[k] == "made_by")
                m.made_by = cells[k];
            else if (names[k] == "measured_by")
                m.measured_by = cells[k];
            else if (!cells[k].empty())
                m.numbers[names[k]] = number_in(cells[k], file);
    }
    return store;
}

void write_store(const std::filesystem::path& file, const MeasureStore& store) {
    std::set<std::string> names;
    for (const auto& [place, m] : store)
        for (const auto& [name, value] : m.numbers)
            names.insert(name);
    std::string text =
        fmt::format("run,seed,at_m,state_hash,made_by,measured_by,{}\n", fmt::join(names, ","));
    for (const auto& [place, m] : store) {
        text += fmt::format("{},{},{},{},{},{}", place.run, place.seed, place.at, m.hash, m.made_by,
                            m.measured_by);
        for (const std::string& name : names) {
            const auto number = m.numbers.find(name);
            text += number == m.numbers.end() ? "," : fmt::format(",{:.6g}", number->second);
        }
        text += '\n';
    }
    write_text(file, text);
}

} // namespace listric

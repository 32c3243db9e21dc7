#include "dem/ranks/table_bytes.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>
#include <variant>

namespace listric::dem {

Table selected(const Table& table, std::span<const std::int32_t> rows,
               bool (*is_wanted)(std::string_view column)) {
    Table result;
    for (const Column& column : table.columns()) {
        if (is_wanted && !is_wanted(column.name))
            continue;
        Column part{column.name, column.unit, {}, column.initial, column.begins_as, column.is_note};
        std::visit(
            [&](const auto& values) {
                std::decay_t<decltype(values)> chosen;
                chosen.reserve(rows.size());
                for (const std::int32_t row : rows)
                    chosen.push_back(values[static_cast<std::size_t>(row)]);
                part.values = std::move(chosen);
            },
            column.values);
        result.set(std::move(part));
    }
    return result;
}

void append_rows(const Table& rows, Table& to) {
    assert(rows.columns().size() == to.columns().size());
    const std::size_t before = to.rows();
    to.resize(before + rows.rows());
    for (const Column& column : rows.columns())
        std::visit(
            [&]<class T>(const std::vector<T>& values) {
                std::ranges::copy(values, to.get<T>(column.name).subspan(before).begin());
            },
            column.values);
}

std::size_t byte_count(const Table& table) {
    std::size_t count = 8;
    for (const Column& column : table.columns())
        std::visit(
            [&]<class T>(const std::vector<T>& values) {
                count += 64 + column.name.size() + column.unit.size() + column.begins_as.size() +
                         sizeof(T) * values.size();
            },
            column.values);
    return count;
}

void add_table(const Table& table, BytesOut& to) {
    to.add(table.columns().size());
    for (const Column& column : table.columns()) {
        to.add(std::string_view(column.name));
        to.add(std::string_view(column.unit));
        to.add(std::string_view(column.begins_as));
        to.add(column.is_note);
        to.add(column.values.index());
        std::visit([&](const auto& values) { to.add(values); }, column.values);
        std::visit([&](const auto& initial) { to.add(initial); }, column.initial);
    }
}

namespace {

template <std::size_t index = 0> void take_values(BytesIn& from, std::size_t wanted, Column& to) {
    if constexpr (index < std::variant_size_v<Column::Values>) {
        if (index != wanted)
            return take_values<index + 1>(from, wanted, to);
        using T = typename std::variant_alternative_t<index, Column::Values>::value_type;
        to.values = from.take_all<T>();
        to.initial = from.take<T>();
    }
}

} // namespace

Table take_table(BytesIn& from) {
    Table table;
    for (auto columns = from.take<std::size_t>(); columns > 0; --columns) {
        Column column;
        column.name = from.take_text();
        column.unit = from.take_text();
        column.begins_as = from.take_text();
        column.is_note = from.take<bool>();
        take_values(from, from.take<std::size_t>(), column);
        table.set(std::move(column));
    }
    return table;
}

} // namespace listric::dem

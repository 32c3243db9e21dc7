#include "dem/column.hpp"

#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cassert>

namespace listric::dem {

void Table::set(Column column) {
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, column.values);
    if (columns_.empty())
        rows_ = size;
    if (size != rows_)
        throw std::logic_error("column " + column.name + " has " + std::to_string(size) +
                               " values in a table of " + std::to_string(rows_) + " rows");
    for (Column& present : columns_)
        if (present.name == column.name) {
            present = std::move(column);
            return;
        }
    columns_.push_back(std::move(column));
}

void Table::remove(std::string_view name) {
    std::erase_if(columns_, [&](const Column& c) { return c.name == name; });
}

void Table::resize(std::size_t rows) {
    for (Column& column : columns_)
        std::visit(
            [&](auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                values.reserve(rows); // not twice as much, which resize() takes for few more
                values.resize(rows, std::get<T>(column.initial));
            },
            column.values);
    rows_ = rows;
}

void Table::begin_rows(std::size_t first) {
    assert(first <= rows_);
    const auto skip = static_cast<std::ptrdiff_t>(first);
    for (Column& column : columns_)
        if (!column.begins_as.empty())
            std::visit(
                [&](auto& values) {
                    const auto& others =
                        std::get<std::decay_t<decltype(values)>>(require(column.begins_as).values);
                    std::copy(others.begin() + skip, others.end(), values.begin() + skip);
                },
                column.values);
}

void Table::reorder(std::span<const std::int32_t> order) {
    assert(std::ranges::all_of(order, [&](std::int32_t row) {
        return row >= 0 && static_cast<std::size_t>(row) <= rows_;
    }));
    const std::size_t worth = 1 + 20000 / (order.size() + 1); // columns
    in_pieces(columns_.size(), worth, [&](std::size_t column, std::size_t end) {
        for (; column < end; ++column)
            std::visit(
                [&]<class T>(std::vector<T>& values) {
                    const T initial = std::get<T>(columns_[column].initial);
                    std::vector<T> moved(order.size());
                    for (std::size_t k = 0; k < order.size(); ++k) {
                        const auto row = static_cast<std::size_t>(order[k]);
                        moved[k] = row < rows_ ? values[row] : initial;
                    }
                    values = std::move(moved);
                },
                columns_[column].values);
    });
    rows_ = order.size();
}

void Table::mark_note(std::string_view name) {
    for (Column& column : columns_)
        column.is_note = column.is_note || column.name == name;
}

const Column* Table::find(std::string_view name) const {
    const auto it = std::ranges::find(columns_, name, &Column::name);
    return it == columns_.end() ? nullptr : &*it;
}

const Column& Table::require(std::string_view name) const {
    if (const Column* column = find(name))
        return *column;
    throw std::out_of_range("no column named " + std::string(name));
}

} // namespace listric::dem

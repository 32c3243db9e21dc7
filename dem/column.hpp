#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace listric::dem {

/// A named, typed, unit-bearing array with one value per row of its table.
struct Column {
    using Values = std::variant<std::vector<double>, std::vector<float>, std::vector<std::int64_t>,
                                std::vector<std::int32_t>, std::vector<std::uint8_t>>;
    using Value = std::variant<double, float, std::int64_t, std::int32_t, std::uint8_t>;

    std::string name;
    std::string unit; ///< SI, "1" when dimensionless
    Values values;
    Value initial;              ///< value of a new row
    std::string begins_as = {}; ///< name of the column whose value a new row takes, if not that
    /// An observer wrote it for people: the hash of a state leaves it out, so that what is noted
    /// besides changes no recorded hash. It is saved, sorted and resumed as all others.
    bool is_note = false;
};

/// What a column is called, its unit and type, and the value of a new row.
template <class T> struct ColumnName {
    std::string_view name, unit;
    T initial;

    constexpr operator std::string_view() const {
        return name;
    } // NOLINT(google-explicit-constructor)
};

/// Columns of equal length. Sorting, growing, saving, resuming and hashing are one loop over
/// columns each, so memory that an effect keeps in a column is never forgotten by any of them.
///
/// A span of a column lives until rows come, go or are reordered, or the column is set or removed;
/// other columns may be added meanwhile.
class Table {
public:
    std::size_t rows() const { return rows_; }
    const std::vector<Column>& columns() const { return columns_; }

    bool has(std::string_view name) const { return find(name) != nullptr; }

    /// Adds a column filled with `initial`; keeps the values of one that is already there.
    template <class T> std::span<T> add(std::string_view name, std::string_view unit, T initial) {
        if (!has(name))
            columns_.push_back(
                {std::string(name), std::string(unit), std::vector<T>(rows_, initial), initial});
        return get<T>(name);
    }

    template <class T> std::span<T> add(const ColumnName<T>& column) {
        return add(column, column.initial);
    }
    template <class T>
    std::span<T> add(const ColumnName<T>& column, std::type_identity_t<T> initial) {
        return add<T>(column.name, column.unit, initial);
    }

    /// Adds a column that begins as another of its type is, now and in every row that comes. Keeps
    /// the values of one that is already there.
    template <class T>
    std::span<T> add_like(std::string_view name, std::string_view unit, std::string_view other) {
        if (!has(name)) {
            const std::span<const T> values = std::as_const(*this).get<T>(other);
            columns_.push_back({std::string(name), std::string(unit),
                                std::vector<T>(values.begin(), values.end()), T{},
                                std::string(other)});
        }
        return get<T>(name);
    }

    template <class T>
    std::span<T> add_like(const ColumnName<T>& column, const ColumnName<T>& other) {
        return add_like<T>(column.name, column.unit, other.name);
    }

    /// Adds a column that no hash of a state counts, as add() does.
    template <class T>
    std::span<T> add_note(std::string_view name, std::string_view unit, T initial) {
        const std::span<T> values = add<T>(name, unit, initial);
        mark_note(name);
        return values;
    }

    template <class T> std::span<T> add_note(const ColumnName<T>& column) {
        return add_note<T>(column.name, column.unit, column.initial);
    }

    /// Marks a column as one that no hash of a state counts.
    void mark_note(std::string_view name);

    /// Gives the columns that begin as another its values, in the rows from `first` on: for new
    /// rows, once they have been filled in.
    void begin_rows(std::size_t first);

    /// Adds a column with its values; replaces one of the same name. The first column of an empty
    /// table sets the number of rows.
    void set(Column column);

    template <class T> std::span<T> get(std::string_view name) {
        // The const overload looks, this one may write: the table is not const.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        return std::get<std::vector<T>>(const_cast<Column&>(require(name)).values);
    }
    template <class T> std::span<const T> get(std::string_view name) const {
        return std::get<std::vector<T>>(require(name).values);
    }

    template <class T> std::span<T> get(const ColumnName<T>& column) { return get<T>(column.name); }
    template <class T> std::span<const T> get(const ColumnName<T>& column) const {
        return get<T>(column.name);
    }

    void remove(std::string_view name);

    /// New rows get each column's initial value.
    void resize(std::size_t rows);

    /// Row k becomes the former row order[k], or a new one where that is rows(): sorts, selects,
    /// adds or drops rows.
    void reorder(std::span<const std::int32_t> order);

private:
    const Column* find(std::string_view name) const;
    const Column& require(std::string_view name) const;

    std::vector<Column> columns_;
    std::size_t rows_ = 0;
};

} // namespace listric::dem

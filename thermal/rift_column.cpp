#include "thermal/rift_column.hpp"

#include <algorithm>

namespace listric::thermal {

namespace {

constexpr std::size_t column_rows = 500;

} // namespace

RiftColumn::RiftColumn(const HeatParameters& p, const Rock& rock)
    : p_(p), rock_(rock), height_(p.lithosphere / static_cast<double>(column_rows)), moho_(p.crust),
      temperature_(column_rows) {
    const Geotherm geotherm(p);
    for (std::size_t row = 0; row < column_rows; ++row)
        temperature_[row] = geotherm.at(depth(row));
}

/// Straight between rows, and to what is kept above and below.
double RiftColumn::temperature(double depth) const {
    const double place = depth / height_ - 0.5;
    if (place < 0.0)
        return temperature_.front() + 2.0 * place * (temperature_.front() - p_.surface_temperature);
    const auto row = std::min(static_cast<std::size_t>(place), column_rows - 1);
    const double share = place - static_cast<double>(row);
    if (row + 1 >= column_rows)
        return temperature_.back() +
               std::min(1.0, 2.0 * share) * (p_.base_temperature - temperature_.back());
    return (1.0 - share) * temperature_[row] + share * temperature_[row + 1];
}

void RiftColumn::stretch(double crust, double mantle) {
    const double moho = rock_.still + (moho_ - rock_.still) / crust;
    std::vector<double> now;
    for (std::size_t row = 0; row < column_rows; ++row) {
        const double z = depth(row);
        now.push_back(temperature(z <= rock_.still ? z
                                  : z < moho       ? rock_.still + (z - rock_.still) * crust
                                                   : moho_ + (z - moho) * mantle));
    }
    temperature_ = std::move(now);
    moho_ = moho;
}

/// Backward Euler, solved from the ground down and back.
void RiftColumn::rest(double seconds) {
    const auto conductivity = [&](std::size_t row) {
        return is_crust(row) ? p_.conductivity : p_.mantle_conductivity;
    };
    std::vector<double> above(column_rows), right(column_rows);
    double link = 2.0 * conductivity(0) / height_; // to the row above
    for (std::size_t row = 0; row < column_rows; ++row) {
        const double k = conductivity(row);
        const bool is_last = row + 1 == column_rows;
        const double below = is_last ? k : 2.0 / (1.0 / k + 1.0 / conductivity(row + 1));
        const double next = (is_last ? 2.0 : 1.0) * below / height_;
        const double capacity =
            (is_crust(row) ? crust_capacity : mantle_capacity) * height_ / seconds;
        double diagonal = capacity + link + next;
        double side =
            capacity * temperature_[row] + (is_crust(row) ? p_.heat_production * height_ : 0.0);
        if (is_last)
            side += next * p_.base_temperature;
        if (row == 0) {
            side += link * p_.surface_temperature;
        } else {
            diagonal -= link * above[row - 1];
            side += link * right[row - 1];
        }
        above[row] = next / diagonal;
        right[row] = side / diagonal;
        link = next;
    }
    for (std::size_t row = column_rows; row-- > 0;)
        temperature_[row] =
            right[row] + (row + 1 < column_rows ? above[row] * temperature_[row + 1] : 0.0);
}

double RiftColumn::mass_lost() const {
    const Geotherm start(p_);
    double sum = 0.0;
    for (std::size_t row = 0; row < column_rows; ++row)
        sum += (is_crust(row) ? rock_.crust_density : rock_.mantle_density) *
               (temperature_[row] - start.at(depth(row)));
    return p_.expansion * height_ * sum;
}

} // namespace listric::thermal

#pragma once

#include "thermal/geotherm.hpp"

#include <vector>

namespace listric::thermal {

/// A column of the lithosphere that stretches in pure shear and cools: what a wide section does,
/// without its sediment and without heat that goes sideways.
class RiftColumn {
public:
    struct Rock {
        double still = 0.0; ///< depth down to which nothing stretches, m
        double crust_density = 2700.0, mantle_density = 3300.0; ///< kg/m^3
    };

    RiftColumn(const HeatParameters& p, const Rock& rock);

    /// By factors, of the rock as it is.
    void stretch(double crust, double mantle);
    void rest(double seconds);

    /// As of columns of a section: see mass_lost(), kg/m^2.
    double mass_lost() const;

private:
    bool is_crust(std::size_t row) const { return depth(row) < moho_; }
    double depth(std::size_t row) const { return (static_cast<double>(row) + 0.5) * height_; }
    double temperature(double depth) const;

    HeatParameters p_;
    Rock rock_;
    double height_, moho_;
    std::vector<double> temperature_; ///< of rows from the ground down
};

} // namespace listric::thermal

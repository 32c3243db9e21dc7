#pragma once

#include "apps/laboratory/tests.hpp"
#include "apps/support/statistics.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace listric {

/// Facts of a call, on their way into its output folder. Each function below makes a test on
/// all samples, prints its table, writes its CSV files and adds its results to the summary.
struct LaboratoryReport {
    const Laboratory& lab;
    const RockMaterial& rock;
    std::filesystem::path output;
    nlohmann::ordered_json summary;
};

/// Writes curves.csv.
void report_uniaxial(LaboratoryReport& report);

/// @param confining  stresses, Pa, ascending
/// Writes curves.csv, and envelopes.csv with strength by confining stress: Byerlee's and, fitted to
/// two stresses or more, the rock's.
void report_biaxial(LaboratoryReport& report, const std::vector<double>& confining);

/// @param vice  the filling's vice for people
/// @param normal  stresses, Pa, ascending
/// Writes curves.csv and profiles.csv.
void report_shear_box(LaboratoryReport& report, const ShearBoxFilling& filling,
                      const std::string& vice, const std::vector<double>& normal);

/// {"mean": ..., "sd": ...}
nlohmann::ordered_json to_json(const Spread& spread);

} // namespace listric

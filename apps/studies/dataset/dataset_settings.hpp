#pragma once

#include "apps/studies/plan_file.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace listric {

/// Least and greatest of what is drawn for each section.
using Drawn = std::vector<double>;

/// How sections of a data set are made: the table [dataset] of a sweep's plan.
struct DatasetSettings {
    std::string split_by; ///< parameter of the plan, all of whose values stay in one split
    std::string validation, test;
    std::string licence = "CC BY 4.0", author;

    int traces = 768, samples = 768;
    double trace_spacing = 25.0;                           ///< m
    bool in_depth = false;                                 ///< else by two-way time
    double sample_interval = 0.004, depth_interval = 10.0; ///< s; m

    Drawn frequency = {15.0, 35.0}; ///< of the wavelet, Hz
    Drawn quality = {60.0, 300.0};  ///< of rock
    Drawn noise = {0.0, 0.6};       ///< its size over that of the reflections
    Drawn lateral = {0.0, 150.0};   ///< width of the point-spread function, m
    Drawn layer = {200.0, 500.0};   ///< thickness of layers of pre-rift rock, m
    double contrast = 0.06;         ///< standard deviation of their velocities

    double fault_width = 3.0;     ///< of a line in the mask, samples
    double least_throw = 50.0;    ///< of a fault that is marked, m
    double least_height = 500.0;  ///< from the upper to the lower end of what is marked of it, m
    double certain_throw = 100.0; ///< median of a fault that is not doubtful, m
    double certain_height = 750.0;
};

/// The keys of [dataset].
PlanTable<DatasetSettings> dataset_settings();

/// JSON schema of the table.
nlohmann::ordered_json dataset_schema();

} // namespace listric

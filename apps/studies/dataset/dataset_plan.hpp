#pragma once

#include "apps/studies/dataset/dataset_settings.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace listric {

struct DatasetPlan {
    SweepPlan sweep;
    DatasetSettings settings = {};
    std::vector<std::string> validation = {}, test = {}; ///< values of split_by
    std::size_t split_parameter = 0;                     ///< place of split_by among the parameters
    std::string text = {}; ///< of the settings, to tell others from them

    /// "train", "validation" or "test".
    std::string_view split_of(const SweepPoint& point) const;
};

/// Reads a sweep's plan that has [dataset]. Throws SceneError.
DatasetPlan load_dataset_plan(const std::filesystem::path& name_or_path);

} // namespace listric

#pragma once

#include "apps/studies/dataset/dataset_plan.hpp"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace listric {

/// What a split holds.
struct SplitCount {
    std::string_view name;
    std::size_t sections = 0, faults = 0;
    std::uintmax_t bytes = 0;
};

/// The card of a data set, for people (Markdown).
/// @param missing  runs without a section
std::string card_of(const DatasetPlan& plan, std::span<const SplitCount> splits,
                    std::size_t missing);

/// The same for programs: arrays, labels, axes, splits, licence and who made it.
nlohmann::ordered_json description_of(const DatasetPlan& plan);

} // namespace listric

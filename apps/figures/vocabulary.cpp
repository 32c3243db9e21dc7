#include "apps/figures/vocabulary.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/resources.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace listric {

nlohmann::ordered_json vocabulary() {
    const auto file = resource_folder() / "figures/vocabulary.json";
    try {
        return nlohmann::ordered_json::parse(read_text(file));
    } catch (const nlohmann::json::exception& error) {
        throw StorageError(file.string() + ": " + error.what());
    }
}

double scale_end(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty())
        return 0.01;
    const auto scale = vocabulary().at("scale");
    // Between the two values in their order that the share falls between, as NumPy has it.
    const double place = scale.at("below").get<double>() * static_cast<double>(values.size() - 1);
    const auto low = values.begin() + static_cast<std::ptrdiff_t>(place);
    std::ranges::nth_element(values, low);
    const double next = low + 1 == values.end() ? *low : *std::min_element(low + 1, values.end());
    double high = std::lerp(*low, next, place - std::floor(place));
    if (high <= 0.0)
        high = std::ranges::max(values);
    if (high <= 0.0)
        return 0.01;
    const double power = dem::power(10.0, std::floor(dem::logarithm_to_base_10(high)));
    const auto steps = scale.at("steps").get<std::vector<double>>();
    const auto step = std::ranges::find_if(
        steps, [&](double factor) { return high <= factor * power * (1.0 + 1e-9); });
    return (step == steps.end() ? steps.back() : *step) * power;
}

double strain_scale_end(std::vector<double> values) {
    return std::max(scale_end(std::move(values)),
                    vocabulary().at("scale").at("least_strain").get<double>());
}

bool is_near(const fem::StressPatch& patch, double right) {
    constexpr double reach = 60e3; // m
    const fem::Vector at = patch.corner[0];
    return at.x >= -reach && at.x <= right + reach && at.y >= -reach;
}

double largest_shear(const fem::StressPatch& patch) {
    return 1e-6 * dem::hypotenuse(0.5 * (patch.xx - patch.yy), patch.xy);
}

double shear_end(std::span<const fem::StressPatch> patches, double right) {
    std::vector<double> shear;
    for (const fem::StressPatch& patch : patches)
        if (is_near(patch, right))
            shear.push_back(largest_shear(patch));
    return scale_end(std::move(shear));
}

std::string data_name(const FigureLayer& layer) { return "layer_" + std::string(layer.name); }

nlohmann::json declared_layers(const Scene& scene) {
    constexpr const char* kinds[] = {"band", "line", "discs"};
    nlohmann::json list = nlohmann::json::array();
    for (const FigureLayer& layer : figure_layers(scene)) {
        list.push_back({{"name", data_name(layer)},
                        {"kind", kinds[static_cast<int>(layer.kind)]},
                        {"label", layer.label},
                        {"ink", layer.ink}});
        if (layer.full != 1.0)
            list.back()["full"] = layer.full;
        if (layer.arrows)
            list.back()["arrows"] = layer.arrows->label;
    }
    return list;
}

} // namespace listric

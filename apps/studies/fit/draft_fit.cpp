#include "apps/studies/fit/draft_fit.hpp"

#include "apps/studies/least_squares.hpp"
#include "apps/support/words/number.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace listric {

namespace {

using BoxPlace = std::array<double, 3>;

constexpr std::size_t terms = 10;
constexpr int steps_of_search = 40; ///< of half the box along each number

/// 1, the numbers, their squares and products.
std::array<double, terms> terms_at(const BoxPlace& p) {
    return {1.0,         p[0],        p[1],        p[2],        p[0] * p[0],
            p[1] * p[1], p[2] * p[2], p[0] * p[1], p[0] * p[2], p[1] * p[2]};
}

/// Where a shape is in the box.
BoxPlace place_in(const DraftDesign& design, const ListricShape& shape) {
    BoxPlace place{};
    for (std::size_t k = 0; k < place.size(); ++k) {
        const auto value = shape_numbers()[k].value;
        place[k] = (shape.*value - design.centre.*value) / design.steps[k];
    }
    return place;
}

/// Greatest and least of what a number may be.
std::array<double, 2> limits_of(std::size_t number, double least_depth) {
    return number == 0   ? std::array{20.0, 90.0}
           : number == 1 ? std::array{least_depth, 100e3}
                         : std::array{0.0, 0.9};
}

} // namespace

DraftDesign::DraftDesign(const ListricShape& about, double least_depth) : centre(about), steps{} {
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const ShapeNumber& number = shape_numbers()[k];
        const auto [low, high] = limits_of(k, least_depth);
        double& value = centre.*number.value;
        steps[k] = number.is_relative ? number.step * value : number.step;
        value = std::clamp(value, low + steps[k], high - steps[k]);
    }
}

ListricShape DraftDesign::shape_at(const BoxPlace& place) const {
    ListricShape shape = centre;
    for (std::size_t k = 0; k < place.size(); ++k)
        shape.*(shape_numbers()[k].value) += place[k] * steps[k];
    return shape;
}

std::vector<ListricShape> DraftDesign::shapes() const {
    std::vector<ListricShape> shapes{centre};
    for (std::size_t k = 0; k < 3; ++k)
        for (const double side : {-1.0, 1.0}) {
            BoxPlace place{};
            place[k] = side;
            shapes.push_back(shape_at(place));
        }
    for (int corner = 0; corner < 8; ++corner)
        shapes.push_back(
            shape_at({corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0}));
    return shapes;
}

std::optional<DraftFit> fit_drafts(const DraftDesign& design, std::span<const DraftMisfit> drafts,
                                   double least_depth) {
    std::vector<DraftMisfit> made;
    std::ranges::copy_if(drafts, std::back_inserter(made),
                         [](const DraftMisfit& draft) { return draft.misfit.has_value(); });
    if (made.size() <= terms)
        return std::nullopt;
    std::vector<std::vector<double>> columns(terms);
    std::vector<double> squares;
    for (const DraftMisfit& draft : made) {
        const auto row = terms_at(place_in(design, draft.shape));
        for (std::size_t k = 0; k < terms; ++k)
            columns[k].push_back(row[k]);
        squares.push_back(*draft.misfit * *draft.misfit);
    }
    const LeastSquares model(columns);
    std::array<double, terms> coefficients{};
    for (std::size_t k = 0; k < terms; ++k) {
        const auto weights = model.weights(k);
        if (!weights)
            return std::nullopt;
        coefficients[k] = dot(*weights, squares);
    }
    const auto misfit_at = [&](const BoxPlace& place) {
        return std::sqrt(std::max(0.0, dot(terms_at(place), coefficients)));
    };
    DraftFit fit;
    double squared = 0.0;
    for (const DraftMisfit& draft : made) {
        const double off = misfit_at(place_in(design, draft.shape)) - *draft.misfit;
        squared += off * off;
    }
    fit.residual = std::sqrt(squared / static_cast<double>(made.size() - terms));
    constexpr int values = 2 * steps_of_search + 1;
    const auto coordinate = [](int k) { return static_cast<double>(k) / steps_of_search - 1.0; };
    std::array<std::array<double, values>, 3> least;
    for (auto& of_number : least)
        of_number.fill(INFINITY);
    BoxPlace best{};
    fit.misfit = INFINITY;
    for (int i = 0; i < values; ++i)
        for (int j = 0; j < values; ++j)
            for (int k = 0; k < values; ++k) {
                const BoxPlace place{coordinate(i), coordinate(j), coordinate(k)};
                const double misfit = misfit_at(place);
                const std::array at{i, j, k};
                for (std::size_t number = 0; number < 3; ++number) {
                    double& value = least[number][static_cast<std::size_t>(at[number])];
                    value = std::min(value, misfit);
                }
                if (misfit < fit.misfit) {
                    fit.misfit = misfit;
                    best = place;
                }
            }
    fit.shape = design.shape_at(best);
    for (std::size_t number = 0; number < 3; ++number) {
        const auto value = shape_numbers()[number].value;
        for (int k = 0; k < values; ++k) {
            BoxPlace place{};
            place[number] = coordinate(k);
            fit.profiles[number].values.push_back(design.shape_at(place).*value);
            fit.profiles[number].misfit.push_back(least[number][static_cast<std::size_t>(k)]);
        }
        const auto [low, high] = limits_of(number, least_depth);
        const double at = fit.shape.*value, margin = 1e-6 * design.steps[number];
        if (number < 2 && ((best[number] <= -1.0 && at > low + margin) ||
                           (best[number] >= 1.0 && at < high - margin)))
            fit.at_end = true;
    }
    return fit;
}

std::optional<double> observed_misfit(const JsonObject& summary) {
    const auto rows = summary.find("observed");
    if (rows == summary.end() || !rows->is_array())
        return std::nullopt;
    double sum = 0.0, points = 0.0;
    for (const auto& row : *rows) {
        const auto mean = number_at(row, "mean_m");
        const auto compared = number_at(row, "points_compared");
        if (!mean || !compared)
            continue;
        sum += *mean * *compared;
        points += *compared;
    }
    return points > 0.0 ? std::optional(sum / points) : std::nullopt;
}

std::string uncompared_horizon(const JsonObject& summary) {
    const auto rows = summary.find("observed");
    if (rows != summary.end() && rows->is_array())
        for (const auto& row : *rows)
            if (!number_at(row, "mean_m"))
                return fmt::format("horizon {} {}", text_at(row, "name"), text_at(row, "outside"));
    return "";
}

SweepPlan plan_of_shapes(const SweepPlan& common, std::span<const ListricShape> shapes) {
    SweepPlan plan = common;
    plan.design = SweepDesign::list;
    for (const char* name :
         {"detachment.start_dip_deg", "detachment.segments", "hanging_wall.thickness_m"}) {
        plan.parameters.emplace_back();
        plan.parameters.back().name = name;
    }
    const auto add = [&](std::size_t k, const std::string& text, const std::string& value) {
        SweepParameter& parameter = plan.parameters[k];
        parameter.values.push_back({text, {parameter.name + "=" + value}, parse_number(value)});
    };
    const auto number = [](double value) { return fmt::format("{:.3f}", value); };
    for (const ListricShape& shape : shapes) {
        std::string pieces;
        for (const dem::DetachmentSegment& piece : detachment_of(shape).segments)
            pieces += piece.kind == dem::DetachmentSegment::Kind::arc
                          ? fmt::format("{{arc = {{radius_m = {:.3f}, end_dip_deg = {:.1f}}}}}, ",
                                        piece.radius, piece.end_dip)
                          : fmt::format("{{line = {{length_m = {:.3f}}}}}, ", piece.length);
        add(0, number(shape.dip), number(shape.dip));
        add(1, pieces, "[" + pieces + "]");
        add(2, number(shape.depth), number(shape.depth));
    }
    return plan;
}

} // namespace listric

#include "apps/scene/parameters/parameter.hpp"

#include "apps/support/words/spelling.hpp"
#include "dem/numbers/round_off.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <iterator>

namespace listric {

std::string text(const Range& range) {
    std::vector<std::string> bounds;
    const auto add = [&](const char* word, double bound) {
        if (std::isfinite(bound))
            bounds.push_back(fmt::format("{} {}", word, text(bound)));
    };
    add("at least", range.from);
    add("above", range.above);
    add("at most", range.to);
    add("below", range.below);
    return fmt::format("{}", fmt::join(bounds, ", "));
}

Parameter by_travel(Parameter parameter) {
    assert(parameter.unit == "a" || parameter.unit == "1/s");
    parameter.follows_rate = true;
    return parameter;
}

double at_rate(const Parameter& parameter, double usual, double rate) {
    assert(parameter.follows_rate);
    if (rate == usual_rate)
        return usual;
    if (parameter.unit != "a")
        return dem::without_round_off(usual * (rate / usual_rate));
    // A short number where it stands for the same metres to the last bit.
    const double metres = usual * usual_rate, years = metres / rate;
    const double rounded = dem::without_round_off(years);
    const bool is_same = dem::without_round_off(rounded * rate) == dem::without_round_off(metres);
    return is_same ? rounded : years;
}

std::string usual_text(const Parameter& parameter) {
    const Range& usual = parameter.usual;
    return usual.is_given() ? fmt::format("{} to {}", text(usual.from), text(usual.to)) : "";
}

std::string type_of(const Parameter& parameter) {
    struct {
        std::string operator()(const Place<double>&) const { return "number"; }
        std::string operator()(const Place<std::optional<double>>&) const { return "number"; }
        std::string operator()(const Place<int>&) const { return "integer"; }
        std::string operator()(const Place<std::uint64_t>&) const { return "integer"; }
        std::string operator()(const Place<bool>&) const { return "true or false"; }
        std::string operator()(const Place<std::string>&) const { return "string"; }
        std::string operator()(const Choice& choice) const {
            return fmt::format("one of \"{}\"", fmt::join(choice.names, "\", \""));
        }
        std::string operator()(const Place<std::vector<double>>&) const {
            return "array of numbers";
        }
        std::string operator()(const Place<std::vector<dem::DetachmentSegment>>&) const {
            return "array of {arc = {...}} and {line = {...}}";
        }
        std::string operator()(const Place<std::vector<dem::TargetStage>>&) const {
            return "array of points [x, y], or of {time_a = ..., points = [[x, y], ...]}";
        }
        std::string operator()(const Place<std::vector<std::array<double, 4>>>&) const {
            return "array of [px, py, x_m, depth_m]";
        }
        std::string operator()(const Place<std::vector<PickedLine>>&) const {
            return "array of {name = ..., age_a = ..., x_m = [...], depth_m = [...]}";
        }
        std::string operator()(const Place<std::vector<dem::Point>>&) const {
            return "array of points [x_m, depth_m]";
        }
        std::string operator()(const Place<std::vector<fem::Layer>>&) const {
            return "array of {top_depth_m = ..., young_modulus_pa = ..., ...}";
        }
    } name;
    return std::visit(name, parameter.value);
}

std::vector<std::string_view> keys(const std::vector<Parameter>& parameters) {
    std::vector<std::string_view> keys;
    std::ranges::transform(parameters, std::back_inserter(keys), &Parameter::key);
    return keys;
}

} // namespace listric

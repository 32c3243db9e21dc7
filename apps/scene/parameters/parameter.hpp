#pragma once

#include "apps/scene/picks/observed.hpp"
#include "dem/base/target_line.hpp"
#include "dem/genesis/detachment.hpp"
#include "fem/footwall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

// How parameters of a scene are declared: once, by pointers to members, so that reading, writing
// and the reference follow from the declaration and looking at it changes nothing.

namespace listric {

/// The numbers that a parameter may take, in the unit of its key: {.above = 0, .to = 10}.
struct Range {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double from = -infinity, above = -infinity; ///< from: included; above: excluded
    double to = infinity, below = infinity;     ///< to: included; below: excluded
    std::string_view reason = {};               ///< why not elsewhere, where that is not plain

    bool is_given() const {
        return std::max(from, above) > -infinity || std::min(to, below) < infinity;
    }
    bool contains(double x) const {
        return std::isfinite(x) && x >= from && x > above && x <= to && x < below;
    }
};

constexpr Range between(double from, double to) { return {.from = from, .to = to}; }

/// Where a parameter's value of type T is within the object that has it.
template <class T> struct Place {
    const T& (*get)(const void* object);
    T& (*reach)(void* object);
};

/// An enumeration, a switch or a string with few allowed values, seen as one of its names.
struct Choice {
    std::vector<std::string_view> names;
    /// Empty: none of them.
    std::string_view (*get)(const void* object, const std::vector<std::string_view>& names);
    void (*set)(void* object, const std::vector<std::string_view>& names, std::string_view name);
    /// What was a name once, and the name now: older scenes can be read.
    std::vector<std::pair<std::string_view, std::string_view>> former = {};
};

/// The value behind a parameter.
using Value =
    std::variant<Place<double>, Place<std::optional<double>>, Place<int>, Place<std::uint64_t>,
                 Place<bool>, Place<std::string>, Choice, Place<std::vector<double>>,
                 Place<std::vector<dem::DetachmentSegment>>, Place<std::vector<dem::TargetStage>>,
                 Place<std::vector<fem::Layer>>, Place<std::vector<std::array<double, 4>>>,
                 Place<std::vector<PickedLine>>, Place<std::vector<dem::Point>>>;

/// The one declaration of a parameter. A default outside the range means that the parameter must be
/// given.
struct Parameter {
    std::string_view key; ///< in the scene file, ends with the unit
    Value value;          ///< in SI units
    std::string_view unit;
    Range range;
    std::string_view symbol; ///< in the paper
    std::string_view doc;
    std::string_view changes = {}; ///< effect of another value on a run: "Raising it ..."
    Range usual = {};    ///< where scenes of ours and published values lie; not given: not known
    double per_si = 1.0; ///< units of the key in one SI unit
    /// Whether its default stands for metres of travel: it is for usual_rate, and follows
    /// extension.rate_m_per_a at any other.
    bool follows_rate = false;
};

/// The geological rate that defaults are for, m/a: the paper's.
inline constexpr double usual_rate = 0.01;

/// A time, or a rate of strain, whose default stands for metres of travel.
Parameter by_travel(Parameter parameter);

/// Value that does at a geological rate, m/a, as a default does at the usual rate: a time is
/// longer, and a rate of strain lower, by as much as the motion is slower.
double at_rate(const Parameter& parameter, double usual, double rate);

namespace detail {

template <class Member> struct MemberOf;
template <class Object, class T> struct MemberOf<T Object::*> { using object = Object; };

/// The member at a path; const where the object is.
template <auto First, auto... Rest> auto& member(auto& object) {
    if constexpr (sizeof...(Rest) == 0)
        return object.*First;
    else
        return member<Rest...>(object.*First);
}

template <auto First, auto...> struct OwnerOf : MemberOf<decltype(First)> {};
/// The type of object that a path of members starts from.
template <auto... Path> using Owner = typename OwnerOf<Path...>::object;

template <auto... Path> const auto& get(const void* object) {
    return member<Path...>(*static_cast<const Owner<Path...>*>(object));
}

template <auto... Path> auto& reach(void* object) {
    return member<Path...>(*static_cast<Owner<Path...>*>(object));
}

} // namespace detail

/// The value at a path of members: at<&FaultParameters::material, &Material::friction>.
template <auto... Path>
constexpr auto at = Place<std::remove_cvref_t<decltype(detail::get<Path...>(nullptr))>>{
    detail::get<Path...>, detail::reach<Path...>};

/// A choice at a path of members: names in the order of the enumeration; of a switch the first
/// means true; a string is one of them; what is behind an optional may be none.
template <auto... Path> Choice one_of(std::vector<std::string_view> names) {
    using T = std::remove_cvref_t<decltype(detail::get<Path...>(nullptr))>;
    using Names = std::vector<std::string_view>;
    const auto number_of = [](const Names& all, std::string_view name) {
        std::size_t k = 0;
        while (k + 1 < all.size() && all[k] != name)
            ++k;
        return k;
    };
    static_assert(std::is_empty_v<decltype(number_of)>);
    return {std::move(names),
            [](const void* object, const Names& all) -> std::string_view {
                const T& value = detail::get<Path...>(object);
                if constexpr (std::is_same_v<T, std::string>)
                    return value;
                else if constexpr (std::is_same_v<T, bool>)
                    return all[value ? 0 : 1];
                else if constexpr (requires { value.has_value(); })
                    return value ? all[static_cast<std::size_t>(*value)] : std::string_view();
                else
                    return all[static_cast<std::size_t>(value)];
            },
            [](void* object, const Names& all, std::string_view name) {
                T& value = detail::reach<Path...>(object);
                if constexpr (std::is_same_v<T, std::string>)
                    value = name;
                else if constexpr (std::is_same_v<T, bool>)
                    value = name == all[0];
                else if constexpr (requires { value.has_value(); })
                    value = static_cast<typename T::value_type>(decltype(number_of){}(all, name));
                else
                    value = static_cast<T>(decltype(number_of){}(all, name));
            },
            {}};
}

/// A dem::BaseKind at a path of members.
template <auto... Path> Choice base_kinds() {
    Choice choice = one_of<Path...>({"sheet", "rests", "ramp"});
    choice.former = {{"moves", "sheet"}};
    return choice;
}

/// "above 0, at most 10"; empty if every number is allowed.
std::string text(const Range& range);

/// "0.1 to 0.85"; empty if it is not known.
std::string usual_text(const Parameter& parameter);

/// "number", "integer", "string", "one of ..."
std::string type_of(const Parameter& parameter);

std::vector<std::string_view> keys(const std::vector<Parameter>& parameters);

// Ranges that several parameters share.
namespace ranges {
inline constexpr Range any;
inline constexpr Range duration{.from = 1, .to = 3e8};  ///< of a pause, a
inline constexpr Range interval{.from = 1, .to = 1e13}; ///< a: follows the rate down to 1e-9 m/a
inline constexpr Range length{.from = 1e-3, .to = 1e6};
inline constexpr Range height{.from = -1e5, .to = 1e5};
inline constexpr Range dip{
    .from = 0, .to = 90, .reason = "else the detachment rises or folds back"};
inline constexpr Range poisson_ratio{.from = 0, .below = 0.5};
inline constexpr Range friction{.from = 0, .to = 10};
inline constexpr Range stiffness{.from = 1e3, .to = 1e15};
inline constexpr Range strength{.from = 0, .to = 1e12};
inline constexpr Range density{.from = 100, .to = 20e3};
inline constexpr Range target_x{.from = -1e7, .to = 1e7};  ///< of a target line's points, m
inline constexpr Range target_time{.from = 0, .to = 1e10}; ///< of its stages, a
inline constexpr Range strain_rate{.from = 1e-30, .to = 1e-3};
} // namespace ranges

} // namespace listric

#include "apps/scene/svg/svg_transform.hpp"

#include "apps/scene/svg/svg_text.hpp"
#include "apps/support/words/text.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace listric {

namespace {

using Affine = Eigen::Affine2d;
using Eigen::Vector2d;

struct NumberWithUnit {
    double value = 0.0;
    std::string_view unit;
};

/// Size of a unit in units of SVG (lengths) or radians (angles).
struct Unit {
    std::string_view name;
    double size;
};
constexpr std::array<Unit, 7> lengths{{{"px", 1.0},
                                       {"in", 96.0},
                                       {"cm", 96.0 / 2.54},
                                       {"mm", 9.6 / 2.54},
                                       {"Q", 2.4 / 2.54},
                                       {"pt", 4.0 / 3.0},
                                       {"pc", 16.0}}};
constexpr std::array<Unit, 4> angles{
    {{"deg", dem::pi / 180.0}, {"rad", 1.0}, {"grad", dem::pi / 200.0}, {"turn", 2.0 * dem::pi}}};

/// The quantities between brackets.
class Arguments {
public:
    Arguments(SvgText& text, std::string_view function, bool css)
        : text_(text), function_(function), css_(css) {
        while (!text_.takes(')')) {
            if (text_.at_end())
                text_.refuse(fmt::format("{}( is not closed", shown(function_)));
            const double value = text_.number();
            all_.push_back({value, text_.takes('%') ? "%" : text_.unit()});
        }
    }

    std::size_t size() const { return all_.size(); }
    double number(std::size_t k) const { return all_[k].unit.empty() ? all_[k].value : refuse(k); }
    double length(std::size_t k) const { return in(lengths, 1.0, k); }
    double angle(std::size_t k) const { return in(angles, dem::pi / 180.0, k); }

private:
    template <std::size_t count>
    double in(const std::array<Unit, count>& units, double bare, std::size_t k) const {
        const NumberWithUnit& q = all_[k];
        if (q.unit.empty() && (!css_ || q.value == 0.0))
            return q.value * bare;
        if (q.unit.empty())
            text_.refuse(fmt::format("{}({}) has no unit, which the transform of a style needs "
                                     "(px, deg); write it so, or as an attribute",
                                     function_, q.value));
        for (const Unit& unit : units)
            if (unit.name == q.unit)
                return q.value * unit.size;
        return refuse(k);
    }
    [[noreturn]] double refuse(std::size_t k) const {
        text_.refuse(fmt::format("{}(...{}{}...) has a unit that is not read there", function_,
                                 all_[k].value, shown(all_[k].unit)));
    }

    SvgText& text_;
    std::string_view function_;
    bool css_;
    std::vector<NumberWithUnit> all_;
};

Affine translation(double x, double y) { return Affine(Eigen::Translation2d(x, y)); }
Affine sheared(double xy, double yx) {
    Affine shear = Affine::Identity();
    shear.matrix() << 1.0, xy, 0.0, yx, 1.0, 0.0, 0.0, 0.0, 1.0;
    return shear;
}
Affine scaled(double x, double y) { return Affine(Eigen::Scaling(x, y)); }

Affine one_transformation(SvgText& text, bool css) {
    const std::string_view name = text.word();
    if (name.empty() || !text.takes('('))
        text.refuse(fmt::format("has a transformation {} without brackets", shown(name)));
    const Arguments v(text, name, css);
    const auto has = [&](std::string_view called, std::size_t least, std::size_t most) {
        return name == called && v.size() >= least && v.size() <= most;
    };
    const std::size_t n = v.size();
    if (has("matrix", 6, 6)) {
        Affine one = Affine::Identity();
        one.matrix() << v.number(0), v.number(2), v.length(4), //
            v.number(1), v.number(3), v.length(5), 0.0, 0.0, 1.0;
        return one;
    }
    if (has("translate", 1, 2))
        return translation(v.length(0), n == 2 ? v.length(1) : 0.0);
    if (css && has("translateX", 1, 1))
        return translation(v.length(0), 0.0);
    if (css && has("translateY", 1, 1))
        return translation(0.0, v.length(0));
    if (has("scale", 1, 2))
        return scaled(v.number(0), v.number(n - 1));
    if (css && has("scaleX", 1, 1))
        return scaled(v.number(0), 1.0);
    if (css && has("scaleY", 1, 1))
        return scaled(1.0, v.number(0));
    if (has("rotate", 1, 1))
        return Affine(Eigen::Rotation2Dd(v.angle(0)));
    if (!css && has("rotate", 3, 3)) // about a point
        return translation(v.length(1), v.length(2)) * Eigen::Rotation2Dd(v.angle(0)) *
               translation(-v.length(1), -v.length(2));
    if (has("skewX", 1, 1))
        return sheared(dem::tangent(v.angle(0)), 0.0);
    if (has("skewY", 1, 1))
        return sheared(0.0, dem::tangent(v.angle(0)));
    if (css && has("skew", 1, 2))
        return sheared(dem::tangent(v.angle(0)), n == 2 ? dem::tangent(v.angle(1)) : 0.0);
    text.refuse(fmt::format("the transformation {} with {} number{} is not read, allowed: matrix, "
                            "translate, scale, rotate, skewX, skewY",
                            shown(name), n, n == 1 ? "" : "s"));
}

Affine transformations(std::string_view list, const std::string& where, bool css) {
    Affine all = Affine::Identity();
    SvgText text(list, where);
    if (list == "none")
        return all;
    while (!text.at_end()) {
        all = all * one_transformation(text, css);
        text.takes(',');
    }
    return all;
}

std::string trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\f";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == text.npos)
        return "";
    return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

std::string without_comments(std::string_view text) {
    std::string rest;
    while (!text.empty()) {
        const std::size_t begin = text.find("/*");
        rest += text.substr(0, begin);
        const std::size_t end = begin == text.npos ? text.npos : text.find("*/", begin + 2);
        text = end == text.npos ? std::string_view() : text.substr(end + 2);
    }
    return rest;
}

} // namespace

Affine svg_transformation(std::string_view text, const std::string& where) {
    return transformations(text, where, false);
}

Affine css_transformation(std::string_view text, const std::string& where) {
    return transformations(text, where, true);
}

std::map<std::string, std::string> css_declarations(std::string_view style) {
    const std::string text = without_comments(style) + ';';
    std::map<std::string, std::string> found;
    std::size_t begin = 0, colon = text.npos;
    int brackets = 0; // a semicolon within them or within quotes parts nothing
    char quote = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (quote != 0)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '(' || c == ')')
            brackets += c == '(' ? 1 : -1;
        else if (c == ':' && colon == text.npos)
            colon = k;
        else if (c == ';' && brackets <= 0) {
            if (colon != text.npos) {
                std::string name = trimmed(std::string_view(text).substr(begin, colon - begin));
                for (char& letter : name)
                    letter += letter >= 'A' && letter <= 'Z' ? 'a' - 'A' : 0;
                std::string value =
                    trimmed(std::string_view(text).substr(colon + 1, k - colon - 1));
                if (const std::size_t mark = value.rfind('!'); mark != value.npos)
                    value = trimmed(std::string_view(value).substr(0, mark)); // !important
                found[name] = value;
            }
            begin = k + 1;
            colon = text.npos;
        }
    }
    return found;
}

double svg_length(std::string_view length, std::optional<double> whole, const std::string& where) {
    SvgText text(length, where);
    const double value = text.number();
    if (text.takes('%') && text.at_end()) {
        if (!whole)
            text.refuse(fmt::format("{} of a drawing without viewBox or size", length));
        return 0.01 * value * *whole;
    }
    const std::string_view unit = text.unit();
    if (text.at_end() && unit.empty())
        return value;
    if (text.at_end())
        for (const Unit& known : lengths)
            if (known.name == unit)
                return value * known.size;
    text.refuse(fmt::format("the length {} is not read, allowed: px, mm, cm, in, pt, pc, %",
                            shown(length)));
}

Affine svg_view(std::string_view view_box, std::string_view aspect, SvgViewport& size,
                const std::string& where) {
    SvgText text(view_box, where);
    const double x = text.number(), y = text.number(), width = text.number(),
                 height = text.number();
    if (!text.at_end() || !(width > 0.0) || !(height > 0.0))
        text.refuse(fmt::format("viewBox=\"{}\" must be four numbers, the last two above 0",
                                shown(view_box)));
    if (!size.width || !size.height)
        text.refuse("an inner <svg> with a viewBox needs width and height");
    double across = *size.width / width, down = *size.height / height;
    SvgText ratio(aspect, where);
    std::string_view align = ratio.word();
    if (align == "defer")
        align = ratio.word();
    const std::string_view how = ratio.word();
    double left = 0.0, above = 0.0; // shares of the room that is left
    if (align.empty())
        align = "xMidYMid";
    if (align != "none") {
        const auto share = [](std::string_view place) {
            return place == "Min" ? 0.0 : place == "Mid" ? 0.5 : place == "Max" ? 1.0 : -1.0;
        };
        left = align.size() == 8 && align[0] == 'x' ? share(align.substr(1, 3)) : -1.0;
        above = align.size() == 8 && align[4] == 'Y' ? share(align.substr(5, 3)) : -1.0;
        across = down = how == "slice" ? std::max(across, down) : std::min(across, down);
    }
    if (left < 0.0 || above < 0.0 || !(how.empty() || how == "meet" || how == "slice") ||
        !ratio.at_end())
        ratio.refuse(fmt::format("preserveAspectRatio=\"{}\" is not read", shown(aspect)));
    const Affine view = translation(left * (*size.width - across * width) - across * x,
                                    above * (*size.height - down * height) - down * y) *
                        Eigen::Scaling(across, down);
    size = {width, height};
    return view;
}

} // namespace listric

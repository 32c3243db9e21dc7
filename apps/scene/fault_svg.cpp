#include "apps/scene/fault_svg.hpp"

#include "apps/support/error.hpp"
#include "dem/units.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

namespace listric {

using namespace dem;

namespace {

using Eigen::Vector2d;
using Affine = Eigen::Affine2d;

constexpr int steps_of_a_curve = 64; ///< points on each Bezier curve and elliptic arc

/// Numbers and command letters of an attribute, one after the other.
class Tokens {
public:
    Tokens(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {}

    /// The next letter, if one is next.
    std::optional<char> letter() {
        skip();
        if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])))
            return text_[at_++];
        return std::nullopt;
    }
    bool at_end() {
        skip();
        return at_ == text_.size();
    }
    double number() {
        skip();
        if (at_ < text_.size() && text_[at_] == '+')
            ++at_;
        double value = 0.0;
        const auto [end, error] =
            std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (error != std::errc{} || !std::isfinite(value))
            refuse(fmt::format("a number is missing at character {}", at_ + 1));
        at_ = static_cast<std::size_t>(end - text_.data());
        return value;
    }
    /// A flag of an elliptic arc, which needs nothing between it and what follows.
    bool flag() {
        skip();
        if (at_ == text_.size() || (text_[at_] != '0' && text_[at_] != '1'))
            refuse(fmt::format("a flag, 0 or 1, is missing at character {}", at_ + 1));
        return text_[at_++] == '1';
    }
    std::string word_before_bracket() {
        skip();
        const std::size_t end = text_.find('(', at_);
        if (end == text_.npos)
            refuse("has a transformation without brackets");
        std::string word(text_.substr(at_, end - at_));
        at_ = end + 1;
        return word;
    }
    std::vector<double> numbers_to_bracket() {
        std::vector<double> all;
        for (skip(); at_ < text_.size() && text_[at_] != ')'; skip())
            all.push_back(number());
        at_ = std::min(text_.size(), at_ + 1);
        return all;
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw SceneError(fmt::format("{}: {}", where_, what));
    }

private:
    void skip() {
        while (at_ < text_.size() &&
               (std::isspace(static_cast<unsigned char>(text_[at_])) || text_[at_] == ','))
            ++at_;
    }

    std::string_view text_;
    std::string where_;
    std::size_t at_ = 0;
};

/// SVG 1.1, section 7.6.
Affine transformation(const char* attribute, const std::string& where) {
    Affine all = Affine::Identity();
    for (Tokens tokens(attribute, where); !tokens.at_end();) {
        std::string word = tokens.word_before_bracket();
        word.erase(word.find_last_not_of(' ') + 1);
        const std::vector<double> v = tokens.numbers_to_bracket();
        Affine one = Affine::Identity();
        if (word == "matrix" && v.size() == 6)
            one.matrix() << v[0], v[2], v[4], v[1], v[3], v[5], 0.0, 0.0, 1.0;
        else if (word == "translate" && (v.size() == 1 || v.size() == 2))
            one.translate(Vector2d(v[0], v.size() == 2 ? v[1] : 0.0));
        else if (word == "scale" && (v.size() == 1 || v.size() == 2))
            one.scale(Vector2d(v[0], v.size() == 2 ? v[1] : v[0]));
        else if (word == "rotate" && v.size() == 1)
            one.rotate(v[0] * pi / 180.0);
        else
            tokens.refuse(fmt::format("the transformation {}({}) is not understood, allowed: "
                                      "matrix, translate, scale, rotate(angle)",
                                      word, fmt::join(v, " ")));
        all = all * one;
    }
    return all;
}

/// Points along a path's data (SVG 1.1, section 8.3).
class PathReader {
public:
    PathReader(const char* data, const std::string& where) : tokens_(data, where) {}

    std::vector<Vector2d> read() {
        char command = 0;
        while (!tokens_.at_end()) {
            if (const auto letter = tokens_.letter())
                command = *letter;
            else if (command == 0)
                tokens_.refuse("the path does not begin with a command");
            else if (command == 'M' || command == 'm')
                command = command == 'M' ? 'L' : 'l'; // further pairs are lines
            carry_out(command);
        }
        return std::move(points_);
    }

private:
    void carry_out(char command) {
        relative_ = std::islower(static_cast<unsigned char>(command)) != 0;
        char curve = 0; // whose control point the next smooth one mirrors
        switch (std::toupper(static_cast<unsigned char>(command))) {
        case 'M':
            if (!points_.empty())
                tokens_.refuse("the path has a second part; join the two, or name another path");
            points_.push_back(point());
            break;
        case 'L':
            points_.push_back(point());
            break;
        case 'H':
            points_.push_back({(relative_ ? here().x() : 0.0) + tokens_.number(), here().y()});
            break;
        case 'V':
            points_.push_back({here().x(), (relative_ ? here().y() : 0.0) + tokens_.number()});
            break;
        case 'C':
        case 'S': {
            curve = 'C';
            const Vector2d first =
                std::toupper(static_cast<unsigned char>(command)) == 'C' ? point() : mirrored('C');
            const Vector2d second = point();
            cubic(first, second, point());
            control_ = second;
            break;
        }
        case 'Q':
        case 'T': {
            curve = 'Q';
            const Vector2d middle =
                std::toupper(static_cast<unsigned char>(command)) == 'Q' ? point() : mirrored('Q');
            const Vector2d end = point();
            cubic(here() + 2.0 / 3.0 * (middle - here()), end + 2.0 / 3.0 * (middle - end), end);
            control_ = middle;
            break;
        }
        case 'A':
            elliptic();
            break;
        case 'Z':
            tokens_.refuse("the path is closed, but a fault is open; break it at the breakaway");
        default:
            tokens_.refuse(fmt::format("the path has an unknown command {}", command));
        }
        last_curve_ = curve;
    }

    Vector2d here() const { return points_.empty() ? Vector2d(0.0, 0.0) : points_.back(); }
    Vector2d point() {
        const double x = tokens_.number(), y = tokens_.number();
        return (relative_ ? here() : Vector2d(0.0, 0.0)) + Vector2d(x, y);
    }
    Vector2d mirrored(char curve) const {
        return last_curve_ == curve ? Vector2d(2.0 * here() - control_) : here();
    }

    void cubic(const Vector2d& b, const Vector2d& c, const Vector2d& d) {
        const Vector2d a = here();
        for (int k = 1; k <= steps_of_a_curve; ++k) {
            const double t = static_cast<double>(k) / steps_of_a_curve, s = 1.0 - t;
            points_.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c +
                              t * t * t * d);
        }
    }

    /// SVG 1.1, appendix F.6.5: from end points to centre.
    void elliptic() {
        double rx = std::abs(tokens_.number()), ry = std::abs(tokens_.number());
        const Eigen::Rotation2Dd axes(tokens_.number() * pi / 180.0);
        const bool large = tokens_.flag(), sweep = tokens_.flag();
        const Vector2d from = here(), to = point();
        if (rx == 0.0 || ry == 0.0 || from == to) {
            points_.push_back(to);
            return;
        }
        const Vector2d half = axes.inverse() * Vector2d(0.5 * (from - to));
        const auto needed = [&] {
            return half.x() * half.x() / (rx * rx) + half.y() * half.y() / (ry * ry);
        };
        if (const double enlarge = std::sqrt(std::max(1.0, needed())); enlarge > 1.0) {
            rx *= enlarge;
            ry *= enlarge;
        }
        const double size =
            std::sqrt(std::max(0.0, 1.0 / needed() - 1.0)) * (large == sweep ? -1.0 : 1.0);
        const Vector2d centre(size * rx * half.y() / ry, -size * ry * half.x() / rx);
        const auto angle = [&](const Vector2d& p) {
            return std::atan2((p.y() - centre.y()) / ry, (p.x() - centre.x()) / rx);
        };
        const double begin = angle(half);
        double turn = angle(-half) - begin;
        if (sweep && turn < 0.0)
            turn += 2.0 * pi;
        else if (!sweep && turn > 0.0)
            turn -= 2.0 * pi;
        for (int k = 1; k <= steps_of_a_curve; ++k) {
            const double a = begin + turn * k / steps_of_a_curve;
            const Vector2d local(rx * std::cos(a), ry * std::sin(a));
            points_.push_back(0.5 * (from + to) + axes * Vector2d(centre + local));
        }
    }

    Tokens tokens_;
    std::vector<Vector2d> points_;
    Vector2d control_{0.0, 0.0};
    char last_curve_ = 0;
    bool relative_ = false;
};

/// Metres along one direction by drawing units: value = offset + scale * units.
struct Scale {
    double offset = 0.0, scale = 0.0;
};

/// Least squares through the reference points.
Scale scale_of(const std::vector<std::array<double, 4>>& points, std::size_t from, std::size_t to,
               const char* direction, const std::string& where) {
    double mean_from = 0.0, mean_to = 0.0, square = 0.0, product = 0.0;
    const auto count = static_cast<double>(points.size());
    for (const auto& p : points) {
        mean_from += p[from] / count;
        mean_to += p[to] / count;
    }
    for (const auto& p : points) {
        square += (p[from] - mean_from) * (p[from] - mean_from);
        product += (p[from] - mean_from) * (p[to] - mean_to);
    }
    if (points.size() < 2 || !(square > 0.0) || product == 0.0)
        throw SceneError(fmt::format("{}: svg_points must have two points that differ {}, "
                                     "[[px, py, x_m, depth_m], ...]",
                                     where, direction));
    const double scale = product / square;
    return {mean_to - scale * mean_from, scale};
}

} // namespace

FaultPoints read_fault_svg(const FaultSource& source, const std::filesystem::path& file) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_file(file.c_str());
    if (!parsed)
        throw SceneError(fmt::format("{}: cannot be read as SVG: {} at byte {}", file.string(),
                                     parsed.description(), parsed.offset));
    std::vector<std::string> ids;
    pugi::xml_node path;
    const auto look = [&](const auto& self, pugi::xml_node node) -> void {
        for (pugi::xml_node child : node.children()) {
            if (std::string_view(child.name()) == "path") {
                ids.emplace_back(child.attribute("id").value());
                if (ids.back() == source.svg_path && !path)
                    path = child;
            }
            self(self, child);
        }
    };
    look(look, document);
    const std::string where = fmt::format("{}: path {}", file.string(), source.svg_path);
    if (!path)
        throw SceneError(fmt::format("{}: has no path with the id svg_path = \"{}\"; its paths: {}",
                                     file.string(), source.svg_path, fmt::join(ids, ", ")));
    Affine placed = Affine::Identity();
    for (pugi::xml_node node = path; node; node = node.parent())
        placed = transformation(node.attribute("transform").value(), where) * placed;
    const Scale x = scale_of(source.svg_points, 0, 2, "across", where);
    const Scale depth = scale_of(source.svg_points, 1, 3, "in depth", where);
    FaultPoints fault;
    for (const Vector2d& drawn : PathReader(path.attribute("d").value(), where).read()) {
        const Vector2d p = placed * drawn;
        fault.points.push_back({x.offset + x.scale * p.x(), -(depth.offset + depth.scale * p.y())});
        fault.where.push_back(where);
    }
    if (fault.points.empty())
        throw SceneError(where + ": has no points");
    return fault;
}

} // namespace listric

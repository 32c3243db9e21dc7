#include "apps/scene/svg/svg_place.hpp"

#include "apps/scene/svg/svg_element.hpp"
#include "apps/scene/svg/svg_transform.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace listric {

namespace {

using Affine = Eigen::Affine2d;
using pugi::xml_node;
using Declarations = std::map<std::string, std::string>;

constexpr std::string_view svg_namespace = "http://www.w3.org/2000/svg";

/// The element and all that it is in, the outer one first.
std::vector<xml_node> chain_to(xml_node element) {
    std::vector<xml_node> chain;
    for (xml_node node = element; node.type() == pugi::node_element; node = node.parent())
        chain.push_back(node);
    std::ranges::reverse(chain);
    return chain;
}

/// The namespace of an element's prefix; empty where none is said.
std::string_view namespace_of(xml_node element) {
    const std::string_view name = element.name();
    const std::size_t colon = name.rfind(':');
    const std::string key =
        colon == name.npos ? "xmlns" : "xmlns:" + std::string(name.substr(0, colon));
    for (xml_node node = element; node; node = node.parent())
        if (const pugi::xml_attribute attribute = node.attribute(key.c_str()))
            return attribute.value();
    return {};
}

/// Property of an element: in its style or else as an attribute.
std::string said(xml_node element, const Declarations& style, const char* property) {
    const auto declared = style.find(property);
    return declared != style.end() ? declared->second : element.attribute(property).value();
}

/// Refuses attributes that move an element besides `transform`.
void check_read(xml_node element, const Declarations& style, const std::string& where) {
    for (const char* property : {"translate", "rotate", "scale", "offset-path", "zoom", "d"})
        if (const auto declared = style.find(property);
            declared != style.end() && declared->second != "none" && declared->second != "1")
            refuse(where, fmt::format("the style of {} sets {}, which is not read; write it as "
                                      "transform or d",
                                      svg_tag(element), property));
    const std::string origin = said(element, style, "transform-origin");
    if (origin.find_first_not_of("0px \t,") != origin.npos && // all but zeros
        !said(element, style, "transform").empty())
        refuse(where, fmt::format("{} has a transform-origin, {}, which is not read; write it into "
                                  "the transform",
                                  svg_tag(element), shown(origin)));
    for (const xml_node child : element.children())
        if (svg_name(child) == "animateTransform" || svg_name(child) == "animateMotion")
            refuse(where, fmt::format("{} is moved by {}, which is not read", svg_tag(element),
                                      svg_tag(child)));
}

/// A style sheet is not read; what it could do to places is looked for.
void check_style_sheets(xml_node outer, const std::string& where) {
    for (const xml_node element : svg_elements(outer)) {
        if (svg_name(element) != "style")
            continue;
        const std::string_view text = element.child_value();
        for (std::size_t at = text.find("transform"); at != text.npos;
             at = text.find("transform", at + 1))
            if (at == 0 || text[at - 1] != '-') // text-transform is another thing
                refuse(where, fmt::format("{} sets a transform for classes of elements, which is "
                                          "not read; write it as an attribute of the element",
                                          svg_tag(element)));
    }
}

/// Refuses elements that are drawn elsewhere, or not at all.
void check_drawn(const std::vector<xml_node>& chain, const std::string& where) {
    std::string visibility, hidden_by;
    for (std::size_t k = 0; k < chain.size(); ++k) {
        const xml_node node = chain[k];
        const Declarations style = css_declarations(node.attribute("style").value());
        if (said(node, style, "display") == "none")
            refuse(where,
                   fmt::format("is not drawn, {} has display: none; show it, or name another path",
                               svg_tag(node)));
        if (const std::string own = said(node, style, "visibility"); !own.empty()) {
            visibility = own;
            hidden_by = svg_tag(node);
        }
        if (k + 1 == chain.size())
            continue;
        const std::string_view name = svg_name(node);
        if (is_store(node) || name == "use")
            refuse(where, fmt::format("is inside {}, which is not read: its content is drawn "
                                      "elsewhere or not at all; name a path of the drawing itself "
                                      "(Inkscape: Edit, Clone, Unlink Clone)",
                                      svg_tag(node)));
        if (name != "svg" && name != "g" && name != "a" && name != "switch")
            refuse(where, fmt::format("is inside {}, which is not read", svg_tag(node)));
        if (name != "switch")
            continue;
        for (const xml_node other : node.children()) {
            if (other == chain[k + 1])
                break;
            if (other.type() == pugi::node_element && !other.attribute("requiredExtensions") &&
                !other.attribute("requiredFeatures") && !other.attribute("systemLanguage"))
                refuse(where, fmt::format("is not drawn: {} shows {} instead", svg_tag(node),
                                          svg_tag(other)));
        }
    }
    if (visibility == "hidden" || visibility == "collapse")
        refuse(where, fmt::format("is not drawn, {} has visibility: {}; show it, or name another "
                                  "path",
                                  hidden_by, visibility));
}

/// The viewport of the outer <svg>, in its own units.
SvgViewport outer_viewport(xml_node outer, const std::string& where) {
    SvgViewport size;
    if (const char* box = outer.attribute("viewBox").value(); *box != '\0') {
        svg_view(box, "none", size = {1.0, 1.0}, where);
        return size;
    }
    for (const auto& [key, value] : {std::pair{"width", &size.width}, {"height", &size.height}})
        if (const std::string_view said = outer.attribute(key).value();
            !said.empty() && said.find('%') == said.npos && said != "auto")
            *value = svg_length(said, std::nullopt, where);
    return size;
}

/// @param size  of what it is in; on return its own
Affine inner_view(xml_node inner, SvgViewport& size, const std::string& where) {
    const auto length = [&](const char* key, std::optional<double> whole,
                            std::optional<double> missing) -> std::optional<double> {
        const std::string_view said = inner.attribute(key).value();
        return said.empty() || said == "auto" ? missing
                                              : std::optional(svg_length(said, whole, where));
    };
    const double x = *length("x", size.width, 0.0), y = *length("y", size.height, 0.0);
    size = {length("width", size.width, size.width), length("height", size.height, size.height)};
    if ((size.width && !(*size.width > 0.0)) || (size.height && !(*size.height > 0.0)))
        refuse(where, fmt::format("is not drawn, {} has no size", svg_tag(inner)));
    const Affine moved{Eigen::Translation2d(x, y)};
    const char* box = inner.attribute("viewBox").value();
    return *box == '\0'
               ? moved
               : moved * svg_view(box, inner.attribute("preserveAspectRatio").value(), size, where);
}

} // namespace

Affine place_in_drawing(xml_node element, const std::string& where) {
    const std::vector<xml_node> chain = chain_to(element);
    if (svg_name(chain.front()) != "svg")
        refuse(where, fmt::format("the outer element is {}, not <svg>", svg_tag(chain.front())));
    // Illustrator writes an entity in its place.
    if (const std::string_view space = namespace_of(element);
        !space.empty() && space != svg_namespace && !space.starts_with('&'))
        refuse(where, fmt::format("is no element of SVG but of {}", shown(space)));
    check_drawn(chain, where);
    check_style_sheets(chain.front(), where);
    Affine place = Affine::Identity();
    SvgViewport size = outer_viewport(chain.front(), where);
    for (std::size_t k = 0; k < chain.size(); ++k) {
        const xml_node node = chain[k];
        const Declarations style = css_declarations(node.attribute("style").value());
        const std::string here =
            k + 1 == chain.size() ? where : fmt::format("{}: {}", where, svg_tag(node));
        check_read(node, style, here);
        const auto declared = style.find("transform");
        const Affine own = declared != style.end()
                               ? css_transformation(declared->second, here)
                               : svg_transformation(node.attribute("transform").value(), here);
        if (k == 0 && !own.isApprox(Affine::Identity(), 0.0))
            refuse(here, "has a transform, which is not read; svg_points are in the units inside "
                         "the outer <svg>");
        place = place * own;
        if (k > 0 && svg_name(node) == "svg")
            place = place * inner_view(node, size, here);
        if (!place.matrix().allFinite())
            refuse(here, "the transformations make numbers that are not finite");
    }
    const Eigen::Matrix2d m = place.linear();
    if (!(std::abs(m.determinant()) > 1e-12 * m.squaredNorm()))
        refuse(where, "the transformations make a point or a line of all that is drawn, as "
                      "scale(0) does");
    return place;
}

} // namespace listric

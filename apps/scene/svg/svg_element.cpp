#include "apps/scene/svg/svg_element.hpp"

#include "apps/support/error.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace listric {

namespace {

using pugi::xml_node;

template <std::size_t count>
bool is_one_of(std::string_view name, const std::array<std::string_view, count>& names) {
    return std::ranges::find(names, name) != names.end();
}

bool is_line(xml_node element) {
    return is_one_of(svg_name(element),
                     std::array<std::string_view, 3>{"path", "polyline", "line"});
}

std::string_view id_of(xml_node element) { return element.attribute("id").value(); }

/// The name that people gave in a drawing program: Inkscape's label, whatever prefix its names
/// have, data-name of Illustrator, serif:id of Affinity, a title within the element.
std::string_view label_of(xml_node element) {
    for (const pugi::xml_attribute attribute : element.attributes()) {
        const std::string_view name = attribute.name();
        if (name.ends_with(":label") || name == "data-name" || name == "serif:id")
            return attribute.value();
    }
    for (const xml_node child : element.children())
        if (svg_name(child) == "title")
            return child.text().get();
    return {};
}

/// Whether an id stands for a name with blanks or other letters, which an id cannot have:
/// "Main_fault", "Main_x20_fault" (Illustrator), "Main_x0020_fault" (CorelDRAW) for "Main fault".
bool stands_for(std::string_view id, std::string_view name) {
    for (const char letter : name) {
        const auto byte = static_cast<unsigned char>(letter);
        const std::array<std::string, 4> written{std::string(1, letter),
                                                 fmt::format("_x{:02X}_", byte),
                                                 fmt::format("_x{:04X}_", byte), "_"};
        const std::size_t known = letter == ' ' ? 4 : 3;
        const auto* const found =
            std::find_if(written.begin(), written.begin() + known,
                         [&](const std::string& one) { return id.starts_with(one); });
        if (found == written.begin() + known)
            return false;
        id.remove_prefix(found->size());
    }
    return id.empty();
}

/// "path1234 (label fault)"; of many only some.
std::string listed(const std::vector<xml_node>& elements) {
    constexpr std::size_t most = 12;
    std::vector<std::string> names;
    std::size_t nameless = 0;
    for (const xml_node element : elements) {
        const std::string_view id = id_of(element), label = label_of(element);
        if (id.empty() && label.empty())
            ++nameless;
        else if (names.size() <= most)
            names.push_back(
                label.empty() || label == id
                    ? shown(id)
                    : fmt::format("{} (label {})", id.empty() ? "no id" : shown(id), shown(label)));
    }
    if (names.size() > most) {
        names.resize(most);
        names.push_back(fmt::format("and {} more", elements.size() - nameless - most));
    }
    if (nameless > 0)
        names.push_back(fmt::format("{} without id", nameless));
    return fmt::format("{}", fmt::join(names, ", "));
}

class Search {
public:
    Search(const pugi::xml_document& document, std::string_view name, const std::string& file)
        : all_(svg_elements(static_cast<const xml_node&>(document))), name_(name), file_(file) {
        std::ranges::copy_if(all_, std::back_inserter(lines_), is_line);
    }

    xml_node found() const {
        std::vector<xml_node> named = those_with(id_of);
        if (named.empty())
            named = those_with(label_of);
        if (named.empty())
            named = those_that([&](xml_node one) { return stands_for(id_of(one), name_); });
        if (named.empty())
            refuse_unknown();
        // An id that a group and the line in it share is clear.
        std::vector<xml_node> named_lines;
        std::ranges::copy_if(named, std::back_inserter(named_lines), is_line);
        if (named_lines.size() == 1)
            return named_lines.front();
        if (named.size() > 1)
            refuse(fmt::format("{} is the {} of {} elements: {}; give one of them an id of its own",
                               shown(name_), id_of(named[0]) == name_ ? "id" : "label",
                               named.size(), listed(named)));
        return line_in(named.front());
    }

private:
    template <class Is> std::vector<xml_node> those_that(Is is) const {
        std::vector<xml_node> found;
        if (!name_.empty())
            std::ranges::copy_if(all_, std::back_inserter(found), is);
        return found;
    }
    template <class Name> std::vector<xml_node> those_with(Name name) const {
        return those_that([&](xml_node element) { return name(element) == name_; });
    }

    /// Groups and layers that have a name and hold a line.
    std::vector<xml_node> named_groups() const {
        std::vector<xml_node> groups;
        std::ranges::copy_if(all_, std::back_inserter(groups), [](xml_node element) {
            return svg_name(element) == "g" &&
                   !(id_of(element).empty() && label_of(element).empty()) &&
                   std::ranges::any_of(svg_elements(element, true), is_line);
        });
        return groups;
    }

    /// The line of a group, or what the element is instead.
    xml_node line_in(xml_node element) const {
        const std::string_view kind = svg_name(element);
        const std::string what = fmt::format(
            "{} is {} {}", shown(name_), id_of(element) == name_ ? "a" : "the label of",
            id_of(element) == name_ ? fmt::format("<{}>", shown(kind)) : svg_tag(element));
        if (kind == "use") {
            std::string_view of = element.attribute("xlink:href").value();
            if (of.empty())
                of = element.attribute("href").value();
            refuse(fmt::format("{}, a clone of {}, which is not read; name what it is a clone of, "
                               "or make a path of it (Inkscape: Edit, Clone, Unlink Clone)",
                               what, shown(of)));
        }
        if (is_one_of(kind,
                      std::array<std::string_view, 4>{"polygon", "rect", "circle", "ellipse"}))
            refuse(what + ", which is closed, but a fault is an open path; draw it as one");
        if (!is_one_of(kind, std::array<std::string_view, 4>{"g", "a", "svg", "switch"}))
            refuse(fmt::format("{}, which is not read; allowed: path, polyline, line, or a group "
                               "with one of them; its paths: {}",
                               what, listed(lines_)));
        std::vector<xml_node> lines;
        std::ranges::copy_if(svg_elements(element, true), std::back_inserter(lines), is_line);
        if (lines.size() == 1)
            return lines.front();
        refuse(lines.empty() ? fmt::format("{}, which has no path, polyline or line; its paths: {}",
                                           what, listed(lines_))
                             : fmt::format("{}, which has {} paths: {}; name one of them", what,
                                           lines.size(), listed(lines)));
    }

    [[noreturn]] void refuse_unknown() const {
        if (lines_.empty())
            refuse("has no path, polyline or line");
        std::vector<std::string_view> names;
        for (const xml_node line : lines_)
            for (const std::string_view name : {id_of(line), label_of(line)})
                if (!name.empty())
                    names.push_back(name);
        const std::vector<xml_node> groups = named_groups();
        for (const xml_node group : groups)
            for (const std::string_view name : {id_of(group), label_of(group)})
                if (!name.empty())
                    names.push_back(name);
        const auto meant = nearest(name_, names);
        refuse(fmt::format("has no path with the id {}{}; its paths: {}{}",
                           name_.empty() ? "for detachment.svg_path to name"
                                         : fmt::format("svg_path = \"{}\"", shown(name_)),
                           meant ? fmt::format(", did you mean {}?", shown(*meant)) : "",
                           listed(lines_),
                           groups.empty() ? "" : "; its groups: " + listed(groups)));
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw SceneError(fmt::format("{}: {}", file_, what));
    }

    std::vector<xml_node> all_, lines_;
    std::string_view name_;
    const std::string& file_;
};

} // namespace

std::string_view svg_name(xml_node element) {
    const std::string_view name = element.name();
    return name.substr(name.rfind(':') + 1); // npos + 1 is 0
}

std::string svg_tag(xml_node element) {
    const std::string_view id = id_of(element);
    return id.empty() ? fmt::format("<{}>", shown(element.name()))
                      : fmt::format("<{} id=\"{}\">", shown(element.name()), shown(id));
}

bool is_store(xml_node element) {
    return is_one_of(svg_name(element),
                     std::array<std::string_view, 8>{"defs", "symbol", "clipPath", "mask",
                                                     "pattern", "marker", "font", "glyph"});
}

std::vector<xml_node> svg_elements(xml_node top, bool drawn) {
    std::vector<xml_node> elements;
    for (xml_node node = top.first_child(); node;) {
        const bool is_element = node.type() == pugi::node_element;
        if (is_element)
            elements.push_back(node);
        if (node.first_child() && !(drawn && is_store(node))) {
            node = node.first_child();
            continue;
        }
        while (node != top && !node.next_sibling())
            node = node.parent();
        if (node == top)
            break;
        node = node.next_sibling();
    }
    return elements;
}

xml_node find_svg_line(const pugi::xml_document& document, std::string_view name,
                       const std::string& file) {
    return Search(document, name, file).found();
}

} // namespace listric

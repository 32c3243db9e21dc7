#include "fem/mesh_scan.hpp"

#include "fem/request.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <vector>

namespace listric::fem {

namespace {

/// The words of a text, and the lines that they stand in.
class Words {
public:
    explicit Words(std::string_view text) : text_(text) {}

    /// The next word; empty at the end.
    std::string_view next() {
        while (at_ < text_.size() && is_blank(text_[at_]))
            step();
        line_ = next_line_;
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }

    std::size_t line() const { return line_; } ///< of the last word, from 1
    std::size_t left() const { return text_.size() - at_; }

private:
    static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    void step() { next_line_ += text_[at_++] == '\n'; }

    std::string_view text_;
    std::size_t at_ = 0, line_ = 1, next_line_ = 1;
};

class MeshScan {
public:
    MeshScan(const std::string& name, std::string_view text) : name_(name), words_(text) {}

    void run() {
        double version = 0.0;
        std::int64_t binary = 1;
        if (words_.next() != "$MeshFormat" || !read(version) || !(version >= 2.0 && version < 3.0))
            refuse("is no Gmsh mesh of format 2.2; write one with gmsh -2 -format msh22");
        if (!read(binary) || binary != 0)
            refuse("is a binary mesh, needs a text; write one with gmsh -2 -format msh22");
        skip_to("$EndMeshFormat");
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next())
            if (word == "$Nodes")
                scan_nodes();
            else if (word == "$Elements")
                scan_elements();
            else if (word.starts_with('$') && !word.starts_with("$End"))
                skip_to("$End" + std::string(word.substr(1)));
        if (quadrilaterals_ == 0)
            refuse("has no quadrilaterals");
    }

private:
    [[noreturn]] void refuse(const std::string& reason) const {
        throw FootwallError(name_ + ":" + std::to_string(words_.line()) + ": " + reason);
    }

    template <class Number> bool read(Number& number) {
        std::string_view word = words_.next();
        if (word.starts_with('+'))
            word.remove_prefix(1);
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, number);
        return error == std::errc() && stop == end;
    }

    std::int64_t whole(const char* what, std::int64_t least, std::int64_t most) {
        std::int64_t number = 0;
        if (!read(number) || number < least || number > most)
            refuse(std::string("needs ") + what + ", a whole number from " + std::to_string(least) +
                   " to " + std::to_string(most) + "; is the file whole?");
        return number;
    }

    /// How many lines follow; no more than the rest of the file can hold.
    std::size_t count(const char* what, std::size_t least_bytes) {
        std::int64_t number = 0;
        if (!read(number) || number < 0)
            refuse(std::string("needs the number of ") + what);
        const auto size = static_cast<std::size_t>(number);
        if (size > words_.left() / least_bytes)
            refuse("announces " + std::to_string(size) + " " + what +
                   ", more than the rest of the file can hold; is the file whole?");
        return size;
    }

    void skip_to(const std::string& end) {
        for (std::string_view word = words_.next(); word != end; word = words_.next())
            if (word.empty())
                refuse("ends without " + (end.size() < 40 ? end : "the end of its last section"));
    }

    void scan_nodes() {
        constexpr std::size_t shortest = 8; // "1 0 0 0\n"
        constexpr double farthest = 1e9;    // m
        if (!nodes_.empty())
            refuse("has $Nodes twice");
        const std::size_t size = count("nodes", shortest);
        nodes_.assign(size + 1, {absent, absent});
        for (std::size_t k = 0; k < size; ++k) {
            std::int64_t number = 0;
            double x = 0.0, y = 0.0, z = 0.0;
            if (!read(number) || !read(x) || !read(y) || !read(z))
                refuse("needs a node, four numbers: number, x, y, z; is the file whole?");
            if (number < 0 || static_cast<std::size_t>(number) > size)
                refuse("node numbers have gaps; write it with gmsh's renumbering");
            if (!(std::abs(x) <= farthest && std::abs(y) <= farthest))
                refuse("node " + std::to_string(number) + " is further than 1e9 m away");
            Vector& node = nodes_[static_cast<std::size_t>(number)];
            if (!std::isnan(node.x))
                refuse("node " + std::to_string(number) + " is there twice");
            node = {x, y};
        }
        skip_to("$EndNodes");
    }

    void scan_elements() {
        constexpr std::size_t shortest = 8; // "1 15 0 1"
        const std::size_t size = count("elements", shortest);
        for (std::size_t k = 0; k < size; ++k)
            scan_element();
        skip_to("$EndElements");
    }

    void scan_element() {
        constexpr std::int64_t point = 15, line = 1, quadrilateral = 3; // Gmsh's types
        constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
        const std::int64_t number = whole("an element's number", 0, most);
        const std::int64_t type = whole("an element's type", 0, most);
        const std::size_t corners = type == point           ? 1
                                    : type == line          ? 2
                                    : type == quadrilateral ? 4
                                                            : 0;
        if (corners == 0)
            refuse("element " + std::to_string(number) + " is of Gmsh type " +
                   std::to_string(type) +
                   ", allowed: first-order lines and quadrilaterals; recombine all surfaces");
        const std::size_t tags = count("tags", 2);
        for (std::size_t i = 0; i < tags; ++i) // the numbers of ghosts' parts are negative
            whole("a tag", i < 2 ? 0 : -most, most);
        std::array<std::size_t, 4> v{};
        for (std::size_t i = 0; i < corners; ++i)
            v[i] = static_cast<std::size_t>(whole("a node's number", 0, most));
        for (std::size_t i = 0; i < corners; ++i)
            if (v[i] >= nodes_.size() || std::isnan(nodes_[v[i]].x))
                refuse("element " + std::to_string(number) + " names node " + std::to_string(v[i]) +
                       ", which is not there");
        if (type == quadrilateral)
            check_quadrilateral(number, v);
    }

    void check_quadrilateral(std::int64_t number, const std::array<std::size_t, 4>& v) {
        ++quadrilaterals_;
        if (!(least_corner({nodes_[v[0]], nodes_[v[1]], nodes_[v[3]], nodes_[v[2]]}) > 0.0))
            refuse("element " + std::to_string(number) +
                   " is inverted or folded: nodes must run anticlockwise around a convex "
                   "quadrilateral");
    }

    static constexpr double absent = std::numeric_limits<double>::quiet_NaN();

    std::string name_;
    Words words_;
    std::vector<Vector> nodes_; ///< by number, from 1
    std::size_t quadrilaterals_ = 0;
};

} // namespace

double least_corner(const std::array<Vector, 4>& v) {
    const auto corner = [&](std::size_t at, std::size_t right, std::size_t up) {
        return cross(v[right] - v[at], v[up] - v[at]);
    };
    return std::min({corner(0, 1, 2), corner(1, 3, 0), corner(2, 0, 3), corner(3, 2, 1)});
}

void scan_mesh(const std::string& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw FootwallError(file + ": no such mesh file");
    std::ifstream in(file, std::ios::binary);
    std::string text(std::filesystem::file_size(file, error), '\0');
    if (error || !in.read(text.data(), static_cast<std::streamsize>(text.size())))
        throw FootwallError(file + ": cannot be read");
    MeshScan(file, text).run();
}

} // namespace listric::fem

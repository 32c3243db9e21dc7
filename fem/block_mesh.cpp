#include "fem/block_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace listric::fem {

Path segment(Vector a, Vector b) {
    return [a, b](double t) { return a + t * (b - a); };
}

Path stretch(const Curve& curve, double from, double to) {
    return [&curve, from, to](double t) { return curve.at(from + t * (to - from)); };
}

Path reversed(Path path) {
    return [path = std::move(path)](double t) { return path(1.0 - t); };
}

Fractions even(double length, double size) {
    const int parts = std::max(1, static_cast<int>(std::lround(length / size)));
    Fractions fractions;
    for (int k = 0; k <= parts; ++k)
        fractions.push_back(static_cast<double>(k) / parts);
    return fractions;
}

Fractions growing(double length, double size, double fine, double ratio, double largest) {
    assert(length > 0.0 && size > 0.0 && ratio >= 1.0);
    Fractions fractions{0.0};
    double part = size;
    while (fractions.back() < length) {
        if (fractions.back() >= fine)
            part = std::min(part * ratio, largest);
        fractions.push_back(fractions.back() + part);
    }
    const double whole = fractions.back();
    for (double& place : fractions)
        place /= whole;
    return fractions;
}

Fractions reversed(Fractions fractions) {
    std::ranges::reverse(fractions);
    for (double& f : fractions)
        f = 1.0 - f;
    return fractions;
}

void BlockMesher::add(const Block& block, const Fractions& u, const Fractions& v) {
    assert(u.size() >= 2 && v.size() >= 2);
    const Path &bottom = block.bottom.path, &top = block.top.path;
    const Path &left = block.left.path, &right = block.right.path;
    const Vector sw = bottom(0), se = bottom(1), nw = top(0), ne = top(1);
    std::vector<unsigned> index;
    for (double t : v)
        for (double s : u)
            index.push_back(vertex((1 - t) * bottom(s) + t * top(s) + (1 - s) * left(t) +
                                   s * right(t) - (1 - s) * (1 - t) * sw - s * (1 - t) * se -
                                   (1 - s) * t * nw - s * t * ne));
    const std::size_t n = u.size(), m = v.size();
    const auto edge = [&](std::size_t start, std::size_t end, const MeshSide& side) {
        if (side.boundary || side.curve != EdgeCurve::straight)
            mesh_.edges.push_back({index[start], index[end], side.boundary, side.curve});
    };
    for (std::size_t j = 0; j + 1 < m; ++j)
        for (std::size_t i = 0; i + 1 < n; ++i)
            mesh_.cells.push_back({{index[j * n + i], index[j * n + i + 1], index[(j + 1) * n + i],
                                    index[(j + 1) * n + i + 1]}});
    for (std::size_t i = 0; i + 1 < n; ++i) {
        edge(i, i + 1, block.bottom);
        edge((m - 1) * n + i, (m - 1) * n + i + 1, block.top);
    }
    for (std::size_t j = 0; j + 1 < m; ++j) {
        edge(j * n, (j + 1) * n, block.left);
        edge(j * n + n - 1, (j + 1) * n + n - 1, block.right);
    }
}

BlockMesh BlockMesher::take() {
    vertices_by_square_.clear();
    return std::exchange(mesh_, {});
}

/// The first that was added within the tolerance, or a new one.
unsigned BlockMesher::vertex(Vector p) {
    const double width = 1000.0 * tolerance_; // of squares: more than one is seldom within reach
    const auto place = [&](double x) { return std::floor(x / width); };
    const auto key = [](double column, double row) { // far squares may share one
        return 31 * std::hash<double>{}(column) + std::hash<double>{}(row);
    };
    const auto added = static_cast<unsigned>(mesh_.vertices.size());
    unsigned first = added;
    const auto look = [&](double column, double row) {
        const auto [begin, end] = vertices_by_square_.equal_range(key(column, row));
        for (auto it = begin; it != end; ++it) {
            const Vector& q = mesh_.vertices[it->second];
            if (std::abs(q.x - p.x) + std::abs(q.y - p.y) < tolerance_)
                first = std::min(first, it->second);
        }
    };
    const double left = place(p.x - tolerance_), right = place(p.x + tolerance_);
    const double low = place(p.y - tolerance_), high = place(p.y + tolerance_);
    look(left, low);
    if (right != left)
        look(right, low);
    if (high != low)
        look(left, high);
    if (right != left && high != low)
        look(right, high);
    if (first == added) {
        mesh_.vertices.push_back(p);
        vertices_by_square_.emplace(key(place(p.x), place(p.y)), added);
    }
    return first;
}

} // namespace listric::fem

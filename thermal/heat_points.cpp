#include "thermal/heat_points.hpp"

#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cmath>

namespace listric::thermal {

using namespace dem;

namespace {

constexpr double widest = 6e3;         // m, of a cell
constexpr double reach_of_point = 2.5; // widths

/// Cells of the rock without discs, quartered until they are as small as their distance asks.
class Layout {
public:
    struct Leaf {
        Point centre;
        double width, height;
    };

    /// @param edge  of the hanging wall: base and right wall
    Layout(std::vector<Point> edge, double finest, double left, double right, double floor,
           const GroundLine& ground)
        : edge_(std::move(edge)), finest_(finest), left_(left), right_(right), floor_(floor),
          ground_(ground) {}

    void quarter(const Leaf& leaf, std::vector<Leaf>& leaves) const {
        const double wanted =
            finest_ + 0.06 * std::max(0.0, distance(leaf.centre) - 0.5 * leaf.width);
        if (std::max(leaf.width, leaf.height) > wanted) {
            for (const double v : {-0.25, 0.25})
                for (const double u : {-0.25, 0.25})
                    quarter({{leaf.centre.x + u * leaf.width, leaf.centre.y + v * leaf.height},
                             0.5 * leaf.width,
                             0.5 * leaf.height},
                            leaves);
            return;
        }
        constexpr double least = 0.3; // of a cell: nearer to base and ground are discs and air
        if (!is_in_hanging_wall(leaf.centre) && distance(leaf.centre) > least * leaf.height &&
            ground_.depth(leaf.centre) > least * leaf.height)
            leaves.push_back(leaf);
    }

private:
    double distance(Point p) const {
        double least = 1e300;
        for (const Point& q : edge_) {
            const double dx = p.x - q.x, dy = p.y - q.y;
            least = std::min(least, dx * dx + dy * dy);
        }
        return std::sqrt(least);
    }

    bool is_in_hanging_wall(Point p) const {
        if (p.x <= left_ || p.x >= right_ || p.y < floor_)
            return false;
        const auto next = std::ranges::find_if(edge_, [&](Point q) { return q.x >= p.x; });
        if (next == edge_.begin() || next == edge_.end())
            return true;
        const Point a = *(next - 1), b = *next;
        const double base = b.x > a.x ? a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x) : a.y;
        return p.y > base;
    }

    std::vector<Point> edge_; // from left to right, then up the wall
    double finest_, left_, right_, floor_;
    const GroundLine& ground_;
};

} // namespace

SectionEnds section_ends(const HeatParameters& p, const HeatSetting& setting) {
    constexpr double beyond = 150e3; // m
    double left = 0.0, right = setting.beside.wall_x;
    if (setting.shear) {
        left = std::min(left, setting.shear->left);
        const double width = std::max(setting.shear->crust_width, setting.shear->mantle_width);
        right = std::max(right, setting.shear->left + width);
    }
    const double share = setting.shear ? setting.shear->share : 1.0;
    return {left - beyond, right + std::max(0.0, share * setting.greatest_extension) + beyond,
            -p.lithosphere};
}

double estimated_points(const SectionEnds& ends, double edge, double mean_radius) {
    const double finest = 3.0 * mean_radius, growth = 0.06;
    // Rows along the edge, each wider than the one before, and what is as wide as can be; the
    // factors are those of lis1, whose cells are smaller than wanted by up to a half.
    return 4.6 * edge / (growth * finest) +
           1.2 * (ends.right - ends.left) * -ends.floor / (widest * widest);
}

HeatPoints::HeatPoints(const HeatParameters& p, const HeatSetting& setting,
                       const Schedule& schedule)
    : Event("heat_points", schedule), p_(p), setting_(setting), ends_(section_ends(p, setting)) {
    for (const char* name :
         {Columns::x, Columns::y, Columns::height, Columns::uplift, Columns::reach})
        memory.add<double>(name, "m", 0.0);
    memory.add<double>(Columns::area, "m^2", 0.0);
    memory.add<double>(Columns::temperature, "degC", 0.0);
    for (const char* name : {Columns::crust, Columns::with_wall})
        memory.add<std::uint8_t>(name, "1", std::uint8_t{0});
}

struct HeatPoints::Point {
    dem::Point place;
    double temperature;
    double height;            ///< of its rock, which stretching thins
    double reach, area = 0.0; ///< the area of one at the start is that of its cell
    bool is_crust = false, goes_with_wall = false;
};

void HeatPoints::add(const State& state, const Point& point) {
    const std::size_t row = memory.rows();
    memory.resize(row + 1);
    memory.get<double>(Columns::x)[row] = point.place.x;
    memory.get<double>(Columns::y)[row] = point.place.y;
    memory.get<double>(Columns::height)[row] = point.height;
    memory.get<double>(Columns::uplift)[row] = uplift_at(state, point.place.x);
    memory.get<double>(Columns::temperature)[row] = point.temperature;
    memory.get<double>(Columns::area)[row] = point.area;
    memory.get<double>(Columns::reach)[row] = point.reach;
    memory.get<std::uint8_t>(Columns::crust)[row] = point.is_crust;
    memory.get<std::uint8_t>(Columns::with_wall)[row] = point.goes_with_wall;
}

namespace {

/// Greatest depth of what discs rest on where nothing deforms, m.
double base_depth(const RigidBase& base) {
    double lowest = 0.0;
    for (const Segment& segment : base_line(base, 0.0))
        lowest = std::min({lowest, segment.start.y, segment.end.y});
    return -lowest;
}

} // namespace

void HeatPoints::lay_out(const State& state, const RigidBase& base) {
    const double finest = 3.0 * state.mean_radius, wall = setting_.beside.wall_x;
    const std::vector<dem::Point> all = base_points(state, base, finest);
    std::vector<dem::Point> edge;
    for (const dem::Point& p : all)
        if (p.x <= wall)
            edge.push_back(p);
    if (edge.empty())
        edge.push_back(all.front());
    const double floor = -base_depth(base), left = edge.front().x;
    const GroundLine ground = ground_line(state, base, setting_.beside);
    // Where the base does not begin at the ground, a wall is on its left.
    const double shore = setting_.beside.left;
    std::vector<dem::Point> left_wall;
    for (double y = edge.front().y + finest; y < shore; y += finest)
        left_wall.push_back({left, y});
    for (double y = floor; y < setting_.beside.right; y += finest)
        edge.push_back({wall, y});
    edge.insert(edge.begin(), left_wall.rbegin(), left_wall.rend());
    const Layout layout(std::move(edge), finest, left, wall, floor, ground);
    const double top = std::max(0.0, ground.highest());
    const auto parts = [](double length) { return std::max(1.0, std::ceil(length / widest)); };
    std::vector<Layout::Leaf> leaves;
    const double columns = parts(ends_.right - ends_.left);
    const double width = (ends_.right - ends_.left) / columns;
    const auto rows = [&](double from, double to) {
        const double count = parts(from - to), height = (from - to) / count;
        for (double row = 0.0; row < count; ++row)
            for (double column = 0.0; column < columns; ++column)
                layout.quarter({{ends_.left + (column + 0.5) * width, from - (row + 0.5) * height},
                                width,
                                height},
                               leaves);
    };
    rows(top, -p_.crust);
    rows(-p_.crust, ends_.floor);
    const Geotherm geotherm(p_);
    for (const Layout::Leaf& leaf : leaves)
        add(state, {.place = leaf.centre,
                    .temperature = geotherm.at(ground.depth(leaf.centre)),
                    .height = leaf.height,
                    .reach = reach_of_point * std::max(leaf.width, leaf.height),
                    .is_crust = leaf.centre.y > -p_.crust,
                    .goes_with_wall = leaf.centre.x > wall && leaf.centre.y > floor});
}

bool HeatPoints::start(State& state, const RigidBase& base) {
    lay_out(state, base);
    return false;
}

void HeatPoints::set_areas(std::span<const PowerCell> cells, std::size_t first) {
    const auto area = memory.get<double>(Columns::area);
    for (std::size_t k = 0; k < area.size(); ++k)
        area[k] = cells[first + k].area;
}

namespace {

/// Where crust and mantle are at an extension, below the detachment.
struct Sheared {
    const PureShear& shear;
    double top, crust; ///< depth of the detachment; thickness of the crust below it, m
    double extension;  ///< of crust and mantle, m

    double stretch(double x, double width) const {
        const bool within = x >= shear.left && x <= shear.left + width + extension;
        return within ? (width + extension) / width : 1.0;
    }
    double moho(double x) const { return top + crust / stretch(x, shear.crust_width); }
};

/// x of material that stretches by the way from one extension to another.
double stretched_x(double x, double left, double width, double before, double now) {
    if (x <= left)
        return x;
    if (x >= left + width + before)
        return x + now - before;
    return left + (x - left) * (width + now) / (width + before);
}

} // namespace

void HeatPoints::move(const State& state, double depth, double before, double now, double way) {
    const auto x = memory.get<double>(Columns::x), y = memory.get<double>(Columns::y);
    const auto uplift = memory.get<double>(Columns::uplift);
    const auto height = memory.get<double>(Columns::height);
    const auto crust = memory.get<std::uint8_t>(Columns::crust);
    const auto with_wall = memory.get<std::uint8_t>(Columns::with_wall);
    for (std::size_t k = 0; k < x.size(); ++k) {
        y[k] -= uplift[k];
        if (with_wall[k]) {
            x[k] += way;
        } else if (setting_.shear && -y[k] > depth) {
            const PureShear& shear = *setting_.shear;
            const double below = std::max(0.0, p_.crust - depth);
            const double first = shear.share * before, last = shear.share * now;
            const Sheared from{shear, depth, below, first}, to{shear, depth, below, last};
            const double width = crust[k] ? shear.crust_width : shear.mantle_width;
            const double start = crust[k] ? depth : from.moho(x[k]);
            const double was = from.stretch(x[k], width);
            const double thickness = (-y[k] - start) * was;
            x[k] = stretched_x(x[k], shear.left, width, first, last);
            const double is = to.stretch(x[k], width);
            y[k] = -((crust[k] ? depth : to.moho(x[k])) + thickness / is);
            height[k] *= was / is;
        }
        uplift[k] = uplift_at(state, x[k]);
        y[k] += uplift[k];
    }
}

/// Makes points of those that have become wide: between them the cells of rows below would reach
/// up.
void HeatPoints::split(const State& state) {
    for (std::size_t k = 0, end = memory.rows(); k < end; ++k) {
        const double height = get<double>(Columns::height)[k];
        const double width = get<double>(Columns::area)[k] / height;
        const double reach = get<double>(Columns::reach)[k];
        const double parts = std::floor(width / (reach / reach_of_point));
        if (parts < 2.0)
            continue;
        const double part = width / parts, left = get<double>(Columns::x)[k] - 0.5 * width;
        const Point whole{.place = {left + 0.5 * part, get<double>(Columns::y)[k]},
                          .temperature = get<double>(Columns::temperature)[k],
                          .height = height,
                          .reach = reach,
                          .area = part * height,
                          .is_crust = get<std::uint8_t>(Columns::crust)[k] != 0,
                          .goes_with_wall = get<std::uint8_t>(Columns::with_wall)[k] != 0};
        memory.get<double>(Columns::x)[k] = whole.place.x;
        memory.get<double>(Columns::area)[k] = whole.area;
        for (double n = 1.0; n < parts; ++n) {
            Point next = whole;
            next.place.x += n * part;
            add(state, next);
        }
    }
}

/// Takes away what has left the section, and what has been eroded beside the hanging wall.
void HeatPoints::drop(const State& state, const RigidBase& base) {
    std::optional<GroundLine> flank;
    if (setting_.beside.cover)
        flank = ground_line(state, base, setting_.beside);
    const double breakaway = flank ? base_points(state, base, widest).front().x : 0.0;
    const auto x = get<double>(Columns::x), y = get<double>(Columns::y);
    const auto crust = get<std::uint8_t>(Columns::crust);
    std::vector<std::int32_t> kept;
    for (std::size_t k = 0; k < x.size(); ++k)
        if (x[k] > ends_.left && x[k] < ends_.right && y[k] > ends_.floor &&
            !(flank && x[k] < breakaway && flank->depth({x[k], y[k]}) <= 0.0))
            kept.push_back(static_cast<std::int32_t>(k));
        else
            carried_out_ += (crust[k] ? crust_capacity : mantle_capacity) *
                            get<double>(Columns::area)[k] * get<double>(Columns::temperature)[k];
    if (kept.size() < x.size())
        memory.reorder(kept);
}

/// Lower end of the rock in columns of a width, m. Stretched points are wider apart than columns,
/// so that neighbours within a reach count.
std::vector<double> HeatPoints::lowest_rock(std::size_t columns, double width,
                                            std::size_t reach) const {
    std::vector<double> own(columns, 0.0), lowest;
    const auto x = get<double>(Columns::x), y = get<double>(Columns::y);
    const auto height = get<double>(Columns::height);
    for (std::size_t k = 0; k < x.size(); ++k) {
        double& least = own[static_cast<std::size_t>(
            std::clamp((x[k] - ends_.left) / width, 0.0, static_cast<double>(columns) - 1.0))];
        least = std::min(least, y[k] - 0.5 * height[k]);
    }
    for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t end = std::min(column + reach + 1, columns);
        lowest.push_back(*std::min_element(
            own.begin() + static_cast<std::ptrdiff_t>(column - std::min(column, reach)),
            own.begin() + static_cast<std::ptrdiff_t>(end)));
    }
    return lowest;
}

/// Adds points where rock has risen from the section's floor by half a cell: as much rock as came,
/// for what is missing would cool without its heat.
/// @param stretch  greatest factor of it
void HeatPoints::fill_floor(const State& state, double stretch) {
    const double columns = std::ceil((ends_.right - ends_.left) / widest);
    const double width = (ends_.right - ends_.left) / columns;
    const std::vector<double> lowest =
        lowest_rock(static_cast<std::size_t>(columns), width,
                    static_cast<std::size_t>(std::ceil(0.5 * stretch)));
    for (std::size_t column = 0; column < lowest.size(); ++column) {
        const double room = lowest[column] - ends_.floor;
        if (room < 0.5 * widest)
            continue;
        const double rows = std::ceil(room / widest), height = room / rows;
        for (double row = 0.0; row < rows; ++row)
            add(state, {.place = {ends_.left + (static_cast<double>(column) + 0.5) * width,
                                  lowest[column] - (row + 0.5) * height},
                        .temperature = p_.base_temperature,
                        .height = height,
                        .reach = reach_of_point * widest,
                        .area = width * height});
        carried_in_ += mantle_capacity * width * room * p_.base_temperature;
    }
}

bool HeatPoints::apply(State& state, const RigidBase& base) {
    carried_in_ = carried_out_ = 0.0;
    const double before = base.motion.position(schedule().due(applied)).m;
    const double now = base.motion.position(schedule().due(applied + 1)).m;
    move(state, base_depth(base), before, now, wall_way(base, now) - wall_way(base, before));
    drop(state, base);
    if (setting_.shear) {
        split(state);
        const double width = std::min(setting_.shear->crust_width, setting_.shear->mantle_width);
        fill_floor(state, (width + setting_.shear->share * std::max(before, now)) / width);
    }
    return false;
}

} // namespace listric::thermal

#include "apps/scene/picks/picks_check.hpp"
#include "apps/scene/coordinates.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/picks/picked_pieces.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace listric {

namespace {

/// A length to a decimetre: shifted coordinates have no more.
std::string metres(double x) { return fmt::format("{}", std::round(10.0 * x) / 10.0); }

struct Pick {
    double x, depth;
    std::size_t row;
};

/// The picks of a file in the order of its rows.
std::vector<Pick> all_picks(const PickedFile& picked) {
    std::vector<Pick> all;
    for (std::size_t l = 0; l < picked.lines.size(); ++l)
        for (std::size_t k = 0; k < picked.rows[l].size(); ++k)
            all.push_back({picked.lines[l].x[k], picked.lines[l].depth[k], picked.rows[l][k]});
    std::ranges::sort(all, {}, &Pick::row);
    return all;
}

double greatest(const std::vector<Pick>& picks, double Pick::*member) {
    double greatest = 0.0;
    for (const Pick& pick : picks)
        greatest = std::max(greatest, std::abs(pick.*member));
    return greatest;
}

/// Where a scene's model is, or may be drawn.
struct PickSpace {
    double left, right, bottom;

    bool holds(double x, double depth) const { return x >= left && x <= right && depth <= bottom; }
};

PickSpace room_of(const Scene& scene, PickKind kind) {
    const double length = scene.hanging_wall.length, thickness = scene.hanging_wall.thickness;
    const double right = length + greatest_extension(scene), margin = 0.01 * length;
    if (kind == PickKind::faults) // which are drawn, in the footwall, too
        return {-length, right + length, 3.0 * thickness};
    return {-margin, right + margin, 1.2 * thickness};
}

/// Message about the picks of one file.
class Check {
public:
    Check(Scene& scene, const PickedFile& picked, PickKind kind, double shift)
        : scene_(scene), picked_(picked), file_(picked.file), picks_(all_picks(picked)),
          kind_(kind), shift_(shift), thickness_(scene.hanging_wall.thickness) {}

    void all() {
        check_sign();
        check_unit();
        check_room();
        if (kind_ == PickKind::horizons)
            check_ages();
        else
            std::ranges::copy(turns_back(picked_), std::back_inserter(scene_.warnings));
    }

private:
    [[noreturn]] void refuse(const Pick& at, const std::string& what) const {
        throw SceneError(fmt::format("{}: {}", csv_place(file_, at.row), what));
    }
    void warn(const Pick& at, const std::string& what) {
        scene_.warnings.push_back(fmt::format("{}: {}", csv_place(file_, at.row), what));
    }

    /// Hills and sediment above the original surface are few and low; elevations are all of them.
    void check_sign() {
        const auto is_above = [&](const Pick& pick) { return pick.depth < -0.02 * thickness_; };
        const auto first = std::ranges::find_if(picks_, is_above);
        if (first == picks_.end())
            return;
        const auto count = std::ranges::count_if(picks_, is_above);
        const bool all =
            std::ranges::none_of(picks_, [](const Pick& pick) { return pick.depth > 0.0; });
        const std::string what =
            fmt::format("depth_m: {} is above the original surface{}; depth is positive down",
                        to_millimetres(first->depth),
                        count == 1 ? "" : fmt::format(", as {} of {} picks", count, picks_.size()));
        if (all && greatest(picks_, &Pick::depth) > 0.1 * thickness_)
            refuse(*first, what);
        warn(*first, what);
    }

    /// Kilometres look like picks in a corner of the model.
    void check_unit() {
        constexpr double tiny = 0.005;
        const double x = greatest(picks_, &Pick::x), depth = greatest(picks_, &Pick::depth);
        const bool near = x < tiny * scene_.hanging_wall.length && picks_.size() > 1;
        const bool shallow = depth > 0.0 && depth < tiny * thickness_;
        const std::string ask =
            fmt::format("picks reach x_m = {} and depth_m = {}, the model {} m and {} m; are they "
                        "in metres?",
                        to_millimetres(x), to_millimetres(depth),
                        metres(scene_.hanging_wall.length), metres(thickness_));
        if (near && shallow)
            refuse(picks_.front(), ask);
        if (near || shallow)
            warn(picks_.front(), ask);
    }

    void check_room() {
        const PickSpace room = room_of(scene_, kind_);
        const auto is_in = [&](const Pick& pick) { return room.holds(pick.x, pick.depth); };
        const auto inside = static_cast<std::size_t>(std::ranges::count_if(picks_, is_in));
        if (2 * inside >= picks_.size())
            return;
        const auto first = std::ranges::find_if_not(picks_, is_in);
        const auto [least, most] = std::ranges::minmax_element(picks_, {}, &Pick::x);
        const auto [high, low] = std::ranges::minmax_element(picks_, {}, &Pick::depth);
        const std::string what = fmt::format(
            "{} picks lie beyond the model: they reach from x_m = {} to {} and depth_m = {} "
            "to {}{}; it has room from {} to {} and down to {}{}",
            inside == 0 ? fmt::format("all {}", picks_.size())
                        : fmt::format("{} of {}", picks_.size() - inside, picks_.size()),
            metres(least->x - shift_), metres(most->x - shift_), to_millimetres(high->depth),
            to_millimetres(low->depth),
            shift_ == 0.0 ? "" : fmt::format(", with a shift of {} m", text(shift_)),
            metres(room.left), metres(room.right), metres(room.bottom), cure(room, *least, *most));
        if (inside == 0)
            refuse(*first, what);
        warn(*first, what);
    }

    std::string cure(const PickSpace& room, const Pick& least, const Pick& most) const {
        const bool good_without =
            room.holds(least.x - shift_, 0.0) && room.holds(most.x - shift_, 0.0);
        if (shift_ != 0.0 && good_without)
            return "; without the shift they lie in it, give observed.shift_x_m = 0.0";
        if (!room.holds(least.x, 0.0) && !room.holds(most.x, 0.0))
            return "; give observed.shift_x_m, which is added to every x_m, so that the breakaway "
                   "is at 0";
        return "; are they in metres?";
    }

    /// Ages in Ma look like the last moments of the rift; older ones have no top.
    void check_ages() {
        const double end = end_age(scene_);
        if (const std::string why = objection_to_ages(picked_, end); !why.empty())
            scene_.warnings.push_back(why);
        std::set<std::string> told;
        for (std::size_t l = 0; l < picked_.lines.size() && end > 0.0; ++l) {
            const auto& age = picked_.lines[l].age;
            const bool is_new = told.insert(picked_.lines[l].name).second; // a horizon of pieces
            if (is_new && age && *age > end * (1.0 + 1e-6))
                scene_.warnings.push_back(fmt::format(
                    "{}: age_a: {} is before the start of extension, which takes {} a; the horizon "
                    "is compared with nothing",
                    csv_place(file_, picked_.rows[l].front()), text(*age), text(std::round(end))));
        }
    }

    Scene& scene_;
    const PickedFile& picked_;
    std::string file_;
    std::vector<Pick> picks_;
    PickKind kind_;
    double shift_, thickness_;
};

} // namespace

void check_picks(Scene& scene, const PickedFile& picked, PickKind kind, double shift) {
    Check(scene, picked, kind, shift).all();
}

std::string objection_to_ages(const PickedFile& picked, double duration) {
    double greatest_age = 0.0;
    std::size_t row = 0;
    for (std::size_t l = 0; l < picked.lines.size(); ++l)
        if (const double age = picked.lines[l].age.value_or(0.0); age > greatest_age) {
            greatest_age = age;
            row = picked.rows[l].front();
        }
    if (greatest_age == 0.0 ||
        greatest_age > 1.000001e-3 * duration) // in ka the rift is a thousandth
        return "";
    return fmt::format("{}: age_a: no age is above {}, extension takes {} a; is it in years before "
                       "the end of extension?",
                       csv_place(picked.file, row), text(greatest_age), text(std::round(duration)));
}

} // namespace listric

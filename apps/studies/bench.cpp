#include "apps/studies/bench.hpp"

#include "apps/scene/toml/json_text.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/memory.hpp"
#include "apps/support/stopwatch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <sstream>

namespace listric {

using namespace dem;

namespace {

struct Packing {
    State state;
    RigidBase base;
    CyclePhysics physics;
};

/// The next line that is neither empty nor a comment.
bool next_record(std::istream& in, std::istringstream& record, int& line_number) {
    for (std::string line; std::getline(in, line);) {
        ++line_number;
        if (line.empty() || line[0] == '#')
            continue;
        record = std::istringstream(line);
        return true;
    }
    return false;
}

Packing make_packing(std::size_t discs, double width, double normal_stiffness,
                     double shear_stiffness, double friction, double gravity) {
    constexpr double disc_price = 1500.0; // bytes, with its contacts and the search's copies
    note_memory_need(disc_price * static_cast<double>(discs));
    Packing p;
    // A contact's stiffness is two discs' in series.
    const Material material{2.0 * normal_stiffness, 2.0 * shear_stiffness, friction, true};
    p.state = empty_state();
    p.state.materials.assign(3, material);
    p.base.material = material;
    constexpr double high = 1e7;
    p.base.surfaces = {{"left", {line({0.0, high}, {0.0, 0.0})}, friction, 0.0, {}},
                       {"floor", {line({0.0, 0.0}, {width, 0.0})}, friction, 0.0, {}},
                       {"right", {line({width, 0.0}, {width, high})}, friction, 0.0, {}}};
    p.physics.gravity = gravity;
    add_discs(p.state, discs);
    return p;
}

Packing read_packing(const std::filesystem::path& path) {
    if (is_pipe_or_device(path))
        throw UsageError(path.string() + ": is no regular file (a pipe or a device)");
    std::ifstream in(path);
    if (!in)
        throw UsageError(path.string() + ": cannot be read");
    std::istringstream record;
    int number = 0;
    std::int64_t n = 0;
    double width = 0, top = 0, normal = 0, shear = 0, friction = 0, density = 0, gravity = 0;
    if (!next_record(in, record, number) ||
        !(record >> n >> width >> top >> normal >> shear >> friction >> density >> gravity) ||
        n <= 0 || n > 100'000'000)
        throw UsageError(fmt::format("{}:{}: the header must be: n width top kn_contact ks_contact "
                                     "mu density gravity",
                                     path.string(), number));
    const auto count = static_cast<std::size_t>(n);
    Packing p = make_packing(count, width, normal, shear, friction, gravity);
    DiscColumns d = disc_columns(p.state);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!next_record(in, record, number) || !(record >> d.x[i] >> d.y[i] >> d.radius[i]) ||
            !(d.radius[i] > 0.0))
            throw UsageError(fmt::format("{}:{}: disc {} of {} must be: x y r, with r > 0",
                                         path.string(), number, i + 1, n));
        d.mass[i] = density * pi * d.radius[i] * d.radius[i];
        sum += d.radius[i];
    }
    if (next_record(in, record, number))
        throw UsageError(
            fmt::format("{}:{}: more than the {} discs of the header", path.string(), number, n));
    p.state.mean_radius = sum / static_cast<double>(n);
    return p;
}

/// Close-packed, about three times as wide as high, as a hanging wall is.
Packing lattice(double discs) {
    constexpr double radius = 93.1;
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(3.125 * discs)));
    const auto rows = static_cast<std::size_t>(std::ceil(discs / static_cast<double>(columns)));
    Packing p = make_packing(columns * rows, 2.0 * radius * (static_cast<double>(columns) + 0.5),
                             8.5e10, 3.19e10, 0.5, 9.81);
    DiscColumns d = disc_columns(p.state);
    for (std::size_t i = 0; i < columns * rows; ++i) {
        const std::size_t row = i / columns;
        d.x[i] = radius * (1.0 + 2.0 * static_cast<double>(i % columns) + (row % 2 ? 1.0 : 0.0));
        d.y[i] = radius * (1.0 + 1.73 * static_cast<double>(row));
        d.radius[i] = radius;
        d.mass[i] = 3042.0 * pi * radius * radius;
    }
    p.state.mean_radius = radius;
    return p;
}

/// Finds contacts and bonds them, if asked for, with bonds that never break, as the peers' decks
/// have them. Returns how many there are.
std::int64_t make_contacts(Packing& p, bool bonded) {
    sort_discs(p.state);
    find_contacts(p.state, p.base);
    const std::vector<bool> touches = touching(p.state);
    const ContactColumns c = contact_columns(p.state);
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k] && bonded) {
            c.bonded[k] = 1;
            c.tensile_strength[k] = c.shear_strength[k] = 1e12f;
        }
    return std::ranges::count(touches, true);
}

} // namespace

std::string bench(const BenchRequest& request) {
    Packing p = request.packing.empty() ? lattice(static_cast<double>(request.discs))
                                        : read_packing(request.packing);
    State& state = p.state;
    state.skin = 0.25 * state.mean_radius;
    state.clock.time_step = 0.005; // s, that of the peers' decks
    const std::int64_t contacts = make_contacts(p, request.bonded);
    Packed packed;
    const Execution execution{request.threads, request.plain ? Cycle::plain : best_cycle(), nullptr,
                              &packed};
    advance(state, p.base, p.physics, 200, execution); // packs, warms caches
    const auto wall = SteadyClock::now();
    const std::clock_t cpu = std::clock();
    advance(state, p.base, p.physics, request.steps, execution);
    const double cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const double wall_seconds = seconds_since(wall);
    const double disc_steps =
        static_cast<double>(state.discs.rows()) * static_cast<double>(request.steps);
    const nlohmann::ordered_json json = {{"discs", state.discs.rows()},
                                         {"contacts", contacts},
                                         {"threads", request.threads},
                                         {"cycle_level", name(execution.cycle)},
                                         {"steps", request.steps},
                                         {"disc_steps_per_s", disc_steps / wall_seconds},
                                         {"disc_steps_per_cpu_s", disc_steps / cpu_seconds}};
    return to_text(json);
}

} // namespace listric

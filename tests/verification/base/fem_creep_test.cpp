// Rock of the footwall that relaxes: plates against the formula, and the condensed base against the
// whole one.

#include "coupling/base_memory.hpp"
#include "coupling/creep.hpp"
#include "coupling/footwall_erosion.hpp"
#include "coupling/independent_solution.hpp"
#include "coupling/interface_loads.hpp"
#include "coupling/lower_crust_thinning.hpp"
#include "dem/columns.hpp"
#include "tests/support.hpp"
#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

namespace listric::fem_creep_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

constexpr double modulus = 28e9, bulk = 70e9 / 1.5; // of 70 GPa and 0.25
constexpr double viscosity = 1e23, relaxation_time = viscosity / modulus;

// ------------------------------------------------------------------------------------ plates

constexpr double thickness = 10e3, restore = 9810.0, pressure = 1e6;

/// Amplitude of a thin plate of Maxwell rock whose bulk is elastic under a wave of pressure that
/// begins at 0, after some relaxation times, m. Its rigidity has 4 mu f (3 K + mu f) / (3 K + 4 mu
/// f) in place of E / (1 - nu^2), with f = z / (1 + z) for z = s times the relaxation time: two
/// poles.
double plate_wave(double wavelength, double times) {
    const double q = 2.0 * std::numbers::pi / wavelength;
    const double c = std::pow(thickness, 3) / 12.0 * std::pow(q, 4);
    const double k3 = 3.0 * bulk, mu = modulus, k = restore;
    // A = (1 + z) (3 K (1 + z) + 4 mu z), B = 4 mu z (3 K (1 + z) + mu z), powers of z upward.
    const std::array<double, 3> a{k3, 2.0 * k3 + 4.0 * mu, k3 + 4.0 * mu};
    const std::array<double, 3> b{0.0, 4.0 * mu * k3, 4.0 * mu * (k3 + mu)};
    std::array<double, 3> d{};
    for (std::size_t n = 0; n < 3; ++n)
        d[n] = k * a[n] + c * b[n];
    const double root = std::sqrt(d[1] * d[1] - 4.0 * d[0] * d[2]);
    double amplitude = 1.0 / k;
    for (const double z : {(-d[1] + root) / (2.0 * d[2]), (-d[1] - root) / (2.0 * d[2])})
        amplitude +=
            (a[0] + z * (a[1] + z * a[2])) / (z * (d[1] + 2.0 * z * d[2])) * std::exp(z * times);
    return pressure * amplitude;
}

/// The same of elements, loaded at once, in steps of `step` relaxation times.
std::vector<double> wave_of_elements(double wavelength, double step, int steps) {
    fem::FootwallRequest request = layer(thickness, 0.0, wavelength, 2500.0);
    request.layers.front().viscosity = viscosity;
    request.base_spring = restore;
    const auto footwall = fem::make_footwall(request);
    const double q = 2.0 * std::numbers::pi / wavelength;
    fem::Load load;
    load.traction = [q](fem::Vector p, fem::Vector, fem::Boundary boundary) {
        return boundary == fem::Boundary::surface ? fem::Vector{0.0, -pressure * std::cos(q * p.x)}
                                                  : fem::Vector{};
    };
    std::vector<double> amplitudes;
    for (int k = 0; k <= steps; ++k) {
        footwall->solve(load);
        // Of its lower side, on the springs; above it the plate is squeezed under a load that
        // stays.
        const fem::Field base = row(footwall->field(), -thickness, 1.0);
        amplitudes.push_back(-base.displacement.front().y);
        load.stress = footwall->stress_left(step * relaxation_time);
        if (k == 0)
            footwall->take_step(step * relaxation_time);
    }
    return amplitudes;
}

TEST(Creep, FormulaOfThePlateIsTheElasticOneAtOnceAndAiryAtLast) {
    const double q = 2.0 * std::numbers::pi / 400e3;
    const double rigidity = 70e9 * std::pow(thickness, 3) / 12.0 / (1.0 - 0.0625);
    EXPECT_NEAR(plate_wave(400e3, 0.0), pressure / (restore + rigidity * std::pow(q, 4)), 1e-9);
    EXPECT_NEAR(plate_wave(400e3, 1e4), pressure / restore, 1e-9);
}

/// Long waves: elements against the thin plate. 3 s.
TEST(Creep, AWideLoadSinksAsOnAPlateOfMaxwell) {
    const std::vector<double> found = wave_of_elements(400e3, 0.25, 40);
    for (const auto& [times, numbers] : {std::pair(0, 98.15), std::pair(1, 100.006),
                                         std::pair(3, 101.381), std::pair(10, 101.926)}) {
        const double exact = plate_wave(400e3, times);
        const double here = found[static_cast<std::size_t>(4 * times)];
        std::printf("400 km, %2d times: %.3f m, plate %.3f m (%+.4f %%)\n", times, here, exact,
                    100.0 * (here / exact - 1.0));
        EXPECT_NEAR(exact, numbers, 5e-3);
        EXPECT_NEAR(here / exact, 1.0, 5e-4);
    }
    const std::vector<double> shorter = wave_of_elements(200e3, 0.25, 40);
    for (const auto& [times, numbers] :
         {std::pair(0, 63.01), std::pair(1, 76.71), std::pair(3, 90.79), std::pair(10, 101.20)}) {
        const double exact = plate_wave(200e3, times);
        const double here = shorter[static_cast<std::size_t>(4 * times)];
        std::printf("200 km, %2d times: %.3f m, plate %.3f m (%+.4f %%)\n", times, here, exact,
                    100.0 * (here / exact - 1.0));
        EXPECT_NEAR(exact, numbers, 2e-2);
        EXPECT_NEAR(here / exact, 1.0, 8e-3); // the thin plate has no shear: 0.7 %
    }
}

/// Against steps eight times as short; and what very long ones do.
TEST(Creep, IsOfSecondOrderInTheStep) {
    const double end = wave_of_elements(100e3, 1.0 / 32.0, 96).back();
    const double coarse = wave_of_elements(100e3, 0.5, 6).back() / end - 1.0;
    const double fine = wave_of_elements(100e3, 0.25, 12).back() / end - 1.0;
    const double airy = pressure / restore;
    const double one = wave_of_elements(100e3, 100.0, 1).back() / airy - 1.0;
    const double ten = wave_of_elements(100e3, 10.0, 10).back() / airy - 1.0;
    std::printf("100 km at 3 times: steps of 0.5: %.2e, of 0.25: %.2e; after 100 times: one step "
                "%.2e, ten %.2e\n",
                coarse, fine, one, ten);
    EXPECT_NEAR(coarse / fine, 4.0, 0.3);
    EXPECT_LT(std::abs(fine), 2e-4);
    EXPECT_NEAR(one, -0.12, 0.02);
    EXPECT_NEAR(ten, -0.011, 0.003);
}

// ------------------------------------------------------------------------- the condensed base

/// A small LIS1 whose upper and lower crust relax, but for the skin.
fem::FootwallRequest relaxing(double upper = 1e23, double lower = 1e21) {
    fem::FootwallRequest request;
    request.detachment = listric_detachment();
    request.left = -80e3;
    request.right = 110e3;
    request.surface_spring = request.detachment_spring = 2700.0 * standard_gravity;
    request.base_spring = 600.0 * standard_gravity;
    request.layers = {{0.0, 70e9, 0.25, 2700.0, upper}, {10e3, 70e9, 0.25, 2700.0, lower}};
    request.skin_thickness = 3e3;
    request.cell_size = 3000.0;
    request.interface_end = 50e3;
    request.fine_until = 60e3;
    return request;
}

constexpr LowerCrustThinningParameters thinning{20e3, 60e3, 15e3};
constexpr double contrast = 600.0 * standard_gravity;

/// A base with its loads and a state whose nodes rest where the loads hold them.
struct Base {
    fem::FootwallRequest request;
    std::unique_ptr<fem::Footwall> footwall;
    ElasticBase base;
    std::vector<std::unique_ptr<Event>> events;
    std::optional<LoadSolution> of_surface; ///< newest solution for surface_loads(knots)
    std::vector<double> knots = surface_knots(40e3, -80e3);
    FootwallLoads loads;
    Creep creep;
    State state;
    RigidBase rigid;

    explicit Base(const fem::FootwallRequest& r, const Calendar& calendar, bool is_loaded = true)
        : request(with_step(r, calendar)), footwall(fem::make_footwall(request)),
          base(condense(*footwall, 2), {}), loads(make_loads(is_loaded)),
          creep(*footwall, base, loads, calendar, Travel(1e4)) {
        base.attach(state);
        creep.begin(state);
        for (const auto& event : events)
            event->begin(state);
    }

    static fem::FootwallRequest with_step(fem::FootwallRequest r, const Calendar& calendar) {
        r.step = creep_schedule(calendar).seconds(1);
        return r;
    }

    /// The lower crust, and the surface's knots, on which nothing acts.
    FootwallLoads make_loads(bool is_loaded) {
        if (!is_loaded)
            return FootwallLoads(*footwall, base, {}, events);
        FootwallLoad surface{surface_loads(knots), [this](const LoadSolution& solution) {
                                 of_surface.emplace(solution);
                                 LoadingEvent effect;
                                 effect.event = std::make_unique<Nothing>();
                                 effect.amounts = [this](const State&) {
                                     return std::vector<double>(knots.size(), 0.0);
                                 };
                                 effect.take_solution = [this](const LoadSolution& anew) {
                                     of_surface.emplace(anew);
                                 };
                                 return effect;
                             }};
        const std::vector<FootwallLoad> effects{
            lower_crust_thinning_load(thinning, contrast, 1200.0, 0.0, 0.001), surface};
        return FootwallLoads(*footwall, base, effects, events);
    }

    struct Nothing : Event {
        Nothing() : Event("nothing", never, dem::Stage::load) {}
        bool apply(State&, const RigidBase&) override { return false; }
    };

    /// Displacement of the nodes at rest under forces on them.
    std::vector<double> rest_under(std::vector<double> forces) {
        add_footwall_loads(state, forces);
        const std::vector<double> u = base.displacement(forces);
        const BaseNodeColumns nodes = base_node_columns(state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            nodes.ux[k] = u[2 * k];
            nodes.uy[k] = u[2 * k + 1];
        }
        return u;
    }
    void relax() {
        creep.apply(state, rigid);
        ++creep.applied;
    }
};

double size(const std::vector<double>& v) {
    double square = 0.0;
    for (const double x : v)
        square += x * x;
    return std::sqrt(square);
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        square += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(square) / size(b);
}

/// A load that grows and wanders, N.
std::vector<double> load_of(std::size_t unknowns, int step) {
    std::vector<double> forces(unknowns, 0.0);
    for (std::size_t k = 0; k < unknowns; ++k)
        forces[k] =
            2e10 * (1.0 + 0.3 * step) *
            std::sin(0.1 * static_cast<double>(k) + 0.2 * static_cast<double>(step * (k % 2)));
    return forces;
}

/// Rifting in steps of 25,000 a, three steps of 1 Ma in a pause, rifting again: three lengths of
/// steps, the first in the pause being longer by what was left before.
const Calendar stepped{0.001, {{Travel(110.0), Travel(25.0), 3, 1e6}}};

/// What discs meet, against solutions of the whole footwall that remember their stress. Round-off
/// of factors: soft rock spreads the stiffness over three orders.
TEST(Creep, TheCondensedBaseMovesAsTheWholeOne) {
    Base condensed(relaxing(), stepped);
    const auto whole = fem::make_footwall(condensed.request);
    const std::size_t unknowns = condensed.base.interface().unknowns();
    std::vector<double> stress;
    double worst = 0.0;
    std::vector<double> lengths;
    for (int step = 0; step < 12; ++step) {
        const double extension = 120.0 * std::min(step, 10); // those of the unit loads
        condensed.state.clock.extension.m = extension;
        condensed.events.front()->apply(condensed.state, condensed.rigid);
        const std::vector<double> forces = load_of(unknowns, step);
        const std::vector<double> u = condensed.rest_under(forces);
        fem::Load load = lower_crust_load(thinning, contrast, extension);
        load.interface = forces;
        load.interface.resize(2 * whole->interface().size(), 0.0);
        load.stress = stress;
        whole->solve(load);
        std::vector<double> exact = whole->interface_displacement();
        exact.resize(unknowns);
        worst = std::max(worst, difference(u, exact));
        const double next = condensed.creep.schedule().seconds(condensed.creep.applied + 2);
        lengths.push_back(next);
        stress = whole->stress_left(next);
        whole->take_step(next);
        condensed.relax();
    }
    std::printf("condensed against whole: %.1e\n", worst);
    EXPECT_LT(worst, 1e-10);
    EXPECT_NEAR(lengths.front() / seconds_per_year, 25e3, 1.0);
    EXPECT_EQ(std::ranges::count_if(lengths, [](double s) { return s > 9e5 * seconds_per_year; }),
              3);
}

/// When the step changes, modes hold the nodes where they are.
TEST(Creep, TheNodesDoNotJumpWithTheModes) {
    Base b(relaxing(), stepped);
    for (int step = 0; step < 5; ++step) { // the fifth begins the pause
        b.rest_under(load_of(b.base.interface().unknowns(), step));
        const std::vector<double> before(base_node_columns(b.state).uy.begin(),
                                         base_node_columns(b.state).uy.end());
        const double length = *creep_step(b.state);
        b.relax();
        EXPECT_EQ(*creep_step(b.state) != length, step >= 3) << step;
        for (std::size_t k = 0; k < before.size(); ++k)
            EXPECT_EQ(base_node_columns(b.state).uy[k], before[k]);
        if (*creep_step(b.state) == length)
            continue;
        std::vector<double> of_modes(b.base.interface().unknowns());
        add_rows(b.base.modes().by_mode, mode_columns(b.state).displacement, of_modes);
        for (std::size_t k = 0; k < before.size(); ++k)
            EXPECT_NEAR(of_modes[2 * k + 1], before[k], 1e-9 * std::abs(before[k]) + 1e-9);
    }
}

/// Uplift of the flank by what discs, lower crust and relaxing stress do, by Betti's theorem,
/// against the field.
TEST(Creep, TheSurfaceRisesWithTheStressThatIsLeft) {
    Base b(relaxing(), stepped);
    for (int step = 0; step < 7; ++step) {
        b.state.clock.extension.m = 120.0 * step;
        b.events.front()->apply(b.state, b.rigid);
        b.rest_under(load_of(b.base.interface().unknowns(), step));
        b.relax();
    }
    const SurfaceResponse surface(b.knots, b.of_surface->interface, b.of_surface->sums,
                                  b.of_surface->work);
    const std::vector<double> found = surface_uplift(surface, *b.of_surface)(b.state);
    fem::Load load = b.loads.elsewhere(b.state);
    load.interface = b.base.interface_forces(b.state);
    load.interface.resize(2 * b.footwall->interface().size(), 0.0);
    b.footwall->solve(load);
    const std::vector<double> work = b.footwall->work();
    const std::size_t crust = work.size() - b.knots.size();
    const std::vector<double> of_knots(work.begin() + static_cast<std::ptrdiff_t>(crust),
                                       work.end());
    const std::vector<double> exact = surface.uplift_by_work(of_knots);
    std::printf("uplift of the flank: %.3f m\n", exact.back());
    EXPECT_LT(difference(found, exact), 1e-9);
    EXPECT_GT(size(creep_stress(b.state)), 0.0);
}

/// On elements half as large, with the stress of the run's.
TEST(Creep, AFinerMeshHasTheSameBase) {
    Base b(relaxing(), stepped, false);
    std::vector<double> forces;
    for (int step = 0; step < 12; ++step) {
        forces.assign(b.base.interface().unknowns(), 0.0);
        for (std::size_t k = 20; k < 30; ++k)
            forces[2 * k + 1] = 5e10; // upward, over 15 km
        b.rest_under(forces);
        b.relax();
    }
    const std::vector<double> u = b.rest_under(forces);
    fem::FootwallRequest request = b.request;
    request.step = *creep_step(b.state);
    const auto solve = [&](const fem::Load& other) {
        return solve_independently(request, b.base.interface(), forces, other,
                                   b.footwall->stress_points())
            .displacement;
    };
    const double with = relative_difference(u, solve(b.loads.elsewhere(b.state)));
    fem::Load forgotten = b.loads.elsewhere(b.state);
    std::ranges::fill(forgotten.stress, 0.0);
    const double without = relative_difference(u, solve(forgotten));
    std::printf("finer mesh: %.4f, without the stress %.3f\n", with, without);
    EXPECT_LT(with, 0.02);
    EXPECT_GT(without, 5.0 * with);
}

TEST(Creep, WithoutViscosityNothingRelaxes) {
    fem::FootwallRequest request = relaxing();
    for (fem::Layer& rock : request.layers)
        rock.viscosity.reset();
    const auto elastic = fem::make_footwall(request);
    EXPECT_TRUE(elastic->stress_points().empty());
    const std::vector<double> compliance = elastic->compliance();
    elastic->take_step(1e12);
    EXPECT_EQ(elastic->compliance(), compliance);

    // And with one that no run sees the end of.
    Base b(relaxing(1e35, 1e35), stepped, false);
    const std::vector<double> forces = load_of(b.base.interface().unknowns(), 1);
    const std::vector<double> at_once = b.rest_under(forces);
    for (int step = 0; step < 10; ++step) {
        b.rest_under(forces);
        b.relax();
    }
    EXPECT_LT(difference(b.rest_under(forces), at_once), 1e-8); // 3 Ma of 1e12: 1e-9 or so
}

/// A lower crust of a year below rock of a hundred million: in the end as if it had no shear
/// modulus.
TEST(Creep, RocksOfEightOrdersOfMagnitudeLieInOneBody) {
    Base b(relaxing(1e26, 1e18), stepped, false);
    std::vector<double> forces(b.base.interface().unknowns(), 0.0);
    for (std::size_t k = 20; k < 30; ++k)
        forces[2 * k + 1] = 5e10;
    std::vector<double> u;
    for (int step = 0; step < 12; ++step) {
        u = b.rest_under(forces);
        for (const double x : u)
            ASSERT_TRUE(std::isfinite(x) && std::abs(x) < 1e4) << step;
        b.relax();
    }
    fem::FootwallRequest soft = relaxing();
    for (fem::Layer& rock : soft.layers)
        rock.viscosity.reset();
    soft.elastic_thickness = 10e3;
    soft.relaxation = 1e4;
    const auto limit = fem::make_footwall(soft);
    fem::Load load;
    load.interface = forces;
    load.interface.resize(2 * limit->interface().size(), 0.0);
    limit->solve(load);
    std::vector<double> exact = limit->interface_displacement();
    exact.resize(u.size());
    std::printf("1e26 over 1e18 Pa s: %.1e from no shear modulus\n", difference(u, exact));
    EXPECT_LT(difference(u, exact), 0.02); // 1e26: 3 % of its stress has gone in 3 Ma
}

} // namespace

} // namespace listric::fem_creep_test

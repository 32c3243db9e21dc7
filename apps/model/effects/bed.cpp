#include "apps/scene/parameters/sediment_bed.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/words/spelling.hpp"
#include "fluid/pore_law.hpp"
#include "fluid/pore_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace listric::effects::bed {

namespace {

using B = SedimentBed;
using fluid::PermeabilityLaw;

std::vector<Parameter> parameters() {
    constexpr std::string_view of_file = "Stands in place of what the material's file has.";
    return {
        {"name", at<&B::name>, "", ranges::any, "", "name in `explain` and messages",
         "Changes no run."},
        {"until_a", at<&B::until>, "a", between(1, 1e10), "",
         "age of the run at which the next bed begins; the last bed has none",
         "Raising it thickens the bed."},
        {"surface_porosity", at<&B::surface_porosity>, "", between(0.01, 0.9), "Phi_ini",
         "porosity as laid down", of_file},
        {"coefficient_per_km",
         at<&B::coefficient>,
         "1/km",
         {.above = 0, .to = 10},
         "c",
         "decay of porosity with depth",
         of_file,
         {},
         1e3},
        {"permeability_m2", at<&B::permeability>, "m2", between(1e-22, 1e-12), "",
         "permeability across bedding at a porosity of 0.2; of law constant at any", of_file},
        {"specific_surface_per_m", at<&B::specific_surface>, "1/m", between(1e3, 1e10), "S",
         "surface of the grains over their volume, in place of permeability_m2: Phi^3 / (5 S^2 (1 "
         "- "
         "Phi)^2), Kozeny and Carman",
         "Doubling it lowers permeability to a quarter.", between(1e5, 1e8)},
        {"permeability_law", one_of<&B::law>({"kozeny_carman", "constant", "mudstone"}), "",
         ranges::any, "", "how permeability falls with porosity; default: as in all sediment",
         of_file},
        {"clay_fraction", at<&B::clay_fraction>, "", between(0.12, 0.97), "",
         "clay of law mudstone: mass below 2 micrometres, over all", of_file},
        {"permeability_ratio", at<&B::ratio>, "", between(0.1, 1e8), "",
         "permeability along bedding over that across; default: that of all sediment",
         "Raising it lets the bed hand water up its dip. Above 1e4 it leaks across all the same, "
         "for dips scatter from disc to disc."},
        {"fault_along", at<&B::fault_along>, "", between(1e-6, 1e6), "",
         "permeability between weakened discs of it over that of sound ones; default: that of all "
         "sediment",
         "Raising it makes conduits."},
        {"fault_across", at<&B::fault_across>, "", between(1e-6, 1e6), "",
         "permeability between a weakened and a sound disc of it; default: that of all sediment",
         "Lowering it makes seals, as smeared clay does."},
        {"laminae_share",
         at<&B::laminae>,
         "",
         {.above = 0, .below = 1},
         "",
         "share of the sediment that is thin beds of the material `laminae`",
         "Raising it from 0 lowers permeability across bedding first, then that along."},
    };
}

B& item_of(Scene& scene, std::size_t item) { return (*scene.find<SedimentBeds>())[item]; }

std::string path_of(std::size_t item, std::string_view key) {
    return fmt::format("bed[{}].{}", item, key);
}

template <class T> void take(std::optional<T>& into, T value) {
    if (!into)
        into = value;
}

SedimentPores pores_in(const std::string& file, const std::string& path, const Refuse& refuse) {
    const RockMaterial rock = read_material(file);
    if (!rock.pores)
        refuse(path, fmt::format("{} has no [pores], which say how it compacts and lets water "
                                 "through; mud, silt and sand have some",
                                 rock.name));
    return *rock.pores;
}

void take_material(Scene& scene, std::size_t item, const std::string& file, const Refuse& refuse) {
    B& bed = item_of(scene, item);
    const SedimentPores pores = pores_in(file, path_of(item, "material"), refuse);
    take(bed.surface_porosity, pores.surface_porosity);
    take(bed.coefficient, pores.coefficient);
    const bool is_mudstone = bed.law.value_or(pores.permeability.law) == PermeabilityLaw::mudstone;
    take(bed.law, pores.permeability.law);
    if (is_mudstone)
        take(bed.clay_fraction, pores.permeability.clay_fraction);
    else if (!bed.specific_surface)
        take(bed.permeability, pores.permeability.at_fifth);
}

/// Kozeny and Carman at a porosity of 0.2.
double of_surface(double specific_surface) {
    constexpr double fifth = 0.2;
    return fifth * fifth * fifth /
           (5.0 * specific_surface * specific_surface * (1.0 - fifth) * (1.0 - fifth));
}

fluid::SedimentFlow flow_in(const B& bed, fluid::SedimentFlow flow) {
    flow.permeability.law = bed.law.value_or(flow.permeability.law);
    flow.permeability.at_fifth = bed.permeability.value_or(flow.permeability.at_fifth);
    if (bed.specific_surface)
        flow.permeability.at_fifth = of_surface(*bed.specific_surface);
    flow.permeability.clay_fraction = bed.clay_fraction.value_or(flow.permeability.clay_fraction);
    flow.ratio = bed.ratio.value_or(flow.ratio);
    flow.faults.along = bed.fault_along.value_or(flow.faults.along);
    flow.faults.across = bed.fault_across.value_or(flow.faults.across);
    return flow;
}

/// Thin beds of two kinds: permeabilities are in series across and side by side along, pores are
/// those of both. Done at once, so that what a run writes has the numbers.
void take_laminae(Scene& scene, std::size_t item, const std::string& file, const Refuse& refuse) {
    B& bed = item_of(scene, item);
    const std::string path = path_of(item, "laminae");
    const SedimentPores thin = pores_in(file, path, refuse);
    if (!bed.laminae)
        refuse(path, "needs laminae_share, between 0 and 1");
    if (!bed.surface_porosity || !bed.coefficient || !(bed.permeability || bed.specific_surface))
        refuse(path, "lie in a material of the bed's own; name it, material = \"sand\"");
    const double share = *std::exchange(bed.laminae, std::nullopt), rest = 1.0 - share;
    const double ours = flow_in(bed, {}).permeability.at_fifth;
    const double theirs = thin.permeability.at_fifth;
    if (bed.law != thin.permeability.law || *bed.law == PermeabilityLaw::mudstone)
        refuse(path, "have another law of permeability than the bed; give both kozeny_carman, or "
                     "both constant");
    bed.specific_surface.reset();
    bed.permeability = 1.0 / (rest / ours + share / theirs);
    bed.ratio = bed.ratio.value_or(1.0) * (rest * ours + share * theirs) / *bed.permeability;
    bed.surface_porosity = rest * *bed.surface_porosity + share * thin.surface_porosity;
    bed.coefficient = rest * *bed.coefficient + share * thin.coefficient;
}

std::string name_of(const SedimentBeds& beds, std::size_t k) {
    return beds[k].name.empty() ? fmt::format("bed {}", k) : beds[k].name;
}

/// Refuses ages that cross or leave a gap.
void check_ages(const Scene& scene, const Refuse& refuse) {
    const SedimentBeds& beds = *scene.find<SedimentBeds>();
    const ModelParts parts = make_parts(scene);
    const double strata = parts.sediment->deposition_interval;
    double before = 0.0;
    for (std::size_t k = 0; k < beds.size(); ++k) {
        const bool is_last = k + 1 == beds.size();
        const std::string path = path_of(k, "until_a");
        if (is_last && !beds[k].until)
            return;
        if (!beds[k].until)
            refuse(path, fmt::format("is missing, and {} follows: what is laid down between them "
                                     "would be of no kind; only the last bed goes without",
                                     name_of(beds, k + 1)));
        if (is_last)
            refuse(path, fmt::format("is {} of the last bed: what is laid down later would be of "
                                     "no kind; leave it out, or add a bed",
                                     text(*beds[k].until)));
        if (*beds[k].until <= before)
            refuse(path, fmt::format("is {}, allowed: above {}, where the bed begins; beds come "
                                     "from the oldest on",
                                     text(*beds[k].until), text(before)));
        if (std::floor(*beds[k].until / strata + 1e-9) <= std::floor(before / strata + 1e-9))
            refuse(path, fmt::format("is {}: no stratum ends between {} and that; strata come "
                                     "every {} a, a bed needs at least one",
                                     text(*beds[k].until), text(before), text(strata)));
        before = *beds[k].until;
    }
}

void check(const Scene& scene, const Refuse& refuse) {
    const SedimentBeds& beds = *scene.find<SedimentBeds>();
    const fluid::SedimentFlow usual = make_parts(scene).sediment->flow;
    for (std::size_t k = 0; k < beds.size(); ++k) {
        const B& bed = beds[k];
        const bool is_mudstone =
            bed.law.value_or(usual.permeability.law) == PermeabilityLaw::mudstone;
        if (bed.laminae)
            refuse(path_of(k, "laminae_share"), "is a share of nothing; give laminae, the material "
                                                "of the thin beds, or leave it out");
        if (bed.permeability && bed.specific_surface)
            refuse(path_of(k, "specific_surface_per_m"),
                   "beside permeability_m2: two laws of one permeability; give one of them");
        if (is_mudstone && (bed.permeability || bed.specific_surface))
            refuse(path_of(k, bed.permeability ? "permeability_m2" : "specific_surface_per_m"),
                   "beside law mudstone, which has permeability from clay_fraction; leave it out, "
                   "or give permeability_law = \"kozeny_carman\"");
        if (!is_mudstone && bed.clay_fraction)
            refuse(path_of(k, "clay_fraction"),
                   "is of law mudstone alone; leave it out, or give permeability_law = "
                   "\"mudstone\"");
        if (bed.specific_surface &&
            bed.law.value_or(usual.permeability.law) != PermeabilityLaw::kozeny_carman)
            refuse(path_of(k, "specific_surface_per_m"),
                   "is of law kozeny_carman alone; leave it out, or give that law");
    }
    check_ages(scene, refuse);
}

void contribute(const Scene& scene, ModelParts& parts) {
    SedimentFacts& sediment = *parts.sediment;
    sediment.beds.deposition = {sediment.deposition_interval, make_calendar(scene),
                                dem::InSteps::once};
    for (const B& bed : *scene.find<SedimentBeds>()) {
        sediment.beds.list.push_back({bed.until.value_or(std::numeric_limits<double>::infinity()),
                                      {bed.surface_porosity.value_or(sediment.surface_porosity),
                                       bed.coefficient.value_or(*sediment.porosity_decay)}});
        sediment.flows.push_back(flow_in(bed, sediment.flow));
    }
}

std::string warning(const Scene& scene) {
    const SedimentBeds& beds = *scene.find<SedimentBeds>();
    const std::vector<fluid::SedimentFlow> flows = make_parts(scene).sediment->flows;
    for (std::size_t k = 0; k < flows.size(); ++k)
        if (flows[k].ratio > fluid::greatest_tight_ratio)
            return fmt::format(
                "bed: {} conducts {:.3g} times as much along as across; dips scatter "
                "from disc to disc, so that above {:g} it leaks across by more than "
                "a quarter",
                name_of(beds, k), flows[k].ratio, fluid::greatest_tight_ratio);
    return "";
}

/// What a bed becomes below a floor that sinks by nine tenths of the extension, and a warning where
/// discs are too large for it.
std::string explain(const Scene& scene, EffectList) {
    const SedimentBeds& beds = *scene.find<SedimentBeds>();
    const ModelParts parts = make_parts(scene);
    const dem::Calendar calendar = make_calendar(scene);
    const double end = calendar.age(dem::Travel(greatest_extension(scene)));
    std::string lines = "beds of sediment\n";
    double before = 0.0;
    for (std::size_t k = 0; k < beds.size(); ++k) {
        const double until = std::min(beds[k].until.value_or(end), end);
        const dem::PorosityLaw& pores = parts.sediment->beds.list[k].pores;
        const fluid::SedimentFlow& flow = parts.sediment->flows[k];
        const double thick = 0.9 * scene.extension.rate * std::max(0.0, until - before);
        const double discs = thick / (2.0 * scene.hanging_wall.mean_radius);
        lines += fmt::format(
            "  {}, {:.4g} to {:.4g} ka: porosity {:.2f} exp(-{:.2f} z/km), {:.2g} m2 at 0.2, "
            "{:.3g} "
            "times as much along; some {:.0f} m, {:.1f} discs thick as laid down{}\n",
            name_of(beds, k), before / 1e3, until / 1e3, pores.surface_porosity,
            1e3 * pores.coefficient, fluid::permeability(flow.permeability, 0.2), flow.ratio, thick,
            discs, discs < 2.0 ? ": thinner than two discs, it leaks" : "");
        before = until;
    }
    return lines;
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "bed",
        .doc = "sediment of a kind of its own, laid down after the bed before it: its pores, and "
               "how water flows through them",
        .defaults = make_defaults<SedimentBeds>,
        .address = address_of<SedimentBeds>,
        .parameters = parameters(),
        .items = items_of<B>,
        .files = {{"material", "material, by name or path, whose [pores] the bed has",
                   "Sets porosity, its decay and permeability at once; mud, silt and sand have "
                   "them.",
                   nullptr, take_material, FileParameter::material},
                  {"laminae", "material of thin beds in it, by name or path; needs laminae_share",
                   "Lowers permeability across bedding.", nullptr, take_laminae,
                   FileParameter::material}},
        .needs = {"pore_fluid"},
        .check = check,
        .warning = warning,
        .contribute = contribute,
        .explain = explain,
    };
    return effect;
}

} // namespace listric::effects::bed

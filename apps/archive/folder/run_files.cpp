#include "apps/archive/folder/run_files.hpp"

#include "apps/support/words/moment_names.hpp"
#include "apps/support/words/option_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>

namespace listric::archive {

namespace fs = std::filesystem;

namespace {

/// When a run writes a file that is not of a moment.
enum class Written { always, with_base, with_series, after_failures };

/// A file of a run's folder whose name others might give theirs, and what only a run's has.
struct TopFile {
    std::string_view name, mark;
    Written written;
};

constexpr TopFile top_files[] = {
    {"scene.toml", "# All parameters in force.", Written::always},
    {"summary.json", "\"finished\"", Written::always},
    {"history.csv", "extension_m,cycle,", Written::always},
    {"status.json", "\"phase\"", Written::always},
    {"report.html", "<title>Listric</title>", Written::always},
    {"log.txt", "listric ", Written::always},
    {"failure.json", "\"exit_code\"", Written::after_failures},
    {"paraview.pvd", "file=\"paraview/", Written::with_series},
    {"paraview.py", "Opens the run in whose folder it lies", Written::with_series},
    {"deflection.csv", "x_m,deflection_m,", Written::with_base},
    {"base.csv", "extension_m,x_m,y_m,ux_m,uy_m", Written::with_base},
    {"footwall.csv", "extension_m,x_m,uplift_m", Written::with_base},
    {"footwall.pvd", "footwall", Written::with_base},
    {"footwall.vtu", "<VTKFile", Written::with_base},
};

constexpr std::string_view section_pictures[] = {
    "strata",   "bonds",    "behaviour",  "strain",  "sediment",      "kinematics", "inversion",
    "overview", "underlay", "experiment", "seismic", "seismic-depth", "well"};
constexpr std::string_view layer_picture = "layer-"; ///< and the name of an effect's layer
constexpr std::string_view base_pictures[] = {"base", "footwall", "flexure"};
constexpr std::string_view picture_endings[] = {".png", ".pdf", ".svg"};
constexpr std::string_view film_endings[] = {".mp4", ".gif", ".webp"};
constexpr std::string_view line_exports[] = {"horizons", "faults", "surfaces",
                                             "base",     "layers", "displacement"};
constexpr std::string_view well_exports[] = {"well", "burial"};
constexpr std::string_view line_endings[] = {".csv", ".geojson", ".gmt",  ".gpkg",
                                             ".dxf", ".pl",      ".gempy"};
constexpr std::string_view seismic_endings[] = {".segy", "-image.npy", "-faults.npy", "-strain.npy",
                                                ".json"};
constexpr std::string_view series_parts[] = {"discs", "contacts", "base"};

/// Middle of a text between a beginning and an end; none if it lacks them.
std::optional<std::string_view> between(std::string_view text, std::string_view begin,
                                        std::string_view end) {
    if (text.size() < begin.size() + end.size() || !text.starts_with(begin) || !text.ends_with(end))
        return std::nullopt;
    return text.substr(begin.size(), text.size() - begin.size() - end.size());
}

bool is_moment(std::optional<std::string_view> metres) { return metres && extension_of(*metres); }

bool is_series_file(std::string_view name) {
    return is_moment(between(name, "footwall-", "m.vtu")) ||
           std::ranges::any_of(series_parts, [&](std::string_view part) {
               return is_moment(between(name, fmt::format("{}-", part), "m.vtp"));
           });
}

/// Text between the moment of KIND-extension-MOMENTm and the ending; none: that is no such name.
std::optional<std::string_view> options_of(std::string_view name, std::string_view kind,
                                           std::string_view ending) {
    const auto rest = between(name, fmt::format("{}-extension-", kind), ending);
    const std::size_t m = rest ? rest->find('m') : std::string_view::npos;
    if (m == std::string_view::npos || !is_moment(rest->substr(0, m)))
        return std::nullopt;
    return rest->substr(m + 1);
}

/// Whether that is of a seismic image: -depth-40Hz-lateral-500m, each of which may be missing.
bool is_of_seismic(std::string_view options) {
    constexpr std::string_view depth = "-depth";
    if (options.starts_with(depth))
        options.remove_prefix(depth.size());
    take_number(options, "-", "Hz");
    take_number(options, "-lateral-", "m");
    return options.empty();
}

bool is_export(std::string_view name) {
    const auto has = [&](std::string_view kind, std::span<const std::string_view> endings,
                         bool (*are_known)(std::string_view options)) {
        return std::ranges::any_of(endings, [&](std::string_view ending) {
            const auto options = options_of(name, kind, ending);
            return options && are_known(*options);
        });
    };
    const auto none = [](std::string_view options) { return options.empty(); };
    const auto of_well = [](std::string_view options) {
        take_listed(options, "-x-", "m");
        return options.empty();
    };
    constexpr std::string_view csv[] = {".csv"};
    std::string_view moments = name;
    return name == "discs.gsd" ||
           (take_listed(moments, "discs-extension-", "m.gsd") && moments.empty()) ||
           has("discs", csv, none) || has("seismic", seismic_endings, is_of_seismic) ||
           std::ranges::any_of(line_exports,
                               [&](auto kind) { return has(kind, line_endings, none); }) ||
           std::ranges::any_of(well_exports,
                               [&](auto kind) { return has(kind, line_endings, of_well); });
}

/// Whether a text is names of panels with a dash after each: "strata-strain-".
bool is_panels(std::string_view text) {
    if (text.empty())
        return true;
    if (text.starts_with(layer_picture)) {
        const std::size_t dash = text.find('-', layer_picture.size());
        return dash != text.npos && is_panels(text.substr(dash + 1));
    }
    return std::ranges::any_of(section_pictures, [&](std::string_view kind) {
        return text.starts_with(fmt::format("{}-", kind)) &&
               is_panels(text.substr(kind.size() + 1));
    });
}

/// KIND-KILOMETRESkm and what stands behind it.
struct SectionName {
    std::string_view kind, options;
};

std::optional<SectionName> section_name(std::string_view stem) {
    for (std::size_t km = stem.find("km"); km != stem.npos; km = stem.find("km", km + 1)) {
        const std::size_t dash = stem.rfind('-', km);
        if (dash != stem.npos && is_kilometres(stem.substr(dash + 1, km - dash - 1)))
            return SectionName{stem.substr(0, dash), stem.substr(km + 2)};
    }
    return std::nullopt;
}

/// Whether that is -plain-200dpi, each of which may be missing.
bool is_of_look(std::string_view options) {
    constexpr std::string_view plain = "-plain";
    if (options.starts_with(plain))
        options.remove_prefix(plain.size());
    take_number(options, "-", "dpi");
    return options.empty();
}

/// Whether that begins with the picture that a section is drawn over: -section-1a2b3c4d.
bool is_of_underlay(std::string_view options) {
    for (std::size_t end = options.size(); end > 1; --end)
        if (is_named_after(options.substr(1, end - 1)) && is_of_look(options.substr(end)))
            return options.front() == '-';
    return false;
}

/// Whether a file is the picture of a section at a moment: strata-5.0km.png, with options, for
/// print strata-strain-5.0km-85mm.png, or a film.
bool is_section_picture(std::string_view name) {
    const bool is_film = std::ranges::any_of(film_endings, [&](std::string_view ending) {
        const auto km = between(name, "animation-", fmt::format("km{}", ending));
        return km && is_kilometres(*km);
    });
    return is_film || std::ranges::any_of(picture_endings, [&](std::string_view ending) {
               const auto stem = between(name, "", ending);
               const auto section = stem ? section_name(*stem) : std::nullopt;
               if (!section)
                   return false;
               auto [kind, options] = *section;
               if (take_number(options, "-", "mm"))
                   return is_panels(fmt::format("{}-", kind)) && is_of_look(options);
               if (kind == "well")
                   take_listed(options, "-x-", "m");
               const bool is_known =
                   kind.starts_with(layer_picture) ||
                   std::ranges::find(section_pictures, kind) != std::end(section_pictures);
               return is_known &&
                      (is_of_look(options) || (kind == "underlay" && is_of_underlay(options)));
           });
}

bool is_base_picture(std::string_view name) {
    return std::ranges::any_of(base_pictures, [&](std::string_view kind) {
        return std::ranges::any_of(picture_endings, [&](std::string_view ending) {
            return name == fmt::format("{}{}", kind, ending);
        });
    });
}

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// A file or the link to one; never a folder.
bool is_own_top_file(const fs::path& path, const TopFile& top) {
    return is_file(path) && holds(path, top.mark, 4096);
}

/// Files in a folder, or links to such, whose names are as asked for.
template <class Ours>
void collect(const fs::path& folder, Ours&& ours, std::vector<fs::path>& found) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (ours(name) && is_file(entry.path()))
            found.push_back(entry.path());
    }
}

/// NAME of NAME.PID.part, as write_bytes makes it.
std::string_view written_in_part(std::string_view name) {
    if (!name.ends_with(".part"))
        return {};
    name.remove_suffix(5);
    const std::size_t dot = name.rfind('.');
    const bool is_numbered =
        dot != name.npos && dot + 1 < name.size() &&
        std::ranges::all_of(name.substr(dot + 1), [](char c) { return c >= '0' && c <= '9'; });
    return is_numbered ? name.substr(0, dot) : std::string_view();
}

bool is_snapshot_name(std::string_view name) { return moment_of_snapshot(name).has_value(); }

bool is_top_name(std::string_view name) {
    return std::ranges::find(top_files, name, &TopFile::name) != std::end(top_files);
}

/// NAME of .NAME-PID.tmp, as the drawing scripts make it, is a picture's without its ending.
bool is_half_drawn(std::string_view name) {
    const auto stem = between(name, ".", ".tmp");
    const std::size_t dash = stem ? stem->rfind('-') : std::string_view::npos;
    if (dash == std::string_view::npos || dash + 1 == stem->size() ||
        !std::ranges::all_of(stem->substr(dash + 1), [](char c) { return c >= '0' && c <= '9'; }))
        return false;
    const std::string picture = fmt::format("{}.png", stem->substr(0, dash));
    return is_section_picture(picture) || is_base_picture(picture);
}

} // namespace

bool holds(const fs::path& file, std::string_view mark, std::size_t bytes) {
    std::ifstream in(file, std::ios::binary);
    std::string text(bytes, '\0');
    in.read(text.data(), static_cast<std::streamsize>(bytes));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text.empty() || text.find(mark) != text.npos;
}

std::optional<std::string> moment_of_snapshot(std::string_view name) {
    const auto moment = between(name, "extension-", "m.h5");
    return is_moment(moment) ? std::optional<std::string>(*moment) : std::nullopt;
}

std::string snapshot_name(std::string_view moment) {
    return fmt::format("extension-{}m.h5", moment);
}

std::vector<fs::path> run_files(const fs::path& output) {
    std::vector<fs::path> files;
    collect(output / "snapshots", is_snapshot_name, files);
    collect(output / "paraview", is_series_file, files);
    collect(output / "figures", is_section_picture, files);
    collect(output / "export", is_export, files);
    collect(
        output / "figures",
        [&](std::string_view name) {
            return is_base_picture(name) && holds(output / "figures" / name, "Listric ", 1 << 24);
        },
        files);
    collect(
        output / "figures",
        [&](std::string_view name) {
            return (name == "caption.txt" || name == "origin.txt") &&
                   holds(output / "figures" / name, "Listric ", 1 << 12);
        },
        files);
    for (const TopFile& top : top_files)
        if (is_own_top_file(output / top.name, top))
            files.push_back(output / top.name);
    return files;
}

std::vector<fs::path> remains(const fs::path& output) {
    std::vector<fs::path> found;
    const auto parts = [&](const fs::path& folder, auto&& ours) {
        collect(
            folder, [&](std::string_view name) { return ours(written_in_part(name)); }, found);
    };
    parts(output, is_top_name);
    parts(output, [](std::string_view name) { return name == write_test; });
    parts(output / "snapshots", is_snapshot_name);
    parts(output / "paraview", is_series_file);
    parts(output / "export", is_export);
    collect(output / "figures", is_half_drawn, found);
    std::error_code error;
    for (const char* folder : {"figures", "export"})
        for (const auto& entry : fs::directory_iterator(output / folder, error))
            if (entry.path().filename().string().starts_with(".listric-") &&
                entry.symlink_status(error).type() == fs::file_type::directory)
                found.push_back(entry.path());
    return found;
}

std::vector<fs::path> files_of_moment(const fs::path& output, const std::string& metres,
                                      const std::string& kilometres) {
    std::vector<fs::path> files;
    for (const std::string_view part : series_parts)
        files.push_back(output / "paraview" / fmt::format("{}-{}m.vtp", part, metres));
    files.push_back(output / "paraview" / fmt::format("footwall-{}m.vtu", metres));
    for (const std::string_view kind : section_pictures)
        files.push_back(output / "figures" / fmt::format("{}-{}km.png", kind, kilometres));
    std::erase_if(files, [](const fs::path& file) { return !is_file(file); });
    const std::string ending = fmt::format("-{}km.png", kilometres);
    collect(
        output / "figures",
        [&](std::string_view name) {
            return name.starts_with(layer_picture) && name.ends_with(ending);
        },
        files);
    return files;
}

std::optional<fs::path> file_in_the_way(const fs::path& output, bool with_base, bool with_series) {
    for (const TopFile& top : top_files) {
        const bool is_written = top.written == Written::always ||
                                (top.written == Written::with_base && with_base) ||
                                (top.written == Written::with_series && with_series);
        const fs::path file = output / top.name;
        if (is_written && is_file(file) && !is_own_top_file(file, top))
            return file;
    }
    return std::nullopt;
}

bool would_be_lost(const fs::path& output, const fs::path& file, bool replaced) {
    std::error_code error;
    const auto is_it = [&](const fs::path& other) {
        return !fs::is_symlink(other, error) && fs::equivalent(other, file, error) && !error;
    };
    for (const TopFile& top : top_files)
        if (is_it(output / top.name))
            return true;
    return replaced && std::ranges::any_of(run_files(output), is_it);
}

} // namespace listric::archive

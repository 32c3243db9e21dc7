#include "apps/figures/sections/paraview.hpp"

#include "apps/archive/tables/exports.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/measures/strata/cohesion.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/encoding.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/resources.hpp"
#include "dem/base/place.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/law.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "fluid/columns.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace listric {

std::string vtk_array(std::span<const unsigned char> bytes) {
    constexpr int level = 4; // 6 saves 0.4 % and takes more than twice as long, 1 is 1.7 % larger
    const std::vector<unsigned char> packed = deflated(bytes, level);
    // Number of blocks, bytes of each, bytes of a smaller last one, packed bytes of each.
    std::vector<std::uint64_t> header{1, bytes.size(), 0, packed.size()};
    if (bytes.empty())
        header = {0, 0, 0};
    const std::string head =
        base64({reinterpret_cast<const unsigned char*>(header.data()), 8 * header.size()});
    return bytes.empty() ? head : head + base64(packed);
}

using namespace dem;

namespace {

namespace fs = std::filesystem;

/// In the order in which ParaView lists them.
constexpr std::array<std::string_view, 3> parts = {"discs", "contacts", "base"};

/// VTK XML PolyData, arrays compressed within the text.
class PolyData {
public:
    PolyData(std::size_t point_count, std::size_t vertex_count, std::size_t line_count)
        : points_(point_count), vertices_(vertex_count), lines_(line_count) {}

    template <class T>
    void array(std::string& section, const std::string& name, const std::vector<T>& values,
               int components = 1, const std::vector<const char*>& component_names = {}) {
        const char* type = std::is_same_v<T, float>          ? "Float32"
                           : std::is_same_v<T, std::int32_t> ? "Int32"
                           : std::is_same_v<T, std::int64_t> ? "Int64"
                                                             : "UInt8";
        section += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ",
                               type, name, components);
        for (std::size_t k = 0; k < component_names.size(); ++k)
            section += fmt::format("ComponentName{}=\"{}\" ", k, component_names[k]);
        section += fmt::format("format=\"binary\">\n{}\n</DataArray>\n",
                               vtk_array({reinterpret_cast<const unsigned char*>(values.data()),
                                          values.size() * sizeof(T)}));
    }

    /// A number of the whole file.
    void number(const std::string& name, double value) {
        fields_ += fmt::format("<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" "
                               "format=\"ascii\">\n{}\n</DataArray>\n",
                               name, value);
    }

    std::string point_data, cell_data, points, vertices, lines;

    std::string text() const {
        return fmt::format(
            "<?xml version=\"1.0\"?>\n<!-- x: m from the breakaway; y: m above the original "
            "surface (y = 0) -->\n<VTKFile type=\"PolyData\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
            "compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n{}"
            "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
            "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n"
            "<Verts>\n{}</Verts>\n<Lines>\n{}</Lines>\n"
            "</Piece>\n</PolyData>\n</VTKFile>\n",
            fields_.empty() ? "" : fmt::format("<FieldData>\n{}</FieldData>\n", fields_), points_,
            vertices_, lines_, point_data, cell_data, points, vertices, lines);
    }

private:
    std::size_t points_, vertices_, lines_;
    std::string fields_;
};

/// Cells of `size` consecutive points each.
void cells(PolyData& file, std::string& section, std::size_t count, std::size_t size,
           const std::vector<std::int64_t>& connectivity) {
    std::vector<std::int64_t> offsets(count);
    for (std::size_t k = 0; k < count; ++k)
        offsets[k] = static_cast<std::int64_t>((k + 1) * size);
    file.array(section, "connectivity", connectivity);
    file.array(section, "offsets", offsets);
}

std::vector<float> points(const ConstDiscColumns& d) {
    std::vector<float> p;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        p.insert(p.end(), {static_cast<float>(d.x[i]), static_cast<float>(d.y[i]), 0.0f});
    return p;
}

template <class T, class Range> std::vector<T> as(const Range& values) {
    std::vector<T> result;
    for (const auto& value : values)
        result.push_back(static_cast<T>(value));
    return result;
}

std::string discs_file(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    const std::size_t n = d.x.size();
    PolyData file(n, n, 0);
    file.array(file.points, "Points", points(d), 3);
    if (!base.motion.stages.empty()) {
        file.number("extension_m", state.clock.extension.m);
        file.number(travel_column, state.clock.travel.m);
    }
    std::vector<std::int64_t> connectivity(n);
    for (std::size_t i = 0; i < n; ++i)
        connectivity[i] = static_cast<std::int64_t>(i);
    cells(file, file.vertices, n, 1, connectivity);
    file.array(file.point_data, "id", as<std::int64_t>(d.id));
    file.array(file.point_data, "radius_m", as<float>(d.radius));
    file.array(file.point_data, "material", as<std::int32_t>(d.material));
    file.array(file.point_data, "stratum", as<std::int32_t>(d.stratum));
    file.array(file.point_data, "rotation_rad", as<float>(d.rotation));
    std::vector<float> start_depth;
    for (const double y : d.start_y)
        start_depth.push_back(static_cast<float>(-y));
    file.array(file.point_data, "start_depth_m", start_depth);
    file.array(file.point_data, "coordination", as<std::int32_t>(coordination(state, base)));
    file.array(file.point_data, "bonds", measures::bonds_per_disc(state));
    std::vector<float> velocity, stress;
    for (std::size_t i = 0; i < n; ++i)
        velocity.insert(velocity.end(),
                        {static_cast<float>(d.vx[i]), static_cast<float>(d.vy[i]), 0.0f});
    for (const Stress& s : disc_stresses(state, base))
        stress.insert(stress.end(), {static_cast<float>(s.xx), static_cast<float>(s.yy),
                                     static_cast<float>(s.xy)});
    file.array(file.point_data, "velocity_m_per_s", velocity, 3);
    file.array(file.point_data, "stress_pa", stress, 3, {"XX", "YY", "XY"});
    for (const auto& column : archive::exported_disc_columns)
        if (state.discs.has(column))
            file.array(file.point_data, std::string(column.name),
                       as<float>(state.discs.get(column)));
    if (state.discs.has(fluid::columns::darcy_x)) {
        const auto x = state.discs.get(fluid::columns::darcy_x),
                   y = state.discs.get(fluid::columns::darcy_y);
        std::vector<float> flow;
        for (std::size_t i = 0; i < n; ++i)
            flow.insert(flow.end(), {static_cast<float>(x[i]), static_cast<float>(y[i]), 0.0f});
        file.array(file.point_data, "darcy_velocity_m_per_s", flow, 3);
    }
    return file.text();
}

std::string contacts_file(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    std::vector<std::int64_t> connectivity;
    std::vector<std::uint8_t> bonded;
    std::vector<float> normal, shear;
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k]) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            const double overlap =
                d.radius[i] + d.radius[j] - hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]);
            const ContactParameters law = contact_parameters(state.materials[d.material[i]],
                                                             state.materials[d.material[j]], 1.0);
            normal.push_back(law.normal_stiffness * static_cast<float>(overlap));
            connectivity.insert(connectivity.end(), {c.first[k], c.second[k]});
            bonded.push_back(c.bonded[k]);
            shear.push_back(static_cast<float>(c.shear_force[k]));
        }
    PolyData file(d.x.size(), 0, bonded.size());
    file.array(file.points, "Points", points(d), 3);
    cells(file, file.lines, bonded.size(), 2, connectivity);
    file.array(file.cell_data, "bonded", bonded);
    file.array(file.cell_data, "normal_force_n", normal);
    file.array(file.cell_data, "shear_force_n", shear);
    return file.text();
}

/// A polyline per surface, as far as the discs reach: the surfaces themselves are endless.
std::string base_file(const State& state, const RigidBase& given) {
    const RigidBase base = standing_base(given, state);
    const ConstDiscColumns d = disc_columns(state);
    const Point breakaway = base.surfaces.front().chain.front().start;
    Point low = breakaway, high = breakaway;
    const double margin = 2.0 * state.mean_radius;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        low = {std::min(low.x, d.x[i] - margin), std::min(low.y, d.y[i] - margin)};
        high = {std::max(high.x, d.x[i] + margin), std::max(high.y, d.y[i] + margin)};
    }
    std::vector<float> corners;
    std::vector<std::int64_t> connectivity, offsets;
    std::vector<std::int32_t> surfaces;
    for (std::size_t s = 0; s < base.surfaces.size(); ++s) {
        const Surface& surface = base.surfaces[s];
        double length = 0.0;
        for (const Segment& segment : surface.chain)
            length += segment.length;
        const auto steps = static_cast<std::int64_t>(std::ceil(length / state.mean_radius));
        for (std::int64_t k = 0; k <= steps; ++k) {
            Point p = point_at(surface.chain,
                               length * static_cast<double>(k) / static_cast<double>(steps));
            p.x += surface.translation.x * state.clock.extension.m;
            p.y += surface.translation.y * state.clock.extension.m;
            if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y)
                continue;
            connectivity.push_back(static_cast<std::int64_t>(connectivity.size()));
            corners.insert(corners.end(), {static_cast<float>(p.x), static_cast<float>(p.y), 0.0f});
        }
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
        surfaces.push_back(static_cast<std::int32_t>(s));
    }
    PolyData file(connectivity.size(), 0, surfaces.size());
    file.array(file.points, "Points", corners, 3);
    file.array(file.lines, "connectivity", connectivity);
    file.array(file.lines, "offsets", offsets);
    file.array(file.cell_data, "surface", surfaces);
    return file.text();
}

/// Files in output/paraview whose names are `begin`, a moment and `ending`, with its extension, m:
/// of the ends of windows and of the present moment.
std::vector<std::pair<double, std::string>> files_of_moments(const fs::path& output,
                                                             const std::string& begin,
                                                             const std::string& ending,
                                                             const MomentNames& names, double now) {
    const std::string present = names.metres(now);
    std::vector<std::pair<double, std::string>> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(output / "paraview", error)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(begin) || !name.ends_with(ending))
            continue;
        const std::string moment =
            name.substr(begin.size(), name.size() - begin.size() - ending.size());
        const std::optional<double> extension =
            moment == present ? std::optional(now) : names.window_end(moment);
        if (extension)
            files.emplace_back(*extension, "paraview/" + name);
    }
    std::ranges::sort(files);
    return files;
}

void write_series(const fs::path& output, const MomentNames& names, double now,
                  const Calendar& calendar) {
    std::set<std::tuple<double, std::size_t, std::string>> files; // in the series' order
    for (std::size_t part = 0; part < parts.size(); ++part)
        for (const auto& [extension, name] :
             files_of_moments(output, fmt::format("{}-", parts[part]), "m.vtp", names, now))
            files.emplace(extension, part, name);
    std::string series = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
                         "<Collection>\n";
    // ParaView names a block after `name`; it goes by the order of the lines, not by `part`.
    for (const auto& [extension, part, name] : files)
        series += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                              calendar.age(Travel(extension)) / 1e6, part, parts[part], name);
    write_text(output / "paraview.pvd", series + "</Collection>\n</VTKFile>\n");
}

} // namespace

void write_paraview(const fs::path& output, const State& state, const RigidBase& base,
                    const MomentNames& names, const Calendar& calendar) {
    const fs::path folder = output / "paraview";
    std::error_code error;
    fs::create_directories(folder, error);
    const std::string moment = names.metres(state.clock.travel.m) + "m.vtp";
    write_text(folder / ("discs-" + moment), discs_file(state, base));
    write_text(folder / ("contacts-" + moment), contacts_file(state));
    write_text(folder / ("base-" + moment), base_file(state, base));
    write_series(output, names, state.clock.travel.m, calendar);
    copy_view(output);
}

void write_footwall(const fs::path& output, const fem::Footwall& footwall, double extension,
                    const MomentNames& names, const Calendar& calendar) {
    const fs::path folder = output / "paraview";
    std::error_code error;
    fs::create_directories(folder, error);
    footwall.write(folder.string(), "footwall-" + names.metres(extension) + "m");
    auto moments = files_of_moments(output, "footwall-", "m.vtu", names, extension);
    for (auto& [time, file] : moments)
        time = calendar.age(Travel(time)) / 1e6;
    fem::write_series((output / "footwall.pvd").string(), moments);
}

void copy_view(const fs::path& output) {
    std::string script = read_text_if_there(resource_folder() / "figures/python/paraview.py");
    constexpr std::string_view none = "LOOK = {}";
    const std::size_t place = script.find(none);
    if (place == script.npos)
        return;
    const auto words = vocabulary();
    const std::string palette = words["strata"]["palette"];
    const nlohmann::json look{{"pre_rift", words["pre_rift"]},
                              {"strata", words["strata"]},
                              {"rows", words["palettes"][palette]["rows"]}};
    write_text(output / "paraview.py", script.replace(place + 7, 2, to_text(look)));
}

} // namespace listric

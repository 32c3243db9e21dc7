#include "apps/paraview.hpp"

#include "apps/snapshot.hpp"
#include "dem/contacts.hpp"
#include "dem/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace listric {

namespace {

namespace fs = std::filesystem;

/// VTK XML PolyData with raw appended data: small, and read by every version.
class PolyData {
public:
    PolyData(std::size_t point_count, std::size_t vertex_count, std::size_t line_count)
        : points_(point_count), vertices_(vertex_count), lines_(line_count) {}

    template <class T>
    void array(std::string& section, const std::string& name, const std::vector<T>& values,
               int components = 1) {
        const char* type = std::is_same_v<T, float>          ? "Float32"
                           : std::is_same_v<T, std::int32_t> ? "Int32"
                           : std::is_same_v<T, std::int64_t> ? "Int64"
                                                             : "UInt8";
        section += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
                               "format=\"appended\" offset=\"{}\"/>\n",
                               type, name, components, data_.size());
        const std::uint64_t bytes = values.size() * sizeof(T);
        data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
        data_.append(reinterpret_cast<const char*>(values.data()), bytes);
    }

    std::string point_data, cell_data, points, vertices, lines;

    std::string text() const {
        return fmt::format(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
            "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
            "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n"
            "<Verts>\n{}</Verts>\n<Lines>\n{}</Lines>\n"
            "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_{}\n</AppendedData>\n"
            "</VTKFile>\n",
            points_, vertices_, lines_, point_data, cell_data, points, vertices, lines, data_);
    }

private:
    std::size_t points_, vertices_, lines_;
    std::string data_;
};

/// Cells of `size` consecutive points each.
void cells(PolyData& file, std::string& section, std::size_t count, std::size_t size,
           std::vector<std::int64_t> connectivity) {
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
    std::vector<std::int64_t> connectivity(n);
    for (std::size_t i = 0; i < n; ++i)
        connectivity[i] = static_cast<std::int64_t>(i);
    cells(file, file.vertices, n, 1, connectivity);
    file.array(file.point_data, "id", as<std::int64_t>(d.id));
    file.array(file.point_data, "radius_m", as<float>(d.radius));
    file.array(file.point_data, "material", as<std::int32_t>(d.material));
    file.array(file.point_data, "stratum", as<std::int32_t>(d.stratum));
    file.array(file.point_data, "rotation_rad", as<float>(d.rotation));
    std::vector<float> velocity, stress;
    for (std::size_t i = 0; i < n; ++i)
        velocity.insert(velocity.end(),
                        {static_cast<float>(d.vx[i]), static_cast<float>(d.vy[i]), 0.0f});
    for (const Stress& s : disc_stresses(state, base))
        stress.insert(stress.end(), {static_cast<float>(s.xx), static_cast<float>(s.yy),
                                     static_cast<float>(s.xy)});
    file.array(file.point_data, "velocity_m_per_s", velocity, 3);
    file.array(file.point_data, "stress_xx_yy_xy_pa", stress, 3);
    for (const char* name : {"window_strain", "total_strain", "porosity"})
        if (state.discs.has(name))
            file.array(file.point_data, name, as<float>(state.discs.get<double>(name)));
    return file.text();
}

std::string contacts_file(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    std::vector<std::int64_t> connectivity;
    std::vector<std::uint8_t> bonded;
    std::vector<float> shear;
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k]) {
            connectivity.insert(connectivity.end(), {c.first[k], c.second[k]});
            bonded.push_back(c.bonded[k]);
            shear.push_back(static_cast<float>(c.shear_force[k]));
        }
    PolyData file(d.x.size(), 0, bonded.size());
    file.array(file.points, "Points", points(d), 3);
    cells(file, file.lines, bonded.size(), 2, connectivity);
    file.array(file.cell_data, "bonded", bonded);
    file.array(file.cell_data, "shear_force_n", shear);
    return file.text();
}

/// The moment that a file's name tells, m of extension.
double extension_of(const fs::path& path) {
    const std::string name = path.stem().string();
    return std::stod(name.substr(name.find('-') + 1));
}

} // namespace

void write_paraview(const fs::path& output, const State& state, const RigidBase& base,
                    double extension_rate) {
    const fs::path folder = output / "paraview";
    std::error_code error;
    fs::create_directories(folder, error);
    const std::string moment = fmt::format("{:08.2f}m.vtp", state.clock.extension);
    write_text(folder / ("discs-" + moment), discs_file(state, base));
    write_text(folder / ("contacts-" + moment), contacts_file(state));

    std::vector<std::pair<double, std::string>> files;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".vtp")
            files.emplace_back(extension_of(entry.path()), entry.path().filename().string());
    std::ranges::sort(files);
    std::string series = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
                         "<Collection>\n";
    for (const auto& [extension, name] : files)
        series += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"paraview/{}\"/>\n",
                              extension / extension_rate / 1e6, name[0] == 'd' ? 0 : 1, name);
    write_text(output / "paraview.pvd", series + "</Collection>\n</VTKFile>\n");
}

} // namespace listric

// Contents of a solution: fields, errors, stress, reactions, the guard, files.

#include "fem/byerlee.hpp"
#include "fem/elasticity.hpp"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <unistd.h>

namespace listric::fem {

using dealii::Point;
using dealii::Tensor;

namespace {

/// In the section, Pa; tension positive.
struct Stress {
    double xx, yy, xy;
};

/// Stress by a displacement's gradient.
Stress stress_of(const Rock& rock, const Tensor<2, 2>& g) {
    const double trace = rock.lambda * (g[0][0] + g[1][1]);
    return {trace + 2.0 * rock.mu * g[0][0], trace + 2.0 * rock.mu * g[1][1],
            rock.mu * (g[0][1] + g[1][0])};
}

/// Stress of a solution anywhere. Where rock relaxes, its deviator is the nearest stress point's:
/// it is the small difference of what strain would make and what has relaxed.
class StressField {
public:
    /// @param deviators  by stress point
    StressField(const std::vector<StressPoint>& points, std::vector<double> deviators)
        : deviators_(std::move(deviators)) {
        if (!points.empty())
            nearest_.emplace(points);
    }

    Stress at(const Rock& rock, Vector place, const Tensor<2, 2>& gradient) const {
        if (!rock.remembers || !nearest_)
            return stress_of(rock, gradient);
        const double* deviator = &deviators_[3 * (*nearest_)(place)];
        const double mean = (rock.lambda + 2.0 / 3.0 * rock.mu) * (gradient[0][0] + gradient[1][1]);
        return {mean + deviator[0], mean + deviator[1], deviator[2]};
    }

private:
    std::optional<NearestPoint> nearest_;
    std::vector<double> deviators_;
};

/// Stress, elastic moduli and density at the points of output.
class StressOutput : public dealii::DataPostprocessor<2> {
public:
    StressOutput(const ElasticRock& material, const StressField& field)
        : material_(material), field_(field) {}

    std::vector<std::string> get_names() const override {
        return {"stress_xx_pa",     "stress_yy_pa",  "stress_xy_pa",
                "young_modulus_pa", "poisson_ratio", "density_kg_per_m3"};
    }
    std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
    get_data_component_interpretation() const override {
        return std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
            6, dealii::DataComponentInterpretation::component_is_scalar);
    }
    dealii::UpdateFlags get_needed_update_flags() const override {
        return dealii::update_gradients | dealii::update_quadrature_points;
    }
    void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<2>& in,
                               std::vector<dealii::Vector<double>>& out) const override {
        // A cell's rock is that of its middle, lest a layer's edge flicker.
        Point<2> middle;
        for (const auto& p : in.evaluation_points)
            middle += p / static_cast<double>(in.evaluation_points.size());
        const Rock rock = material_.at_once(plain(middle));
        for (std::size_t k = 0; k < out.size(); ++k) {
            Tensor<2, 2> gradient;
            for (unsigned component = 0; component < 2; ++component)
                gradient[component] = in.solution_gradients[k][component];
            const Stress stress = field_.at(rock, plain(in.evaluation_points[k]), gradient);
            out[k](0) = stress.xx;
            out[k](1) = stress.yy;
            out[k](2) = stress.xy;
            out[k](3) = rock.mu * (3.0 * rock.lambda + 2.0 * rock.mu) / (rock.lambda + rock.mu);
            out[k](4) = 0.5 * rock.lambda / (rock.lambda + rock.mu);
            out[k](5) = rock.density;
        }
    }

private:
    const ElasticRock& material_;
    const StressField& field_;
};

} // namespace

std::vector<double> ElasticFootwall::strain_deviators() const {
    require_solution();
    dealii::FEValues<2> values(mapping_, element_, quadrature(), dealii::update_gradients);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<2, 2>> slopes(values.n_quadrature_points);
    std::vector<double> result;
    result.reserve(3 * stress_points_.size());
    for_each_relaxing_cell([&](const auto& cell, std::size_t, const auto& points) {
        values.reinit(cell);
        values[u].get_function_gradients(displacement_, slopes);
        for (const unsigned q : points) {
            const double mean = (slopes[q][0][0] + slopes[q][1][1]) / 3.0; // zz is 0
            result.push_back(slopes[q][0][0] - mean);
            result.push_back(slopes[q][1][1] - mean);
            result.push_back(0.5 * (slopes[q][0][1] + slopes[q][1][0]));
        }
    });
    return result;
}

std::vector<double> ElasticFootwall::stress_deviators() const {
    std::vector<double> result = strain_deviators();
    for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = 2.0 * material_.at(stress_points_[k / 3].place).mu * result[k] +
                    (stress_.empty() ? 0.0 : stress_[k]);
    return result;
}

/// Of the stress s and the strain e that the step begins with: decay s - 2 mu e, so that the strain
/// of its end makes the rest. Of hot rock all strain does.
std::vector<double> ElasticFootwall::stress_left(const ElasticRock& next) const {
    const std::vector<double> strain = strain_deviators();
    std::vector<double> result;
    result.reserve(strain.size());
    for (std::size_t k = 0; k < stress_points_.size(); ++k) {
        const Rock now = material_.at(stress_points_[k].place);
        const Rock then = next.at(stress_points_[k].place);
        for (std::size_t c = 3 * k; c < 3 * k + 3; ++c) {
            const double stress = (stress_.empty() ? 0.0 : stress_[c]) + 2.0 * now.mu * strain[c];
            result.push_back(next.is_hot(stress_points_[k].place)
                                 ? 0.0
                                 : then.decay * stress - 2.0 * then.mu * strain[c]);
        }
    }
    return result;
}

std::vector<double> ElasticFootwall::stress_left(double seconds) const {
    ElasticRock next = material_;
    next.take_step(seconds);
    return stress_left(next);
}

std::vector<double> ElasticFootwall::stress_left_below(const std::vector<Vector>& isotherm) const {
    ElasticRock next = material_;
    next.take_isotherm(isotherm);
    return stress_left(next);
}

std::vector<double> ElasticFootwall::work() const {
    require_solution();
    GlobalVector solution(owned_, processes_);
    solution = displacement_;
    std::vector<double> work;
    for (const GlobalVector& load : kept_loads_)
        work.push_back(load * solution);
    return work;
}

Field ElasticFootwall::field() const {
    require_solution();
    const auto units = element_.base_element(0).get_unit_support_points();
    dealii::FEValues<2> values(mapping_, element_, dealii::Quadrature<2>(units),
                               dealii::update_quadrature_points);
    std::vector<Index> indices(element_.n_dofs_per_cell());
    const dealii::IndexSet on_surface = dealii::DoFTools::extract_boundary_dofs(
        unknowns_, dealii::ComponentMask(), {id_of(Boundary::surface)});
    std::map<Index, std::array<double, 5>> found; // by the x unknown
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        cell->get_dof_indices(indices);
        for (unsigned i = 0; i < indices.size(); ++i) {
            const auto [component, place] = element_.system_to_component_index(i);
            if (component != 0 || !owned_.is_element(indices[i]))
                continue;
            const Point<2> p = values.quadrature_point(place);
            // The y unknown of a node follows the x unknown.
            found[indices[i]] = {p[0], p[1], displacement_(indices[i]),
                                 displacement_(indices[i] + 1),
                                 on_surface.is_element(indices[i]) ? 1.0 : 0.0};
        }
    });
    std::vector<std::array<double, 5>> own;
    for (const auto& [index, row] : found)
        own.push_back(row);
    std::vector<std::array<double, 5>> rows;
    for (const auto& part : dealii::Utilities::MPI::all_gather(processes_, own))
        rows.insert(rows.end(), part.begin(), part.end());
    // Places of one row of nodes agree to round-off only.
    const double grain = 1e-6 * request_.cell_size;
    std::ranges::sort(rows, {}, [grain](const std::array<double, 5>& row) {
        return std::pair(std::llround(row[1] / grain), row[0]);
    });
    Field field;
    for (const auto& row : rows) {
        if (row[4] > 0.0)
            field.surface.push_back(field.place.size());
        field.place.push_back({row[0], row[1]});
        field.displacement.push_back({row[2], row[3]});
    }
    std::ranges::sort(field.surface, {}, [&](std::size_t k) { return field.place[k].x; });
    return field;
}

FieldError ElasticFootwall::error(const ExactField& exact) const {
    require_solution();
    const dealii::QGauss<2> points(static_cast<unsigned>(request_.degree) + 3);
    dealii::FEValues<2> values(mapping_, element_, points, volume_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<1, 2>> found(points.size());
    std::vector<Tensor<2, 2>> slopes(points.size());
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        values[u].get_function_values(displacement_, found);
        values[u].get_function_gradients(displacement_, slopes);
        for (unsigned q = 0; q < points.size(); ++q) {
            const Vector p = plain(values.quadrature_point(q));
            const Vector e = exact.displacement(p);
            const std::array<double, 4> g = exact.gradient(p);
            const double w = values.JxW(q);
            sums[0] += w * (std::pow(found[q][0] - e.x, 2) + std::pow(found[q][1] - e.y, 2));
            sums[1] += w * (e.x * e.x + e.y * e.y);
            for (unsigned k = 0; k < 4; ++k) {
                sums[2] += w * std::pow(slopes[q][k / 2][k % 2] - g[k], 2);
                sums[3] += w * g[k] * g[k];
            }
        }
    });
    for (double& sum : sums)
        sum = dealii::Utilities::MPI::sum(sum, processes_);
    return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
}

std::vector<StressPatch> ElasticFootwall::stress() const {
    require_solution();
    // The corners of the quarters, three in a row, then their middles.
    std::vector<Point<2>> places;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            places.emplace_back(0.5 * column, 0.5 * row);
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 2; ++column)
            places.emplace_back(0.25 + 0.5 * column, 0.25 + 0.5 * row);
    dealii::FEValues<2> values(mapping_, element_, dealii::Quadrature<2>(places), volume_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<1, 2>> moved(places.size());
    std::vector<Tensor<2, 2>> slopes(places.size());
    const StressField field(stress_points_, stress_deviators());
    std::vector<StressPatch> result;
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        values[u].get_function_values(displacement_, moved);
        values[u].get_function_gradients(displacement_, slopes);
        for (unsigned quarter = 0; quarter < 4; ++quarter) {
            StressPatch patch;
            const unsigned first = quarter / 2 * 3 + quarter % 2;
            const unsigned around[4] = {first, first + 1, first + 4, first + 3};
            for (unsigned k = 0; k < 4; ++k) {
                patch.corner[k] = plain(values.quadrature_point(around[k]));
                patch.displacement[k] = {moved[around[k]][0], moved[around[k]][1]};
            }
            const Vector middle = plain(values.quadrature_point(9 + quarter));
            const Rock rock = material_.at(middle);
            const Stress stress = field.at(rock, middle, slopes[9 + quarter]);
            patch.xx = stress.xx;
            patch.yy = stress.yy;
            patch.xy = stress.xy;
            patch.is_relaxed = rock.relaxed && (request_.relaxation > 1.0 || rock.remembers);
            result.push_back(patch);
        }
    });
    return result;
}

Vector ElasticFootwall::reaction() const {
    require_solution();
    const dealii::QGauss<1> points = face_quadrature();
    dealii::FEFaceValues<2> values(mapping_, element_, points, face_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<1, 2>> found(points.size());
    std::vector<Tensor<2, 2>> slopes(points.size());
    double sums[2] = {0.0, 0.0};
    for_each_own_cell([&](const auto& cell) {
        for (const unsigned f : cell->face_indices()) {
            if (!cell->face(f)->at_boundary())
                continue;
            const auto boundary = static_cast<Boundary>(cell->face(f)->boundary_id());
            values.reinit(cell, f);
            values[u].get_function_values(displacement_, found);
            values[u].get_function_gradients(displacement_, slopes);
            for (unsigned q = 0; q < points.size(); ++q) {
                const Vector place = plain(values.quadrature_point(q));
                const auto normal = values.normal_vector(q);
                const double stretch = slopes[q][0][0] * normal[1] - slopes[q][0][1] * normal[0];
                sums[0] -= values.JxW(q) * found[q][0] * side_spring(boundary, place);
                sums[1] -= values.JxW(q) * (found[q][1] * spring(boundary) * std::abs(normal[1]) +
                                            turned_pressure(boundary, place) * stretch);
            }
        }
    });
    return {dealii::Utilities::MPI::sum(sums[0], processes_),
            dealii::Utilities::MPI::sum(sums[1], processes_)};
}

Guard ElasticFootwall::guard(double rock_weight) const {
    require_solution();
    const dealii::QGauss<2> points = quadrature();
    dealii::FEValues<2> values(mapping_, element_, points, volume_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<2, 2>> slopes(points.size());
    std::size_t point = 0; // of those that relax
    Guard guard;
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        values[u].get_function_gradients(displacement_, slopes);
        for (unsigned q = 0; q < points.size(); ++q) {
            const Vector place = plain(values.quadrature_point(q));
            const Rock rock = material_.at(place);
            const Tensor<2, 2>& slope = slopes[q];
            // Centre and radius of the strain's Mohr circle.
            const double centre = 0.5 * (slope[0][0] + slope[1][1]);
            const double radius =
                0.5 * std::hypot(slope[0][0] - slope[1][1], slope[0][1] + slope[1][0]);
            double& most = rock.relaxed ? guard.relaxed_strain : guard.strong_strain;
            most = std::max(most, std::abs(centre) + radius);
            guard.rotation = std::max(guard.rotation, 0.5 * std::abs(slope[1][0] - slope[0][1]));
            double pressure = -rock_weight * place.y - 2.0 * (rock.lambda + rock.mu) * centre;
            double shear = 2.0 * rock.mu * radius;
            if (rock.remembers && !stress_.empty()) {
                const double* left = &stress_[3 * point];
                pressure -= 0.5 * (left[0] + left[1]);
                shear =
                    std::hypot(rock.mu * (slope[0][0] - slope[1][1]) + 0.5 * (left[0] - left[1]),
                               rock.mu * (slope[0][1] + slope[1][0]) + left[2]);
            }
            point += rock.remembers;
            if (!rock.relaxed && beyond_byerlee(pressure, shear))
                guard.beyond_byerlee += values.JxW(q);
        }
    });
    return {dealii::Utilities::MPI::max(guard.strong_strain, processes_),
            dealii::Utilities::MPI::max(guard.relaxed_strain, processes_),
            dealii::Utilities::MPI::max(guard.rotation, processes_),
            dealii::Utilities::MPI::sum(guard.beyond_byerlee, processes_)};
}

void ElasticFootwall::write(const std::string& folder, const std::string& name) const {
    require_solution();
    const StressField field(stress_points_, stress_deviators());
    const StressOutput stress(material_, field);
    dealii::DataOut<2> out;
    out.attach_dof_handler(unknowns_);
    const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> vector(
        2, dealii::DataComponentInterpretation::component_is_part_of_vector);
    out.add_data_vector(displacement_, std::vector<std::string>(2, "displacement_m"),
                        dealii::DataOut<2>::type_dof_data, vector);
    out.add_data_vector(displacement_, stress);
    out.build_patches(mapping_, static_cast<unsigned>(request_.degree),
                      dealii::DataOut<2>::curved_inner_cells);
    // Equal fields are equal files.
    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;
    out.set_flags(flags);
    // A good file of this name stays until the new one is whole.
    const std::string file = folder + "/" + name + ".vtu";
    const int writer = dealii::Utilities::MPI::broadcast(processes_, static_cast<int>(getpid()));
    const std::string part = file + "." + std::to_string(writer) + ".part";
    std::error_code error;
    try {
        out.write_vtu_in_parallel(part, processes_);
        if (dealii::Utilities::MPI::this_mpi_process(processes_) == 0)
            std::filesystem::rename(part, file);
    } catch (const std::exception&) { // of MPI, in many lines
        const std::string cause = std::strerror(errno ? errno : EIO);
        std::filesystem::remove(part, error);
        throw WriteError("cannot write " + file + ": " + cause);
    }
}

} // namespace listric::fem

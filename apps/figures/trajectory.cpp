#include "apps/figures/trajectory.hpp"

#include "apps/measures/rock.hpp"
#include "apps/support/npy.hpp"
#include "apps/support/python.hpp"

#include <fmt/format.h>

#include <iterator>

namespace listric {

using namespace archive;
using namespace dem;

void Trajectory::add(const ExportedMoment& at) {
    const std::filesystem::path folder = data_.path / fmt::format("{:06d}", frames_++);
    make_folder(folder);
    const State& state = at.now.state;
    const ConstDiscColumns d = disc_columns(state);
    write_npy<double>(folder / "x_m.npy", d.x);
    write_npy<double>(folder / "y_m.npy", d.y);
    write_npy<std::uint32_t>(folder / "rock.npy", measures::rocks(state));
    for (const DiscColumn& column : exported_columns(at))
        write_npy<double>(folder / ("of-" + column.name + ".npy"), column.values);
    const ConstContactColumns c = contact_columns(state);
    std::vector<std::int32_t> bonded;
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (c.bonded[k])
            bonded.insert(bonded.end(), {c.first[k], c.second[k]});
    write_npy<std::int32_t>(folder / "bonded.npy", bonded, 2);
    write_npy<double>(folder / "moment.npy",
                      std::vector{static_cast<double>(state.clock.cycle), state.clock.extension});
}

void Trajectory::write(const std::filesystem::path& file) const {
    std::vector<std::string> words{std::filesystem::absolute(data_.path).string(),
                                   std::filesystem::absolute(file).string()};
    words.insert(words.end(), std::begin(measures::rock_names), std::end(measures::rock_names));
    run_script_with("gsd", "python3-gsd", "trajectory.py", words);
}

} // namespace listric

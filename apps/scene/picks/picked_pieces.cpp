#include "apps/scene/picks/picked_pieces.hpp"

#include "apps/support/files/csv_records.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric {

std::vector<PickedLine> by_name(std::span<const PickedLine> pieces) {
    std::vector<PickedLine> lines;
    for (const PickedLine& piece : pieces) {
        const auto known = std::ranges::find(lines, piece.name, &PickedLine::name);
        if (known == lines.end()) {
            lines.push_back(piece);
            continue;
        }
        known->x.insert(known->x.end(), piece.x.begin(), piece.x.end());
        known->depth.insert(known->depth.end(), piece.depth.begin(), piece.depth.end());
    }
    return lines;
}

std::vector<std::string> turns_back(const PickedFile& picked) {
    std::vector<std::string> told;
    for (std::size_t l = 0; l < picked.lines.size(); ++l) {
        const PickedLine& line = picked.lines[l];
        for (std::size_t k = 2; k < line.x.size(); ++k) {
            const double along =
                (line.x[k - 1] - line.x[k - 2]) * (line.x[k] - line.x[k - 1]) +
                (line.depth[k - 1] - line.depth[k - 2]) * (line.depth[k] - line.depth[k - 1]);
            if (along >= 0.0)
                continue;
            told.push_back(fmt::format(
                "{}: {} turns back here; if it is in pieces, part them by an empty line, or number "
                "them in a column line",
                csv_place(picked.file, picked.rows[l][k]), shown_start(line.name)));
            break;
        }
    }
    return told;
}

} // namespace listric

#pragma once

#include <string_view>
#include <vector>

namespace listric {

/// A published work: what is known of it (docs/reference/references.md); nothing is filled in.
struct Work {
    std::string_view name;   ///< "Baldwin and Butler (1985)"
    std::string_view bibtex; ///< entry
};

using Works = std::vector<const Work*>;

namespace works {
extern const Work seyferth_henk; ///< the method; behind every run
extern const Work itasca, baldwin_butler, kusznir, hetenyi, turcotte_schubert;
extern const Work gibson, audet_fowler, wangen, yang_aplin, catalano;
extern const Work mckenzie, sweeney_burnham;
} // namespace works

/// Works behind an effect besides the paper; declared in effects/NAME.cpp. None of an unknown one.
Works works_behind(std::string_view effect);

} // namespace listric

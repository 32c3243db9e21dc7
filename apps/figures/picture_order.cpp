#include "apps/figures/picture_order.hpp"

#include "apps/scene/toml/json_text.hpp"
#include "apps/support/version.hpp"

namespace listric {

std::string PictureOrder::text() const {
    return to_text(nlohmann::ordered_json{{"formats", formats},
                                          {"software", "Listric " + std::string(version)},
                                          {"provenance", provenance},
                                          {"errors", errors},
                                          {"width_mm", width_mm},
                                          {"only", only},
                                          {"plain", plain},
                                          {"dpi", dpi},
                                          {"caption", caption}});
}

} // namespace listric

#include "dem/beds.hpp"

namespace listric::dem {

std::size_t Beds::of(std::int32_t stratum) const {
    if (list.empty())
        return 0;
    constexpr double almost = 1.0 - 1e-9; // round-off of an age
    const double age = almost * deposition.calendar().age(deposition.due(stratum));
    std::size_t bed = 0;
    while (bed + 1 < list.size() && age > list[bed].until)
        ++bed;
    return bed;
}

const PorosityLaw& Beds::law(std::int32_t stratum, const PorosityLaw& of_all) const {
    return list.empty() ? of_all : list[of(stratum)].pores;
}

} // namespace listric::dem

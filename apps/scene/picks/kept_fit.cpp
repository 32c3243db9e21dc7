#include "apps/scene/picks/kept_fit.hpp"

#include "apps/support/files/cache_folder.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/version.hpp"
#include "dem/numbers/hash.hpp"

#include <fmt/format.h>

#include <charconv>
#include <ctime>

namespace listric {

using namespace dem;

namespace fs = std::filesystem;

namespace {

/// All that a fit follows from, to the bit.
std::string origin_of(std::span<const Point> points, double tolerance) {
    constexpr int generation = 1; // of fault_fit.cpp: more with each change of its results
    std::string text = fmt::format("{} {} {} {} {} {}\n{:a}\n", generation, version, source_hash,
                                   compiler, build_flags, instruction_set, tolerance);
    for (const Point p : points)
        fmt::format_to(std::back_inserter(text), "{:a} {:a}\n", p.x, p.y);
    return text;
}

/// The numbers of a text, one after the other; none after one that cannot be read.
class Numbers {
public:
    explicit Numbers(std::string_view text) : text_(text) {}

    std::optional<double> next() {
        const std::size_t begin = text_.find_first_not_of(" \n");
        if (begin == text_.npos)
            return std::nullopt;
        text_.remove_prefix(begin);
        const bool negative = text_.starts_with('-');
        text_.remove_prefix(negative ? 1 : 0);
        text_.remove_prefix(text_.starts_with("0x") ? 2 : 0); // from_chars takes no such prefix
        double value = 0.0;
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value,
                                                  std::chars_format::hex);
        if (error != std::errc{})
            return std::nullopt;
        text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        return negative ? -value : value;
    }
    bool at_end() const { return text_.find_first_not_of(" \n") == text_.npos; }

private:
    std::string_view text_;
};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

} // namespace

std::string kept_text(const FaultFit& fit, std::span<const Point> points, double tolerance) {
    std::string text = origin_of(points, tolerance);
    fmt::format_to(std::back_inserter(text), "{:a} {:a} {:a} {:a}\n", fit.start_dip, fit.misfit,
                   fit.end_dip, fit.flat ? 1.0 : 0.0);
    for (const DetachmentSegment& segment : fit.segments)
        fmt::format_to(std::back_inserter(text), "{:a} {:a} {:a}\n", segment.radius,
                       segment.end_dip, segment.length);
    return text;
}

std::optional<FaultFit> recalled(std::string_view text, std::span<const Point> points,
                                 double tolerance) {
    const std::string origin = origin_of(points, tolerance);
    if (!text.starts_with(origin) || !text.ends_with('\n'))
        return std::nullopt;
    Numbers numbers(text.substr(origin.size()));
    FaultFit fit;
    const auto start = numbers.next(), misfit = numbers.next(), end = numbers.next(),
               flat = numbers.next();
    if (!flat)
        return std::nullopt;
    fit.start_dip = *start;
    while (!numbers.at_end()) {
        const auto radius = numbers.next(), dip = numbers.next(), length = numbers.next();
        if (!length || !(*radius > 0.0 || *length > 0.0))
            return std::nullopt;
        fit.segments.push_back(*radius > 0.0 ? arc_to_dip(*dip, *radius) : straight(*length));
    }
    if (fit.segments.empty())
        return std::nullopt;
    measure_misfit(fit, points);
    fit.end_dip = *end;
    fit.flat = *flat != 0.0;
    return fit.misfit == *misfit ? std::optional(fit) : std::nullopt;
}

FaultFit fit_or_recall_fault(std::span<const Point> points, double tolerance) {
    constexpr double long_time = 0.05; // s; what is quicker is not worth a file
    fs::path file = cache_folder();
    try {
        if (!file.empty())
            file /= fmt::format("fault-{:016x}.txt", fnv1a(origin_of(points, tolerance)));
        if (const auto fit = recalled(read_text_if_there(file), points, tolerance))
            return *fit;
    } catch (const std::exception&) { // as if there were no file
    }
    const double begin = processor_seconds();
    FaultFit fit = fit_fault(points, tolerance);
    if (processor_seconds() - begin > long_time && !file.empty())
        try {
            fs::create_directories(file.parent_path());
            write_text(file, kept_text(fit, points, tolerance));
        } catch (const std::exception&) { // the next call makes it anew
        }
    return fit;
}

} // namespace listric

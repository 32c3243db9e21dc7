// What the rooms have of the system, as far as a module in a page has it.

#include "apps/scene/picks/kept_fit.hpp"
#include "apps/support/machine/cores.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/text.hpp"
#include "fem/plugin.hpp"

#include <string>

extern "C" __attribute__((import_module("listric"), import_name("tell"))) void
tell_page(bool is_warning, const char* text, std::size_t bytes);

namespace listric {

// Messages go to the page.

namespace {

void tell(bool is_warning, std::string_view message) {
    const std::string text = shown_lines(message);
    tell_page(is_warning, text.data(), text.size());
}

} // namespace

void warn(std::string_view message) { tell(true, message); }

struct Log::Parts {};

Log::Log(const std::filesystem::path&, bool) {}
Log::~Log() = default;

void Log::say(std::string_view message) {
    constexpr std::string_view mark = "warning: ";
    if (message.starts_with(mark))
        tell(true, message.substr(mark.size()));
}

void Log::progress(std::string_view line) { tell(false, line); }
void Log::progress(const std::function<std::string(std::size_t columns)>& line) {
    tell(false, line(std::string::npos));
}
void Log::repeat_warnings() {}

// Files are texts that the page gives; none is kept.

std::filesystem::path resource_folder() { return "/listric"; }
std::filesystem::path record_folder() { return "/listric/records"; }

FaultFit fit_or_recall_fault(std::span<const dem::Point> points, double tolerance) {
    return fit_fault(points, tolerance);
}

int usable_cores() { return 1; }

LoadedPlugin load(const Plugin&) { return {nullptr, "", "a page has none"}; }

} // namespace listric

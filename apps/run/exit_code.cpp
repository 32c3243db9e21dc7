#include "apps/run/exit_code.hpp"

#include "apps/support/error.hpp"
#include "apps/support/machine/job_limits.hpp"
#include "apps/support/machine/memory.hpp"
#include "apps/support/words/text.hpp"
#include "dem/cycle/cycle.hpp"
#include "fem/footwall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string_view>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace listric {

namespace {

Ending out_of_memory() {
    const double need = noted_memory_need();
    return {ExitCode::storage_failed,
            need > 0.0 ? fmt::format("memory is short: about {:.0f} MB are needed{}",
                                     std::ceil(need / 1e6), words_of_address_limit())
                       : "memory is short" + words_of_address_limit()};
}

/// A thread or process that could not be started: it needs room for a stack, which only a limit of
/// addresses refuses, and a place among those that are allowed.
Ending nothing_started() {
    rlimit addresses{}, processes{};
    if (getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY)
        return out_of_memory();
    double allowed = granted_tasks("/");
    if (getrlimit(RLIMIT_NPROC, &processes) == 0 && processes.rlim_cur != RLIM_INFINITY)
        allowed = std::min(allowed, static_cast<double>(processes.rlim_cur));
    const std::string count =
        std::isfinite(allowed)
            ? fmt::format(" ({:.0f} processes and threads are allowed here)", allowed)
            : "";
    return {ExitCode::storage_failed,
            "no further thread or process can be started" + count + "; --threads 1 needs fewest"};
}

Ending internal_error(const std::string& what) {
    return {ExitCode::internal_error,
            fmt::format("internal error: {}; this is our mistake: please report it, with log.txt "
                        "and scene.toml",
                        what)};
}

} // namespace

Ending ending_of(const std::exception_ptr& exception) {
    assert(exception);
    try {
        std::rethrow_exception(exception);
    } catch (const SceneError& error) {
        return {ExitCode::bad_call, error.what()};
    } catch (const UsageError& error) {
        return {ExitCode::bad_call, error.what()};
    } catch (const fem::FootwallError& error) {
        return {ExitCode::bad_call, error.what()};
    } catch (const dem::NumericalFailure& error) {
        return {ExitCode::numerics_failed, error.what()};
    } catch (const StorageError& error) {
        return {ExitCode::storage_failed, error.what()};
    } catch (const fem::WriteError& error) {
        return {ExitCode::storage_failed, error.what()};
    } catch (const MemoryError& error) {
        return {ExitCode::storage_failed, error.what()};
    } catch (const std::bad_alloc&) {
        return out_of_memory();
    } catch (const std::filesystem::filesystem_error& error) {
        return {ExitCode::storage_failed, error.what()};
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again)
            return nothing_started();
        if (error.code() == std::errc::not_enough_memory)
            return out_of_memory();
        return internal_error(error.what());
    } catch (const Interrupted&) {
        return {ExitCode::interrupted, ""};
    } catch (const std::exception& error) {
        return internal_error(error.what());
    } catch (...) {
        return internal_error("an exception without a name");
    }
}

void tell(const Ending& ending) {
    if (ending.message.empty())
        return;
    const std::string text = fmt::format("listric: {}\n", shown_lines(ending.message));
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

int run_guarded(const std::function<ExitCode()>& work) {
    try {
        return static_cast<int>(work());
    } catch (...) {
        const Ending ending = ending_of(std::current_exception());
        tell(ending);
        return static_cast<int>(ending.code);
    }
}

void guard_threads() {
    keep_memory_for_the_end();
    std::set_terminate([] {
        try {
            const auto exception = std::current_exception();
            const Ending ending = exception ? ending_of(exception) : internal_error("terminated");
            tell(ending);
            _exit(static_cast<int>(ending.code));
        } catch (...) { // there is not even memory to say so
            constexpr std::string_view text = "listric: memory is short\n";
            [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
            _exit(static_cast<int>(ExitCode::storage_failed));
        }
    });
}

} // namespace listric

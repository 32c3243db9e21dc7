// Exit codes of the exceptions that end a call: docs/reference/exit-codes.md.

#include "apps/run/exit_code.hpp"

#include "apps/support/error.hpp"
#include "apps/support/machine/memory.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/threads/shared_loop.hpp"
#include "fem/footwall.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <sys/resource.h>
#include <system_error>
#include <vector>

namespace listric::exit_code_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <class Exception> Ending ending(Exception exception) {
    return ending_of(std::make_exception_ptr(exception));
}

TEST(ExitCode, UsersMistakesNumericsStorageAndStopAreToldApart) {
    EXPECT_EQ(ending(UsageError("--seeds")).code, ExitCode::bad_call);
    EXPECT_EQ(ending(SceneError("lis1.toml:3")).code, ExitCode::bad_call);
    EXPECT_EQ(ending(fem::FootwallError("no plug-in")).code, ExitCode::bad_call);
    EXPECT_EQ(ending(dem::NumericalFailure("disc 3")).code, ExitCode::numerics_failed);
    EXPECT_EQ(ending(StorageError("out")).code, ExitCode::storage_failed);
    EXPECT_EQ(ending(std::filesystem::filesystem_error("out", {})).code, ExitCode::storage_failed);
    EXPECT_EQ(ending(Interrupted{}).code, ExitCode::interrupted);
    EXPECT_EQ(ending(UsageError("--seeds 0")).message, "--seeds 0");
}

TEST(ExitCode, MemoryIsStorageAndSaysHowMuchIsNeeded) {
    EXPECT_EQ(ending(MemoryError("short")).code, ExitCode::storage_failed);
    note_memory_need(2.5e9);
    for (const Ending& e :
         {ending(std::bad_alloc()), ending(std::system_error(ENOMEM, std::generic_category()))}) {
        EXPECT_EQ(e.code, ExitCode::storage_failed);
        EXPECT_THAT(e.message, HasSubstr("2500 MB"));
    }
    note_memory_need(0.0);
}

// With a limit of addresses it is the stack's memory that is short.
TEST(ExitCode, AThreadThatIsNotAllowedIsNoShortMemory) {
    const Ending e = ending(std::system_error(EAGAIN, std::generic_category()));
    EXPECT_EQ(e.code, ExitCode::storage_failed);
    rlimit addresses{};
    getrlimit(RLIMIT_AS, &addresses);
    EXPECT_THAT(e.message, addresses.rlim_cur == RLIM_INFINITY
                               ? HasSubstr("no further thread or process can be started")
                               : HasSubstr("memory is short"));
}

TEST(ExitCode, WhateverElseIsOurOwnMistake) {
    for (const Ending& e :
         {ending(std::logic_error("planted")), ending(std::out_of_range("planted")),
          ending(std::runtime_error("planted"))}) {
        EXPECT_EQ(e.code, ExitCode::internal_error);
        EXPECT_THAT(e.message, AllOf(HasSubstr("internal error: planted"), HasSubstr("our mistake"),
                                     HasSubstr("log.txt"), HasSubstr("scene.toml")));
    }
    EXPECT_EQ(ending(3).code, ExitCode::internal_error);
}

TEST(ExitCode, GuardedWorkEndsInItsCode) {
    EXPECT_EQ(run_guarded([] { return ExitCode::done; }), 0);
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_guarded([]() -> ExitCode { throw std::logic_error("planted"); }), 70);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("listric: internal error: pl"));
    EXPECT_EQ(run_guarded([]() -> ExitCode { throw Interrupted{}; }), 130);
}

// A process of its own: faults planted where nobody can catch them.
TEST(ExitCodeDeathTest, FaultsOnThreadsEndTheProgramWithTheirCode) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto on_a_thread = [](auto exception) {
        guard_threads();
        note_memory_need(7e6);
        const dem::Team team(2);
        dem::run_team(2, [&](int thread) {
            if (thread == 1)
                throw exception;
        });
    };
    EXPECT_EXIT(on_a_thread(std::bad_alloc()), testing::ExitedWithCode(4), "about 7 MB");
    EXPECT_EXIT(on_a_thread(std::logic_error("planted")), testing::ExitedWithCode(70),
                "internal error: planted");
}

} // namespace
} // namespace listric::exit_code_test

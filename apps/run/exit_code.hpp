#pragma once

#include <exception>
#include <functional>
#include <string>

namespace listric {

/// How a call ended.
enum class ExitCode {
    done = 0,
    differs = 1,         ///< listric diff has found a difference
    bad_call = 2,        ///< UsageError, SceneError: the user's to correct
    numerics_failed = 3, ///< NumericalFailure
    storage_failed = 4,  ///< StorageError; memory does not suffice
    internal_error = 70, ///< anything else: our own mistake
    interrupted = 130,   ///< Interrupted
};

struct Ending {
    ExitCode code;
    std::string message; ///< for people, without a newline; may be empty
};

/// Exit code and message of the exception that ended a call.
Ending ending_of(const std::exception_ptr& exception);

/// Writes the message, if there is one, to stderr.
void tell(const Ending& ending);

/// Does the work; what it throws ends in a message on stderr and in its exit code.
int run_guarded(const std::function<ExitCode()>& work);

/// From now on an exception that cannot be caught, since it was thrown on a thread of its own, ends
/// the program with the same message and exit code.
void guard_threads();

} // namespace listric

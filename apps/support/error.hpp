#pragma once

#include <stdexcept>
#include <string>

namespace listric {

/// A call that cannot be carried out; what() says why and what to do.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A scene that cannot be used; what() is one line: "file:line: parameter: what is wrong, cure".
struct SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

[[noreturn]] inline void refuse(const std::string& place, const std::string& what) {
    throw SceneError(place + ": " + what);
}

/// A file could not be written or read; what() names it and the cause.
struct StorageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that is there cannot be opened or read: nothing is known of what it holds.
struct UnreadableFile : StorageError {
    using StorageError::StorageError;
};

/// There is less memory than is needed; what() says how much that is.
struct MemoryError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Somebody asked for an end, and what was under way has been left in order.
struct Interrupted {};

} // namespace listric

#pragma once

#include "apps/support/error.hpp"

#include <atomic>
#include <csignal>

namespace listric {

/// The signal by which processes of the program ask each other to stop.
inline constexpr int request_to_stop = SIGUSR2;

/// Tells work that takes long whether somebody has asked for its end. Without a flag nobody can.
/// The flag must outlive the token; a signal handler may set it.
class StopToken {
public:
    StopToken() = default;
    explicit StopToken(const std::atomic<bool>& flag) : flag_(&flag) {}

    bool requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }

    /// Throws Interrupted if it is requested: for moments at which all is in order.
    void check() const {
        if (requested())
            throw Interrupted{};
    }

private:
    const std::atomic<bool>* flag_ = nullptr;
};

} // namespace listric

#pragma once

#include <atomic>

namespace listric {

/// Tells work that takes long whether somebody has asked for its end. Without a flag nobody can.
/// The flag must outlive the token; a signal handler may set it.
class StopToken {
public:
    StopToken() = default;
    explicit StopToken(const std::atomic<bool>& flag) : flag_(&flag) {}

    bool requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }

private:
    const std::atomic<bool>* flag_ = nullptr;
};

} // namespace listric

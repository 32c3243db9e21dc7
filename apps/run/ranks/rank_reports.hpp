#pragma once

#include <map>
#include <optional>

namespace listric {

// A process that starts mpirun hears from its ranks who they are and how they end, since mpirun's
// exit code alone does not say what has ended them: over a pipe, which the environment names.

/// The end of the pipe of those that listen. While it lives, processes that are started find it.
class RankReports {
public:
    RankReports();
    ~RankReports();
    RankReports(const RankReports&) = delete;
    RankReports& operator=(const RankReports&) = delete;

    /// Listens until a process, mpirun, has ended, for which it does not wait.
    void listen_until_end_of(int process);

    /// Whether any rank has begun.
    bool any() const { return !ranks_.empty(); }
    /// The root's exit code, if it has come to its end.
    std::optional<int> root_code() const;
    /// The rank that has ended first without coming to its end.
    std::optional<int> lost() const { return lost_; }

private:
    struct Rank {
        int watch = -1; ///< a descriptor that tells the end of its process
        std::optional<int> code;
    };
    void hear();
    void look_for_ended();

    int read_ = -1, write_ = -1;
    std::map<int, Rank> ranks_;
    std::optional<int> lost_;
};

/// Tells whoever listens, if somebody does, that this process is a rank and has begun.
void report_begin(int rank);
/// That it ends, with an exit code.
void report_end(int rank, int code);

} // namespace listric

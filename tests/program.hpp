#pragma once

// The program as a child process, for tests of signals, limits and exit codes.

#include "tests/places.hpp"
#include "tests/small_halfgraben.hpp"

#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace listric::support {

/// How a program ended and what it said.
struct Ended {
    int code; ///< exit code, or minus the signal
    std::string out, err;
};

/// The program as a child process.
class Program {
public:
    /// `prepare` runs in the child before the program starts.
    Program(const std::filesystem::path& folder, std::vector<std::string> words,
            const std::function<void()>& prepare = {})
        : folder_(folder) {
        words.insert(words.begin(), program_path);
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        id_ = fork();
        if (id_ == 0) {
            redirect("stdout", STDOUT_FILENO);
            redirect("stderr", STDERR_FILENO);
            // Where tests run in the background nobody hears of what they send.
            for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
                std::signal(signal, SIG_DFL);
            if (prepare)
                prepare();
            execv(arguments[0], arguments.data());
            _exit(127);
        }
    }

    void send(int signal) const { kill(id_, signal); }

    bool runs() const {
        siginfo_t info{};
        waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT);
        return info.si_pid == 0;
    }

    Ended wait() const {
        int status = 0;
        waitpid(id_, &status, 0);
        return {WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status),
                contents(folder_ / "stdout"), contents(folder_ / "stderr")};
    }

private:
    void redirect(const char* name, int descriptor) const {
        dup2(open((folder_ / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), descriptor);
    }

    std::filesystem::path folder_;
    pid_t id_;
};

} // namespace listric::support

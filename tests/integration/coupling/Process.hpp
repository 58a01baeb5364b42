// SPDX-License-Identifier: BSD-3-Clause
/// A child process whose end and output a test can wait for.
#pragma once

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace gimdem::test
{

/// Waits until the condition holds, at most so long [s]; tells whether it does.
inline bool wait_until(std::function<bool()> const& condition, double seconds)
{
    auto const deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition())
    {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

/// Starts in the constructor; the destructor kills what still runs. Standard output and error go to the file.
class Process
{
public:
    Process(std::vector<std::string> command, std::filesystem::path output_file) : output_file_(std::move(output_file))
    {
        std::vector<char*> arguments;
        for (std::string& word : command)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        int const output = ::open(output_file_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
        id_ = ::fork();
        if (id_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
        if (id_ == 0) become(arguments.data(), output);
        ::close(output);
    }

    ~Process()
    {
        if (!exit_code_) signal(SIGKILL);
        wait(60);
    }
    Process(Process const&) = delete;
    Process& operator=(Process const&) = delete;

    pid_t id() const { return id_; }
    void signal(int number) const { ::kill(id_, number); }

    /// Exit code, or 128 + the signal that ended it; empty if it still runs after so long [s].
    std::optional<int> wait(double seconds)
    {
        wait_until([this] { return has_ended(); }, seconds);
        return exit_code_;
    }

    /// All that it has printed so far.
    std::string output() const
    {
        std::ifstream file(output_file_);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    bool wait_for_output(std::string const& part, double seconds) const
    {
        return wait_until([&] { return output().find(part) != std::string::npos; }, seconds);
    }

private:
    /// In the child: only calls that are safe after fork().
    [[noreturn]] static void become(char** arguments, int output)
    {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        ::dup2(output, STDOUT_FILENO);
        ::dup2(output, STDERR_FILENO);
        ::execv(arguments[0], arguments);
        ::_exit(127);
    }

    bool has_ended()
    {
        int status = 0;
        if (!exit_code_ && ::waitpid(id_, &status, WNOHANG) == id_)
            exit_code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
        return exit_code_.has_value();
    }

    std::filesystem::path output_file_;
    pid_t id_ = -1;
    std::optional<int> exit_code_;
};

}  // namespace gimdem::test

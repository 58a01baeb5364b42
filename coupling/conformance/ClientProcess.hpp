// SPDX-License-Identifier: BSD-3-Clause
/// A child process: a client under trial, or the mock server that tries it.
#pragma once

#include <sys/types.h>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gimdem::conformance
{

/// Runs in a process group of its own, with which it is killed by the destructor at the latest.
class ChildProcess
{
public:
    /// Starts a program; both its outputs go to the file.
    static ChildProcess start(std::vector<std::string> const& command, std::string const& output_file);
    /// Runs a function in a child; it must be called while this process has one thread.
    static ChildProcess fork(std::function<int()> const& body);

    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess(ChildProcess const&) = delete;
    ChildProcess& operator=(ChildProcess const&) = delete;
    ~ChildProcess();

    /// Empty while it runs; then its exit code, or 128 + the signal that ended it.
    std::optional<int> exit_code();
    /// Whether it was stopped (SIGSTOP) since it began.
    bool was_stopped();
    void kill() noexcept;

private:
    explicit ChildProcess(pid_t id) : id_(id) {}
    void look();

    pid_t id_;
    std::optional<int> code_;
    bool stopped_ = false;
};

}  // namespace gimdem::conformance

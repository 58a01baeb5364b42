// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/ClientProcess.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

namespace gimdem::conformance
{
namespace
{

/// In a new child.
void settle_in()
{
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

pid_t fork_or_throw()
{
    pid_t const id = ::fork();
    if (id < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (id > 0) ::setpgid(id, id);
    return id;
}

}  // namespace

ChildProcess ChildProcess::start(std::vector<std::string> const& command, std::string const& output_file)
{
    std::vector<char*> arguments;
    for (std::string const& word : command)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    int const output = ::open(output_file.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
    int const nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    pid_t const id = fork_or_throw();
    if (id == 0)
    {
        settle_in();
        ::dup2(nothing, STDIN_FILENO);
        ::dup2(output, STDOUT_FILENO);
        ::dup2(output, STDERR_FILENO);
        ::execvp(arguments[0], arguments.data());
        ::_exit(127);
    }
    ::close(output);
    ::close(nothing);
    return ChildProcess(id);
}

ChildProcess ChildProcess::fork(std::function<int()> const& body)
{
    pid_t const id = fork_or_throw();
    if (id == 0)
    {
        settle_in();
        ::_exit(body());
    }
    return ChildProcess(id);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), code_(other.code_), stopped_(other.stopped_)
{
}

ChildProcess::~ChildProcess()
{
    kill();
}

std::optional<int> ChildProcess::exit_code()
{
    look();
    return code_;
}

bool ChildProcess::was_stopped()
{
    look();
    return stopped_;
}

void ChildProcess::look()
{
    int status = 0;
    if (id_ < 0 || code_ || ::waitpid(id_, &status, WNOHANG | WUNTRACED) != id_) return;
    if (WIFSTOPPED(status))
        stopped_ = true;
    else
        code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

void ChildProcess::kill() noexcept
{
    if (id_ < 0) return;
    ::kill(-id_, SIGKILL);  // also what it started and left
    int status = 0;
    if (!code_ && ::waitpid(id_, &status, 0) == id_) code_ = 128 + SIGKILL;
    id_ = -1;
}

}  // namespace gimdem::conformance

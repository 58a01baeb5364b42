// SPDX-License-Identifier: BSD-3-Clause
/// The process at the other end.
#pragma once

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

namespace gimdem::bench
{

class FarEnd
{
public:
    /// Runs serve() in a child, which tells its endpoint through tell(); waits for that. Fork before any thread runs.
    explicit FarEnd(std::function<void(std::function<void(std::string const&)> tell)> const& serve)
    {
        std::array<int, 2> pipe{};
        if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
        id_ = ::fork();
        if (id_ < 0) throw std::runtime_error("no second process");
        if (id_ == 0) become(serve, pipe[1]);
        ::close(pipe[1]);
        std::array<char, 256> text{};
        auto const length = ::read(pipe[0], text.data(), text.size());
        ::close(pipe[0]);
        if (length <= 0) throw std::runtime_error("the second process ended at once");
        endpoint_.assign(text.data(), static_cast<std::size_t>(length));
    }
    ~FarEnd()
    {
        ::kill(id_, SIGTERM);
        ::waitpid(id_, nullptr, 0);
    }
    FarEnd(FarEnd const&) = delete;
    FarEnd& operator=(FarEnd const&) = delete;

    std::string const& endpoint() const { return endpoint_; }

private:
    [[noreturn]] static void become(std::function<void(std::function<void(std::string const&)>)> const& serve, int pipe)
    {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        try
        {
            serve(
                [pipe](std::string const& endpoint)
                {
                    if (::write(pipe, endpoint.data(), endpoint.size()) < 0) ::_exit(1);
                    ::close(pipe);
                });
        }
        catch (std::exception const& error)
        {
            std::fprintf(stderr, "exchange_times: the far end: %s\n", error.what());
            ::_exit(1);
        }
        ::_exit(0);
    }

    pid_t id_ = -1;
    std::string endpoint_;
};

}  // namespace gimdem::bench

// SPDX-License-Identifier: BSD-3-Clause
/// What a session says when it ends before its time.
#include "session/Session.hpp"

#include <cstdio>

namespace gimdem::coupling::session
{
namespace
{

using message::Message;

std::string named(Role role, std::string const& name)
{
    std::string const who = role == Role::client ? "client" : "server";
    return name.empty() ? "the " + who : who + " \"" + name + "\"";
}

Role other(Role role)
{
    return role == Role::client ? Role::server : Role::client;
}

}  // namespace

std::string seconds_text(double seconds)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g s", seconds);
    return text;
}

void Session::fail(Fault fault, std::string const& text)
{
    tell(fault, text);
    fall(text);
    throw CouplingError(fault, text);
}

void Session::fail_by_peer(Message const& message, std::string const& awaited)
{
    message::ErrorReport const report = message::unpack_error(message);
    bool const special = report.fault == Fault::mesh || report.fault == Fault::version;
    set_peer_name(report.name);
    std::string const text = peer_name() + (report.fault == Fault::mesh ? " refused the mesh: " : " ended the run: ") +
                             report.reason + " (it was in state " + report.state + ", step " +
                             std::to_string(report.step) + "); " + our_name() + " was waiting for " + awaited + " " +
                             here();
    fall(text);
    throw CouplingError(special ? report.fault : Fault::peer, text);
}

void Session::fail_by_ending(transport::Ending const& ending, std::string const& awaited)
{
    has_lost_peer_ = true;
    std::string const us = our_name() + " was waiting for " + awaited + " " + here();
    if (ending.kind == transport::Ending::Kind::silent)
        fail(Fault::timeout, peer_name() + " at " + endpoint_ + " has been silent for " + seconds_text(ending.silence) +
                                 " (time-out " + seconds_text(timeout_) + "; " + last_word() + "); " + us +
                                 "; see whether it was stopped or hangs, or raise the time-out");
    if (ending.kind == transport::Ending::Kind::refused)
        fail(Fault::endpoint, peer_name() + " at " + endpoint_ + " has turned us away (it does not know our key); " +
                                  us + "; have its user put our client.public among its clients, see docs/security.md");
    std::string const detail = ending.detail.empty() ? "" : ", " + ending.detail;
    fail(Fault::peer, peer_name() + " at " + endpoint_ + " has disappeared (its connection broke" + detail + "; " +
                          last_word() + "); " + us + "; its own output should tell why it ended");
}

void Session::fail_by_delay(std::string const& awaited, double patience)
{
    has_lost_peer_ = true;
    fail(Fault::timeout, peer_name() + " at " + endpoint_ + " has not sent " + awaited + " within " +
                             seconds_text(patience) + " (" + last_word() + "); " + our_name() + " was waiting " +
                             here() + "; see what it is doing, or allow more time");
}

void Session::fall(std::string const& why)
{
    last_fault_ = why;
    std::lock_guard<std::mutex> const lock(mutex_);
    state_ = State::failed;
    state_since_ = transport::Clock::now();
    ++progress_;
}

void Session::tell(Fault fault, std::string const& reason)
{
    if (!channel_ || !inbox_.has_contact()) return;
    message::ErrorReport report;
    report.fault = fault;
    report.reason = reason;
    report.state = name_of(state());
    report.name = name_;
    send(message::pack(report));
}

void Session::abort(Fault fault, std::string const& reason) noexcept
{
    try
    {
        if (!is_over())
        {
            tell(fault, reason);
            fall(reason);
        }
    }
    catch (std::exception const&)
    {
        // The peer will see the connection break.
    }
    close();
}

std::string Session::our_name() const
{
    return named(role_, name_);
}

std::string Session::peer_name() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return named(other(role_), peer_.empty() ? peer_heartbeat_.name : peer_);
}

std::string Session::connection_note() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return connection_note_.empty() ? "" : " (" + connection_note_ + ")";
}

void Session::set_peer_name(std::string const& name)
{
    std::lock_guard<std::mutex> const lock(mutex_);
    if (!name.empty()) peer_ = name;
}

/// "in state waiting, step 17".
std::string Session::here() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    return "in state " + name_of(state_) + ", step " + std::to_string(step_);
}

std::string Session::last_word() const
{
    std::lock_guard<std::mutex> const lock(mutex_);
    if (peer_heartbeat_.state.empty()) return "it has said nothing of its state";
    return "its last heartbeat told state " + peer_heartbeat_.state + ", step " + std::to_string(peer_heartbeat_.step) +
           ", progress " + std::to_string(peer_heartbeat_.progress);
}

}  // namespace gimdem::coupling::session

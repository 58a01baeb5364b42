// SPDX-License-Identifier: BSD-3-Clause
#include "ScriptedChannel.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "message/Codec.hpp"
#include "message/Control.hpp"

namespace gimdem::fuzz
{

using coupling::CouplingError;
using coupling::transport::Clock;
using coupling::transport::Frames;
using coupling::transport::Role;

namespace
{

Frames copy_of(Frames const& frames)
{
    Frames copy;
    for (auto const& frame : frames)
        copy.emplace_back(frame.data(), frame.size());
    return copy;
}

bool is_right_heartbeat(Frames const& frames)
{
    if (coupling::message::peek_kind(frames.front()) != coupling::message::Kind::kHeartbeat) return false;
    try
    {
        coupling::message::unpack_heartbeat(coupling::message::decode(copy_of(frames)));
        return true;
    }
    catch (CouplingError const&)
    {
        return false;
    }
}

}  // namespace

void report(char const* what)
{
    std::cerr << "finding: " << what << std::endl;
    std::abort();
}

Wire& Wire::of_session()
{
    static Wire wire;
    return wire;
}

void Wire::open(void const* channel, Role role, coupling::transport::ChannelHooks hooks)
{
    if (open_) return;
    auto coming = std::move(coming_);
    auto ending = std::move(ending_);
    *this = Wire();
    channel_ = channel;
    role_ = role;
    hooks_ = std::move(hooks);
    coming_ = std::move(coming);
    ending_ = std::move(ending);
    open_ = true;
}

void Wire::put(Frames frames)
{
    bool const is_letter = !frames.empty() && !is_right_heartbeat(frames);
    coming_.push_back({std::move(frames), is_letter});
}

void Wire::deliver()
{
    while (open_ && !coming_.empty())
    {
        Post post = std::move(coming_.front());
        coming_.pop_front();
        if (post.frames.empty() || !is_open_to(post)) continue;
        contact_ = true;
        if (post.is_letter) ++delivered_;
        hooks_.deliver(std::move(post.frames), Clock::now());
    }
}

void Wire::deliver_to_stranger(Frames frames)
{
    if (!open_) return;
    Frames const answer = hooks_.answer_stranger(std::move(frames));
    if (!answer.empty()) coupling::message::decode(copy_of(answer));
    coupling::message::decode(hooks_.heartbeat());
}

void Wire::end(coupling::transport::Ending ending)
{
    if (open_)
        hooks_.ended(std::move(ending));
    else
        ending_ = std::move(ending);
}

bool Wire::is_open_to(Post const& post) const
{
    return contact_ || role_ == Role::client || hooks_.may_open(post.frames.front());
}

std::size_t Wire::supply() const
{
    auto const counts = [this](Post const& post) { return post.is_letter && is_open_to(post); };
    return delivered_ + static_cast<std::size_t>(std::count_if(coming_.begin(), coming_.end(), counts));
}

bool Wire::has_sent(coupling::message::Kind kind) const
{
    return std::find(sent_.begin(), sent_.end(), kind) != sent_.end();
}

void Wire::send(void const* channel, Frames frames)
{
    if (channel != channel_) return;
    if (!open_) report("a message is sent over a closed channel");
    auto const message = coupling::message::decode(std::move(frames));  // throws: what we send we would refuse
    sent_.push_back(message.kind());
    if (message.kind() == coupling::message::Kind::kWelcome) session_ = message.envelope.session();
    deliver();
    if (ending_) hooks_.ended(*std::exchange(ending_, std::nullopt));
}

}  // namespace gimdem::fuzz

namespace gimdem::coupling::transport
{

Socket::Socket(Role role, Address const& address) : role_(role), endpoint_(address.text), context_(1) {}
Socket::~Socket() = default;

Socket Socket::connect(std::string const& endpoint, std::optional<ClientKeys> const&)
{
    return Socket(Role::client, {endpoint, "", false});
}

Socket Socket::bind(std::string const& endpoint, std::optional<ServerKeys> const&)
{
    return Socket(Role::server, {endpoint, "", false});
}

Channel::Channel(Socket socket, double timeout, ChannelHooks hooks)
    : socket_(std::move(socket)), endpoint_(socket_.endpoint()), liveness_(timeout, Clock::now())
{
    fuzz::Wire::of_session().open(this, socket_.role(), std::move(hooks));
}

Channel::~Channel()
{
    fuzz::Wire::of_session().close(this);
}

void Channel::send(Frames frames)
{
    fuzz::Wire::of_session().send(this, std::move(frames));
}

void Channel::close(Clock::duration) noexcept
{
    fuzz::Wire::of_session().close(this);
}

}  // namespace gimdem::coupling::transport

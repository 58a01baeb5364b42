// SPDX-License-Identifier: BSD-3-Clause
/// A channel without sockets and threads: it takes the place of transport/Channel.cpp and transport/Socket.cpp, so that
/// a whole session runs a hundred thousand times a second, and each time the same.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "message/Message.hpp"
#include "transport/Channel.hpp"

namespace gimdem::fuzz
{

/// The peer of the one session that is open.
class Wire
{
public:
    static Wire& of_session();

    /// The peer's next message: it arrives at deliver(), or as the answer to the next message of the session.
    void put(coupling::transport::Frames frames);
    void deliver();
    void deliver_to_stranger(coupling::transport::Frames frames);
    /// Nothing more will come, at once or, of a session that is not open yet, once it has spoken.
    void end(coupling::transport::Ending ending);
    bool is_open() const { return open_; }

    /// Letters that the session has not been seen to take, or that are still to come.
    std::size_t supply() const;
    /// A call of the session took so many letters.
    void taken(std::size_t letters) { delivered_ -= std::min(delivered_, letters); }

    bool has_sent(coupling::message::Kind kind) const;
    std::uint64_t session() const { return session_; }  ///< number that the server chose

    // The channel's side. Only the first one is attended to: those of further ranks never hear of anybody.
    void open(void const* channel, coupling::transport::Role role, coupling::transport::ChannelHooks hooks);
    void send(void const* channel, coupling::transport::Frames frames);
    void close(void const* channel) { open_ = open_ && channel != channel_; }

private:
    /// What will come, and whether it is a letter at all: everything but a right heartbeat, which changes nothing.
    struct Post
    {
        coupling::transport::Frames frames;
        bool is_letter;
    };
    /// Is there a session, or may it open one?
    bool is_open_to(Post const& post) const;

    void const* channel_ = nullptr;
    coupling::transport::Role role_{};
    coupling::transport::ChannelHooks hooks_;
    bool open_ = false;
    bool contact_ = false;
    std::uint64_t session_ = 0;
    std::size_t delivered_ = 0;
    std::deque<Post> coming_;
    std::optional<coupling::transport::Ending> ending_;
    std::vector<coupling::message::Kind> sent_;
};

/// A finding: tells what must not be, and aborts.
[[noreturn]] void report(char const* what);

}  // namespace gimdem::fuzz

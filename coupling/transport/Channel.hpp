// SPDX-License-Identifier: BSD-3-Clause
/// A live connection to one peer, served by a thread of its own.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "transport/Liveness.hpp"
#include "transport/Socket.hpp"
#include "transport/Wakeup.hpp"

namespace gimdem::coupling::transport
{

/// Why nothing more will come from the peer.
struct Ending
{
    enum class Kind
    {
        lost,    ///< the connection broke: the peer's process is gone
        silent,  ///< the connection stands but the peer says nothing
        refused  ///< client: the server does not let our key in
    };
    Kind kind = Kind::lost;
    double silence = 0;  ///< [s]
    std::string detail;  ///< from the system, if there is any
};

/// What the channel asks of its owner. All are called on the I/O thread, one at a time, and must not block.
struct ChannelHooks
{
    /// The peer sent this, and it arrived then. Returns the peer's time-out if the message tells it [s].
    std::function<std::optional<double>(Frames, Time)> deliver;
    /// Writes a heartbeat.
    std::function<Frames()> heartbeat;
    /// May a message that begins with this frame be the first of a peer?
    std::function<bool(Frame const&)> may_open;
    /// Someone other than the peer sent this to the server. Returns the answer, or nothing.
    std::function<Frames(Frames)> answer_stranger;
    /// Something for the user's eyes, Socket::take_notes(). May be empty.
    std::function<void(std::string const&)> note;
    /// Anybody, who does not become the peer by this, may ask something of the server. Returns the answer, which may be
    /// empty, if this is a question; else leaves the frames as they are. Null: nobody may ask.
    std::function<std::optional<Frames>(Frames&)> answer_question;
    /// Nothing more will come. Called once.
    std::function<void(Ending)> ended;
};

/// Sends, receives, beats and watches, whatever the owner's thread is doing. The first to speak to a server is its
/// peer until the channel closes.
class Channel
{
public:
    /// timeout: a peer silent for this long is dead [s].
    Channel(Socket socket, double timeout, ChannelHooks hooks);
    ~Channel();
    Channel(Channel const&) = delete;
    Channel& operator=(Channel const&) = delete;

    std::string const& endpoint() const { return endpoint_; }

    /// To the peer; any thread. On a server, not before the peer has spoken.
    void send(Frames frames);

    /// Sends what is queued, waits so long at most for it to leave, and ends the thread.
    void close(Clock::duration linger) noexcept;

private:
    void start_thread();
    void run() noexcept;
    void turn();
    void send_queued();
    void tell_notes();
    void receive_some(int most);
    bool answer_question(Parcel& parcel);
    void receive_from(Parcel parcel, Time now);
    void handle_broken_connection();
    void beat(Time now);
    void lose();
    void end(Ending ending);

    Socket socket_;
    std::string const endpoint_;
    ChannelHooks hooks_;
    Wakeup wakeup_;
    Liveness liveness_;
    std::string peer_;    ///< routing id, on a server
    Time probe_until_;    ///< server: beat fast until then, to find out whose connection broke
    bool ended_ = false;  ///< the owner knows that nothing more will come
    bool lost_ = false;   ///< there is no connection to send to

    std::mutex mutex_;
    std::deque<Frames> queue_;  ///< guarded by mutex_
    std::atomic<bool> closing_{false};
    std::thread thread_;
};

}  // namespace gimdem::coupling::transport

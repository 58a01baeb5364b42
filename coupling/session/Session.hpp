// SPDX-License-Identifier: BSD-3-Clause
/// What both sides of a session have in common: state, order, and what to say when something goes wrong.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "message/Control.hpp"
#include "session/Inbox.hpp"
#include "session/States.hpp"
#include "session/StatusDesk.hpp"
#include "transport/Channel.hpp"
#include "transport/Mailbox.hpp"

namespace gimdem::coupling::session
{

/// Arrays of this size may come at any time; the checks of a message tell more than its size does [byte].
inline constexpr std::size_t least_limit = std::size_t{1} << 20;

using transport::Role;
using transport::Time;

/// "0.5 s".
std::string seconds_text(double seconds);

/// One session, used by the program's thread; the channel's I/O thread enters through the on_...() functions only.
class Session
{
public:
    /// name: ours. timeout: a peer silent for this long is dead [s].
    Session(Role role, std::string name, double timeout);
    /// Tells the peer, if the session has not ended.
    ~Session();
    Session(Session const&) = delete;
    Session& operator=(Session const&) = delete;

    /// Starts to talk over the socket. log: what the program's user may like to know, told on the I/O thread.
    void open(transport::Socket socket, std::function<void(std::string const&)> log = {});

    State state() const;
    std::string const& endpoint() const { return endpoint_; }
    bool is_ipc() const { return endpoint_.rfind("ipc:", 0) == 0; }
    double bytes() const { return bytes_; }
    std::uint64_t session_number() const { return session_number_; }
    /// The peer is gone, silent or slow; it has not said why.
    bool has_lost_peer() const { return has_lost_peer_; }

    /// Fault::user, which ends nothing, if the call is not legal now.
    void require(Event call);
    /// The call has happened.
    void advance(Event call);
    /// The coupling step that both sides are at.
    void set_step(std::int64_t step);
    /// Server: the session number that every later message carries.
    void choose_session_number();

    /// A step's message comes soon: whoever sleeps over there may wake up meanwhile.
    void announce_soon();
    /// Fills the fields of a step, which send() then sends; where it can, the peer reads the envelope meanwhile.
    /// Fault::user if a number cannot be sent: nothing has been sent, and nothing happens.
    void prepare(message::Message& message);
    void send(message::Message message);

    /// From now on messages that may be posted go through these; null: they do not.
    void use(std::unique_ptr<transport::Outbox> outbox) { outbox_ = std::move(outbox); }
    /// take_in(message, n) is called while the peer packs a message, n of whose arrays are there; it throws
    /// Fault::protocol for what cannot be used.
    void use(std::unique_ptr<transport::Postbox> postbox, std::function<void(message::Message&, std::size_t)> take_in)
    {
        postbox_ = std::move(postbox);
        take_in_ = std::move(take_in);
    }

    /// From now on a message of the peer with more bytes in its arrays is refused unread. It may always have a few.
    void limit_arrays(std::size_t bytes);

    /// The next message, checked against the state table. awaited: what we wait for, in words.
    Letter receive(std::string const& awaited, Time deadline, double patience);
    /// False if the peer has not appeared by then.
    bool wait_for_contact(Time deadline);
    /// What receive() and wait_for_contact() call every 20 ms while nothing comes; what it throws ends the waiting.
    void set_watch(std::function<void()> watch) { watch_ = std::move(watch); }
    /// Throws if the peer is gone, or has sent what is not allowed now; leaves unread what it has sent otherwise.
    void look_for_loss(std::string const& awaited);
    /// Throws what receive() would throw at once: a fault that is known before we send more.
    void look_for_trouble(std::string const& awaited);

    /// Runs an unpack function; a Fault::protocol of it ends the session.
    template <class Unpack>
    auto read(Unpack unpack) -> decltype(unpack());
    /// Remembers a fault that did not end the session, as the likely reason if it ends soon.
    void note(std::string const& text) { last_fault_ = text; }

    /// Server: what it answers to a StatusRequest.
    StatusDesk& status_desk() { return desk_; }

    /// Ends the session: tells the peer, and throws.
    [[noreturn]] void fail(Fault fault, std::string const& text);
    /// Ends the session: tells the peer, waits one second at most for the words to leave.
    void abort(Fault fault, std::string const& reason) noexcept;
    /// Ends the session in order.
    void close() noexcept;

    /// `client "solver"`, `server "gimdem-server 0.1"`: for texts.
    std::string our_name() const;
    std::string peer_name() const;
    void set_peer_name(std::string const& name);
    /// What the connection met with last, " (...)"; empty if nothing.
    std::string connection_note() const;

private:
    bool is_over() const;
    Delivery next_letter(Time deadline);
    Delivery watched_letter(Time deadline);
    std::optional<Letter> take_post();
    void stamp(message::Message& message) const;
    void note_heard(Time arrival);
    void fall(std::string const& why);
    void tell(Fault fault, std::string const& reason);
    void check_letter(Letter const& letter, std::string const& awaited);
    void check_session_number(message::Message const& message, std::string const& awaited);
    [[noreturn]] void fail_by_peer(message::Message const& message, std::string const& awaited);
    [[noreturn]] void fail_by_ending(transport::Ending const& ending, std::string const& awaited);
    [[noreturn]] void fail_by_delay(std::string const& awaited, double patience);
    std::string here() const;
    std::string last_word() const;

    // On the I/O thread.
    std::optional<double> on_frames(transport::Frames frames, Time arrival);
    std::optional<double> on_message(message::Message message, Time arrival);
    transport::Frames on_heartbeat_due() const;
    void on_note(std::string const& text);
    transport::Frames on_stranger(transport::Frames frames) const;
    std::optional<transport::Frames> on_question(transport::Frames& frames);
    Status status() const;

    Role const role_;
    std::string const name_;
    double const timeout_;
    Span<Rule const> const rules_;
    std::string endpoint_;
    std::string last_fault_;
    double bytes_ = 0;
    bool has_lost_peer_ = false;
    std::atomic<std::size_t> most_array_bytes_{least_limit};
    std::function<void(std::string const&)> log_;
    std::uint64_t session_number_ = 0;

    mutable std::mutex mutex_;  ///< guards what follows
    State state_;
    Time state_since_ = transport::Clock::now();
    std::optional<Time> heard_;  ///< the peer, the last time
    std::int64_t step_ = 0;
    std::uint64_t progress_ = 0;
    std::string peer_;  ///< name
    std::string connection_note_;
    message::Heartbeat peer_heartbeat_;  ///< the last one

    StatusDesk desk_;
    Inbox inbox_;
    std::unique_ptr<transport::Outbox> outbox_;    ///< null: everything goes through the channel
    std::unique_ptr<transport::Postbox> postbox_;  ///< null: everything comes through the channel
    bool is_announced_ = false;                    ///< prepare() told the peer
    std::optional<message::Message> incoming_;     ///< announced by the peer, perhaps not complete yet
    std::function<void(message::Message&, std::size_t)> take_in_;
    std::function<void()> watch_;
    std::unique_ptr<transport::Channel> channel_;  ///< last: its thread uses the rest
};

template <class Unpack>
auto Session::read(Unpack unpack) -> decltype(unpack())
{
    try
    {
        return unpack();
    }
    catch (CouplingError const& error)
    {
        fail(error.fault(), peer_name() + " sent something unusable: " + error.what() + " (" + here() +
                                "); the two programs do not fit together, see docs/protocol.md");
    }
}

}  // namespace gimdem::coupling::session

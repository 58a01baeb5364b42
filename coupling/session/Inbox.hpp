// SPDX-License-Identifier: BSD-3-Clause
/// From the I/O thread to the program's thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "message/Message.hpp"
#include "transport/Channel.hpp"

namespace gimdem::coupling::session
{

/// What the peer sent: a message, or something that is none.
struct Letter
{
    message::Message message;
    std::optional<CouplingError> refusal;  ///< why it is no message
    transport::Time arrival;
};

/// What waiting for a letter came to; empty if the time was up.
struct Delivery
{
    std::optional<Letter> letter;
    std::optional<transport::Ending> ending;  ///< there is no letter and there never will be
};

class Inbox
{
public:
    void put(Letter letter);
    void end(transport::Ending ending);
    void note_contact();

    /// Sleeps until there is a letter, or no hope of one, or it is that time. Letters come before the ending.
    Delivery wait(transport::Time deadline);
    /// Sleeps until the peer has sent anything, be it a heartbeat. False: it was that time first.
    bool wait_for_contact(transport::Time deadline);
    /// A look at the first letter, if there is one: its kind, or KIND_NOT_SET for one that is no message.
    std::optional<message::Kind> peek() const;
    bool has_ended() const;
    std::optional<transport::Ending> ending() const;
    bool has_contact() const;

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Letter> letters_;
    std::optional<transport::Ending> ending_;
    bool contact_ = false;
};

}  // namespace gimdem::coupling::session

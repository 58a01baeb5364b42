// SPDX-License-Identifier: BSD-3-Clause
/// Decides whose key opens the server: the handler that ZeroMQ asks (ZAP, ZeroMQ RFC 27).
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <zmq.hpp>

namespace gimdem::coupling::transport
{

class Gatekeeper
{
public:
    /// clients: public keys that may come in, z85 text. Made before the socket that it guards is bound.
    Gatekeeper(zmq::context_t& context, std::vector<std::string> clients);

    /// To be polled for reading.
    void* handle() const { return const_cast<zmq::socket_t&>(door_).handle(); }
    /// Answers whoever knocks. Never blocks.
    void serve();
    /// Who was turned away since the last call, a sentence each; no more of them after the hundredth.
    std::vector<std::string> take_notes();
    void note(std::string const& text);

private:
    void turn_away(std::string const& address, std::string const& key);

    zmq::socket_t door_;
    std::set<std::string> clients_;
    std::vector<std::string> notes_;
    std::set<std::string> told_;  ///< notes so far, each once: a stranger tries again and again
};

}  // namespace gimdem::coupling::transport

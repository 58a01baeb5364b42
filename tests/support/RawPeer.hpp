// SPDX-License-Identifier: BSD-3-Clause
/// A scripted end of a session that may break every rule. Link gimdem::coupling_internals.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <zmq.hpp>

#include "gimdem/v1/session.pb.h"

namespace gimdem::test
{

/// An envelope and the bytes of its arrays, built without the library under test.
struct RawMessage
{
    v1::Envelope envelope;
    std::vector<std::string> arrays;

    /// Adds an array with a true header.
    template <class T>
    void add(std::string const& name, v1::ElementType type, unsigned components, std::vector<T> const& values)
    {
        v1::ArrayHeader& header = *envelope.add_arrays();
        header.set_name(name);
        header.set_type(type);
        header.set_components(components);
        header.set_count(values.size() / components);
        header.set_dense(true);
        arrays.emplace_back(reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T));
    }

    std::vector<std::string> frames() const
    {
        std::vector<std::string> all{envelope.SerializeAsString()};
        all.insert(all.end(), arrays.begin(), arrays.end());
        return all;
    }
};

/// One ZeroMQ socket, used by hand: no heartbeats, no states, no checks.
class RawPeer
{
public:
    static RawPeer client(std::string const& endpoint) { return RawPeer(zmq::socket_type::dealer, endpoint); }
    static RawPeer server(std::string const& endpoint) { return RawPeer(zmq::socket_type::router, endpoint); }

    std::string endpoint() const { return socket_.get(zmq::sockopt::last_endpoint); }

    /// A server sends to whoever it heard last.
    void send_frames(std::vector<std::string> frames)
    {
        if (is_server_) frames.insert(frames.begin(), sender_);
        for (std::size_t k = 0; k < frames.size(); ++k)
            socket_.send(zmq::buffer(frames[k]),
                         k + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }

    /// Sets version and session number, unless they are set.
    RawMessage stamped(RawMessage message) const
    {
        if (message.envelope.protocol_major() == 0) message.envelope.set_protocol_major(1);
        if (message.envelope.session() == 0) message.envelope.set_session(session_);
        return message;
    }
    void send(RawMessage const& message) { send_frames(stamped(message).frames()); }

    /// The next message that is not a heartbeat. Empty: nothing came in time.
    std::optional<RawMessage> receive(double seconds = 20)
    {
        auto const deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < deadline)
        {
            auto message = receive_any(deadline - std::chrono::steady_clock::now());
            if (!message || message->envelope.has_heartbeat()) continue;
            if (message->envelope.has_welcome()) session_ = message->envelope.session();
            return message;
        }
        return std::nullopt;
    }

    /// The reason of the next message that is an Error; says what came instead otherwise.
    std::string receive_error(double seconds = 20)
    {
        auto const message = receive(seconds);
        if (!message) return "(nothing came)";
        if (!message->envelope.has_error())
            return "(not an Error, but kind " + std::to_string(message->envelope.kind_case()) + ")";
        return message->envelope.error().reason();
    }

    void set_session(std::uint64_t number) { session_ = number; }

private:
    RawPeer(zmq::socket_type type, std::string const& endpoint)
        : socket_(context_, type), is_server_(type == zmq::socket_type::router)
    {
        socket_.set(zmq::sockopt::linger, 1000);
        if (is_server_)
            socket_.bind(endpoint);
        else
            socket_.connect(endpoint);
    }

    std::optional<RawMessage> receive_any(std::chrono::duration<double> patience)
    {
        auto const left = std::chrono::ceil<std::chrono::milliseconds>(patience);
        socket_.set(zmq::sockopt::rcvtimeo, static_cast<int>(left.count()));
        std::vector<std::string> frames;
        zmq::message_t frame;
        do
        {
            if (!socket_.recv(frame)) return std::nullopt;
            frames.push_back(frame.to_string());
        } while (socket_.get(zmq::sockopt::rcvmore));
        if (is_server_)
        {
            sender_ = frames.front();
            frames.erase(frames.begin());
        }

        RawMessage message;
        message.envelope.ParseFromString(frames.front());
        message.arrays.assign(frames.begin() + 1, frames.end());
        return message;
    }

    zmq::context_t context_;
    zmq::socket_t socket_;
    bool is_server_;
    std::string sender_;         ///< routing id
    std::uint64_t session_ = 0;  ///< number that the server told or was given
};

}  // namespace gimdem::test

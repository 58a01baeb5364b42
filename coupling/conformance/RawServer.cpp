// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/RawServer.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <zmq.hpp>

#include "gimdem/v1/session.pb.h"
#include "message/Fields.hpp"

namespace gimdem::conformance
{
namespace
{

std::uint64_t constexpr session_number = 77;

/// One ROUTER socket, used by hand.
class RawServer
{
public:
    explicit RawServer(Script const& script) : script_(script), socket_(context_, zmq::socket_type::router)
    {
        socket_.set(zmq::sockopt::linger, 1000);
        socket_.bind(script.endpoint);
    }

    std::string endpoint() const { return socket_.get(zmq::sockopt::last_endpoint); }

    /// The next envelope that is no heartbeat; empty if none comes in time [s].
    std::optional<v1::Envelope> receive(double seconds)
    {
        auto const deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (true)
        {
            auto const left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
            if (left.count() <= 0) return std::nullopt;
            socket_.set(zmq::sockopt::rcvtimeo, static_cast<int>(left.count()));
            auto const envelope = receive_one();
            if (envelope && !envelope->has_heartbeat()) return envelope;
        }
    }

    void send(v1::Envelope envelope, std::vector<std::string> const& arrays = {})
    {
        int const major = script_.misbehaviour == Misbehaviour::wrong_version ? 2 : coupling::protocol_major;
        envelope.set_protocol_major(static_cast<unsigned>(major));
        envelope.set_session(session_number);
        std::vector<std::string> frames{client_, envelope.SerializeAsString()};
        frames.insert(frames.end(), arrays.begin(), arrays.end());
        for (std::size_t k = 0; k < frames.size(); ++k)
            socket_.send(zmq::buffer(frames[k]),
                         k + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }

private:
    std::optional<v1::Envelope> receive_one()
    {
        zmq::message_t frame;
        if (!socket_.recv(frame)) return std::nullopt;
        client_ = frame.to_string();
        std::optional<v1::Envelope> envelope;
        while (socket_.get(zmq::sockopt::rcvmore))
        {
            static_cast<void>(socket_.recv(frame));
            if (!envelope) envelope.emplace().ParseFromArray(frame.data(), static_cast<int>(frame.size()));
        }
        return envelope;
    }

    Script const& script_;
    zmq::context_t context_;
    zmq::socket_t socket_;
    std::string client_;  ///< routing id
};

v1::Envelope welcome(Script const& script)
{
    v1::Envelope envelope;
    v1::Welcome& body = *envelope.mutable_welcome();
    body.set_server("gimdem-mock-server");
    body.set_title("a mock without particles");
    body.set_schedule(v1::SCHEDULE_SERIAL);
    body.set_end_time(script.end_time);
    for (std::string const& name : script.needs)
        body.add_needs(name);
    return envelope;
}

/// The fields that the client wants, the first of them one cell short.
void send_truncated_solid(RawServer& server, v1::Hello const& hello, std::int32_t cell_count)
{
    v1::Envelope envelope;
    envelope.mutable_solid_state();
    std::vector<std::string> arrays;
    for (auto const& entry : coupling::message::solid_fields)
    {
        bool const wanted = std::find(hello.wants().begin(), hello.wants().end(), entry.name) != hello.wants().end();
        if (!wanted) continue;
        v1::ArrayHeader& header = *envelope.add_arrays();
        header.set_name(entry.name);
        header.set_type(v1::ELEMENT_TYPE_F64);
        header.set_components(entry.components);
        header.set_count(static_cast<std::uint64_t>(cell_count));
        header.set_dense(true);
        std::vector<double> const values(entry.components * static_cast<std::size_t>(cell_count), 0.5);
        std::size_t const bytes = sizeof(double) * (values.size() - (arrays.empty() ? 1 : 0));
        arrays.emplace_back(reinterpret_cast<char const*>(values.data()), bytes);
    }
    server.send(envelope, arrays);
}

bool truncate(RawServer& server, Script const& script, v1::Hello const& hello)
{
    server.send(welcome(script));
    auto const mesh = server.receive(script.connect_time);
    if (!mesh || !mesh->has_mesh()) return false;
    v1::Envelope accepted;
    accepted.mutable_mesh_accepted()->set_cell_count(mesh->mesh().cell_count());
    server.send(accepted);
    send_truncated_solid(server, hello, mesh->mesh().cell_count());
    return true;
}

}  // namespace

bool play_raw(Script const& script, FindingsFile& findings)
{
    RawServer server(script);
    findings.tell("endpoint", server.endpoint());
    auto const hello = server.receive(script.connect_time);
    if (!hello || !hello->has_hello())
    {
        findings.fail("handshake", "the first message is no Hello");
        return false;
    }
    findings.tell("timeout", std::to_string(hello->hello().timeout()));
    if (script.misbehaviour == Misbehaviour::wrong_version)
        server.send(welcome(script));
    else if (!truncate(server, script, hello->hello()))
        return false;
    findings.tell("misbehaved", "");
    // We stay, so that the client ends by what it got and not because we went.
    while (auto const answer = server.receive(script.timeout))
        if (answer->has_mesh() || answer->has_fluid_state())
            findings.fail("refusal", "it went on as if nothing were wrong");
    return true;
}

}  // namespace gimdem::conformance

// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Gatekeeper.hpp"

#include <array>
#include <optional>
#include <utility>

namespace gimdem::coupling::transport
{
namespace
{

std::size_t constexpr most_notes = 100;
std::size_t constexpr binary_key_bytes = 32;

/// The frames of a request, RFC 27: version, request, domain, address, identity, mechanism, credentials.
enum Part
{
    version,
    request,
    domain,
    address,
    identity,
    mechanism,
    credentials,
    part_count
};

std::string z85_text(std::string const& binary)
{
    std::array<char, 41> text{};
    return zmq_z85_encode(text.data(), reinterpret_cast<unsigned char const*>(binary.data()), binary.size());
}

std::optional<std::vector<std::string>> receive(zmq::socket_t& socket)
{
    std::vector<std::string> parts;
    zmq::message_t frame;
    if (!socket.recv(frame, zmq::recv_flags::dontwait)) return std::nullopt;
    parts.push_back(frame.to_string());
    while (socket.get(zmq::sockopt::rcvmore))
    {
        static_cast<void>(socket.recv(frame, zmq::recv_flags::none));  // all parts arrive together
        parts.push_back(frame.to_string());
    }
    return parts;
}

void reply(zmq::socket_t& socket, std::string const& request, bool welcome, std::string const& user)
{
    std::array<std::string, 6> const parts{"1.0", request, welcome ? "200" : "400", welcome ? "OK" : "unknown key",
                                           user,  ""};
    for (std::size_t k = 0; k < parts.size(); ++k)
        socket.send(zmq::buffer(parts[k]), k + 1 < parts.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
}

}  // namespace

Gatekeeper::Gatekeeper(zmq::context_t& context, std::vector<std::string> clients)
    : door_(context, zmq::socket_type::rep), clients_(clients.begin(), clients.end())
{
    door_.set(zmq::sockopt::linger, 0);
    door_.bind("inproc://zeromq.zap.01");
}

void Gatekeeper::serve()
{
    while (auto const parts = receive(door_))
    {
        bool const has_key = parts->size() == part_count && (*parts)[mechanism] == "CURVE" &&
                             (*parts)[credentials].size() == binary_key_bytes;
        std::string const key = has_key ? z85_text((*parts)[credentials]) : "";
        bool const welcome = has_key && clients_.count(key) == 1;
        if (!welcome && parts->size() > address) turn_away((*parts)[address], key);
        reply(door_, parts->size() > request ? (*parts)[request] : "", welcome, welcome ? key : "");
    }
}

void Gatekeeper::turn_away(std::string const& address, std::string const& key)
{
    note("turned away a client at " + (address.empty() ? "this machine" : address) +
         (key.empty() ? " without a key" : " with the unknown key " + key));
}

void Gatekeeper::note(std::string const& text)
{
    if (told_.size() >= most_notes || !told_.insert(text).second) return;
    notes_.push_back(told_.size() < most_notes ? text : "turned away many clients; more are not told");
}

std::vector<std::string> Gatekeeper::take_notes()
{
    return std::exchange(notes_, {});
}

}  // namespace gimdem::coupling::transport

// SPDX-License-Identifier: BSD-3-Clause
#include "Relay.hpp"

#include <array>
#include <chrono>

#include "gimdem/v1/session.pb.h"

namespace gimdem::test
{
namespace
{

std::vector<std::string> receive(zmq::socket_t& socket)
{
    std::vector<std::string> frames;
    zmq::message_t frame;
    do
    {
        static_cast<void>(socket.recv(frame));
        frames.push_back(frame.to_string());
    } while (socket.get(zmq::sockopt::rcvmore));
    return frames;
}

void send(zmq::socket_t& socket, std::vector<std::string> const& frames)
{
    for (std::size_t k = 0; k < frames.size(); ++k)
        socket.send(zmq::buffer(frames[k]), k + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
}

bool is_heartbeat(std::string const& frame)
{
    v1::Envelope envelope;
    return envelope.ParseFromString(frame) && envelope.has_heartbeat();
}

}  // namespace

Relay::Relay(std::string const& server, Damage damage, int message, unsigned seed)
    : front_(context_, zmq::socket_type::router),
      back_(context_, zmq::socket_type::dealer),
      damage_(damage),
      left_(message),
      random_(seed)
{
    front_.set(zmq::sockopt::linger, 0);
    back_.set(zmq::sockopt::linger, 0);
    front_.bind("tcp://127.0.0.1:*");
    endpoint_ = front_.get(zmq::sockopt::last_endpoint);
    back_.connect(server);
    thread_ = std::thread([this] { run(); });
}

Relay::~Relay()
{
    ending_ = true;
    thread_.join();
}

void Relay::run()
{
    using namespace std::chrono_literals;
    while (!ending_)
    {
        std::array<zmq::pollitem_t, 2> items{{{front_.handle(), 0, ZMQ_POLLIN, 0}, {back_.handle(), 0, ZMQ_POLLIN, 0}}};
        zmq::poll(items.data(), items.size(), 20ms);
        if ((items[0].revents & ZMQ_POLLIN) != 0) pass(front_, back_, true);
        if ((items[1].revents & ZMQ_POLLIN) != 0) pass(back_, front_, false);
    }
}

void Relay::pass(zmq::socket_t& from, zmq::socket_t& to, bool to_server)
{
    std::vector<std::string> frames = receive(from);
    if (to_server)
    {
        client_ = frames.front();
        frames.erase(frames.begin());
    }
    bool const counts = !frames.empty() && !is_heartbeat(frames.front());
    bool const due = counts && --left_ == 0;
    if (due && damage_ != Damage::doubled) spoil(frames);
    if (!to_server) frames.insert(frames.begin(), client_);
    send(to, frames);
    if (due && damage_ == Damage::doubled) send(to, frames);
    if (due) damaged_ = true;
}

void Relay::spoil(std::vector<std::string>& frames)
{
    std::size_t const k = random_() % frames.size();
    switch (damage_)
    {
        case Damage::truncated:
            frames[k].resize(frames[k].empty() ? 0 : random_() % frames[k].size());
            break;
        case Damage::corrupted:
            for (unsigned n = 1 + random_() % 8; n > 0 && !frames[k].empty(); --n)
                frames[k][random_() % frames[k].size()] = static_cast<char>(random_());
            break;
        case Damage::frame_lost:
            frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(k));
            if (frames.empty()) frames.emplace_back();
            break;
        default:
            frames.assign(1 + random_() % 3, std::string(random_() % 4096, static_cast<char>(random_())));
    }
}

}  // namespace gimdem::test

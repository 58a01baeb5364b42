// SPDX-License-Identifier: BSD-3-Clause
#include <numeric>
#include <optional>
#include <vector>

#include <zmq.hpp>

#include "Endpoint.hpp"
#include "Exchange.hpp"
#include "FarEnd.hpp"

namespace gimdem::bench
{

namespace
{

std::size_t constexpr envelope_bytes = 300;

/// Frames of one message, whose bytes lie in memory that is never copied by us.
class Frames
{
public:
    explicit Frames(std::vector<std::size_t> sizes) : sizes_(std::move(sizes))
    {
        sizes_.insert(sizes_.begin(), envelope_bytes);
        for (std::size_t const size : sizes_)
            memory_.emplace_back(size, static_cast<unsigned char>(7));
    }

    void send(zmq::socket_t& socket)
    {
        for (std::size_t k = 0; k < sizes_.size(); ++k)
        {
            zmq::message_t frame(
                memory_[k].data(), sizes_[k], [](void*, void*) {}, nullptr);
            socket.send(frame, k + 1 < sizes_.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
        }
    }
    std::size_t bytes() const { return std::accumulate(sizes_.begin(), sizes_.end(), std::size_t{0}); }

private:
    std::vector<std::size_t> sizes_;
    std::vector<std::vector<unsigned char>> memory_;
};

void receive_all(zmq::socket_t& socket)
{
    zmq::message_t frame;
    do
        static_cast<void>(socket.recv(frame));
    while (frame.more());
}

class Bare : public Exchange
{
public:
    Bare(Way const& way, Scene const& scene)
        : fluid_(scene.fluid_bytes(way.encodings)),
          solid_(scene.solid_bytes(way.encodings)),
          far_end_([&](auto const& tell) { serve(way.transport, tell); })
    {
    }

    void exchange() override
    {
        if (!socket_)
        {
            socket_.emplace(context_.emplace(), zmq::socket_type::dealer);
            socket_->connect(far_end_.endpoint());
        }
        fluid_.send(*socket_);
        receive_all(*socket_);
    }
    double bytes() const override { return static_cast<double>(fluid_.bytes() + solid_.bytes()); }

private:
    [[noreturn]] void serve(std::string const& transport, std::function<void(std::string const&)> const& tell)
    {
        zmq::context_t context;
        zmq::socket_t socket(context, zmq::socket_type::router);
        socket.bind(transport == "ipc" ? test::unused_ipc_endpoint() : test::any_tcp_endpoint());
        tell(socket.get(zmq::sockopt::last_endpoint));
        while (true)
        {
            zmq::message_t sender;
            static_cast<void>(socket.recv(sender));
            receive_all(socket);
            socket.send(sender, zmq::send_flags::sndmore);
            solid_.send(socket);
        }
    }

    Frames fluid_, solid_;
    FarEnd far_end_;
    std::optional<zmq::context_t> context_;
    std::optional<zmq::socket_t> socket_;
};

}  // namespace

std::unique_ptr<Exchange> bare(Way const& way, Scene const& scene)
{
    return std::make_unique<Bare>(way, scene);
}

}  // namespace gimdem::bench

// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Question.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include <zmq.hpp>

#include "gimdem/coupling/Error.hpp"
#include "transport/Address.hpp"
#include "transport/Clock.hpp"

namespace gimdem::coupling::transport
{
namespace
{

char const* const monitor_address = "inproc://question";

/// A DEALER with a look at what becomes of its connection.
class QuestionSocket
{
public:
    QuestionSocket(Address const& address, std::optional<ClientKeys> const& keys)
        : context_(1), socket_(context_, zmq::socket_type::dealer), monitor_(context_, zmq::socket_type::pair)
    {
        socket_.set(zmq::sockopt::linger, 0);
        monitor_.set(zmq::sockopt::linger, 0);
        socket_.set(zmq::sockopt::ipv6, address.ipv6);
        if (zmq_socket_monitor(socket_.handle(), monitor_address, ZMQ_EVENT_ALL) != 0) throw zmq::error_t();
        monitor_.connect(monitor_address);
        if (keys)
        {
            socket_.set(zmq::sockopt::curve_serverkey, keys->server);
            socket_.set(zmq::sockopt::curve_publickey, keys->own.public_key);
            socket_.set(zmq::sockopt::curve_secretkey, keys->own.secret_key);
        }
        socket_.connect(address.text);
    }
    ~QuestionSocket() { zmq_socket_monitor(socket_.handle(), nullptr, 0); }
    QuestionSocket(QuestionSocket const&) = delete;
    QuestionSocket& operator=(QuestionSocket const&) = delete;

    void send(Frames& frames)
    {
        for (std::size_t k = 0; k < frames.size(); ++k)
            socket_.send(frames[k], k + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }

    void wait(Time until)
    {
        std::array<zmq::pollitem_t, 2> items{
            {{socket_.handle(), 0, ZMQ_POLLIN, 0}, {monitor_.handle(), 0, ZMQ_POLLIN, 0}}};
        zmq::poll(items.data(), items.size(), std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()));
    }

    /// Empty: nothing has arrived.
    Frames receive()
    {
        Frames frames;
        Frame frame;
        if (!socket_.recv(frame, zmq::recv_flags::dontwait)) return frames;
        frames.push_back(std::move(frame));
        while (socket_.get(zmq::sockopt::rcvmore))
        {
            Frame next;
            static_cast<void>(socket_.recv(next));
            if (frames.size() <= max_frames) frames.push_back(std::move(next));
        }
        return frames;
    }

    /// Why there is no hope of an answer, if there is none.
    std::optional<Reply::Silence> trouble()
    {
        Frame frame;
        Frame address;
        while (monitor_.recv(frame, zmq::recv_flags::dontwait))
        {
            static_cast<void>(monitor_.recv(address));
            std::uint16_t event = 0;
            std::memcpy(&event, frame.data(), sizeof(event));
            if (event == ZMQ_EVENT_CONNECTED) connected_ = true;
            if (event == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) greeted_ = true;
            // ZeroMQ on either side: it is the keys that do not fit.
            if (event == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH || event == ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL)
                return Reply::Silence::locked_out;
            bool const closed = event == ZMQ_EVENT_CLOSED || event == ZMQ_EVENT_CONNECT_RETRIED ||
                                event == ZMQ_EVENT_DISCONNECTED || event == ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL;
            if (closed)
                return !connected_ ? Reply::Silence::nobody
                       : !greeted_ ? Reply::Silence::not_zeromq
                                   : Reply::Silence::hung_up;
        }
        return std::nullopt;
    }

    Reply::Silence patience_is_over() const
    {
        return greeted_ ? Reply::Silence::no_answer : Reply::Silence::no_greeting;
    }

private:
    bool connected_ = false;
    bool greeted_ = false;  ///< ZeroMQ's own handshake has succeeded
    zmq::context_t context_;
    zmq::socket_t socket_;
    zmq::socket_t monitor_;
};

}  // namespace

Reply ask(std::string const& endpoint, Frames question, double timeout, std::optional<ClientKeys> const& keys)
{
    Time const deadline = Clock::now() + ticks(timeout);
    Address const address = parse_address(endpoint, Role::client, keys ? Protection::keys : Protection::none);
    try
    {
        QuestionSocket socket(address, keys);
        socket.send(question);
        while (Clock::now() < deadline)
        {
            socket.wait(deadline);
            auto const trouble = socket.trouble();
            if (Frames answer = socket.receive(); !answer.empty()) return {std::move(answer), {}};
            if (trouble) return {{}, *trouble};
        }
        return {{}, socket.patience_is_over()};
    }
    catch (zmq::error_t const& error)
    {
        throw CouplingError(Fault::endpoint, "endpoint \"" + endpoint + "\" cannot be reached (" + error.what() +
                                                 "); choose another endpoint");
    }
}

}  // namespace gimdem::coupling::transport

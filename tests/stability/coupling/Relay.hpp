// SPDX-License-Identifier: BSD-3-Clause
/// Stands between a client and a server and damages one message.
#pragma once

#include <atomic>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <zmq.hpp>

namespace gimdem::test
{

class Relay
{
public:
    enum class Damage
    {
        truncated,   ///< a frame loses its end
        corrupted,   ///< some bytes are others
        frame_lost,  ///< a frame is missing
        doubled,     ///< the message comes twice
        garbage      ///< random bytes come instead
    };

    /// Passes on what comes, but for the message of that number (1, 2, ...), counted over both directions without
    /// heartbeats.
    Relay(std::string const& server, Damage damage, int message, unsigned seed);
    ~Relay();
    Relay(Relay const&) = delete;
    Relay& operator=(Relay const&) = delete;

    /// For the client.
    std::string endpoint() const { return endpoint_; }
    bool has_damaged() const { return damaged_; }

private:
    void run();
    void pass(zmq::socket_t& from, zmq::socket_t& to, bool to_server);
    void spoil(std::vector<std::string>& frames);

    zmq::context_t context_;
    zmq::socket_t front_;
    zmq::socket_t back_;
    std::string endpoint_;
    Damage damage_;
    int left_;  ///< messages until the damaged one
    std::mt19937 random_;
    std::string client_;  ///< routing id
    std::atomic<bool> damaged_{false};
    std::atomic<bool> ending_{false};
    std::thread thread_;
};

}  // namespace gimdem::test

// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Channel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "Endpoint.hpp"
#include "KeyFolder.hpp"
#include "RawMessages.hpp"
#include "transport/Keys.hpp"

namespace gimdem::coupling::transport
{
namespace
{

using namespace std::chrono_literals;
using test::RawPeer;

double constexpr timeout = 1;  ///< of the channel; it beats five times in that [s]
auto constexpr patience = 20s;

/// A server's channel, and all that it told its owner, in order.
class Owner
{
public:
    Owner() : channel_(Socket::bind(test::unused_ipc_endpoint()), timeout, hooks()) {}

    std::string endpoint() const { return channel_.endpoint(); }
    void send(std::string const& text)
    {
        Frames frames;
        frames.emplace_back(text.data(), text.size());
        channel_.send(std::move(frames));
    }

    /// Everything told until so many things were.
    std::vector<std::string> told(std::size_t count)
    {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait_for(lock, patience, [&] { return told_.size() >= count; });
        return told_;
    }

    /// Done once, on the I/O thread, just before the next heartbeat goes out.
    void before_next_heartbeat(std::function<void()> action)
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        action_ = std::move(action);
    }

private:
    ChannelHooks hooks()
    {
        ChannelHooks hooks;
        hooks.deliver = [this](Frames frames, Time)
        {
            note("got " + frames.front().to_string());
            return std::nullopt;
        };
        hooks.heartbeat = [this]
        {
            std::function<void()> action;
            {
                std::lock_guard<std::mutex> const lock(mutex_);
                action.swap(action_);
            }
            if (action) action();
            Frames frames;
            frames.emplace_back(test::raw_heartbeat().envelope.SerializeAsString());
            return frames;
        };
        hooks.may_open = [](Frame const& first) { return first.to_string() != "closed door"; };
        hooks.answer_stranger = [this](Frames frames)
        {
            note("stranger " + frames.front().to_string());
            return frames;
        };
        hooks.ended = [this](Ending ending) { note(ending.kind == Ending::Kind::lost ? "lost" : "silent"); };
        return hooks;
    }

    void note(std::string text)
    {
        std::lock_guard<std::mutex> const lock(mutex_);
        told_.push_back(std::move(text));
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> told_;
    std::function<void()> action_;
    Channel channel_;
};

using Told = std::vector<std::string>;

TEST(Channel, ServesTheFirstWhoMayOpenAndNoOther)
{
    Owner owner;
    RawPeer rude = RawPeer::client(owner.endpoint());
    rude.send_frames({"closed door"});
    std::this_thread::sleep_for(50ms);
    RawPeer first = RawPeer::client(owner.endpoint());
    first.send_frames({"one"});
    EXPECT_EQ(owner.told(1), Told{"got one"});
    RawPeer second = RawPeer::client(owner.endpoint());
    second.send_frames({"two"});
    EXPECT_EQ(owner.told(2), (Told{"got one", "stranger two"}));
}

TEST(Channel, TellsTheLastWordsBeforeTheLoss)
{
    // The worst moment: the peer speaks and dies between our last look at the socket and our next heartbeat, so that we
    // find it gone by sending.
    Owner owner;
    std::optional<RawPeer> peer(RawPeer::client(owner.endpoint()));
    peer->send_frames({"one"});
    owner.told(1);
    owner.before_next_heartbeat(
        [&]
        {
            peer->send_frames({"last words"});
            peer.reset();
            std::this_thread::sleep_for(200ms);
        });
    EXPECT_EQ(owner.told(3), (Told{"got one", "got last words", "lost"}));
}

TEST(Channel, TellsOfARefusalAlsoWhereItFindsItBySending)
{
    // A client whose program comes to speak only when the server has turned it away, and whose next send fails.
    test::KeyFolder const keys, strangers;
    std::filesystem::copy_file(keys / "server.public", strangers / "server.public",
                               std::filesystem::copy_options::overwrite_existing);
    Channel const server(Socket::bind(test::any_tcp_endpoint(), read_server_keys(keys.path())), timeout, {});
    std::promise<Channel*> made;
    std::promise<Ending::Kind> ended;
    ChannelHooks hooks;
    hooks.note = [&, channel = made.get_future().share()](std::string const&)
    {
        std::this_thread::sleep_for(200ms);  // ZeroMQ takes the way to the server from us
        Frames hello;
        hello.emplace_back("hello", 5);
        channel.get()->send(std::move(hello));
    };
    hooks.ended = [&](Ending ending) { ended.set_value(ending.kind); };
    Channel client(Socket::connect(server.endpoint(), read_client_keys(strangers.path())), timeout, hooks);
    made.set_value(&client);
    auto kind = ended.get_future();
    ASSERT_EQ(kind.wait_for(patience), std::future_status::ready);
    EXPECT_EQ(kind.get(), Ending::Kind::refused);
}

TEST(Channel, TellsOfSilenceOnce)
{
    Owner owner;
    RawPeer peer = RawPeer::client(owner.endpoint());
    peer.send_frames({"one"});
    EXPECT_EQ(owner.told(2), (Told{"got one", "silent"}));
    std::this_thread::sleep_for(500ms);
    EXPECT_EQ(owner.told(2), (Told{"got one", "silent"}));
}

}  // namespace
}  // namespace gimdem::coupling::transport

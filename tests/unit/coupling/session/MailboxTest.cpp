// SPDX-License-Identifier: BSD-3-Clause
/// Step messages through the mailboxes of the segments: a raw client that posts, and one that abuses it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <thread>
#include <utility>

#include "Faults.hpp"
#include "RawSharedClient.hpp"
#include "SharedMemoryNames.hpp"
#include "transport/Mailbox.hpp"

namespace gimdem::test
{
namespace
{

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using transport::Outbox;
using transport::Postbox;

/// The fluid of step 1, all of it shared: velocity at 0, the pressure gradient behind it.
RawMessage fluid()
{
    RawMessage message = RawSharedClient::fluid(0);
    message.envelope.mutable_arrays(1)->set_shared(true);
    message.envelope.mutable_arrays(1)->set_offset(velocity_bytes);
    message.arrays[1].clear();
    return message;
}

struct Posting : testing::Test
{
    RawSharedClient client{true};
    std::unique_ptr<Outbox> outbox;
    std::unique_ptr<Postbox> postbox;

    void SetUp() override
    {
        ASSERT_NO_FATAL_FAILURE(client.be_ready());
        outbox = std::make_unique<Outbox>(client.own);
        postbox = std::make_unique<Postbox>(client.theirs);
    }

    void announce(RawMessage const& message)
    {
        std::string const envelope = client.peer.stamped(message).envelope.SerializeAsString();
        outbox->announce(transport::Frame(envelope.data(), envelope.size()));
    }

    /// The envelope of the server's answer; empty if there is none in time.
    std::optional<v1::Envelope> answer(std::chrono::milliseconds patience = 20s)
    {
        auto const until = transport::Clock::now() + patience;
        for (; transport::Clock::now() < until; postbox->wait(until))
            if (auto const envelope = postbox->look())
            {
                while (postbox->packing() == Postbox::Packing::going_on && transport::Clock::now() < until)
                    postbox->wait(until);
                v1::Envelope read;
                EXPECT_TRUE(read.ParseFromArray(envelope->data(), static_cast<int>(envelope->size())));
                return read;
            }
        return std::nullopt;
    }
};

TEST_F(Posting, AnswersAFluidInTheMailboxThroughItsOwn)
{
    std::vector<double> const velocity = FluidArrays(cells, 3).velocity;
    announce(fluid());
    std::this_thread::sleep_for(5ms);  // the server has read the envelope and waits for the numbers
    std::memcpy(client.own->memory().data(), velocity.data(), velocity_bytes);
    outbox->finish();

    auto const solid = answer();
    ASSERT_TRUE(solid && solid->has_solid_state());
    EXPECT_EQ(solid->step(), 1);
    EXPECT_TRUE(solid->arrays(0).shared());
    client.peer.send(raw_goodbye());  // through the socket, while the server waits for the bell
    EXPECT_EQ(client.end(), "(nothing)");
    EXPECT_EQ(client.velocity, velocity);
}

TEST_F(Posting, HearsNothingOfAnAbandonedFluid)
{
    RawMessage other = fluid();
    other.envelope.set_step(7);
    announce(other);
    std::this_thread::sleep_for(2ms);
    outbox->abandon();
    EXPECT_FALSE(answer(50ms));
    announce(fluid());
    outbox->finish();
    auto const solid = answer();
    ASSERT_TRUE(solid);
    EXPECT_EQ(solid->step(), 1);
    client.peer.send(raw_goodbye());
    EXPECT_EQ(client.end(), "(nothing)");
}

TEST_F(Posting, IsRefusedForAnythingButSharedFields)
{
    announce(RawSharedClient::fluid(0));  // the pressure gradient is not shared
    outbox->finish();
    EXPECT_THAT(client.peer.receive_error(), HasSubstr("only fields in shared memory may be there"));
    EXPECT_THAT(client.end(), StartsWith("protocol: "));
}

TEST_F(Posting, IsRefusedForWordsThatBelongInTheSocket)
{
    announce(raw_goodbye());
    outbox->finish();
    EXPECT_THAT(client.peer.receive_error(), HasSubstr("Goodbye in a mailbox"));
    client.end();
}

TEST_F(Posting, IsRefusedForBytesThatAreNoEnvelope)
{
    outbox->announce(transport::Frame("\xff\xff\xff", 3));
    outbox->finish();
    EXPECT_THAT(client.peer.receive_error(), HasSubstr("cannot be read"));
    client.end();
}

TEST_F(Posting, IsRefusedForAnotherSession)
{
    RawMessage message = fluid();
    message.envelope.set_session(12345);
    announce(message);
    outbox->finish();
    EXPECT_THAT(client.peer.receive_error(), HasSubstr("belongs to session 12345"));
    client.end();
}

TEST(PostingClient, ThatEndsWhileItPacksIsMissedAtOnce)
{
    auto client = std::make_unique<RawSharedClient>(true);
    ASSERT_NO_FATAL_FAILURE(client->be_ready());
    Outbox outbox(client->own);
    std::string const envelope = client->peer.stamped(fluid()).envelope.SerializeAsString();
    outbox.announce(transport::Frame(envelope.data(), envelope.size()));
    auto const start = transport::Clock::now();
    {
        RawPeer const gone = std::move(client->peer);  // its socket closes
    }
    EXPECT_THAT(client->end(), HasSubstr("has disappeared"));
    EXPECT_LT(transport::Clock::now() - start, 5s) << "the time-out is longer";
    EXPECT_THAT(shared_memory_names(), IsEmpty());
}

}  // namespace
}  // namespace gimdem::test

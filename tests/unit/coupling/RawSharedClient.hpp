// SPDX-License-Identifier: BSD-3-Clause
/// A client by hand that uses shared memory, or abuses it.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Pair.hpp"
#include "RawMessages.hpp"
#include "transport/SharedMemory.hpp"

namespace gimdem::test
{

using namespace coupling;

/// 2500 cells: every field is large enough for shared memory.
inline Mesh mesh()
{
    return BoxMesh::make({10, 10, 25}, {0.1, 0.1, 0.25});
}
inline std::size_t constexpr cells = 2500;
inline std::size_t constexpr velocity_bytes = 3 * cells * sizeof(double);

/// A client by hand that offers shared memory to a real server.
class RawSharedClient
{
public:
    /// Does it offer to post envelopes, too?
    explicit RawSharedClient(bool posts = false)
        : posts_(posts),
          server_(std::make_unique<Server>(server_options(unused_ipc_endpoint()))),
          own(transport::make_segment(1 << 20).segment),
          peer(RawPeer::client(server_->endpoint()))
    {
        served_ = in_background([this] { return thrown_by([this] { serve_void_fraction(); }); });
    }

    /// Up to the mesh; tells what Welcome offered.
    bool greet()
    {
        RawMessage hello = raw_hello();
        hello.envelope.mutable_shared_memory()->set_offered(true);
        hello.envelope.mutable_shared_memory()->set_mailbox(posts_);
        peer.send(hello);
        auto const welcome = peer.receive();
        return welcome && welcome->envelope.shared_memory().offered();
    }

    /// Announces a segment; gives the MeshAccepted, or what came instead.
    std::optional<RawMessage> announce(std::string const& name, std::uint64_t bytes)
    {
        RawMessage message = raw_mesh(mesh());
        message.envelope.mutable_shared_memory()->set_name(name);
        message.envelope.mutable_shared_memory()->set_bytes(bytes);
        peer.send(message);
        return peer.receive();
    }

    /// Ready for the first step: both segments are mapped.
    void be_ready()
    {
        ASSERT_TRUE(greet());
        auto const accepted = announce(own->notice().name, own->notice().bytes);
        ASSERT_TRUE(accepted && accepted->envelope.has_mesh_accepted());
        auto const& told = accepted->envelope.shared_memory();
        EXPECT_TRUE(told.mapped());
        theirs = transport::map_segment({told.name(), told.bytes()}).segment;
        ASSERT_TRUE(theirs);
        ASSERT_TRUE(peer.receive());  // SolidState of step 0
    }

    /// The fluid of step 1, whose velocity lies there in our segment.
    static RawMessage fluid(std::uint64_t offset)
    {
        RawMessage message = raw_fluid(1, 0, 0.5, static_cast<int>(cells), {{"velocity", 3}, {"pressure_gradient", 3}});
        message.envelope.mutable_shared_memory()->set_mapped(true);
        message.envelope.mutable_arrays(0)->set_shared(true);
        message.envelope.mutable_arrays(0)->set_offset(offset);
        message.arrays[0].clear();
        return message;
    }

    /// What the server threw; it is gone then.
    std::string end()
    {
        std::string const thrown = served_.get();
        server_.reset();
        return thrown;
    }

private:
    void serve_void_fraction()
    {
        std::vector<double> const full(cells, 0.75);
        SolidFields solid;
        solid.void_fraction = full;
        server_->wait_for_client(server_terms());
        server_->receive_mesh();
        server_->accept_mesh(solid);
        note = server_->shared_memory_note();
        while (auto const received = server_->receive_fluid())
        {
            velocity = to_vector(received->fields.velocity);
            server_->send_solid(solid, {});
        }
    }

    bool posts_;
    std::unique_ptr<Server> server_;

public:
    std::vector<double> velocity;  ///< that the server received
    std::string note;              ///< of the server

private:
    std::future<std::string> served_;

public:
    std::shared_ptr<transport::OwnSegment> own;
    std::shared_ptr<transport::Mapping const> theirs;
    RawPeer peer;
};

}  // namespace gimdem::test

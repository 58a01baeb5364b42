// SPDX-License-Identifier: BSD-3-Clause
/// The mesh and its answer.
#include "message/MeshMessage.hpp"
#include "session/ServerSession.hpp"

namespace gimdem::coupling::session
{

Mesh ServerSession::receive_mesh()
{
    session_.require(Event::receive_mesh);
    Letter const letter = receive("Mesh");
    if (said_goodbye(letter))
        throw CouplingError(Fault::peer, session_.peer_name() + " said goodbye before it sent its mesh: " + goodbye_);
    // First, so that no fault leaves its name behind.
    session_.use(session_.read([&] { return shared_.map_announced(letter.message); }),
                 [this](message::Message& fluid, std::size_t packed)
                 { message::take_in(fluid, packed, terms_.fluid, terms_.cell_count, terms_.store); });
    Mesh mesh = session_.read([&] { return message::unpack_mesh(letter.message); });
    terms_.cell_count = static_cast<std::size_t>(mesh.cell_count);
    session_.limit_arrays(message::field_bytes(terms_.fluid, terms_.cell_count));
    return mesh;
}

void ServerSession::accept_mesh(SolidFields const& initial, Timings const& timings, StepCells const& cells)
{
    session_.require(Event::accept_mesh);
    message::Message solid = message::pack(message::SolidState{initial, timings, 0, stop_reason(), cells}, terms_);
    terms_.needed = cells.needed;
    session_.look_for_trouble("the judgement of the mesh by its program");
    session_.advance(Event::accept_mesh);
    message::Message accepted = message::pack_mesh_accepted(static_cast<std::int32_t>(terms_.cell_count));
    shared_.confirm(accepted);
    shared_.announce(accepted, message::shared_bytes(terms_.solid, terms_.cell_count, terms_.encodings.sparse));
    session_.send(std::move(accepted));
    session_.send(std::move(solid));
}

}  // namespace gimdem::coupling::session

// SPDX-License-Identifier: BSD-3-Clause
/// Hello, Welcome and the mesh, as the client sees them.
#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "session/ClientSession.hpp"
#include "session/Options.hpp"

namespace gimdem::coupling::session
{

using transport::Clock;
using transport::ticks;

void ClientSession::connect(FluidProperties const& properties)
{
    session_.require(Event::connect);
    session_.open(transport::Socket::connect(options_.endpoint, keys_));
    session_.advance(Event::connect);
    shared_.want(options_.shared_memory && session_.is_ipc());
    message::Message hello = message::pack(message::Hello{.name = options_.name,
                                                          .fluid = properties,
                                                          .wants = options_.wants,
                                                          .schedule = options_.schedule,
                                                          .timeout = options_.timeout,
                                                          .resume = options_.resume,
                                                          .iterates = options_.iterates,
                                                          .rank = options_.rank,
                                                          .encodings = options_.encodings});
    shared_.offer(hello);
    record_.stamp(hello);
    Time const hello_sent = Clock::now();
    session_.send(std::move(hello));

    if (!session_.wait_for_contact(Clock::now() + ticks(options_.connect_time)))
        session_.fail(Fault::endpoint, "no server has answered at " + options_.endpoint + " within " +
                                           seconds_text(options_.connect_time) + session_.connection_note() +
                                           " (none runs there, or it is not a gimdem server); start gimdem-server with "
                                           "the same endpoint");
    Letter const letter = receive("Welcome");
    welcome_ = session_.read([&] { return message::unpack_welcome(letter.message); });
    session_.set_peer_name(welcome_.server);
    check_rank_endpoints();
    shared_.agree(letter.message);
    terms_.encodings = both(welcome_.encodings, options_.encodings);
    session_.read([&] { record_.heard(letter.message, hello_sent, letter.arrival); });
    terms_.fluid = session_.read([&] { return message::choose_fluid_fields(welcome_.needs, Fault::protocol); });
    log_connection();
}

void ClientSession::log_connection()
{
    record_.log().write(LogLevel::info, "connected", "connected to " + welcome_.server,
                        {{"endpoint", options_.endpoint},
                         {"title", welcome_.title},
                         {"schedule", name_of(welcome_.schedule)},
                         {"clock_offset_s", record_.offset() ? record_.offset()->offset : not_known},
                         {"clock_uncertainty_s", record_.offset() ? record_.offset()->uncertainty : not_known}});
}

/// A server of protocol 1.0 would take rank 0 for the whole client.
void ClientSession::check_rank_endpoints()
{
    auto const expected = static_cast<std::size_t>(options_.rank.number == 0 ? options_.rank.count - 1 : 0);
    if (welcome_.rank_endpoints.size() == expected) return;
    session_.fail(Fault::version, session_.peer_name() + " told endpoints for " +
                                      std::to_string(welcome_.rank_endpoints.size()) + " more ranks instead of " +
                                      std::to_string(expected) + "; update it, or run one process");
}

void ClientSession::send_mesh(MeshView const& mesh)
{
    session_.require(Event::send_mesh);
    message::Message message = message::pack(mesh);
    session_.look_for_trouble("the mesh of its program");
    session_.advance(Event::send_mesh);
    terms_.cell_count = static_cast<std::size_t>(mesh.cell_count);
    session_.limit_arrays(message::field_bytes(terms_.solid, terms_.cell_count));
    shared_.announce(message, message::shared_bytes(terms_.fluid, terms_.cell_count, terms_.encodings.sparse));
    session_.send(std::move(message));

    Letter const letter = receive("MeshAccepted");
    session_.read([&] { message::check_mesh_accepted(letter.message, mesh.cell_count); });
    session_.use(shared_.use_if_confirmed(letter.message, terms_.memory));
    session_.use(session_.read([&] { return shared_.map_announced(letter.message); }),
                 [this](message::Message& solid, std::size_t packed)
                 { message::take_in(solid, packed, terms_.solid, terms_.cell_count, terms_.store); });
    take_solid();
    record_.log().write(LogLevel::info, "mesh_accepted", "the server holds the mesh",
                        {{"cells", static_cast<double>(mesh.cell_count)}});
}

}  // namespace gimdem::coupling::session

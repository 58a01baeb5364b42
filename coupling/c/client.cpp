// SPDX-License-Identifier: BSD-3-Clause
/// client.h over Client.hpp: no exception and no C++ type leaves this file.
#include "gimdem/coupling/client.h"

#include <exception>
#include <string>
#include <vector>

#include "c/Structs.hpp"
#include "c/Views.hpp"

using namespace gimdem::coupling;

/// What the handle is.
struct gimdem_client
{
    explicit gimdem_client(ClientOptions options) : client(std::move(options)) {}

    Client client;
    std::size_t cell_count = 0;
    std::vector<char const*> needs;  ///< texts of client.welcome()
    std::vector<char const*> rank_endpoints;
    std::string checkpoint;  ///< name of the last one
};

namespace
{

/// Survives a failure to remember a failure.
thread_local std::string last_error;
thread_local bool lost_error = false;

void remember(char const* text) noexcept
{
    try
    {
        last_error = text;
        lost_error = false;
    }
    catch (std::exception const&)
    {
        lost_error = true;
    }
}

gimdem_status status_of(Fault fault)
{
    switch (fault)
    {
        case Fault::user:
            return GIMDEM_ERROR_USER;
        case Fault::version:
            return GIMDEM_ERROR_VERSION;
        case Fault::protocol:
            return GIMDEM_ERROR_PROTOCOL;
        case Fault::mesh:
            return GIMDEM_ERROR_MESH;
        case Fault::timeout:
            return GIMDEM_ERROR_TIMEOUT;
        case Fault::peer:
            return GIMDEM_ERROR_PEER;
        case Fault::endpoint:
            return GIMDEM_ERROR_ENDPOINT;
    }
    return GIMDEM_ERROR_INTERNAL;
}

/// Runs a call; whatever it throws becomes a status and words.
template <class Body>
gimdem_status guarded(Body body) noexcept
{
    try
    {
        body();
        return GIMDEM_OK;
    }
    catch (CouplingError const& error)
    {
        remember(error.what());
        return status_of(error.fault());
    }
    catch (std::exception const& error)
    {
        remember(error.what());
    }
    catch (...)
    {
        remember("an unknown failure in libgimdem_client");
    }
    return GIMDEM_ERROR_INTERNAL;
}

gimdem_client& checked(gimdem_client* client)
{
    return c::require(client, "the client");
}

std::int32_t plain(Schedule schedule)
{
    switch (schedule)
    {
        case Schedule::serial:
            return GIMDEM_SCHEDULE_SERIAL;
        case Schedule::overlapped:
            return GIMDEM_SCHEDULE_OVERLAPPED;
        case Schedule::iterated:
            return GIMDEM_SCHEDULE_ITERATED;
    }
    return GIMDEM_SCHEDULE_OF_SERVER;
}

std::vector<char const*> pointers(std::vector<std::string> const& texts)
{
    std::vector<char const*> result;
    for (std::string const& text : texts)
        result.push_back(text.c_str());
    return result;
}

gimdem_welcome plain(Welcome const& welcome, gimdem_client const& handle)
{
    gimdem_welcome result{};
    result.server = welcome.server.c_str();
    result.title = welcome.title.c_str();
    result.end_time = welcome.end_time;
    result.needs = handle.needs.data();
    result.need_count = handle.needs.size();
    result.rank_endpoints = handle.rank_endpoints.data();
    result.rank_endpoint_count = handle.rank_endpoints.size();
    result.tolerance = welcome.iteration.tolerance;
    result.relaxation = welcome.iteration.relaxation;
    result.max_passes = welcome.iteration.max_passes;
    result.must_converge = welcome.iteration.must_converge ? 1 : 0;
    result.schedule = plain(welcome.schedule);
    result.fluid_steps = welcome.fluid_steps;
    result.saves_checkpoints = welcome.saves_checkpoints ? 1 : 0;
    return result;
}

void connect(gimdem_client& handle, gimdem_fluid_properties const* fluid, gimdem_welcome* target)
{
    auto const given = c::read(fluid, "gimdem_fluid_properties");
    if (target != nullptr) c::require_room(target, "gimdem_welcome");
    Welcome const& welcome = handle.client.connect({given.density, given.viscosity});
    handle.needs = pointers(welcome.needs);
    handle.rank_endpoints = pointers(welcome.rank_endpoints);
    if (target != nullptr) c::write(plain(welcome, handle), target);
}

void begin_step(gimdem_client& handle, gimdem_step const* step, gimdem_fluid_fields const* fluid,
                std::vector<Monitor> const& monitors, gimdem_solid_fields* target)
{
    auto const at = c::read(step, "gimdem_step");
    auto const fields = c::read(fluid, "gimdem_fluid_fields");
    c::require_room(target, "gimdem_solid_fields");
    SolidFields const& solid = handle.client.begin_step({at.number, at.time, at.dt}, c::fields_of(fields), monitors);
    c::write(c::plain(solid, handle.cell_count), target);
}

}  // namespace

gimdem_status gimdem_client_protocol(int32_t* major, int32_t* minor)
{
    return guarded(
        [&]
        {
            c::require(major, "major") = protocol_major;
            c::require(minor, "minor") = protocol_minor;
        });
}

char const* gimdem_client_last_error(void)
{
    return lost_error ? "no memory for the words of an error" : last_error.c_str();
}

gimdem_status gimdem_client_options_init(gimdem_client_options* options, size_t size)
{
    return guarded(
        [&]
        {
            c::require(options, "gimdem_client_options").struct_size = size;
            c::require_room(options, "gimdem_client_options");
            ClientOptions const defaults;
            gimdem_client_options plain{};
            plain.timeout = defaults.timeout;
            plain.connect_time = defaults.connect_time;
            plain.step_time = defaults.step_time;
            c::write(plain, options);
        });
}

gimdem_status gimdem_client_create(gimdem_client_options const* options, gimdem_client** client)
{
    return guarded(
        [&]
        {
            c::require(client, "the address of the client") = nullptr;
            *client = new gimdem_client(c::options_of(c::read(options, "gimdem_client_options")));
        });
}

gimdem_status gimdem_client_connect(gimdem_client* client, gimdem_fluid_properties const* fluid,
                                    gimdem_welcome* welcome)
{
    return guarded([&] { connect(checked(client), fluid, welcome); });
}

gimdem_status gimdem_client_send_mesh(gimdem_client* client, gimdem_mesh const* mesh)
{
    return guarded(
        [&]
        {
            gimdem_client& handle = checked(client);
            MeshView const view = c::view_of(c::read(mesh, "gimdem_mesh"));
            handle.client.send_mesh(view);
            handle.cell_count = static_cast<std::size_t>(view.cell_count);
        });
}

gimdem_status gimdem_client_begin_step(gimdem_client* client, gimdem_step const* step, gimdem_fluid_fields const* fluid,
                                       gimdem_monitor const* monitors, size_t monitor_count, gimdem_solid_fields* solid)
{
    return guarded([&] { begin_step(checked(client), step, fluid, c::monitors_of(monitors, monitor_count), solid); });
}

gimdem_status gimdem_client_iterate_step(gimdem_client* client, gimdem_fluid_fields const* estimate, double residual,
                                         gimdem_solid_fields* solid)
{
    return guarded(
        [&]
        {
            gimdem_client& handle = checked(client);
            auto const fields = c::read(estimate, "gimdem_fluid_fields");
            c::require_room(solid, "gimdem_solid_fields");
            c::write(c::plain(handle.client.iterate_step(c::fields_of(fields), residual), handle.cell_count), solid);
        });
}

gimdem_status gimdem_client_end_step(gimdem_client* client, gimdem_timings const* timings)
{
    return guarded(
        [&]
        {
            gimdem_client& handle = checked(client);
            gimdem_timings given{};
            if (timings != nullptr) given = c::read(timings, "gimdem_timings");
            Timings known;
            known.compute = given.compute;
            known.output = given.output;
            handle.client.end_step(known, given.residual);
        });
}

gimdem_status gimdem_client_save_checkpoint(gimdem_client* client, double time, int64_t complete_step,
                                            gimdem_saved_checkpoint* saved)
{
    return guarded(
        [&]
        {
            gimdem_client& handle = checked(client);
            c::require_room(saved, "gimdem_saved_checkpoint");
            SavedCheckpoint const known = handle.client.save_checkpoint(time, complete_step);
            handle.checkpoint = known.name;
            c::write(gimdem_saved_checkpoint{0, known.session, known.step, known.time, handle.checkpoint.c_str()},
                     saved);
        });
}

gimdem_status gimdem_client_solid(gimdem_client* client, gimdem_solid_fields* solid)
{
    return guarded(
        [&]
        {
            gimdem_client& handle = checked(client);
            c::require_room(solid, "gimdem_solid_fields");
            c::write(c::plain(handle.client.solid(), handle.cell_count), solid);
        });
}

gimdem_status gimdem_client_stop_request(gimdem_client* client, char const** reason)
{
    return guarded(
        [&]
        {
            auto const& asked = checked(client).client.stop_request();
            c::require(reason, "the address of the reason") = asked ? asked->c_str() : nullptr;
        });
}

gimdem_status gimdem_client_exchange_times(gimdem_client* client, gimdem_exchange_times* times)
{
    return guarded(
        [&]
        {
            ExchangeTimes const& known = checked(client).client.exchange_times();
            c::require_room(times, "gimdem_exchange_times");
            c::write(gimdem_exchange_times{0, known.exchange, known.waiting, known.bytes}, times);
        });
}

gimdem_status gimdem_client_finish(gimdem_client* client, char const* reason)
{
    return guarded([&] { checked(client).client.finish(c::text(reason)); });
}

gimdem_status gimdem_client_abort(gimdem_client* client, char const* reason)
{
    return guarded([&] { checked(client).client.abort(c::text(reason)); });
}

gimdem_status gimdem_client_destroy(gimdem_client* client)
{
    return guarded([&] { delete client; });
}

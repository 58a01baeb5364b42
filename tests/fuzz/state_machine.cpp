// SPDX-License-Identifier: BSD-3-Clause
/// Fuzz target: a whole session of a server or a client, whose peer and whose program do whatever the input says. Each
/// call does its work or throws a CouplingError with a reason, and a peer that broke the rules is told so.
#include <cstdlib>
#include <string>
#include <vector>

#include "BoxMesh.hpp"
#include "Bytes.hpp"
#include "MessageMaker.hpp"
#include "ScriptedChannel.hpp"
#include "gimdem/coupling/Client.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::fuzz
{
namespace
{

using namespace coupling;
using message::Kind;
using transport::Ending;

unsigned constexpr hello = 10, welcome = 11, mesh_kind = 12, mesh_accepted = 13, fluid_state = 14, solid_state = 15,
                   goodbye = 18;
unsigned constexpr most_calls = 24;

/// What both sides' scripts share: the peer's messages, and what every call must keep to.
class Script
{
public:
    explicit Script(Bytes& input) : input_(input) {}

    /// The peer sends what is due, now and then something else; and that many letters at least, or it is gone.
    void prepare(std::vector<unsigned> const& due)
    {
        for (unsigned const kind : due)
        {
            bool const other = input_.once_in(16);
            auto const message = other ? make_message(truth, input_) : make_message(kind, truth, input_);
            wire_.put(frames_of(message, input_));
        }
        if (input_.once_in(8)) wire_.put(frames_of(make_message(truth, input_), input_));
        if (input_.once_in(32)) wire_.deliver();
        if (input_.once_in(16)) wire_.deliver_to_stranger(frames_of(make_message(truth, input_), input_));
    }

    /// Runs a call that takes so many letters. True if it did its work.
    template <class Call>
    bool does(std::size_t letters, Call call)
    {
        // Nobody may wait: whoever has said too little is gone.
        if (wire_.supply() < letters) wire_.end({Ending::Kind::lost, 0, "the script is over"});
        if (input_.once_in(32)) wire_.end({Ending::Kind::lost, 0, ""});
        try
        {
            call();
            wire_.taken(letters);
            return true;
        }
        catch (CouplingError const& error)
        {
            if (*error.what() == 0) report("a session ends without a reason");
            over = error.fault() != Fault::user;
            bool const told = wire_.has_sent(Kind::kError);
            if (error.fault() == Fault::protocol && !told) report("a peer that broke the rules is not told so");
            return false;
        }
    }

    void deliver() { wire_.deliver(); }

    Truth truth;
    bool over = false;

private:
    Bytes& input_;
    Wire& wire_ = Wire::of_session();
};

Timings timings_of(Bytes& input)
{
    return {input.once_in(64) ? input.raw<double>() : 0.1, 0, 0};
}

SolidFields fields_of(std::vector<double> const& values, std::size_t cells)
{
    Span<double const> const all(values.data(), values.size());
    SolidFields fields;
    fields.void_fraction = {all.data(), cells};
    fields.momentum_source = {all.data(), 3 * cells};
    fields.drag_coefficient = {all.data(), cells};
    fields.drag_momentum = {all.data(), 3 * cells};
    return fields;
}

void run_server(Bytes input)
{
    ServerOptions options;
    options.endpoint = "tcp://127.0.0.1:1";
    options.name = "server";
    options.connect_time = options.step_time = 1;  // nobody should wait
    options.shared_memory = false;
    Server server(options);
    Script script(input);
    std::vector<double> values(9 * 8, 0.5);
    ServerTerms terms;
    terms.title = "a case";
    terms.end_time = 1;
    terms.needs = {field::velocity, field::pressure};
    unsigned next = 0;
    for (unsigned n = 0; n < most_calls && !script.over && !input.empty(); ++n)
    {
        unsigned const call = input.once_in(24) ? input.choose(7) : next;
        script.truth.session = Wire::of_session().session();
        std::size_t const cells = input.once_in(32) ? 1 : static_cast<std::size_t>(script.truth.cells);
        switch (call)
        {
            case 0:
                script.prepare({hello});
                script.deliver();
                if (script.does(1, [&] { server.wait_for_client(terms); })) next = 1;
                break;
            case 1:
                script.prepare({mesh_kind});
                script.deliver();
                if (script.does(1, [&] { script.truth.cells = server.receive_mesh().cell_count; })) next = 2;
                if (script.truth.cells > 8) return;
                break;
            case 2:
                if (script.does(0, [&] { server.accept_mesh(fields_of(values, cells), timings_of(input)); })) next = 3;
                break;
            case 3:
                script.prepare({input.once_in(16) ? goodbye : fluid_state});
                script.deliver();
                if (script.does(1, [&] { server.receive_fluid(); })) next = 4;
                break;
            case 4:
                if (!script.does(0, [&] { server.send_solid(fields_of(values, cells), timings_of(input)); })) break;
                next = 3;
                script.truth.time += script.truth.dt;
                ++script.truth.step;
                break;
            case 5:
                server.request_stop("a reason");
                break;
            default:
                if (input.once_in(2)) return server.abort("a reason");
                script.does(0, [&] { server.reject_mesh("a reason"); });
        }
    }
}

void run_client(Bytes input)
{
    ClientOptions options;
    options.endpoint = "tcp://127.0.0.1:1";
    options.name = "client";
    options.connect_time = options.step_time = 1;  // nobody should wait
    options.shared_memory = false;
    Client client(options);
    Script script(input);
    script.truth.session = 77;  // that of raw_welcome()
    Mesh const mesh = test::BoxMesh::make({1, 1, script.truth.cells}, {1, 1, 1});
    MeshView const view{mesh.points,    mesh.face_offsets, mesh.face_points, mesh.owner,
                        mesh.neighbour, mesh.cell_count,   mesh.patches};
    auto const cells = static_cast<std::size_t>(mesh.cell_count);
    std::vector<double> values(9 * cells, 0.5);
    auto const fluid = [&]
    {
        FluidFields fields;
        fields.velocity = {values.data(), 3 * cells};
        fields.pressure = {values.data(), cells};
        fields.pressure_gradient = {values.data(), 3 * cells};
        fields.void_fraction_gradient = {values.data(), 3 * cells};
        fields.velocity_gradient = {values.data(), 9 * cells};
        return fields;
    };
    bool overlapped = false;
    unsigned next = 0;
    for (unsigned n = 0; n < most_calls && !script.over && !input.empty(); ++n)
    {
        unsigned const call = input.once_in(24) ? input.choose(6) : next;
        bool const late = call == 3 && overlapped;
        switch (call)
        {
            case 0:
                script.prepare({welcome});
                if (!script.does(1, [&] { client.connect({1.2, 1.8e-5}); })) break;
                overlapped = client.welcome().schedule == Schedule::overlapped;
                next = 1;
                break;
            case 1:
                script.truth.step = 0;
                script.prepare({mesh_accepted, solid_state});
                script.truth.step = 1;
                if (script.does(2, [&] { client.send_mesh(view); })) next = 2;
                break;
            case 2:
                script.prepare({solid_state});
                if (script.does(overlapped ? 0 : 1,
                                [&] {
                                    client.begin_step({script.truth.step, script.truth.time, script.truth.dt}, fluid());
                                }))
                    next = 3;
                break;
            case 3:
                if (late) script.deliver();
                if (!script.does(late ? 1 : 0, [&] { client.end_step(timings_of(input)); })) break;
                next = 2;
                script.truth.time += script.truth.dt;
                ++script.truth.step;
                break;
            case 4:
                script.does(0, [&] { client.finish("a reason"); });
                break;
            default:
                return client.abort("a reason");
        }
    }
}

}  // namespace
}  // namespace gimdem::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    if (size == 0) return 0;
    gimdem::fuzz::Wire::of_session() = {};
    gimdem::fuzz::Bytes const input(data + 1, size - 1);
    if (data[0] % 2 == 0)
        gimdem::fuzz::run_server(input);
    else
        gimdem::fuzz::run_client(input);
    return 0;
}

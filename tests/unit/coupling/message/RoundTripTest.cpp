// SPDX-License-Identifier: BSD-3-Clause
/// Every message comes back from the wire bit for bit.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <vector>

#include "Faults.hpp"
#include "Pair.hpp"
#include "message/Codec.hpp"
#include "message/Control.hpp"
#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::coupling::message
{
namespace
{

using Limits = std::numeric_limits<double>;

Message over_the_wire(Message message)
{
    return decode(encode(std::move(message)));
}

template <class T>
bool same_bits(Span<T const> a, Span<T const> b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Numbers whose bits would not survive a detour over text or another type.
std::vector<double> delicate_numbers(std::size_t count)
{
    std::vector<double> const kinds{-0.0, 0.1, Limits::denorm_min(), Limits::max(), -1e-300, 1 + Limits::epsilon()};
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = kinds[i % kinds.size()];
    return numbers;
}

Terms all_terms(std::size_t cells)
{
    Terms terms;
    terms.fluid = {fluid_fields.begin(), fluid_fields.end()};
    terms.solid = {solid_fields.begin(), solid_fields.end()};
    terms.cell_count = cells;
    return terms;
}

TEST(RoundTrip, Hello)
{
    Hello const sent{"a client", {1.25, 1.8e-5}, {"void_fraction", "momentum_source"}, Schedule::overlapped, 12.5};
    Hello const got = unpack_hello(over_the_wire(pack(sent)));

    EXPECT_EQ(got.name, sent.name);
    EXPECT_EQ(got.fluid.density, sent.fluid.density);
    EXPECT_EQ(got.fluid.viscosity, sent.fluid.viscosity);
    EXPECT_EQ(got.wants, sent.wants);
    EXPECT_EQ(got.schedule, sent.schedule);
    EXPECT_EQ(got.timeout, sent.timeout);
}

TEST(RoundTrip, HelloWithoutASchedule)
{
    Hello const got = unpack_hello(over_the_wire(pack(Hello{"a client", {}, {}, std::nullopt, 1})));
    EXPECT_EQ(got.schedule, std::nullopt);
    EXPECT_TRUE(got.wants.empty());
}

TEST(RoundTrip, WhoIteratesAndHow)
{
    EXPECT_TRUE(unpack_hello(over_the_wire(pack(Hello{
                                 .name = "a client", .schedule = Schedule::iterated, .timeout = 1, .iterates = true})))
                    .iterates);
    EXPECT_FALSE(unpack_hello(over_the_wire(pack(Hello{"a client", {}, {}, std::nullopt, 1}))).iterates);

    Welcome const sent{.server = "a server",
                       .title = "a title",
                       .schedule = Schedule::iterated,
                       .end_time = 0.1,
                       .fluid_steps = 4,
                       .iteration = {1e-5, 7, 0.25, true}};
    Welcome const got = unpack_welcome(over_the_wire(pack(sent)));
    EXPECT_EQ(got.schedule, Schedule::iterated);
    EXPECT_EQ(got.fluid_steps, 4);
    EXPECT_EQ(got.iteration.tolerance, 1e-5);
    EXPECT_EQ(got.iteration.max_passes, 7);
    EXPECT_EQ(got.iteration.relaxation, 0.25);
    EXPECT_TRUE(got.iteration.must_converge);
}

TEST(RoundTrip, WelcomeOfProtocol10HasOneFluidStep)
{
    Message message = pack(Welcome{"a server", "a title", Schedule::serial, 0.1, {}});
    message.envelope.mutable_welcome()->clear_fluid_steps();
    EXPECT_EQ(unpack_welcome(over_the_wire(std::move(message))).fluid_steps, 1);
}

TEST(RoundTrip, Welcome)
{
    Welcome const sent{"a server", "a title", Schedule::serial, 0.1, {"pressure", "velocity"}};
    Welcome const got = unpack_welcome(over_the_wire(pack(sent)));

    EXPECT_EQ(got.server, sent.server);
    EXPECT_EQ(got.title, sent.title);
    EXPECT_EQ(got.schedule, sent.schedule);
    EXPECT_EQ(got.end_time, sent.end_time);
    EXPECT_EQ(got.needs, sent.needs);
}

TEST(RoundTrip, Mesh)
{
    Mesh sent = test::BoxMesh::make({3, 2, 2}, {0.1, 0.2, 0.3});
    sent.patches[0].kind = PatchKind::symmetry;
    sent.patches[1].kind = PatchKind::empty;
    sent.patches[2].kind = PatchKind::cyclic;
    sent.patches[3].kind = PatchKind::processor;
    Mesh const got = unpack_mesh(over_the_wire(pack(view_of(sent))));

    EXPECT_TRUE(same_bits<double>(got.points, sent.points));
    EXPECT_EQ(got.face_offsets, sent.face_offsets);
    EXPECT_EQ(got.face_points, sent.face_points);
    EXPECT_EQ(got.owner, sent.owner);
    EXPECT_EQ(got.neighbour, sent.neighbour);
    EXPECT_EQ(got.cell_count, sent.cell_count);
    ASSERT_EQ(got.patches.size(), sent.patches.size());
    for (std::size_t k = 0; k < sent.patches.size(); ++k)
    {
        EXPECT_EQ(got.patches[k].name, sent.patches[k].name);
        EXPECT_EQ(got.patches[k].kind, sent.patches[k].kind);
        EXPECT_EQ(got.patches[k].start_face, sent.patches[k].start_face);
        EXPECT_EQ(got.patches[k].face_count, sent.patches[k].face_count);
    }
}

TEST(RoundTrip, MeshAccepted)
{
    Message const message = over_the_wire(pack_mesh_accepted(17));
    EXPECT_NO_THROW(check_mesh_accepted(message, 17));
    EXPECT_FAULT(check_mesh_accepted(message, 18), Fault::protocol, "17 cells instead of 18");
}

TEST(RoundTrip, FluidState)
{
    std::size_t constexpr cells = 11;
    auto const numbers = delicate_numbers(9 * cells);
    auto const rows = [&](std::size_t components) { return Span<double const>(numbers.data(), components * cells); };
    FluidState sent;
    sent.step = {7, 0.1, 1e-4};
    sent.fields = {rows(3), rows(9), rows(3), rows(3), rows(1)};
    sent.monitors = {{"courant_max", 0.4, "1"}, {"not a number", Limits::quiet_NaN(), "m"}};
    sent.previous = {1.5, 0, 0.25};
    sent.exchange = 0.125;
    sent.waiting = 3;
    Message const message = over_the_wire(pack(sent, all_terms(cells)));
    FluidState const got = unpack_fluid_state(message, all_terms(cells));

    EXPECT_EQ(got.step.number, sent.step.number);
    EXPECT_EQ(got.step.time, sent.step.time);
    EXPECT_EQ(got.step.dt, sent.step.dt);
    for (auto const& entry : fluid_fields)
        EXPECT_TRUE(same_bits(got.fields.*entry.values, sent.fields.*entry.values)) << entry.name;
    ASSERT_EQ(got.monitors.size(), 2u);
    EXPECT_EQ(got.monitors[0].name, "courant_max");
    EXPECT_EQ(got.monitors[0].value, 0.4);
    EXPECT_EQ(got.monitors[0].unit, "1");
    EXPECT_TRUE(std::isnan(got.monitors[1].value)) << "a monitor may tell that something has no value";
    EXPECT_EQ(got.previous.compute, 1.5);
    EXPECT_EQ(got.previous.output, 0.25);
    EXPECT_EQ(got.exchange, 0.125);
    EXPECT_EQ(got.waiting, 3);
}

TEST(RoundTrip, FluidStateOfALaterPass)
{
    FluidState sent;
    sent.step = {7, 0.1, 1e-4};
    sent.pass = 3;
    sent.residual = 0.25;
    Message const message = over_the_wire(pack(sent, {}));
    EXPECT_EQ(message.envelope.iteration(), 3);
    EXPECT_EQ(unpack_fluid_state(message, {}).pass, 3);
    EXPECT_EQ(unpack_fluid_state(message, {}).residual, 0.25);
}

TEST(RoundTrip, RewindAndIterationBelongTogether)
{
    Message first = pack(FluidState{}, {}), later = pack(FluidState{}, {});
    first.envelope.mutable_fluid_state()->mutable_rewind();
    later.envelope.set_iteration(1);
    EXPECT_FAULT(unpack_fluid_state(first, {}), Fault::protocol, "iteration 0 with a Rewind");
    EXPECT_FAULT(unpack_fluid_state(later, {}), Fault::protocol, "iteration 1 without a Rewind");
}

TEST(RoundTrip, SolidState)
{
    std::size_t constexpr cells = 5;
    auto const numbers = delicate_numbers(3 * cells);
    auto const rows = [&](std::size_t components) { return Span<double const>(numbers.data(), components * cells); };
    SolidState sent;
    sent.fields = {rows(1), rows(3), rows(1), rows(3)};
    sent.timings = {1, 2, 4};
    sent.busy_time = 8;
    sent.stop_request = "Ctrl-C";
    Message const message = over_the_wire(pack(sent, all_terms(cells)));
    SolidState const got = unpack_solid_state(message, all_terms(cells));

    for (auto const& entry : solid_fields)
        EXPECT_TRUE(same_bits(got.fields.*entry.values, sent.fields.*entry.values)) << entry.name;
    EXPECT_EQ(got.timings.compute, 1);
    EXPECT_EQ(got.timings.mapping, 2);
    EXPECT_EQ(got.timings.output, 4);
    EXPECT_EQ(got.busy_time, 8);
    EXPECT_EQ(got.stop_request, "Ctrl-C");
}

TEST(RoundTrip, AnEmptyReasonToStopIsStillARequest)
{
    SolidState sent;
    Terms const none;
    EXPECT_FALSE(unpack_solid_state(over_the_wire(pack(sent, none)), none).stop_request);
    sent.stop_request = "";
    EXPECT_TRUE(unpack_solid_state(over_the_wire(pack(sent, none)), none).stop_request);
}

TEST(RoundTrip, Heartbeat)
{
    Heartbeat const got = unpack_heartbeat(over_the_wire(pack(Heartbeat{"a peer", "computing", 12, 34, 0.5})));
    EXPECT_EQ(got.name, "a peer");
    EXPECT_EQ(got.state, "computing");
    EXPECT_EQ(got.step, 12);
    EXPECT_EQ(got.progress, 34u);
    EXPECT_EQ(got.timeout, 0.5);
}

TEST(RoundTrip, Error)
{
    for (Fault const fault :
         {Fault::user, Fault::version, Fault::protocol, Fault::mesh, Fault::timeout, Fault::peer, Fault::endpoint})
    {
        ErrorReport const got = unpack_error(over_the_wire(pack(ErrorReport{fault, "why", "ready", "a peer", 3})));
        EXPECT_EQ(got.fault, fault);
        EXPECT_EQ(got.reason, "why");
        EXPECT_EQ(got.state, "ready");
        EXPECT_EQ(got.name, "a peer");
        EXPECT_EQ(got.step, 3);
    }
}

TEST(RoundTrip, Goodbye)
{
    EXPECT_EQ(unpack_goodbye(over_the_wire(pack_goodbye("the end"))), "the end");
}

}  // namespace
}  // namespace gimdem::coupling::message

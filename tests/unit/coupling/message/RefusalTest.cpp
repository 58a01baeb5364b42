// SPDX-License-Identifier: BSD-3-Clause
/// What unpack functions refuse, and what pack functions refuse to send.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "Faults.hpp"
#include "Pair.hpp"
#include "RawMessages.hpp"
#include "message/Codec.hpp"
#include "message/Control.hpp"
#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::coupling::message
{
namespace
{

using test::RawMessage;

double constexpr infinity = std::numeric_limits<double>::infinity();
double constexpr nan = std::numeric_limits<double>::quiet_NaN();
int constexpr cells = 24;

Message decoded(RawMessage message)
{
    message.envelope.set_protocol_major(1);
    transport::Frames frames;
    for (std::string const& text : message.frames())
        frames.emplace_back(text.data(), text.size());
    return decode(std::move(frames));
}

/// The client gets its default fields; the server needs the velocity alone.
Terms terms()
{
    Terms result;
    result.fluid = choose_fluid_fields({"velocity"}, Fault::user);
    result.solid = choose_solid_fields({"void_fraction", "drag_coefficient", "drag_momentum"}, Fault::user);
    result.cell_count = cells;
    return result;
}

void unpack(RawMessage const& raw)
{
    Message const message = decoded(raw);
    switch (message.kind())
    {
        case Kind::kHello:
            unpack_hello(message);
            break;
        case Kind::kWelcome:
            unpack_welcome(message);
            break;
        case Kind::kMesh:
            unpack_mesh(message);
            break;
        case Kind::kFluidState:
            unpack_fluid_state(message, terms());
            break;
        case Kind::kSolidState:
            unpack_solid_state(message, terms());
            break;
        case Kind::kHeartbeat:
            unpack_heartbeat(message);
            break;
        default:
            FAIL() << "no such case";
    }
}

/// Overwrites one number of an array.
template <class T>
void set_number(RawMessage& message, std::size_t array, std::size_t position, T value)
{
    message.arrays[array].replace(position * sizeof(T), sizeof(T), reinterpret_cast<char const*>(&value), sizeof(T));
}

struct Damage
{
    std::string name;
    RawMessage message;
    std::function<void(RawMessage&)> apply;
    std::string text;
};

class DamagedBody : public testing::TestWithParam<Damage>
{
};

TEST_P(DamagedBody, IsRefused)
{
    RawMessage message = GetParam().message;
    ASSERT_NO_THROW(unpack(message));

    GetParam().apply(message);

    EXPECT_FAULT(unpack(message), Fault::protocol, GetParam().text);
}

v1::Hello& hello(RawMessage& m)
{
    return *m.envelope.mutable_hello();
}
v1::Welcome& welcome(RawMessage& m)
{
    return *m.envelope.mutable_welcome();
}
v1::FluidState& fluid(RawMessage& m)
{
    return *m.envelope.mutable_fluid_state();
}
v1::SolidState& solid(RawMessage& m)
{
    return *m.envelope.mutable_solid_state();
}

RawMessage const good_hello = test::raw_hello();
RawMessage const good_welcome = test::raw_welcome();
RawMessage const good_mesh = test::raw_mesh(test::small_mesh());
RawMessage const good_fluid = test::raw_fluid(1, 0, 1e-3, cells);
RawMessage const good_solid = test::raw_solid(1, cells);

std::vector<Damage> const damages{
    {"HelloNameless", good_hello, [](auto& m) { hello(m).clear_name(); }, "client's name is empty"},
    {"HelloDensity", good_hello, [](auto& m) { hello(m).set_density(nan); }, "density is nan"},
    {"HelloViscosity", good_hello, [](auto& m) { hello(m).set_viscosity(-1); }, "viscosity is -1"},
    {"HelloTimeout", good_hello, [](auto& m) { hello(m).set_timeout(0); }, "timeout is 0"},
    {"HelloWants", good_hello, [](auto& m) { hello(m).add_wants("colour"); }, "unknown solid field \"colour\""},
    {"HelloWantsTwice", good_hello, [](auto& m) { hello(m).add_wants("void_fraction"); }, "asked for twice"},
    {"HelloSchedule", good_hello, [](auto& m) { hello(m).set_schedule(static_cast<v1::Schedule>(9)); }, "schedule 9"},
    {"WelcomeNameless", good_welcome, [](auto& m) { welcome(m).clear_server(); }, "server's name is empty"},
    {"WelcomeSchedule", good_welcome, [](auto& m) { welcome(m).clear_schedule(); }, "no schedule"},
    {"WelcomeEnd", good_welcome, [](auto& m) { welcome(m).set_end_time(infinity); }, "end time is inf"},
    {"WelcomeNeeds", good_welcome, [](auto& m) { welcome(m).add_needs("colour"); }, "unknown fluid field \"colour\""},
    {"MeshArrayMissing", good_mesh,
     [](auto& m)
     {
         m.envelope.mutable_arrays()->RemoveLast();
         m.arrays.pop_back();
     },
     "4 arrays instead of 5"},
    {"MeshArrayRenamed", good_mesh, [](auto& m) { m.envelope.mutable_arrays(3)->set_name("landlord"); },
     "array \"owner\" is missing"},
    {"MeshArrayType", good_mesh, [](auto& m) { m.envelope.mutable_arrays(0)->set_type(v1::ELEMENT_TYPE_I64); },
     "\"points\" has another element type"},
    {"MeshIndex", good_mesh, [](auto& m) { set_number<std::int32_t>(m, 3, 5, 1000); }, "owner[5] names cell 1000"},
    {"MeshPatchKind", good_mesh, [](auto& m) { m.envelope.mutable_mesh()->mutable_patches(0)->clear_kind(); },
     "patch \"left\" has an unknown kind 0"},
    {"FluidNan", good_fluid, [](auto& m) { set_number(m, 0, 3 * 7 + 2, nan); },
     "FluidState of step 1: field \"velocity\" has nan in cell 7"},
    {"FluidInfinity", good_fluid, [](auto& m) { set_number(m, 0, 0, -infinity); }, "-inf in cell 0"},
    {"FluidRows", test::raw_fluid(1, 0, 1e-3, cells), [](auto& m) { m = test::raw_fluid(1, 0, 1e-3, cells - 1); },
     "23 rows instead of 24"},
    {"FluidComponents", good_fluid,
     [](auto& m)
     {
         m.envelope.mutable_arrays(0)->set_components(1);
         m.envelope.mutable_arrays(0)->set_count(3 * cells);
     },
     "1 components instead of 3"},
    {"FluidMoreComponents", good_fluid,
     [](auto& m)
     {
         m.envelope.mutable_arrays(0)->set_components(9);
         m.envelope.mutable_arrays(0)->set_count(cells / 3);
     },
     "9 components instead of 3"},
    {"FluidUnasked", good_fluid,
     [](auto& m) { m.add("pressure", v1::ELEMENT_TYPE_F64, 1, std::vector<double>(cells)); }, "2 arrays instead of 1"},
    {"FluidMissing", good_fluid,
     [](auto& m)
     {
         m.envelope.clear_arrays();
         m.arrays.clear();
     },
     "\"velocity\" is missing"},
    {"FluidStepTwoNumbers", good_fluid, [](auto& m) { m.envelope.set_step(2); }, "step 1 in an envelope of step 2"},
    {"FluidMonitors", good_fluid,
     [](auto& m)
     {
         for (int k = 0; k < 300; ++k)
             fluid(m).add_monitors()->set_name("m");
     },
     "300 monitors"},
    {"FluidTimings", good_fluid, [](auto& m) { fluid(m).mutable_previous()->set_compute(-1); }, "compute is -1"},
    {"FluidExchange", good_fluid, [](auto& m) { fluid(m).set_exchange(nan); }, "exchange is nan"},
    {"FluidWaiting", good_fluid, [](auto& m) { fluid(m).set_waiting(-2); }, "waiting is -2"},
    {"SolidNan", good_solid, [](auto& m) { set_number(m, 0, 23, nan); }, "\"void_fraction\" has nan in cell 23"},
    {"SolidBusy", good_solid, [](auto& m) { solid(m).set_busy_time(nan); }, "busy time is nan"},
    {"SolidTimings", good_solid, [](auto& m) { solid(m).mutable_timings()->set_output(infinity); }, "output is inf"},
    {"HeartbeatTimeout", test::raw_heartbeat(), [](auto& m) { m.envelope.mutable_heartbeat()->set_timeout(nan); },
     "timeout is nan"}};

INSTANTIATE_TEST_SUITE_P(Unpack, DamagedBody, testing::ValuesIn(damages),
                         [](auto const& damage) { return damage.param.name; });

TEST(Pack, RefusesAFluidFieldOfTheWrongSize)
{
    std::vector<double> const velocity(3 * cells - 3);
    FluidState state;
    state.fields.velocity = velocity;
    EXPECT_FAULT(pack(state, terms()), Fault::user,
                 "\"velocity\" has 69 numbers (the mesh has 24 cells, 3 each, so 72)");
    state.fields.velocity = {};
    EXPECT_FAULT(pack(state, terms()), Fault::user, "\"velocity\" has 0 numbers");
}

TEST(Pack, RefusesAFieldThatIsNotFinite)
{
    std::vector<double> velocity(3 * cells);
    velocity[3 * 20 + 1] = infinity;
    FluidState state;
    state.fields.velocity = velocity;
    EXPECT_FAULT(pack(state, terms()), Fault::user, "\"velocity\" has inf in cell 20");

    test::SolidArrays arrays(cells, 1);
    arrays.void_fraction[3] = nan;
    SolidState answer;
    answer.fields = arrays.view();
    EXPECT_FAULT(pack(answer, terms()), Fault::user, "\"void_fraction\" has nan in cell 3");
}

TEST(Pack, RefusesNumbersAndNamesThatThePeerWould)
{
    std::vector<double> const velocity(3 * cells);
    FluidState good;
    good.fields.velocity = velocity;
    ASSERT_NO_THROW(pack(good, terms()));

    FluidState state = good;
    state.step.dt = nan;
    EXPECT_FAULT(pack(state, terms()), Fault::user, "step.dt is nan");
    state = good;
    state.previous.output = -1;
    EXPECT_FAULT(pack(state, terms()), Fault::user, "timings.output is -1");
    state = good;
    state.monitors.resize(257);
    EXPECT_FAULT(pack(state, terms()), Fault::user, "257 monitors");
    state.monitors.resize(1);
    EXPECT_FAULT(pack(state, terms()), Fault::user, "a monitor has an empty");
}

TEST(Pack, RefusesAnInconsistentMesh)
{
    Mesh mesh = test::small_mesh();
    mesh.owner[0] = -1;
    EXPECT_FAULT(pack(view_of(mesh)), Fault::user, "owner[0] names cell -1");
}

TEST(Pack, RefusesAnEnvelopeThatThePeerWould)
{
    Message message = pack_goodbye("");
    message.envelope.mutable_goodbye()->set_reason(std::string(2 << 20, 'x'));
    EXPECT_FAULT(encode(std::move(message)), Fault::user, "too large");
}

}  // namespace
}  // namespace gimdem::coupling::message

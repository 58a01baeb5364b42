// SPDX-License-Identifier: BSD-3-Clause
/// How often the numbers of a field are copied between two programs: once on each side at most.
///
/// A copy has another address than its original. So each test follows one array through all that our code does with it:
/// pack, encode, decode, unpack; what ZeroMQ does between encode and decode is its own.
#include <gtest/gtest.h>

#include <vector>

#include "message/Codec.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::coupling::message
{
namespace
{

std::size_t constexpr cells = 5000;  // far more than ZeroMQ keeps in a message's handle

Terms terms(Encodings encodings = {})
{
    Terms result;
    result.fluid = choose_fluid_fields({"velocity"}, Fault::user);
    result.cell_count = cells;
    result.encodings = encodings;
    return result;
}

/// The addresses of the velocity's numbers at each station.
struct Stations
{
    void const *packed, *sent, *received, *seen;
};

Stations follow(Terms const& client, Terms const& server)
{
    std::vector<double> const velocity(3 * cells, 2.5);
    FluidState fluid;
    fluid.step = {1, 0, 1e-3};
    fluid.fields.velocity = velocity;
    Message message = pack(fluid, client);
    Stations at{};
    at.packed = message.arrays[0].data();
    transport::Frames frames = encode(std::move(message));
    at.sent = frames[1].data();
    Message const got = decode(std::move(frames));
    at.received = got.arrays[0].data();
    at.seen = unpack_fluid_state(got, server).fields.velocity.data();
    return at;
}

TEST(Copies, OfADenseFieldAreOneOnTheWayOutAndNoneOnTheWayIn)
{
    Stations const at = follow(terms(), terms());
    EXPECT_EQ(at.packed, at.sent);
    EXPECT_EQ(at.sent, at.received);
    EXPECT_EQ(at.received, at.seen);
}

TEST(Copies, OfASparseFieldAreOneOnEachSide)
{
    Terms both = terms({true, false, false});
    both.needed = {{{"velocity"}, {{100, 1000}}}};
    Stations const at = follow(both, both);
    EXPECT_EQ(at.packed, at.sent);
    EXPECT_EQ(at.sent, at.received);
    EXPECT_NE(at.received, at.seen) << "rows to their cells";
    EXPECT_EQ(at.seen, follow(both, both).seen) << "always to the same memory";
}

TEST(Copies, OfRoundedFieldsAreOneOnEachSide)
{
    Terms const both = terms({false, true, false});
    Stations const at = follow(both, both);
    EXPECT_EQ(at.packed, at.sent);
    EXPECT_EQ(at.sent, at.received);
}

}  // namespace
}  // namespace gimdem::coupling::message

// SPDX-License-Identifier: BSD-3-Clause
#include "message/Codec.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "Faults.hpp"
#include "RawMessages.hpp"
#include "message/Arrays.hpp"

namespace gimdem::coupling::message
{
namespace
{

transport::Frames to_frames(std::vector<std::string> const& texts)
{
    transport::Frames frames;
    for (std::string const& text : texts)
        frames.emplace_back(text.data(), text.size());
    return frames;
}

/// A solid state on 4 cells that decode() accepts.
test::RawMessage good_message()
{
    test::RawMessage message = test::raw_solid(3, 4);
    message.envelope.set_protocol_major(1);
    return message;
}

v1::ArrayHeader& first_header(test::RawMessage& message)
{
    return *message.envelope.mutable_arrays(0);
}

struct Damage
{
    std::string name;
    std::function<void(test::RawMessage&)> apply;
    Fault fault;
    std::string text;
};

class Damaged : public testing::TestWithParam<Damage>
{
};

TEST_P(Damaged, MessageIsRefused)
{
    auto message = good_message();
    ASSERT_NO_THROW(decode(to_frames(message.frames())));

    GetParam().apply(message);

    EXPECT_FAULT(decode(to_frames(message.frames())), GetParam().fault, GetParam().text);
}

std::vector<Damage> const damages{
    {"OlderVersion", [](auto& m) { m.envelope.set_protocol_major(0); }, Fault::version,
     "protocol 0.0 and this side speaks 1."},
    {"NewerVersion", [](auto& m) { m.envelope.set_protocol_major(2); }, Fault::version, "protocol 2.0"},
    {"NoKind", [](auto& m) { m.envelope.clear_kind(); }, Fault::protocol, "without a message"},
    {"EndlessIteration", [](auto& m) { m.envelope.set_iteration(10001); }, Fault::protocol, "iteration 10001"},
    {"NegativeIteration", [](auto& m) { m.envelope.set_iteration(-1); }, Fault::protocol, "iteration -1"},
    {"IterationOfNoStep",
     [](auto& m)
     {
         m = test::raw_goodbye();
         m.envelope.set_protocol_major(1);
         m.envelope.set_iteration(1);
     },
     Fault::protocol, "Goodbye with iteration 1"},
    {"TruncatedFrame", [](auto& m) { m.arrays[0].pop_back(); }, Fault::protocol,
     "31 bytes, but its header promises 4 rows of 8"},
    {"PaddedFrame", [](auto& m) { m.arrays[0] += 'x'; }, Fault::protocol, "33 bytes"},
    {"EmptyFrame", [](auto& m) { m.arrays[0].clear(); }, Fault::protocol, "has 0 bytes"},
    {"MissingFrame", [](auto& m) { m.arrays.pop_back(); }, Fault::protocol,
     "2 array frames, but its envelope describes 3"},
    {"ExtraFrame", [](auto& m) { m.arrays.emplace_back("12345678"); }, Fault::protocol, "4 array frames"},
    {"TooManyFrames", [](auto& m) { m.arrays.resize(40); }, Fault::protocol, "more than 32 frames"},
    {"WrongCount", [](auto& m) { first_header(m).set_count(5); }, Fault::protocol, "5 rows of 8"},
    {"CountThatOverflows", [](auto& m) { first_header(m).set_count((std::uint64_t{1} << 61) + 4); }, Fault::protocol,
     "promises"},
    {"HugeCount", [](auto& m) { first_header(m).set_count(~std::uint64_t{0}); }, Fault::protocol, "promises"},
    {"NoComponents", [](auto& m) { first_header(m).set_components(0); }, Fault::protocol, "0 components"},
    {"ManyComponents", [](auto& m) { first_header(m).set_components(1u << 31); }, Fault::protocol,
     "components (1 to 9)"},
    {"NoType", [](auto& m) { first_header(m).clear_type(); }, Fault::protocol, "unknown element type"},
    {"FutureType", [](auto& m) { first_header(m).set_type(static_cast<v1::ElementType>(99)); }, Fault::protocol,
     "unknown element type"},
    {"CompressedInSharedMemory",
     [](auto& m)
     {
         first_header(m).set_compression(v1::COMPRESSION_SHUFFLED_LZ4);
         first_header(m).set_shared(true);
         m.arrays[0].clear();
     },
     Fault::protocol, "compressed and in shared memory"},
    {"NoName", [](auto& m) { first_header(m).clear_name(); }, Fault::protocol, "name of an array is empty"},
    {"LongName", [](auto& m) { first_header(m).set_name(std::string(300, 'n')); }, Fault::protocol, "300 bytes"},
    {"NameTwice", [](auto& m) { first_header(m).set_name("drag_momentum"); }, Fault::protocol, "comes twice"},
    {"ArraysOnHello", [](auto& m) { m.envelope.mutable_hello(); }, Fault::protocol, "Hello with array frames"},
    {"HugeEnvelope", [](auto& m) { m.envelope.mutable_solid_state()->set_stop_reason(std::string(2 << 20, 'r')); },
     Fault::protocol, "too large"}};

INSTANTIATE_TEST_SUITE_P(Codec, Damaged, testing::ValuesIn(damages),
                         [](auto const& damage) { return damage.param.name; });

TEST(Codec, RefusesWhatIsNoEnvelope)
{
    EXPECT_FAULT(decode({}), Fault::protocol, "without an envelope");
    EXPECT_FAULT(decode(to_frames({"GET / HTTP/1.1"})), Fault::protocol, "cannot be read");
    EXPECT_FAULT(decode(to_frames({""})), Fault::version, "protocol 0.0");
}

TEST(Codec, ShowsTheReasonOfAPeerOfAnotherVersion)
{
    auto message = test::raw_error("I am from the future");
    message.envelope.set_protocol_major(9);
    EXPECT_FAULT(decode(to_frames(message.frames())), Fault::version, "I am from the future");
}

TEST(Codec, ToleratesANewerMinorVersion)
{
    auto message = good_message();
    message.envelope.set_protocol_minor(99);
    EXPECT_NO_THROW(decode(to_frames(message.frames())));
}

TEST(Codec, AlignsEveryArray)
{
    // Small frames come out of ZeroMQ's read buffer and begin anywhere in it.
    std::vector<double> const values{1, 2, 3, 4, 5};
    test::RawMessage raw;
    raw.envelope.set_protocol_major(1);
    raw.envelope.mutable_solid_state();
    raw.add("numbers", v1::ELEMENT_TYPE_F64, 1, values);
    for (std::size_t shift = 0; shift < 8; ++shift)
    {
        std::string buffer = std::string(shift, 'x') + raw.arrays.front();
        transport::Frames frames = to_frames({raw.frames().front()});
        frames.emplace_back(buffer.data() + shift, raw.arrays.front().size(), [](void*, void*) {});

        Message const message = decode(std::move(frames));

        Span<double const> const seen = view_array<double>(message, "numbers", 1, values.size());
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(seen.data()) % sizeof(double), 0u) << shift;
        EXPECT_EQ(std::vector<double>(seen.begin(), seen.end()), values) << shift;
    }
}

TEST(Codec, SurvivesRandomDamage)
{
    std::mt19937 random(20240607);
    std::vector<std::string> const good = good_message().frames();
    int refused = 0;
    int constexpr trials = 20000;
    for (int trial = 0; trial < trials; ++trial)
    {
        auto frames = good;
        std::string& frame = frames[random() % frames.size()];
        frame[random() % frame.size()] = static_cast<char>(random());
        if (random() % 4 == 0) frame.resize(random() % (frame.size() + 1));
        if (test::thrown_by([&] { decode(to_frames(frames)); }) != "(nothing)") ++refused;
    }
    // Damage to the numbers of a field passes here, and so does some to names: but not most of the rest.
    EXPECT_GT(refused, trials / 4);
    EXPECT_LT(refused, trials);
}

}  // namespace
}  // namespace gimdem::coupling::message

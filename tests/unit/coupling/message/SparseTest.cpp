// SPDX-License-Identifier: BSD-3-Clause
/// Fields of some cells, of 32 bits, and compressed: what comes back, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "BoxMesh.hpp"
#include "Faults.hpp"
#include "RawMessages.hpp"
#include "message/Codec.hpp"
#include "message/Compression.hpp"
#include "message/Runs.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::coupling::message
{
namespace
{

using test::RawMessage;

std::size_t constexpr cells = 100;

Terms terms(Encodings encodings)
{
    Terms result;
    result.fluid = choose_fluid_fields({"velocity", "pressure_gradient"}, Fault::user);
    result.solid = choose_solid_fields({"void_fraction", "drag_momentum"}, Fault::user);
    result.cell_count = cells;
    result.encodings = encodings;
    return result;
}

Message over_the_wire(Message message)
{
    return decode(encode(std::move(message)));
}

/// Numbers of all magnitudes and both signs, zeros of both signs among them.
std::vector<double> wild_numbers(std::size_t count, double largest_exponent = 300)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-largest_exponent, largest_exponent), sign(-1, 1);
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = i % 10 == 0 ? std::copysign(0.0, sign(random)) : sign(random) * std::pow(10, exponent(random));
    return numbers;
}

bool same_bits(double const* a, double const* b, std::size_t count)
{
    return std::memcmp(a, b, count * sizeof(double)) == 0;
}

/// The shapes of sets of cells: none, all, one, every other, a block with holes.
std::vector<CellRuns> sets()
{
    CellRuns alternate;
    for (std::int32_t c = 1; c < 100; c += 2)
        alternate.push_back({c, 1});
    return {{}, {{0, 100}}, {{42, 1}}, {{0, 1}, {99, 1}}, alternate, {{0, 17}, {20, 3}, {60, 8}}};
}

bool is_in(CellRuns const& runs, std::size_t c)
{
    return contains(runs, {{static_cast<std::int32_t>(c), 1}});
}

TEST(Sparse, FluidOfEverySetOfCellsComesBackToTheBit)
{
    std::vector<double> const velocity = wild_numbers(3 * cells);
    Terms client = terms({true, false, false}), server = client;
    FluidState sent;
    sent.step = {1, 0, 1e-3};
    sent.fields.velocity = velocity;
    sent.fields.pressure_gradient = velocity;
    // Twice through all sets in one session: what an earlier message left in the store must not show.
    for (int round = 0; round < 2; ++round)
        for (CellRuns const& set : sets())
        {
            client.needed = server.needed = {{{"velocity"}, set}, {{"pressure_gradient"}, set}};
            Message const got = over_the_wire(pack(sent, client));
            FluidState const state = unpack_fluid_state(got, server);
            bool const is_whole = cell_count(set) > 75;
            EXPECT_EQ(state.is_complete, is_whole);
            EXPECT_EQ(static_cast<std::size_t>(got.envelope.arrays(0).count()), is_whole ? cells : cell_count(set));
            for (std::size_t c = 0; c < cells; ++c)
            {
                std::vector<double> const nothing(3, 0.0);
                double const* const expected = is_whole || is_in(set, c) ? &velocity[3 * c] : nothing.data();
                ASSERT_TRUE(same_bits(&state.fields.velocity[3 * c], expected, 3)) << "cell " << c;
                ASSERT_TRUE(same_bits(&state.fields.pressure_gradient[3 * c], expected, 3)) << "cell " << c;
            }
        }
}

TEST(Sparse, RunsThatTheArrayBeforeHasToldAreNotToldAgain)
{
    std::vector<double> const velocity(3 * cells, 1.5);
    Terms client = terms({true, false, false});
    client.needed = {{{"velocity", "pressure_gradient"}, {{3, 4}, {50, 6}}}};
    FluidState sent;
    sent.step = {1, 0, 1e-3};
    sent.fields.velocity = sent.fields.pressure_gradient = velocity;
    Message const message = pack(sent, client);
    EXPECT_EQ(message.envelope.arrays(0).runs_size(), 4);
    EXPECT_EQ(message.envelope.arrays(1).runs_size(), 0);
    EXPECT_EQ(unpack_fluid_state(over_the_wire(pack(sent, client)), client).fields.pressure_gradient[3 * 55], 1.5);
}

TEST(Sparse, CellsWithoutSolidHoldNoSolid)
{
    Terms const both = terms({true, false, false});
    std::vector<double> void_fraction(cells, 1.0), drag_momentum(3 * cells, 0.0);
    SolidState sent;
    sent.cells.solid = CellRuns{{10, 5}, {30, 1}};
    for (std::size_t c : {10u, 11u, 12u, 13u, 14u, 30u})
    {
        void_fraction[c] = 0.5 + 1e-3 * static_cast<double>(c);
        drag_momentum[3 * c + 2] = -7;
    }
    sent.fields.void_fraction = void_fraction;
    sent.fields.drag_momentum = drag_momentum;
    Message const message = over_the_wire(pack(sent, both));
    SolidState const got = unpack_solid_state(message, both);
    EXPECT_EQ(message.arrays[0].size(), 6 * sizeof(double));
    EXPECT_TRUE(same_bits(got.fields.void_fraction.data(), void_fraction.data(), cells));
    EXPECT_TRUE(same_bits(got.fields.drag_momentum.data(), drag_momentum.data(), 3 * cells));
}

TEST(Sparse, RunsWhereFlagsAreSet)
{
    std::mt19937 random(3);
    for (unsigned const density : {0u, 1u, 50u, 99u, 100u})
    {
        std::vector<std::uint8_t> flags(20011);
        for (auto& flag : flags)
            flag = random() % 100 < density;
        CellRuns const runs = runs_where(flags);
        EXPECT_LE(runs.size(), most_runs_sent);
        std::int32_t end = -1;
        for (CellRun const& run : runs)
        {
            EXPECT_GT(run.first, end);
            EXPECT_GT(run.count, 0);
            end = run.first + run.count;
        }
        EXPECT_LE(end, 20011);
        for (std::size_t c = 0; c < flags.size(); ++c)
            ASSERT_TRUE(flags[c] == 0 || is_in(runs, c)) << "cell " << c;
    }
    std::vector<std::uint8_t> blocks(50);
    for (std::size_t const c : {0u, 1u, 2u, 20u, 21u, 24u, 49u})
        blocks[c] = 1;
    CellRuns const runs = runs_where(blocks);  // a gap of two cells costs less than a run
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[1].first, 20);
    EXPECT_EQ(runs[1].count, 5);
    EXPECT_EQ(runs[2].first, 49);
}

TEST(Sparse, ContainsSeesEveryMissingCell)
{
    CellRuns const whole{{5, 10}, {20, 5}};
    EXPECT_TRUE(contains(whole, {}));
    EXPECT_TRUE(contains(whole, {{5, 1}, {14, 1}, {20, 5}}));
    for (CellRuns const& part : {CellRuns{{4, 2}}, CellRuns{{14, 2}}, CellRuns{{5, 10}, {24, 2}}, CellRuns{{15, 1}},
                                 CellRuns{{0, 100}}, CellRuns{{30, 1}}})
        EXPECT_FALSE(contains(whole, part));
}

// ---- what a peer must not send ----

/// A fluid with a sparse velocity of so many rows and these runs.
RawMessage raw_sparse(std::vector<std::uint32_t> const& runs, int rows)
{
    RawMessage message = test::raw_fluid(1, 0, 1e-3, rows);
    message.envelope.mutable_arrays(0)->set_dense(false);
    message.envelope.mutable_arrays(0)->mutable_runs()->Add(runs.begin(), runs.end());
    return message;
}

Message decoded(RawMessage message)
{
    message.envelope.set_protocol_major(1);
    transport::Frames frames;
    for (std::string const& text : message.frames())
        frames.emplace_back(text.data(), text.size());
    return decode(std::move(frames));
}

void unpack(RawMessage const& raw, Encodings encodings = {true, true, true})
{
    Terms server = terms(encodings);
    server.fluid = choose_fluid_fields({"velocity"}, Fault::user);
    server.needed = {{{"velocity"}, {{10, 2}}}};
    unpack_fluid_state(decoded(raw), server);
}

TEST(SparseRefusal, RunsThatCannotBe)
{
    unpack(raw_sparse({10, 2}, 2));
    unpack(raw_sparse({0, 1, 9, 91}, 92));
    struct Malformed
    {
        std::vector<std::uint32_t> runs;
        int rows;
        std::string why;
    };
    std::uint32_t constexpr most = 0xffff'ffff;
    for (Malformed const& bad : std::vector<Malformed>{
             {{10, 2}, 3, "3 rows, but its runs have 2 cells"},
             {{10, 4}, 3, "3 rows, but its runs have 4 cells"},
             {{}, 2, "does not tell its cells"},
             {{10, 2, 12}, 2, "without its number of cells"},
             {{10, 0}, 0, "a run of 0 cells"},
             {{10, 5, 12, 5}, 10, "must rise"},       // overlap
             {{10, 5, 15, 5}, 10, "must rise"},       // no gap
             {{50, 2, 10, 2}, 4, "must rise"},        // order
             {{10, 2, 10, 2}, 4, "must rise"},        // twice
             {{99, 2}, 2, "the mesh has 100 cells"},  // beyond the end by one
             {{100, 1}, 1, "the mesh has 100 cells"},
             {{most, 1}, 1, "the mesh has 100 cells"},
             {{1, most}, 1, "the mesh has 100 cells"},
             {{most, most}, 2, "the mesh has 100 cells"},           // 2^32 would wrap to a small end
             {{most - 9, 11, 5, 2}, 13, "the mesh has 100 cells"},  // so would this
         })
        EXPECT_FAULT(unpack(raw_sparse(bad.runs, bad.rows)), Fault::protocol, bad.why);
    std::vector<std::uint32_t> many;
    for (std::uint32_t k = 0; k <= max_runs; ++k)
        many.insert(many.end(), {2 * k, 1});
    EXPECT_FAULT(unpack(raw_sparse(many, max_runs + 1)), Fault::protocol, "4097 runs of cells");
}

TEST(SparseRefusal, CellsThatAreNeededAndNotSent)
{
    EXPECT_FAULT(unpack(raw_sparse({10, 1}, 1)), Fault::protocol, "lacks cells that the server needs");
    EXPECT_FAULT(unpack(raw_sparse({}, 0)), Fault::protocol, "lacks cells that the server needs");
}

TEST(SparseRefusal, WhatWasNotAgreedOn)
{
    EXPECT_FAULT(unpack(raw_sparse({10, 2}, 2), {false, true, true}), Fault::protocol, "sparse, which was not agreed");
    RawMessage narrow = test::raw_fluid(1, 0, 1e-3, cells / 2);
    narrow.envelope.mutable_arrays(0)->set_type(v1::ELEMENT_TYPE_F32);
    narrow.envelope.mutable_arrays(0)->set_count(cells);
    unpack(narrow);
    EXPECT_FAULT(unpack(narrow, {true, false, true}), Fault::protocol, "32 bits, which was not agreed");
    RawMessage packed = test::raw_fluid(1, 0, 1e-3, cells);
    packed.envelope.mutable_arrays(0)->set_compression(v1::COMPRESSION_SHUFFLED_LZ4);
    EXPECT_FAULT(unpack(packed, {true, true, false}), Fault::protocol, "compressed, which was not agreed");
}

TEST(SparseRefusal, WhatOnlyFieldsMayBe)
{
    for (bool const compressed : {false, true})
    {
        RawMessage mesh = test::raw_mesh(test::BoxMesh::make({1, 1, 1}, {1, 1, 1}));
        v1::ArrayHeader& header = *mesh.envelope.mutable_arrays(0);
        compressed ? header.set_compression(v1::COMPRESSION_SHUFFLED_LZ4) : header.set_dense(false);
        EXPECT_FAULT(decoded(mesh), Fault::protocol, "sparse or compressed (only fields may be)");
    }
}

TEST(SparseRefusal, NeedsThatCannotBe)
{
    v1::SolidState body;
    body.add_needed()->add_fields("velocity");
    body.mutable_needed(0)->mutable_runs()->Add(5);
    body.mutable_needed(0)->mutable_runs()->Add(96);
    EXPECT_FAULT(unpack_needed(body, cells), Fault::protocol, "the mesh has 100 cells");
    body.mutable_needed(0)->set_runs(1, 95);
    EXPECT_EQ(cell_count(*needed_cells(unpack_needed(body, cells), "velocity")), 95u);
    EXPECT_EQ(needed_cells(unpack_needed(body, cells), "pressure"), nullptr);
    body.add_needed()->add_fields("velocity");
    EXPECT_FAULT(unpack_needed(body, cells), Fault::protocol, "twice");
    body.mutable_needed(1)->set_fields(0, "warmth");
    EXPECT_FAULT(unpack_needed(body, cells), Fault::protocol, "unknown fluid field");
    for (int k = 0; k < 4; ++k)
        body.add_needed();
    EXPECT_FAULT(unpack_needed(body, cells), Fault::protocol, "6 sets of needed cells");
}

TEST(SparseRefusal, NanInACellThatTravels)
{
    RawMessage message = raw_sparse({10, 2, 40, 1}, 3);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    std::memcpy(&message.arrays[0][8 * 7], &nan, sizeof(nan));
    EXPECT_FAULT(unpack(message), Fault::protocol, "nan in cell 40");

    std::vector<double> velocity(3 * cells, 1.0);
    velocity[3 * 40 + 1] = nan;
    Terms client = terms({true, false, false});
    client.needed = {{{"velocity", "pressure_gradient"}, {{40, 1}}}};
    FluidState sent;
    sent.step = {1, 0, 1e-3};
    sent.fields.velocity = sent.fields.pressure_gradient = velocity;
    EXPECT_FAULT(pack(sent, client), Fault::user, "nan in cell 40");
}

// ---- float32 ----

FluidState fluid_of(std::vector<double> const& numbers)
{
    FluidState sent;
    sent.step = {1, 0, 1e-3};
    sent.fields.velocity = sent.fields.pressure_gradient = numbers;
    return sent;
}

TEST(Float32, RoundsWithinHalfAUnitInTheLastPlace)
{
    for (bool const sparse : {false, true})
    {
        Terms both = terms({sparse, true, false});
        CellRuns const set{{0, 30}, {50, 2}};
        if (sparse) both.needed = {{{"velocity", "pressure_gradient"}, set}};
        std::vector<double> const numbers = wild_numbers(3 * cells, 36);
        Message const message = over_the_wire(pack(fluid_of(numbers), both));
        FluidState const got = unpack_fluid_state(message, both);
        EXPECT_EQ(message.arrays[0].size(), 3 * sizeof(float) * (sparse ? 32 : cells));
        double worst = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
            if (sparse && !is_in(set, i / 3)) continue;
            // 2^-24 of the magnitude; below 2^-126 floats are 2^-149 apart.
            double const bound = std::max(std::ldexp(std::abs(numbers[i]), -24), std::ldexp(1.0, -150));
            EXPECT_LE(std::abs(got.fields.velocity[i] - numbers[i]), bound);
            if (numbers[i] != 0) worst = std::max(worst, std::abs(got.fields.velocity[i] / numbers[i] - 1));
        }
        EXPECT_GT(worst, std::ldexp(1.0, -26));  // rounded it is
    }
}

TEST(Float32, RefusesWhatNoFloatHolds)
{
    Terms const both = terms({false, true, false});
    std::vector<double> numbers(3 * cells, 1.0);
    numbers[7] = 3.5e38;
    EXPECT_FAULT(pack(fluid_of(numbers), both), Fault::user, "beyond the largest float");
    numbers[7] = std::numeric_limits<double>::infinity();
    EXPECT_FAULT(pack(fluid_of(numbers), both), Fault::user, "inf in cell 2");
}

// ---- compression ----

/// Alike neighbours, as fields have.
std::vector<double> smooth_numbers(std::size_t count)
{
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = 1 + std::sin(0.01 * static_cast<double>(i / 10));
    return numbers;
}

TEST(Compression, ComesBackToTheBit)
{
    for (bool const narrow : {false, true})
    {
        Terms const both = terms({true, narrow, true});
        for (auto const& numbers : {smooth_numbers(3 * cells), wild_numbers(3 * cells, 30)})
        {
            Message const message = over_the_wire(pack(fluid_of(numbers), both));
            FluidState const got = unpack_fluid_state(message, both);
            for (std::size_t i = 0; i < numbers.size(); ++i)
            {
                double const expected = narrow ? static_cast<double>(static_cast<float>(numbers[i])) : numbers[i];
                ASSERT_TRUE(same_bits(&got.fields.velocity[i], &expected, 1));
            }
        }
        Message const smooth = pack(fluid_of(smooth_numbers(3 * cells)), both);
        EXPECT_LT(smooth.arrays[0].size(), 3 * cells * (narrow ? 4 : 8) * 3 / 4);
    }
}

TEST(Compression, CorruptedFramesAreRefusedOrDecodedAndNothingElse)
{
    Terms const both = terms({false, false, true});
    auto const frames = encode(pack(fluid_of(smooth_numbers(3 * cells)), both));
    std::mt19937 random(11);
    int refused = 0;
    for (int trial = 0; trial < 3000; ++trial)
    {
        transport::Frames bad;
        for (auto const& frame : frames)
            bad.emplace_back(frame.data(), frame.size());
        auto* const bytes = static_cast<unsigned char*>(bad[1].data());
        switch (trial % 3)
        {
            case 0:  // truncated
                bad[1] = transport::Frame(bytes, random() % bad[1].size());
                break;
            case 1:  // one byte is another
                bytes[random() % bad[1].size()] ^= static_cast<unsigned char>(1 + random() % 255);
                break;
            default:  // noise
                for (std::size_t i = 0; i < bad[1].size(); ++i)
                    bytes[i] = static_cast<unsigned char>(random());
        }
        std::string const thrown = test::thrown_by([&] { unpack_fluid_state(decode(std::move(bad)), both); });
        if (thrown != "(nothing)")
        {
            EXPECT_THAT(thrown, testing::StartsWith("protocol: "));
            ++refused;
        }
        else
            EXPECT_EQ(trial % 3, 1) << "only a changed literal can pass";
    }
    EXPECT_GT(refused, 2000);
}

TEST(Compression, NeverMoreThanTheHeaderPromises)
{
    std::vector<double> const numbers(3 * cells, 1.5);
    transport::Frame raw(numbers.data(), numbers.size() * sizeof(double));
    v1::ArrayHeader header;
    header.set_name("velocity");
    header.set_type(v1::ELEMENT_TYPE_F64);
    header.set_components(3);
    header.set_compression(v1::COMPRESSION_SHUFFLED_LZ4);
    transport::Frame const packed = compress(raw, sizeof(double));
    ASSERT_GT(packed.size(), 0u);
    std::vector<unsigned char> to;
    for (std::size_t const count : {cells - 1, cells + 1, std::size_t{1}, std::size_t{1} << 40})
    {
        header.set_count(count);
        EXPECT_FAULT(decompress(header, packed, to), Fault::protocol, "array \"velocity\"");
        EXPECT_LE(to.size(), 3 * (cells + 1) * sizeof(double));
    }
    header.set_count(cells);
    decompress(header, packed, to);
    EXPECT_EQ(std::memcmp(to.data(), numbers.data(), to.size()), 0);
}

}  // namespace
}  // namespace gimdem::coupling::message

// SPDX-License-Identifier: BSD-3-Clause
/// Fuzz target: any frames off the wire become a message or a CouplingError, and a message says the same once sent on.
#include <array>
#include <cstdlib>
#include <iostream>

#include "Bytes.hpp"
#include "MessageMaker.hpp"
#include "message/Arrays.hpp"
#include "message/CheckpointMessages.hpp"
#include "message/Codec.hpp"
#include "message/Control.hpp"
#include "message/Greeting.hpp"
#include "message/MeshMessage.hpp"
#include "message/SharedArrays.hpp"
#include "message/StatusMessages.hpp"
#include "message/StepMessages.hpp"

namespace gimdem::fuzz
{
namespace
{

using namespace coupling;
using message::Kind;

/// The finding: what must not be.
[[noreturn]] void report(char const* what)
{
    std::cerr << "finding: " << what << std::endl;
    std::abort();
}

message::Terms make_terms()
{
    message::Terms terms;
    terms.fluid = message::choose_fluid_fields({field::velocity, field::pressure}, Fault::user);
    terms.solid = message::choose_solid_fields({field::void_fraction, field::drag_coefficient, field::drag_momentum},
                                               Fault::user);
    terms.cell_count = 2;
    return terms;
}

message::Terms const& agreed()
{
    static message::Terms const terms = make_terms();
    return terms;
}

/// Reads every number that is handed out, so that a wrong span is seen.
template <class Fields, class Table>
double sum_of(Fields const& fields, Table const& table)
{
    double sum = 0;
    for (auto const& entry : table)
        for (double const value : fields.*entry.values)
            sum += value;
    return sum;
}

void unpack(message::Message const& message)
{
    switch (message.kind())
    {
        case Kind::kHello:
            message::unpack_hello(message);
            message::unpack_resume_point(message.envelope.hello());
            break;
        case Kind::kWelcome:
            message::unpack_welcome(message);
            break;
        case Kind::kMesh:
            message::unpack_mesh(message);
            break;
        case Kind::kMeshAccepted:
            message::check_mesh_accepted(message, 2);
            break;
        case Kind::kFluidState:
            sum_of(message::unpack_fluid_state(message, agreed()).fields, message::fluid_fields);
            break;
        case Kind::kSolidState:
            sum_of(message::unpack_solid_state(message, agreed()).fields, message::solid_fields);
            break;
        case Kind::kHeartbeat:
            message::unpack_heartbeat(message);
            break;
        case Kind::kError:
            message::unpack_error(message);
            break;
        case Kind::kGoodbye:
            message::unpack_goodbye(message);
            break;
        case Kind::kCheckpoint:
            message::unpack_checkpoint_request(message);
            break;
        case Kind::kCheckpointSaved:
            message::unpack_saved_checkpoint(message);
            break;
        case Kind::kStatus:
            message::unpack_status(message);
            break;
        default:
            break;
    }
}

/// The peer's shared memory: of those bytes, and no more.
transport::Mapping const& shared_memory()
{
    std::size_t constexpr bytes = 4096;
    static transport::Mapping const memory(std::calloc(1, bytes), bytes);
    return memory;
}

void check_sent_on(message::Message const& message)
{
    message::Message copy;
    copy.envelope = message.envelope;
    for (transport::Frame const& frame : message.arrays)
        copy.arrays.emplace_back(frame.data(), frame.size());
    message::Message const again = message::decode(message::encode(std::move(copy)));
    if (again.arrays.size() != message.arrays.size() || again.kind() != message.kind())
        report("a message that was accepted is another one once it was sent on");
}

void run(Bytes input)
{
    transport::Frames frames;
    unsigned const way = input.choose(4);
    if (way == 0)
    {
        std::string const text = input.rest();
        frames.emplace_back(text.data(), text.size());
    }
    else
        frames = frames_of(make_message({}, input), input);

    if (!frames.empty()) message::peek_kind(frames.front());
    bool const posted = way == 3 && !frames.empty();
    message::Message message = posted ? message::decode_posted(frames.front()) : message::decode(std::move(frames));
    check_sent_on(message);
    message::announced_segment(message);
    message::attach_shared(message, posted ? &shared_memory() : nullptr);
    if (posted) message::take_in(message, message.arrays.size(), agreed().fluid, agreed().cell_count, agreed().store);
    unpack(message);
}

}  // namespace
}  // namespace gimdem::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    using gimdem::coupling::Fault;
    try
    {
        gimdem::fuzz::run({data, size});
    }
    catch (gimdem::coupling::CouplingError const& error)
    {
        bool const blames_peer = error.fault() == Fault::protocol || error.fault() == Fault::version;
        if (!blames_peer || *error.what() == 0) gimdem::fuzz::report("the peer's mistake is told as another fault");
    }
    return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "MessageMaker.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <google/protobuf/stubs/common.h>
#if GOOGLE_PROTOBUF_VERSION < 4000000
#include <google/protobuf/stubs/logging.h>
#endif

#include "BoxMesh.hpp"
#include "RawMessages.hpp"

namespace gimdem::fuzz
{
namespace
{

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using test::RawMessage;

/// Field numbers of the messages that an envelope can hold, in a row; and 0: none.
unsigned any_kind(Bytes& input)
{
    auto const& kinds = *v1::Envelope::descriptor()->FindOneofByName("kind");
    unsigned const k = input.choose(static_cast<unsigned>(kinds.field_count()) + 1);
    return k == 0 ? 0u : static_cast<unsigned>(kinds.field(static_cast<int>(k) - 1)->number());
}

/// With every field as protobuf has it by default.
RawMessage empty_message(unsigned kind)
{
    RawMessage message;
    auto const* const field = v1::Envelope::descriptor()->FindFieldByNumber(static_cast<int>(kind));
    if (field) v1::Envelope::GetReflection()->MutableMessage(&message.envelope, field);
    return message;
}

double odd_number(Bytes& input)
{
    using Limits = std::numeric_limits<double>;
    std::array<double, 8> constexpr odd{
        0, -1, Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), 1e308, Limits::denorm_min(), 0.1};
    unsigned const which = input.choose(odd.size() + 1);
    return which < odd.size() ? odd[which] : input.raw<double>();
}

std::int64_t odd_count(Bytes& input)
{
    std::array<std::int64_t, 10> constexpr odd{0,
                                               -1,
                                               1,
                                               2,
                                               255,
                                               1 << 20,
                                               std::numeric_limits<std::int32_t>::max(),
                                               std::numeric_limits<std::int32_t>::min(),
                                               std::numeric_limits<std::int64_t>::max(),
                                               std::numeric_limits<std::int64_t>::min()};
    unsigned const which = input.choose(odd.size() + 1);
    return which < odd.size() ? odd[which] : input.raw<std::int64_t>();
}

std::string odd_text(Bytes& input)
{
    switch (input.choose(4))
    {
        case 0:
            return {};
        case 1:
            return std::string(std::size_t{1} << input.choose(15), 'x');
        case 2:
            return "\xC3\x28\xF4\x90";  // no UTF-8
        default:
            return input.text(input.choose(32));
    }
}

void spoil_value(Message& message, FieldDescriptor const& field, Bytes& input)
{
    auto const& fields = *message.GetReflection();
    switch (field.cpp_type())
    {
        case FieldDescriptor::CPPTYPE_DOUBLE:
            return fields.SetDouble(&message, &field, odd_number(input));
        case FieldDescriptor::CPPTYPE_INT32:
            return fields.SetInt32(&message, &field, static_cast<std::int32_t>(odd_count(input)));
        case FieldDescriptor::CPPTYPE_INT64:
            return fields.SetInt64(&message, &field, odd_count(input));
        case FieldDescriptor::CPPTYPE_UINT32:
            return fields.SetUInt32(&message, &field, static_cast<std::uint32_t>(odd_count(input)));
        case FieldDescriptor::CPPTYPE_UINT64:
            return fields.SetUInt64(&message, &field, static_cast<std::uint64_t>(odd_count(input)));
        case FieldDescriptor::CPPTYPE_BOOL:
            return fields.SetBool(&message, &field, input.choose(2) == 1);
        case FieldDescriptor::CPPTYPE_ENUM:
            return fields.SetEnumValue(&message, &field, static_cast<std::int32_t>(input.choose(12)));
        case FieldDescriptor::CPPTYPE_STRING:
            return fields.SetString(&message, &field, odd_text(input));
        default:
            return;
    }
}

/// One field of a message, or of one of those in it, gets a value that it should not have, goes, or comes twice.
void spoil(Message& message, Bytes& input)
{
    auto const& kind = *message.GetDescriptor();
    if (kind.field_count() == 0) return;  // FluidWanted says all by coming
    auto const& field = *kind.field(static_cast<int>(input.choose(static_cast<unsigned>(kind.field_count()))));
    auto const& fields = *message.GetReflection();
    if (!field.is_repeated())
    {
        if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE)
            return spoil(*fields.MutableMessage(&message, &field), input);
        return spoil_value(message, field, input);
    }

    int const size = fields.FieldSize(message, &field);
    unsigned const how = input.choose(4);
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) return fields.AddString(&message, &field, odd_text(input));
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) return;
    if (size == 0 || how == 0) return spoil(*fields.AddMessage(&message, &field), input);
    int const which = static_cast<int>(input.choose(static_cast<unsigned>(size)));
    if (how == 1) return fields.RemoveLast(&message, &field);
    if (how == 2)
        return fields.AddMessage(&message, &field)->CopyFrom(fields.GetRepeatedMessage(message, &field, which));
    spoil(*fields.MutableRepeatedMessage(&message, &field, which), input);
}

RawMessage right_message(unsigned kind, Truth const& truth)
{
    std::vector<std::pair<std::string, unsigned>> const needs{{"velocity", 3}, {"pressure", 1}};
    switch (kind)
    {
        case 10:
            return test::raw_hello();
        case 11:
            return test::raw_welcome();
        case 12:
            return test::raw_mesh(test::BoxMesh::make({1, 1, static_cast<int>(truth.cells)}, {1, 1, 1}));
        case 13:
            return test::raw_mesh_accepted(truth.cells);
        case 14:
            return test::raw_fluid(static_cast<int>(truth.step), truth.time, truth.dt, truth.cells, needs);
        case 15:
            return test::raw_solid(static_cast<int>(truth.step), truth.cells);
        case 16:
            return test::raw_heartbeat();
        case 17:
            return test::raw_error("a reason");
        case 18:
            return test::raw_goodbye();
        default:
            return empty_message(kind);
    }
}

}  // namespace

RawMessage make_message(unsigned kind, Truth const& truth, Bytes& input)
{
    RawMessage message = right_message(kind, truth);
    message.envelope.set_protocol_major(1);
    if (message.envelope.session() == 0) message.envelope.set_session(truth.session);
    for (unsigned mistakes = input.choose(4); mistakes > 0 && !input.empty(); --mistakes)
        spoil(message.envelope, input);
    return message;
}

RawMessage make_message(Truth const& truth, Bytes& input)
{
    return make_message(any_kind(input), truth, input);
}

coupling::transport::Frames frames_of(RawMessage const& message, Bytes& input)
{
#if GOOGLE_PROTOBUF_VERSION < 4000000
    static google::protobuf::LogSilencer const silence;  // about texts that are no UTF-8: we know
#endif
    std::vector<std::string> texts = message.frames();
    for (unsigned mistakes = input.choose(3); mistakes > 0 && !input.empty() && !texts.empty(); --mistakes)
    {
        std::size_t const k = input.choose(static_cast<unsigned>(texts.size()));
        switch (input.choose(6))
        {
            case 0:
                texts[k].resize(input.choose(64));
                break;
            case 1:
                texts.erase(texts.begin() + static_cast<std::ptrdiff_t>(k));
                break;
            case 2:
                texts.insert(texts.begin() + static_cast<std::ptrdiff_t>(k), texts[k]);
                break;
            case 3:
                texts.resize(texts.size() + input.choose(40));
                break;
            case 4:
                texts[k] = input.text(input.choose(200));
                break;
            default:
                if (!texts[k].empty())
                    texts[k][input.raw<std::uint16_t>() % texts[k].size()] = static_cast<char>(input.byte());
        }
    }

    coupling::transport::Frames frames;
    for (std::string const& text : texts)
        frames.emplace_back(text.data(), text.size());
    return frames;
}

}  // namespace gimdem::fuzz
